// The page: what it shows comes from the data embedded in it.
import {drawChart, nearest} from './chart.js';
import {readData} from './data.js';
import {legendOf, motionView} from './motion.js';
import {showReport} from './report.js';
import {unitsView} from './units.js';

const $ = (id) => document.getElementById(id);
performance.mark('script');
const data = readData();
performance.mark('data');
const charts = data.charts ?? [];
// Charts share their coordinate, and where along the path its values are, unless they have one of their own.
for (const chart of charts) { chart.x ??= data.along; chart.at = chart.x.at; }
const state = {length: 0, index: null, playing: false, cutaway: false};

$('title').textContent = data.title;
$('subtitle').textContent = data.subtitle ?? '';
document.title = `${data.title} - Ridgeline`;
document.body.className = data.motion ? '' : data.units ? 'units' : 'flat';

// ---- the path
const cursors = [];  // told the length along the path
const moveOf = (piece) => data.motion.moves?.[piece] ?? piece + 1;
function told(length, move, point) {
  state.length = length;
  $('place').value = view.total > 0 ? length / view.total : 0;
  for (const follow of cursors) follow(length);
  if (move < 0) { $('now').textContent = 'no motion'; return; }
  const kind = data.motion.names[data.motion.kinds[move]];
  const feed = data.motion.feed[move];
  $('now').textContent = `${kind.replace('_', ' ')}, move ${moveOf(move)}, X ${point[0].toFixed(3)} Y ${point[1].toFixed(3)} Z ${point[2].toFixed(3)}` + (feed > 0 ? `, F ${feed.toFixed(0)}` : '');
}

// ---- machining units
function toldUnits({number, done, list}) {
  state.length = done;
  state.chosen = number;
  $('place').value = done / Math.max(1, list.length);
  const chosen = list.find((unit) => unit.number === number);
  const cut = done === 0 ? 'nothing is cut yet' : `${done} of ${list.length} cut, the last: ${list[done - 1].label.trim()}`;
  $('now').textContent = chosen ? `${chosen.label.trim()}, process ${chosen.process}, ${chosen.volume.toFixed(3)} mm³` : cut;
}
function makeView() {
  if (data.motion) return motionView($('scene'), data, told);
  if (!data.units) return null;
  for (const id of ['picture', 'tree', 'choosing']) $(id).hidden = false;
  return unitsView({host: $('scene'), picture: $('picture'), tree: $('tree')}, data, toldUnits);
}
const view = makeView();
performance.mark('scene');

// ---- charts
const sharing = new Map();  // coordinate -> cursors of its charts
function showIndex(x, index) {
  for (const setCursor of sharing.get(x)) setCursor(index);
  if (x !== data.along) return;
  state.index = index;
  $('place').value = index / Math.max(1, x.values.length - 1);
  $('now').textContent = x.labels?.[index] ?? `${x.title}: ${Number(x.values[index].toPrecision(6))}`;
}
const slack = 1e-3;  // the path is drawn in float32 [mm]
for (const chart of charts) {
  const setCursor = drawChart($('charts'), chart, (index) => {
    setPlaying(false);
    if (chart.at) view.show(chart.at[index]);
    else showIndex(chart.x, index);
  });
  if (!chart.at) {
    sharing.set(chart.x, [...(sharing.get(chart.x) ?? []), setCursor]);
    continue;
  }
  const begin = chart.at.reduce((a, b) => Math.min(a, b));
  const end = chart.at.reduce((a, b) => Math.max(a, b));
  cursors.push((length) => setCursor(length >= begin - slack && length <= end + slack ? nearest(chart.at, length) : null));
}
if (charts.length === 0) $('charts').hidden = true;
showReport($('report'), data);
if ($('report').hidden) document.body.classList.add('alone');

// ---- what the path's colours say
const colors = $('color');
const colorings = charts.filter((chart) => chart.at);
if (data.motion) {
  for (const [value, name] of [['', 'kind of move'], ...colorings.map((chart, i) => [i, chart.title])]) colors.add(new Option(name, value));
  colors.value = data.color === undefined ? '' : String(colorings.indexOf(charts[data.color]));
}
function recolor() {
  const chart = colors.value === '' ? null : colorings[Number(colors.value)];
  view.colorBy(chart);
  $('legend').replaceChildren(...legendOf(data.motion, chart));
}

// ---- playing
let before = 0;
let playhead = 0;
function tick(now) {
  if (!state.playing) return;
  const seconds = Math.min(0.1, (now - before) / 1000);
  before = now;
  playhead += seconds * Number($('speed').value) * view.total / 20;
  view.show(playhead);
  if (playhead >= view.total) setPlaying(false);
  requestAnimationFrame(tick);
}
function setPlaying(on) {
  playhead = state.length >= view?.total ? 0 : state.length;
  state.playing = on;
  $('play').textContent = on ? '❚❚' : '▶';
  $('play').setAttribute('aria-label', on ? 'Pause' : 'Play');
  before = performance.now();
  if (on) requestAnimationFrame(tick);
}
function toggleCutaway() {
  view.toggleCutaway();
  state.cutaway = view.cutaway;
  $('cutaway').setAttribute('aria-pressed', String(view.cutaway));
}

// ---- hands
const last = (data.along?.values.length ?? 1) - 1;
const stepIndex = (by) => showIndex(data.along, Math.min(last, Math.max(0, (state.index ?? -1) + by)));
if (data.units) { state.chosen = null; state.cutaway = true; }
const keys = view
  ? {' ': () => setPlaying(!state.playing), ArrowRight: () => view.stepBy(1), ArrowLeft: () => view.stepBy(-1), c: toggleCutaway, r: view.stage.resetView}
  : {ArrowRight: () => stepIndex(1), ArrowLeft: () => stepIndex(-1), Home: () => showIndex(data.along, 0), End: () => showIndex(data.along, last)};
$('play').addEventListener('click', () => setPlaying(!state.playing));
$('cutaway').addEventListener('click', toggleCutaway);
colors.addEventListener('change', recolor);
$('place').addEventListener('input', () => {
  setPlaying(false);
  const place = Number($('place').value);
  if (view) view.show(place * view.total);
  else showIndex(data.along, Math.round(place * last));
});
if (data.units) Object.assign(keys, {ArrowDown: () => view.chooseBy(1), ArrowUp: () => view.chooseBy(-1), Escape: () => view.choose(null)});
document.addEventListener('keydown', (event) => {
  if (event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement || event.ctrlKey || event.metaKey) return;
  const action = keys[event.key];
  const isPressed = event.target instanceof HTMLButtonElement && event.key === ' ';  // the button's own
  if (!action || isPressed) return;
  event.preventDefault();
  action();
});
$('cutaway').hidden = !view?.hasCutaway;
for (const id of ['play', 'speed']) $(id).hidden = !view;
$('hint').hidden = Boolean(view);
$('coloring').hidden = colorings.length === 0;

window.ridgeline = {
  data, state, total: view?.total ?? 0,
  get drawn() { return view ? view.stage.drawn : true; },
  show: (length) => view.show(length), picture: () => view.stage.picture(), play: () => setPlaying(true)};
if (data.units) {
  $('cutaway').setAttribute('aria-pressed', 'true');
  view.show(0);
  view.stage.ready();
} else if (view) {
  recolor();
  if (data.cutaway && view.hasCutaway) toggleCutaway();
  const first = data.motion.kinds.findIndex((k) => data.motion.names[k] === 'cut');
  view.show(view.line.lengths[Math.max(0, first)]);
  view.stage.ready();
} else if (data.along) {
  showIndex(data.along, 0);
}
performance.mark('page');
