// The part as trimmed analytic surfaces: every surface is drawn whole and its fragments are kept only where they bound
// material, by the same signed distances that the solver uses. Edges are exact at every zoom.
import * as THREE from 'three';
import {surface} from './surface.js';

const MAX_HOLES = 16;

const distances = /* glsl */ `
  uniform vec3 holeOrigin[HOLES];
  uniform mat3 holeAxes[HOLES];    // columns x', y', z'
  uniform vec3 holeProfile[HOLES]; // half straight across, half straight along, R2
  uniform vec2 holeRange[HOLES];   // along z'
  uniform vec3 bodyOrigin;
  uniform mat3 bodyAxes;               // columns across, A1, up
  uniform vec3 bodyHalf;               // block: half sizes; cylinder: outer radius, half length, 0
  uniform float boreRadius;
  uniform float tolerance;
  uniform int cutaway;
  uniform int cap;  // 1: the face of the cut

  float profileDistance(vec2 p, vec3 profile) {
    vec2 q = abs(p) - profile.xy;
    return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - profile.z;
  }
  float material(vec3 p) {
    vec3 b = transpose(bodyAxes) * (p - bodyOrigin);
    #if BLOCK
      vec3 q = abs(b) - bodyHalf;
      float outer = max(q.x, max(q.y, q.z));
    #else
      float outer = max(length(b.xz) - bodyHalf.x, abs(b.y) - bodyHalf.y);
    #endif
    float d = max(outer, boreRadius - length(b.xz));
    for (int i = 0; i < HOLES; ++i) {
      vec3 h = transpose(holeAxes[i]) * (p - holeOrigin[i]);
      float inside = max(profileDistance(h.xy, holeProfile[i]), max(holeRange[i].x - h.z, h.z - holeRange[i].y));
      d = max(d, -inside);
    }
    return d;
  }
`;

function matrix3(columns) {
  const [x, y, z] = columns;
  return new THREE.Matrix3().set(x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]);
}

function uniformsOf(part) {
  const holes = part.holes.slice(0, MAX_HOLES);
  const block = part.shape === 'manifold_block';
  return {
    holeOrigin: {value: holes.map((h) => new THREE.Vector3(...h.position))},
    holeAxes: {value: holes.map((h) => matrix3(h.axes))},
    holeProfile: {value: holes.map((h) => new THREE.Vector3(h.straight_across / 2, h.straight_along / 2, h.radius))},
    holeRange: {value: holes.map((h) => new THREE.Vector2(...h.range))},
    bodyOrigin: {value: new THREE.Vector3(...part.position)},
    bodyAxes: {value: matrix3(part.axes)},
    bodyHalf: {
      value: block ? new THREE.Vector3(...part.size).multiplyScalar(0.5) : new THREE.Vector3(part.outer_radius, part.length / 2, 0),
    },
    boreRadius: {value: part.inner_radius},
    tolerance: {value: 2e-3 * reach(part)},
    cutaway: {value: 0},
  };
}

/** Half the largest extent of the part [mm]. */
export function reach(part) {
  return part.shape === 'manifold_block' ? Math.max(...part.size) / 2 : Math.max(part.outer_radius, part.length / 2);
}

function trimmed(uniforms, isBlock, color, isCap = false) {
  const defines = {HOLES: uniforms.holeOrigin.value.length, BLOCK: isBlock ? 1 : 0};
  const keep = `
    if (cap == 0 && cutaway == 1 && dot(place - holeOrigin[0], holeAxes[0][1]) < 0.0) discard;
    if (material(place) > (cap == 1 ? 0.0 : tolerance)) discard;`;
  return surface(color, {trim: {uniforms: {...uniforms, cap: {value: isCap ? 1 : 0}}, defines, distances, keep}});
}

function basis(axes, origin) {
  const [x, y, z] = axes.map((a) => new THREE.Vector3(...a));
  return new THREE.Matrix4().makeBasis(x, y, z).setPosition(new THREE.Vector3(...origin));
}

function place(mesh, matrix) {
  mesh.matrixAutoUpdate = false;
  mesh.matrix.copy(matrix);
  return mesh;
}

// The wall of a hole: its profile swept along z' (local frame of the hole).
function wallGeometry(hole, half) {
  const a = hole.straight_across / 2;
  const b = hole.straight_along / 2;
  const outline = [];
  for (let corner = 0; corner < 4; ++corner) {
    const [cx, cy] = [[a, b], [-a, b], [-a, -b], [a, -b]][corner];
    for (let i = 0; i <= 32; ++i) {
      const t = (corner + i / 32) * Math.PI / 2;
      outline.push([cx + hole.radius * Math.cos(t), cy + hole.radius * Math.sin(t)]);
    }
  }
  const positions = [];
  const index = [];
  const n = outline.length;
  for (const z of [-half, half]) for (const [x, y] of outline) positions.push(x, y, z);
  for (let i = 0; i < n; ++i) {
    const j = (i + 1) % n;
    index.push(i, j, n + j, i, n + j, n + i);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  return geometry;
}

/** The group of the part's surfaces and a switch for the cut-away view. */
export function partObject(part) {
  const uniforms = uniformsOf(part);
  const group = new THREE.Group();
  const body = basis(part.axes, part.position);
  const isBlock = part.shape === 'manifold_block';
  const outer = trimmed(uniforms, isBlock, 0xb6bec9);
  const inner = trimmed(uniforms, isBlock, 0xc9b18f);
  // What lies outside of this ball is no part of it: walls and the face of the cut go no further.
  const ball = isBlock ? Math.hypot(...part.size) / 2 : Math.hypot(part.outer_radius, part.length / 2);
  const far = (hole) => ball + Math.hypot(...hole.position.map((v, i) => v - part.position[i]));
  if (isBlock) {
    group.add(place(new THREE.Mesh(new THREE.BoxGeometry(...part.size), outer), body));
  } else {
    group.add(place(new THREE.Mesh(new THREE.CylinderGeometry(part.outer_radius, part.outer_radius, part.length, 192, 1), outer), body));
  }
  const length = isBlock ? part.size[1] : part.length;
  group.add(place(new THREE.Mesh(new THREE.CylinderGeometry(part.inner_radius, part.inner_radius, length, 192, 1, true), inner), body));
  for (const hole of part.holes.slice(0, MAX_HOLES)) {
    group.add(place(new THREE.Mesh(wallGeometry(hole, far(hole)), inner), basis(hole.axes, hole.position)));
  }
  // The face of the cut: the plane of A2 and x' through the first hole, where it is material.
  const side = part.holes.length > 0 ? 2 * far(part.holes[0]) : 1;
  const cap = new THREE.Mesh(new THREE.PlaneGeometry(side, side), trimmed(uniforms, isBlock, 0x8d97a5, true));
  if (part.holes.length > 0) {
    const [x, y, z] = part.holes[0].axes;
    group.add(place(cap, basis([x, z, y.map((v) => -v)], part.holes[0].position)));
  }
  cap.visible = false;
  return {group, setCutaway: (on) => { uniforms.cutaway.value = on ? 1 : 0; cap.visible = on; }};
}
