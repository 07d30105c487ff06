// A program of machining units: solids, half section and tree, of which one unit is chosen in all at once.
import * as THREE from 'three';
import {drawSection} from './section.js';
import {pairsOf, turned, unitSolid} from './solid.js';
import {makeStage} from './stage.js';
import {surface} from './surface.js';

const round = (v) => String(Number(v.toPrecision(6)));

// Colours of units are as those of the half section.
const colorOf = (hue) => new THREE.Color(`hsl(${hue}, 65%, 52%)`);

function toolTable(unit) {
  const table = document.createElement('table');
  const columns = [['pattern', 'step'], ['tool', 'tool'], ['number', 'T'], ['depth_of_cut', 'depth of cut [mm]'],
    ['finish_allowance', 'allowance [mm]'], ['cutting_speed', 'speed [m/min]'], ['feed_per_revolution', 'feed [mm/rev]']];
  const head = table.createTHead().insertRow();
  for (const [, title] of columns) head.append(Object.assign(document.createElement('th'), {textContent: title}));
  const body = table.createTBody();
  for (const tool of unit.tools) {
    const row = body.insertRow();
    for (const [key] of columns) row.insertCell().textContent = typeof tool[key] === 'number' ? round(tool[key]) : tool[key] ?? '';
  }
  return table;
}

function treeOf(list, choose) {
  const root = document.createElement('div');
  const items = new Map();
  for (const process of [1, 2]) {
    const units = list.filter((unit) => unit.process === process);
    if (units.length === 0) continue;
    const head = document.createElement('h2');
    head.textContent = `Process ${process}, ${process === 1 ? 'main' : 'sub'} spindle`;
    const all = document.createElement('ol');
    for (const unit of units) {
      const item = document.createElement('li');
      const button = document.createElement('button');
      button.type = 'button';
      button.dataset.unit = unit.number;
      const mark = document.createElement('i');
      mark.style.setProperty('--hue', unit.hue);
      const volume = document.createElement('output');
      volume.textContent = `${unit.volume.toFixed(1)} mm³`;
      volume.title = unit.volume;
      const state = document.createElement('small');
      state.textContent = unit.state === 'auto' ? '' : unit.state;
      button.append(mark, unit.label.trim(), state, volume);
      button.addEventListener('click', () => choose(unit.number));
      const more = document.createElement('div');
      more.hidden = true;
      more.append(toolTable(unit));
      for (const note of unit.notes ?? []) more.append(Object.assign(document.createElement('p'), {className: 'warning', textContent: note}));
      item.append(button, more);
      all.append(item);
      items.set(unit.number, {button, more});
    }
    root.append(head, all);
  }
  return {root, items};
}

/** Shows data.units. `told(view)` hears of every change; view.number: the chosen unit or null, view.done: how many are cut. */
export function unitsView({host, picture, tree}, data, told) {
  const {list, box} = data.units;
  const centre = new THREE.Vector3(0, 0, (box.z0 + box.z1) / 2);
  const size = 1.2 * Math.hypot(box.r1, (box.z1 - box.z0) / 2);
  const stage = makeStage(host, {frame: {centre, size}, view: [0.55, 1.2, 0.25], up: [1, 0, 0]});
  const view = {stage, total: list.length, number: null, done: 0, cutaway: true, hasCutaway: true, list};

  const body = surface(0xb6bec9);
  const cavity = new THREE.Color(0x1f2937);
  // Units overlap where the program says so: one of them is nearer by a few steps of the depth.
  const materials = list.map((unit, i) => surface(colorOf(unit.hue), {
    transparent: true, polygonOffset: true, polygonOffsetUnits: -1 - (i % 8)}));
  let solids = [];
  function build() {
    for (const old of stage.scene.children.filter((child) => child.userData.solid)) stage.scene.remove(old);
    const add = (object) => { object.userData.solid = true; stage.scene.add(object); return object; };
    add(turned(data.units.product.map(pairsOf), body, view.cutaway));
    solids = list.map((unit, i) => add(unitSolid(unit, materials[i], view.cutaway)));
  }
  build();

  const mark = drawSection(picture, data.units, (number) => view.choose(number));
  const {root, items} = treeOf(list, (number) => view.choose(number === view.number ? null : number));
  tree.append(root);

  function show() {
    list.forEach((unit, i) => {
      const isDone = i < view.done;
      const isChosen = unit.number === view.number;
      const isCavity = unit.solid !== null && isDone;  // what is drilled or milled stays visible as a hole
      solids[i].visible = !isDone || isCavity || isChosen;
      materials[i].paint(isCavity && !isChosen ? cavity : colorOf(unit.hue), view.number === null || isChosen ? 1 : 0.25);
      materials[i].depthTest = !isChosen;
      materials[i].depthWrite = view.number === null || isChosen;
      solids[i].renderOrder = isChosen ? 1 : 0;
      const {button, more} = items.get(unit.number);
      button.setAttribute('aria-pressed', String(isChosen));
      button.classList.toggle('done', isDone);
      more.hidden = !isChosen;
    });
    mark(view.number, view.done);
    told(view);
    stage.draw();
  }
  view.choose = (number) => {
    view.number = number;
    show();
    if (number !== null) items.get(number).button.scrollIntoView({block: 'nearest'});
  };
  view.chooseBy = (by) => {
    const at = list.findIndex((unit) => unit.number === view.number);
    const next = at < 0 ? (by > 0 ? 0 : list.length - 1) : Math.min(list.length - 1, Math.max(0, at + by));
    view.choose(list[next]?.number ?? null);
  };
  view.show = (done) => {
    view.done = Math.min(list.length, Math.max(0, Math.round(done)));
    show();
  };
  view.stepBy = (by) => view.show(view.done + by);
  view.toggleCutaway = () => {
    view.cutaway = !view.cutaway;
    build();
    show();
  };
  return view;
}
