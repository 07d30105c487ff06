// The numbers of the report and its warnings.
const number = (v, missing) => {
  if (Array.isArray(v)) return v.map((each) => number(each, missing)).join(', ');
  if (typeof v === 'boolean') return v ? 'yes' : 'no';
  if (typeof v === 'number') return Math.abs(v) < 1e-9 ? '0' : String(Number(v.toPrecision(6)));
  return v ?? missing ?? 'not checked';
};

export function showReport(parent, data) {
  const table = document.createElement('table');
  for (const {name, value, unit, key, missing} of data.report ?? []) {
    const row = table.insertRow();
    row.insertCell().textContent = name;
    const cell = row.insertCell();
    cell.textContent = `${number(value, missing)}${unit && value !== null ? ` ${unit}` : ''}`;
    cell.title = value ?? '';
    if (key) cell.dataset.key = key;
  }
  parent.append(table);
  for (const warning of data.warnings ?? []) {
    const item = document.createElement('p');
    item.className = 'warning';
    item.textContent = warning;
    parent.append(item);
  }
  parent.hidden = table.rows.length === 0 && (data.warnings ?? []).length === 0;
}
