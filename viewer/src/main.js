// The page: scene, playing, charts and report, from the data embedded in it.
import * as THREE from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {drawChart, nearest} from './chart.js';
import {readData} from './data.js';
import {partObject, reach} from './part.js';
import {bandObject, loopObject, moveColors, pathObject, placeAt, toolObject, track} from './path.js';

const $ = (id) => document.getElementById(id);
const data = readData();
// Charts may share where along the path their values are.
if (data.along) for (const chart of data.charts) { chart.x = data.along; chart.at = data.along.at; }
const state = {length: 0, playing: false, cutaway: false};

$('title').textContent = data.title;
$('subtitle').textContent = data.subtitle ?? '';
document.title = `${data.title} - Ridgeline`;

// ---- scene
const host = $('scene');
const renderer = new THREE.WebGLRenderer({antialias: true, alpha: true});
renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
host.prepend(renderer.domElement);
const scene = new THREE.Scene();
scene.add(new THREE.HemisphereLight(0xffffff, 0x667080, 2.2));
const lamp = new THREE.DirectionalLight(0xffffff, 1.6);
const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1e5);
camera.up.set(...(data.up ?? [0, 0, 1]));
camera.add(lamp);
scene.add(camera);
const orbit = new OrbitControls(camera, renderer.domElement);

const line = track(data.motion);
const moveOf = (piece) => data.motion.moves?.[piece] ?? piece + 1;
const lines = [];
if (line.count > 1) { lines.push(pathObject(data.motion, line)); scene.add(lines[0]); }
let setCutaway = () => {};
if (data.part) {
  const part = partObject(data.part);
  scene.add(part.group);
  setCutaway = part.setCutaway;
} else {
  $('cutaway').hidden = true;
}
if (data.ridge) { lines.push(loopObject(data.ridge, 3)); scene.add(lines.at(-1)); }
if (data.ends) scene.add(bandObject(data.ends));

function bounds() {
  if (data.focus) return {centre: new THREE.Vector3(...data.focus.centre), size: data.focus.size};
  const cloud = new THREE.Box3().setFromArray(line.points);
  return {centre: cloud.getCenter(new THREE.Vector3()), size: Math.max(cloud.getSize(new THREE.Vector3()).length() / 2, data.part ? reach(data.part) : 0, 1)};
}
// A path of an unknown tool is followed by a pin.
const pin = 0.01 * bounds().size;
const shape = data.tool ?? {radius: pin, neck_radius: pin / 3, neck_length: 12 * pin, axis: [0, 0, 1], control_to_centre: 0};
const tool = toolObject(shape);
scene.add(tool);
function resetView() {
  const {centre, size} = bounds();
  const towards = new THREE.Vector3(...(data.view ?? [0.9, -1.1, 0.9])).normalize();
  camera.position.copy(centre).addScaledVector(towards, 2.6 * size);
  camera.near = size / 500;
  camera.far = size * 100;
  camera.updateProjectionMatrix();
  orbit.target.copy(centre);
  orbit.update();
  draw();
}

let waiting = false;
function draw() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    renderer.render(scene, camera);
    window.ridgeline.drawn = true;
  });
}
function resize() {
  const {clientWidth: w, clientHeight: h} = host;
  renderer.setSize(w, h);
  camera.aspect = w / h;
  camera.updateProjectionMatrix();
  for (const one of lines) one.material.resolution?.set(w, h);
  draw();
}

// ---- place along the path
const cursors = [];
const toCentre = shape.control_to_centre;
function show(length) {
  state.length = Math.min(line.total, Math.max(0, length));
  const {move, point} = placeAt(line, state.length);
  tool.position.set(...point).addScaledVector(new THREE.Vector3(...shape.axis), toCentre);
  $('place').value = line.total > 0 ? state.length / line.total : 0;
  for (const follow of cursors) follow(state.length);
  draw();
  if (move < 0) { $('now').textContent = 'no motion'; return; }
  const kind = data.motion.names[data.motion.kinds[move]];
  const feed = data.motion.feed[move];
  $('now').textContent = `${kind.replace('_', ' ')}, move ${moveOf(move)}, X ${point[0].toFixed(3)} Y ${point[1].toFixed(3)} Z ${point[2].toFixed(3)}` + (feed > 0 ? `, F ${feed.toFixed(0)}` : '');
}

