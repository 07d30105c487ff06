// The path by kind of move, the ridge line, the chamfer band and the tool that plays along.
import * as THREE from 'three';
import {LineSegments2} from 'three/examples/jsm/lines/LineSegments2.js';
import {LineSegmentsGeometry} from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import {LineMaterial} from 'three/examples/jsm/lines/LineMaterial.js';
import {surface, thinLines} from './surface.js';

export const moveColors = {
  rapid: 0x9aa3ad, approach: 0x0891b2, lead_in: 0x16a34a, cut: 0x2563eb, lead_out: 0xca8a04, retract: 0x9333ea,
  line: 0x2563eb, arc: 0x16a34a, dwell: 0xca8a04,
};

const most_wide = 1500;  // segments: without a graphics card, wide lines are slow

const ridgeColor = new THREE.Color(0xea580c);

/** Pieces of line from positions, x y z of both ends of each; `colors`: the same of their colours. */
function segments(positions, colors, width) {
  if (positions.length / 6 > most_wide) {
    const plain = new THREE.BufferGeometry();
    plain.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    plain.setAttribute('shade', new THREE.BufferAttribute(colors, 3));
    return new THREE.LineSegments(plain, thinLines());
  }
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(positions);
  geometry.setColors(colors);
  return new LineSegments2(geometry, new LineMaterial({linewidth: width, vertexColors: true}));
}

/** The points of the path: start and the end of every move, with length and time along it. */
export function track(motion) {
  const count = motion.kinds.length + 1;
  const points = new Float32Array(3 * count);
  points.set(motion.start, 0);
  points.set(motion.to, 3);
  const lengths = new Float64Array(count);
  for (let i = 1; i < count; ++i) {
    const d = Math.hypot(points[3 * i] - points[3 * i - 3], points[3 * i + 1] - points[3 * i - 2], points[3 * i + 2] - points[3 * i - 1]);
    lengths[i] = lengths[i - 1] + d;
  }
  return {points, lengths, count, total: lengths[count - 1]};
}

/** The point at a length along the track and the index of the move that runs there. */
export function placeAt(track, length) {
  if (track.count < 2) return {move: -1, point: Array.from(track.points)};
  let low = 1;
  let high = track.count - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (track.lengths[middle] < length) low = middle + 1; else high = middle;
  }
  const from = track.lengths[low - 1];
  const span = track.lengths[low] - from;
  const s = span > 0 ? Math.min(1, Math.max(0, (length - from) / span)) : 1;
  const p = track.points;
  const mix = (k) => p[3 * low - 3 + k] + s * (p[3 * low + k] - p[3 * low - 3 + k]);
  return {move: low - 1, point: [mix(0), mix(1), mix(2)]};
}

/** The pieces of the path; setPieceColors(colorOf) gives each the colour that colorOf(piece) says. */
export function pathObject(motion, {points, count}) {
  const positions = new Float32Array(6 * (count - 1));
  for (let i = 1; i < count; ++i) positions.set(points.subarray(3 * i - 3, 3 * i + 3), 6 * (i - 1));
  const colors = new Float32Array(positions.length);
  const object = segments(positions, colors, 2.5);
  const color = new THREE.Color();
  object.setPieceColors = (colorOf) => {
    for (let i = 0; i + 1 < count; ++i) {
      color.set(colorOf(i));
      colors.set([color.r, color.g, color.b, color.r, color.g, color.b], 6 * i);
    }
    if (object.isLineSegments2) object.geometry.setColors(colors);
    else object.geometry.attributes.shade.needsUpdate = true;
  };
  return object;
}

/** A block of stock that one looks through. */
export function boxObject({min, max}) {
  const size = max.map((v, i) => v - min[i]);
  const shape = new THREE.BoxGeometry(...size);
  const group = new THREE.Group();
  group.add(new THREE.Mesh(shape, surface(0x94a3b8, {opacity: 0.25, depthWrite: false})));
  group.add(new THREE.LineSegments(new THREE.EdgesGeometry(shape), new THREE.LineBasicMaterial({color: 0x64748b})));
  group.position.set(...min.map((v, i) => v + size[i] / 2));
  return group;
}

/** A closed curve through the points. */
export function loopObject(points, width) {
  const n = points.length / 3;
  const positions = new Float32Array(6 * n);
  for (let i = 0; i < n; ++i) {
    const j = (i + 1) % n;
    positions.set(points.subarray(3 * i, 3 * i + 3), 6 * i);
    positions.set(points.subarray(3 * j, 3 * j + 3), 6 * i + 3);
  }
  const color = ridgeColor.toArray();
  const colors = Float32Array.from(positions, (_, i) => color[i % 3]);
  return segments(positions, colors, width);
}

/** The chamfer: a band between the borders G1 and G2, ends = x1 y1 z1 x2 y2 z2 a point. */
export function bandObject(ends) {
  const n = ends.length / 6;
  const index = [];
  for (let i = 0; i < n; ++i) {
    const j = (i + 1) % n;
    index.push(2 * i, 2 * i + 1, 2 * j + 1, 2 * i, 2 * j + 1, 2 * j);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(ends, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  // The surfaces are drawn whole: the band lies up to its width below them and is drawn that much nearer.
  const width = Math.hypot(ends[3] - ends[0], ends[4] - ends[1], ends[5] - ends[2]);
  return new THREE.Mesh(geometry, surface(0xf97316, {nearer: 0.75 * width}));
}

/** Ball, neck, shank and holder about the tool axis; origin at the ball's centre. */
export function toolObject(tool) {
  const group = new THREE.Group();
  const steel = surface(0x0f766e, {opacity: 0.75});
  const holder = surface(0x475569, {opacity: 0.5});
  group.add(new THREE.Mesh(new THREE.SphereGeometry(tool.radius, 48, 32), steel));
  const part = (radius, from, to, material) => {
    if (!(radius > 0) || !(to > from)) return;
    const mesh = new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, to - from, 48), material);
    mesh.position.y = (from + to) / 2 - tool.radius;
    group.add(mesh);
  };
  const stickout = tool.stickout ?? tool.neck_length ?? 8 * tool.radius;
  const neck = tool.neck_length ?? stickout;
  part(tool.neck_radius ?? tool.radius * 0.5, tool.radius, neck, steel);
  part(tool.shank_radius, neck, stickout, steel);
  part(tool.holder_radius, stickout, stickout + 4 * (tool.holder_radius ?? 0), holder);
  group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), new THREE.Vector3(...tool.axis));
  return group;
}
