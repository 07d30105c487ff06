// Machining units as solids: turned ones from their half section, drilled holes and milled faces from their machining data.
import * as THREE from 'three';

const parts = 72;  // of a whole turn
const place = (r, z, angle) => [r * Math.cos(angle), r * Math.sin(angle), z];

/** A loop of the half section as [z, r] pairs. */
export const pairsOf = (points) => Array.from({length: points.length / 3}, (_, i) => [points[3 * i], Math.max(0, points[3 * i + 1])]);

function geometryOf(positions, index) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  return geometry;
}

// A strip of its own for each edge of the loop, so that corners stay sharp.
function skin(loop, from, to) {
  const steps = Math.ceil(parts * (to - from) / (2 * Math.PI));
  const positions = [];
  const index = [];
  for (let e = 0; e < loop.length; ++e) {
    const [za, ra] = loop[e];
    const [zb, rb] = loop[(e + 1) % loop.length];
    if (ra < 1e-9 && rb < 1e-9) continue;
    for (let i = 0; i <= steps; ++i) {
      const angle = from + (to - from) * i / steps;
      const at = positions.length / 3;
      positions.push(...place(ra, za, angle), ...place(rb, zb, angle));
      if (i < steps) index.push(at, at + 1, at + 2, at + 1, at + 3, at + 2);
    }
  }
  return geometryOf(positions, index);
}

const areaOf = (loop) => loop.reduce((sum, [z, r], i) => { const [zn, rn] = loop[(i + 1) % loop.length]; return sum + z * rn - zn * r; }, 0) / 2;

// Outer loops run counter-clockwise, holes clockwise.
function shapesOf(loops) {
  const shapes = [];
  const vectors = (loop) => loop.map(([x, y]) => new THREE.Vector2(x, y));
  const outers = loops.filter((loop) => areaOf(loop) > 0);
  for (const outer of outers) shapes.push(new THREE.Shape(vectors(outer)));
  for (const hole of loops) {
    if (areaOf(hole) >= 0) continue;
    const around = outers.findIndex((outer) => holds(outer, hole[0]));
    shapes[Math.max(0, around)]?.holes.push(new THREE.Path(vectors(hole)));
  }
  return shapes;
}

function holds(loop, [x, y]) {
  let inside = false;
  for (let i = 0, k = loop.length - 1; i < loop.length; k = i++) {
    const [[xi, yi], [xk, yk]] = [loop[i], loop[k]];
    if ((yi > y) !== (yk > y) && x < (xk - xi) * (y - yi) / (yk - yi) + xi) inside = !inside;
  }
  return inside;
}

function cap(loops, angle) {
  const flat = new THREE.ShapeGeometry(shapesOf(loops));
  const at = flat.attributes.position;
  for (let i = 0; i < at.count; ++i) at.setXYZ(i, ...place(at.getY(i), at.getX(i), angle));
  flat.computeVertexNormals();
  return flat;
}

/** Loops of the half section turned about Z; `open`: a quarter is left out, its two faces closed. */
export function turned(loops, material, open) {
  const group = new THREE.Group();
  const [from, to] = open ? [Math.PI / 2, 2 * Math.PI] : [0, 2 * Math.PI];
  for (const loop of loops) group.add(new THREE.Mesh(skin(loop, from, to), material));
  if (open) for (const angle of [from, to]) group.add(new THREE.Mesh(cap(loops, angle), material));
  return group;
}

function drilled({start, direction, diameter, depth, steps}, material) {
  const group = new THREE.Group();
  const stretches = steps?.length ? steps : [{diameter, end_diameter: diameter, length: depth}];
  let along = 0;
  for (const {diameter: wide, end_diameter: narrow, length} of stretches) {
    const mesh = new THREE.Mesh(new THREE.CylinderGeometry((narrow ?? wide) / 2, wide / 2, length, 40), material);
    mesh.position.y = along + length / 2;
    along += length;
    group.add(mesh);
  }
  group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), new THREE.Vector3(...direction).normalize());
  group.position.set(...start);
  return group;
}

function milled(outline, {direction, depth}, material) {
  const out = new THREE.Vector3(...direction).normalize();
  const across = Math.abs(out.z) < 0.9 ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(1, 0, 0);
  const u = across.addScaledVector(out, -across.dot(out)).normalize();
  const v = new THREE.Vector3().crossVectors(out, u);
  const origin = new THREE.Vector3(outline[0][0], outline[0][1], outline[0][2]);
  const flat = outline.map((points) => Array.from({length: points.length / 3}, (_, i) => {
    const p = new THREE.Vector3(points[3 * i], points[3 * i + 1], points[3 * i + 2]).sub(origin);
    return new THREE.Vector2(p.dot(u), p.dot(v));
  }));
  const shape = new THREE.Shape(flat[0]);
  for (const hole of flat.slice(1)) shape.holes.push(new THREE.Path(hole));
  const mesh = new THREE.Mesh(new THREE.ExtrudeGeometry(shape, {depth, bevelEnabled: false}), material);
  mesh.matrixAutoUpdate = false;
  mesh.matrix.makeBasis(u, v, out).setPosition(origin);
  return mesh;
}

/** The solid of a unit. */
export function unitSolid(unit, material, open) {
  if (unit.solid === 'hole') return drilled(unit.machining, material);
  if (unit.solid?.length) return milled(unit.solid, unit.machining, material);
  return turned(unit.section.map(pairsOf), material, open);
}