// A chart that runs along the path has `at`, the length along the motion at each value.
const last = data.charts?.find((chart) => chart.at)?.at;
const slack = 1e-3;  // the path is drawn in float32 [mm]
const passBegin = last ? last.reduce((a, b) => Math.min(a, b)) : 0;
const passEnd = last ? last.reduce((a, b) => Math.max(a, b)) : 0;
for (const chart of data.charts ?? []) {
  const setCursor = drawChart($('charts'), chart, (index) => {
    setPlaying(false);
    if (chart.at) show(chart.at[index]);
    else setCursor(index);
  });
  if (!chart.at) continue;
  cursors.push((length) => setCursor(length >= passBegin - slack && length <= passEnd + slack ? nearest(chart.at, length) : null));
}
if (!(data.charts ?? []).length) $('charts').hidden = true;

// ---- report, legend
const number = (v) => typeof v === 'number' ? String(Number(v.toPrecision(6))) : v ?? 'not checked';
const table = document.createElement('table');
for (const {name, value, unit, key} of data.report ?? []) {
  const row = table.insertRow();
  row.insertCell().textContent = name;
  const cell = row.insertCell();
  cell.textContent = `${number(value)}${unit && value !== null ? ` ${unit}` : ''}`;
  cell.title = value ?? '';
  if (key) cell.dataset.key = key;
}
$('report').append(table);
for (const warning of data.warnings ?? []) {
  const item = document.createElement('p');
  item.className = 'warning';
  item.textContent = warning;
  $('report').append(item);
}
for (const name of new Set(Array.from(data.motion.kinds, (k) => data.motion.names[k]))) {
  const item = document.createElement('span');
  const mark = document.createElement('i');
  mark.style.background = `#${(moveColors[name] ?? 0x2563eb).toString(16).padStart(6, '0')}`;
  item.append(mark, name.replace('_', ' '));
  $('legend').append(item);
}

// ---- playing
let before = 0;
function tick(now) {
  if (!state.playing) return;
  const seconds = Math.min(0.1, (now - before) / 1000);
  before = now;
  show(state.length + seconds * Number($('speed').value) * line.total / 20);
  if (state.length >= line.total) setPlaying(false);
  requestAnimationFrame(tick);
}
function setPlaying(on) {
  if (on && state.length >= line.total) state.length = 0;
  state.playing = on;
  $('play').textContent = on ? '❚❚' : '▶';
  $('play').setAttribute('aria-label', on ? 'Pause' : 'Play');
  before = performance.now();
  if (on) requestAnimationFrame(tick);
}
function toggleCutaway() {
  state.cutaway = !state.cutaway;
  setCutaway(state.cutaway);
  $('cutaway').setAttribute('aria-pressed', String(state.cutaway));
  draw();
}
function stepTo(by) {
  const {move} = placeAt(line, state.length);
  show(line.lengths[Math.min(line.count - 1, Math.max(0, move + 1 + by))]);
}
$('play').addEventListener('click', () => setPlaying(!state.playing));
$('cutaway').addEventListener('click', toggleCutaway);
$('place').addEventListener('input', () => { setPlaying(false); show(Number($('place').value) * line.total); });
document.addEventListener('keydown', (event) => {
  if (event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement || event.ctrlKey || event.metaKey) return;
  const keys = {' ': () => setPlaying(!state.playing), ArrowRight: () => stepTo(1), ArrowLeft: () => stepTo(-1), c: toggleCutaway, r: resetView};
  const action = keys[event.key];
  if (!action) return;
  event.preventDefault();
  action();
});

window.ridgeline = {
  data, state, drawn: false, show,
  picture: () => { renderer.render(scene, camera); return renderer.domElement.toDataURL(); },
  play: () => setPlaying(true), total: line.total};
orbit.addEventListener('change', draw);
new ResizeObserver(resize).observe(host);
resize();
resetView();
if (data.part && data.cutaway) toggleCutaway();
const first = data.motion.kinds.findIndex((k) => data.motion.names[k] === 'cut');
show(line.lengths[Math.max(0, first)]);
