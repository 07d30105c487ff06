// One chart: a curve (or several) over a coordinate, with axes, unit and a cursor that follows the tool.
const W = 520;
const H = 190;
const box = {left: 62, right: 508, top: 10, bottom: 158};

function step(span, wanted) {
  const raw = span / wanted;
  const power = 10 ** Math.floor(Math.log10(raw));
  const ratio = raw / power;
  return power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
}

function range(lists) {
  let low = Infinity;
  let high = -Infinity;
  for (const list of lists) for (const v of list) if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
  if (!(low <= high)) return [0, 1];
  const least = Math.max(1e-6, 1e-3 * Math.abs(high));
  if (high - low < least) { const middle = (low + high) / 2; low = middle - least / 2; high = middle + least / 2; }
  return [low, high];
}

function ticks(low, high, wanted) {
  const s = step(high - low, wanted);
  const digits = Math.max(0, -Math.floor(Math.log10(s) + 1e-9));
  const out = [];
  for (let k = Math.ceil(low / s - 1e-9); k * s <= high + 1e-9 * s; ++k) out.push([k * s, (k * s).toFixed(digits)]);
  return out;
}

// At most two points a pixel column: smallest and largest, in order. Gaps are bridged: a series may have a value only at
// some of the places.
function path(xs, ys, toX, toY) {
  let d = '';
  let pen = 'M';
  const emit = (i) => { d += `${pen}${toX(xs[i]).toFixed(1)} ${toY(ys[i]).toFixed(1)}`; pen = 'L'; };
  const stride = Math.max(1, Math.floor(xs.length / 900));
  for (let i = 0; i < xs.length; i += stride) {
    const end = Math.min(i + stride, xs.length);
    let low = -1;
    let high = -1;
    for (let k = i; k < end; ++k) {
      if (!Number.isFinite(ys[k])) continue;
      if (low < 0 || ys[k] < ys[low]) low = k;
      if (high < 0 || ys[k] > ys[high]) high = k;
    }
    if (low < 0) continue;
    emit(Math.min(low, high));
    if (low !== high) emit(Math.max(low, high));
  }
  return d;
}

const escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'})[c]);

// Significant digits that tell neighbouring ticks apart.
const text = (v, span) => Number.isFinite(v) ? v.toFixed(Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(span))))) : '';

/**
 * Draws a chart into `parent`; onPick(index) is called with the index of the value under the pointer. Returns
 * setCursor(index), null: none.
 */
export function drawChart(parent, chart, onPick) {
  const xs = chart.x.values;
  const [x0, x1] = range([xs]);
  const [y0, y1] = range(chart.series.map((s) => s.values));
  const toX = (v) => box.left + (v - x0) / (x1 - x0) * (box.right - box.left);
  const toY = (v) => box.bottom - (v - y0) / (y1 - y0) * (box.bottom - box.top);
  const grid = [
    ...ticks(x0, x1, 7).map(([v, t]) => `<line class="grid" x1="${toX(v)}" x2="${toX(v)}" y1="${box.top}" y2="${box.bottom}"/><text x="${toX(v)}" y="${box.bottom + 14}" text-anchor="middle">${t}</text>`),
    ...ticks(y0, y1, 4).map(([v, t]) => `<line class="grid" x1="${box.left}" x2="${box.right}" y1="${toY(v)}" y2="${toY(v)}"/><text x="${box.left - 5}" y="${toY(v) + 4}" text-anchor="end">${t}</text>`),
  ].join('');
  const curves = chart.series.map((s, i) => `<path class="curve s${i}" d="${path(xs, s.values, toX, toY)}"><title>${escape(s.name)}</title></path>`).join('');
  const legend = chart.series.map((s, i) => `<span class="s${i}">${escape(s.name)} <output></output></span>`).join('');
  const figure = document.createElement('figure');
  figure.innerHTML = `<figcaption>${escape(chart.title)}${chart.unit ? ` [${escape(chart.unit)}]` : ''}<small>${legend}</small></figcaption>
    <svg viewBox="0 0 ${W} ${H}" role="img" aria-label="${escape(chart.title)}">${grid}${curves}
    <line class="cursor" y1="${box.top}" y2="${box.bottom}" x1="-9" x2="-9"/>
    <text x="${(box.left + box.right) / 2}" y="${H - 4}" text-anchor="middle">${escape(chart.x.title)}</text></svg>`;
  parent.append(figure);
  const svg = figure.querySelector('svg');
  const cursor = figure.querySelector('.cursor');
  const outputs = figure.querySelectorAll('output');
  const pick = (event) => {
    const bounds = svg.getBoundingClientRect();
    const x = (event.clientX - bounds.left) / bounds.width * W;
    onPick(nearest(xs, x0 + (x - box.left) / (box.right - box.left) * (x1 - x0)));
  };
  svg.addEventListener('pointerdown', pick);
  svg.addEventListener('pointermove', (event) => { if (event.buttons) pick(event); });
  return (index) => {
    const at = index === null ? -9 : toX(xs[index]);
    cursor.setAttribute('x1', at);
    cursor.setAttribute('x2', at);
    chart.series.forEach((s, i) => { outputs[i].textContent = index === null ? '' : text(s.values[known(s.values, index)], y1 - y0); });
  };
}

/** Index of the value that is nearest to v. */
export function nearest(values, v) {
  let best = 0;
  for (let i = 1; i < values.length; ++i) if (Math.abs(values[i] - v) < Math.abs(values[best] - v)) best = i;
  return best;
}

// The nearest index that has a value.
function known(values, index) {
  for (let k = 0; k < values.length; ++k) {
    if (Number.isFinite(values[index - k])) return index - k;
    if (Number.isFinite(values[index + k])) return index + k;
  }
  return index;
}
