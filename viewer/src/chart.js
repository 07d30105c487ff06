// One chart: curves over a coordinate, with axes, unit and a cursor that follows the tool.
import {rangeOf} from './color.js';

const H = 190;
const margin = {left: 62, right: 24, top: 10, bottom: 32};

function step(span, wanted) {
  const raw = span / wanted;
  const power = 10 ** Math.floor(Math.log10(raw));
  const ratio = raw / power;
  return power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
}

// What the axis shows: never less than what numbers tell apart.
function shown(...lists) {
  const [low, high] = rangeOf(...lists);
  const least = Math.max(1e-6, 1e-3 * Math.abs(high));
  const missing = Math.max(0, least - (high - low)) / 2;
  return [low - missing, high + missing];
}

function ticks(low, high, wanted) {
  const s = step(high - low, wanted);
  const digits = Math.max(0, -Math.floor(Math.log10(s) + 1e-9));
  const out = [];
  for (let k = Math.ceil(low / s - 1e-9); k * s <= high + 1e-9 * s; ++k) out.push([k * s, (k * s).toFixed(digits).replace(/^-(0(\.0*)?)$/, '$1')]);
  return out;
}

// At most two points a pixel column: smallest and largest, in order. Gaps are bridged: a series may have a value only at
// some of the places.
function curve(xs, ys, toX, toY) {
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

function dots(xs, ys, toX, toY) {
  let d = '';
  for (let i = 0; i < xs.length; ++i) if (Number.isFinite(ys[i])) d += `M${toX(xs[i]).toFixed(1)} ${toY(ys[i]).toFixed(1)}h0`;
  return d;
}

const escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'})[c]);

// Significant digits that tell neighbouring ticks apart.
const text = (v, span) => Number.isInteger(v) ? String(v) : Number.isFinite(v) ? v.toFixed(Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(span))))) : '';

/**
 * Draws a chart into `parent`; onPick(index) is called with the index of the value under the pointer. Returns
 * setCursor(index), null: none.
 */
export function drawChart(parent, chart, onPick) {
  const xs = chart.x.values;
  const scale = chart.scale ?? 1;
  const series = chart.series.map((s, i) => ({...s, shown: s.values.map((v) => v * scale), look: `s${i} ${s.style ?? 'curve'}`}));
  const [x0, x1] = shown(xs);
  const [y0, y1] = shown(...series.map((s) => s.shown));
  const figure = document.createElement('figure');
  const legend = series.map((s) => `<span class="${s.look}">${escape(s.name)} <output></output></span>`).join('');
  figure.innerHTML = `<figcaption>${escape(chart.title)}${chart.unit ? ` [${escape(chart.unit)}]` : ''}<small>${legend}</small></figcaption>
    <svg role="img" aria-label="${escape(chart.title)}"></svg>`;
  parent.append(figure);
  const svg = figure.querySelector('svg');
  const outputs = figure.querySelectorAll('output');
  let W = 0;
  let at = null;
  const toX = (v) => margin.left + (v - x0) / (x1 - x0) * (W - margin.right - margin.left);
  const toY = (v) => H - margin.bottom - (v - y0) / (y1 - y0) * (H - margin.bottom - margin.top);

  function place() {
    const x = at === null ? -9 : toX(xs[at]);
    const cursor = svg.querySelector('.cursor');
    cursor.setAttribute('x1', x);
    cursor.setAttribute('x2', x);
  }
  // In the pixels of the page, so that letters keep their size on a phone.
  function layOut() {
    const width = Math.max(240, Math.round(figure.clientWidth));
    if (width === W) return;
    W = width;
    const [left, right, top, bottom] = [margin.left, W - margin.right, margin.top, H - margin.bottom];
    const grid = [
      ...ticks(x0, x1, Math.max(3, W / 75)).map(([v, t]) => `<line class="grid" x1="${toX(v)}" x2="${toX(v)}" y1="${top}" y2="${bottom}"/><text x="${toX(v)}" y="${bottom + 14}" text-anchor="middle">${t}</text>`),
      ...ticks(y0, y1, 4).map(([v, t]) => `<line class="grid" x1="${left}" x2="${right}" y1="${toY(v)}" y2="${toY(v)}"/><text x="${left - 5}" y="${toY(v) + 4}" text-anchor="end">${t}</text>`),
    ].join('');
    const curves = series.map((s) => `<path class="series ${s.look}" d="${(s.style === 'dots' ? dots : curve)(xs, s.shown, toX, toY)}"><title>${escape(s.name)}</title></path>`).join('');
    svg.setAttribute('viewBox', `0 0 ${W} ${H}`);
    svg.innerHTML = `${grid}${curves}<line class="cursor" y1="${top}" y2="${bottom}"/>
      <text x="${(left + right) / 2}" y="${H - 4}" text-anchor="middle">${escape(chart.x.title)}</text>`;
    place();
  }
  layOut();
  new ResizeObserver(() => requestAnimationFrame(layOut)).observe(figure);

  const pick = (event) => {
    const bounds = svg.getBoundingClientRect();
    const x = (event.clientX - bounds.left) / bounds.width * W;
    onPick(nearest(xs, x0 + (x - margin.left) / (W - margin.right - margin.left) * (x1 - x0)));
  };
  svg.addEventListener('pointerdown', pick);
  svg.addEventListener('pointermove', (event) => { if (event.buttons) pick(event); });
  return (index) => {
    at = index;
    place();
    series.forEach((s, i) => {
      const place = index === null || s.style === 'dots' ? index : known(s.values, index);
      outputs[i].textContent = place === null ? '' : text(s.shown[place], y1 - y0);
    });
  };
}

/** Index of the value that is nearest to v. */
export function nearest(values, v) {
  let best = 0;
  for (let i = 1; i < values.length; ++i) if (Math.abs(values[i] - v) < Math.abs(values[best] - v)) best = i;
  return best;
}

// The nearest index that has a value, unless that is far: some series have one only at every so many places.
function known(values, index) {
  for (let k = 0; k <= Math.max(1, values.length / 100); ++k) {
    if (Number.isFinite(values[index - k])) return index - k;
    if (Number.isFinite(values[index + k])) return index + k;
  }
  return index;
}
