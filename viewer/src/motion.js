// A path in space with what stands beside it, and the tool that plays along it.
import * as THREE from 'three';
import {cssOf, gradient, rangeOf, valueColor} from './color.js';
import {partObject, reach} from './part.js';
import {bandObject, boxObject, loopObject, moveColors, pathObject, placeAt, toolObject, track} from './path.js';
import {makeStage} from './stage.js';

function frameOf(data, line) {
  if (data.focus) return {centre: new THREE.Vector3(...data.focus.centre), size: data.focus.size};
  const cloud = new THREE.Box3().setFromArray(line.points);
  if (data.box) cloud.union(new THREE.Box3(new THREE.Vector3(...data.box.min), new THREE.Vector3(...data.box.max)));
  const extent = 0.6 * cloud.getSize(new THREE.Vector3()).length();
  return {centre: cloud.getCenter(new THREE.Vector3()), size: Math.max(extent, data.part ? reach(data.part) : 0, 1)};
}

/** Shows data.motion in `host`. `told(length, move, point)` hears where the tool is. */
export function motionView(host, data, told) {
  const line = track(data.motion);
  const frame = frameOf(data, line);
  const stage = makeStage(host, {frame, view: data.view ?? [0.9, -1.1, 0.9], up: data.up});
  const {scene} = stage;
  const lines = [];
  const add = (object) => { lines.push(object); scene.add(object); return object; };
  const path = line.count > 1 ? add(pathObject(data.motion, line)) : null;
  const part = data.part ? partObject(data.part) : null;
  if (part) scene.add(part.group);
  if (data.box) scene.add(boxObject(data.box));
  if (data.ridge) add(loopObject(data.ridge, 3));
  if (data.ends) scene.add(bandObject(data.ends));
  stage.onResize((w, h) => { for (const one of lines) one.material.resolution?.set(w, h); });
  // A path of an unknown tool is followed by a pin.
  const pin = 0.01 * frame.size;
  const shape = data.tool ?? {radius: pin, neck_radius: pin / 3, neck_length: 12 * pin, axis: [0, 0, 1], control_to_centre: 0};
  const tool = toolObject(shape);
  scene.add(tool);
  const axis = new THREE.Vector3(...shape.axis);

  const view = {line, stage, total: line.total, length: 0, cutaway: false, hasCutaway: Boolean(part)};
  view.show = (length) => {
    view.length = Math.min(line.total, Math.max(0, length));
    const {move, point} = placeAt(line, view.length);
    tool.position.set(...point).addScaledVector(axis, shape.control_to_centre);
    told(view.length, move, point);
    stage.draw();
  };
  view.stepBy = (by) => {
    const {move} = placeAt(line, view.length);
    view.show(line.lengths[Math.min(line.count - 1, Math.max(0, move + 1 + by))]);
  };
  view.toggleCutaway = () => {
    view.cutaway = !view.cutaway;
    part?.setCutaway(view.cutaway);
    stage.draw();
  };
  // By what the path is coloured: a chart along it, or null: the kinds of move.
  view.colorBy = (chart) => {
    if (path) path.setPieceColors(pieceColors(data.motion, line, chart));
    stage.draw();
  };
  return view;
}

// A colour a piece: that of the chart's value where it ends; grey where the chart has none.
function pieceColors(motion, line, chart) {
  if (!chart) return (piece) => moveColors[motion.names[motion.kinds[piece]]] ?? moveColors.cut;
  const {values} = chart.series[0];
  const order = Array.from(values.keys()).sort((a, b) => chart.at[a] - chart.at[b]);
  const [low, high] = rangeOf(values);
  const far = Math.floor(values.length / 100);  // some series have a value only at every so many places
  const slack = 1e-3;  // the path is drawn in float32 [mm]
  return (piece) => {
    const [from, to] = [line.lengths[piece], line.lengths[piece + 1]];
    const isOutside = from > chart.at[order.at(-1)] + slack || to < chart.at[order[0]] - slack;
    if (isOutside || motion.names[motion.kinds[piece]] === 'rapid') return moveColors.rapid;
    let a = 0;
    let b = order.length - 1;
    while (a < b) {
      const middle = (a + b) >> 1;
      if (chart.at[order[middle]] < to - slack) a = middle + 1; else b = middle;
    }
    const value = [...Array(2 * far + 1).keys()].map((k) => values[order[a + (k % 2 ? -1 : 1) * ((k + 1) >> 1)]]).find(Number.isFinite);
    return value === undefined ? moveColors.rapid : valueColor((value - low) / (high - low || 1));
  };
}

/** What the colours of the path mean: kinds of move, or the values of a chart. */
export function legendOf(motion, chart) {
  const items = [];
  const item = (color, ...text) => {
    const span = document.createElement('span');
    const mark = document.createElement('i');
    mark.style.background = color;
    span.append(mark, ...text);
    items.push(span);
    return mark;
  };
  const kinds = new Set(Array.from(motion.kinds, (k) => motion.names[k]));
  if (!chart) {
    for (const name of kinds) item(cssOf(moveColors[name] ?? moveColors.cut), name.replace('_', ' '));
    return items;
  }
  const [low, high] = rangeOf(chart.series[0].values).map((v) => Number((v * (chart.scale ?? 1)).toPrecision(4)));
  const bar = item(gradient, `${chart.title}: ${low} to ${high} ${chart.unit}`);
  bar.className = 'bar';
  return items;
}
