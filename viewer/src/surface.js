// The one material of all surfaces and that of thin lines. Their shaders are short on purpose: without a graphics card most
// of the time until the first picture goes into compiling shaders, and three.js's own are long.
import * as THREE from 'three';

const vertexShader = /* glsl */ `
  uniform float nearer;  // drawn so much nearer to the eye than it lies [mm]
  varying vec3 place;
  varying vec3 across;
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    vec3 seen = (viewMatrix * world).xyz;
    place = world.xyz;
    across = normalMatrix * normal;
    gl_Position = projectionMatrix * vec4(seen * (1.0 - nearer / length(seen)), 1.0);
  }
`;

// Light from all sides, more from above, and a lamp beside the eye. Colours are linear until the last line.
const fragmentShader = (distances, keep) => /* glsl */ `
  uniform vec3 color;
  uniform float opacity;
  uniform vec3 up;
  varying vec3 place;
  varying vec3 across;
  ${distances}
  void main() {
    ${keep}
    vec3 n = normalize(gl_FrontFacing ? across : -across);
    float sky = 0.5 + 0.5 * dot(n, normalize((viewMatrix * vec4(up, 0.0)).xyz));
    float light = mix(0.3, 0.68, sky) + 0.5 * max(0.0, dot(n, normalize(vec3(0.25, 0.45, 1.0))));
    gl_FragColor = vec4(pow(color * light, vec3(1.0 / 2.2)), opacity);
  }
`;

/** Which way is up for the light. */
export const lightFrom = new THREE.Vector3(0, 0, 1);

/**
 * A surface seen from both sides. `nearer`: drawn so much nearer to the eye [mm]. `trim` {uniforms, defines, distances,
 * keep}: GLSL that discards fragments by their `place`. Other options are those of a material.
 */
export function surface(color, {opacity = 1, nearer = 0, trim, ...options} = {}) {
  const material = new THREE.ShaderMaterial({
    side: THREE.DoubleSide, transparent: opacity < 1, ...options, vertexShader, fragmentShader: fragmentShader(trim?.distances ?? '', trim?.keep ?? ''),
    defines: trim?.defines ?? {}});
  material.uniforms = {...trim?.uniforms, color: {value: new THREE.Color(color)}, opacity: {value: opacity}, nearer: {value: nearer}, up: {value: lightFrom}};
  material.paint = (shade, clearness) => {
    material.uniforms.color.value.set(shade);
    material.uniforms.opacity.value = clearness;
  };
  return material;
}

/** Lines a pixel wide in the colours of their ends. */
export const thinLines = () => new THREE.ShaderMaterial({
  vertexShader: /* glsl */ `
    attribute vec3 shade;
    varying vec3 tint;
    void main() { tint = shade; gl_Position = projectionMatrix * (modelViewMatrix * vec4(position, 1.0)); }
  `,
  fragmentShader: /* glsl */ `
    varying vec3 tint;
    void main() { gl_FragColor = vec4(pow(tint, vec3(1.0 / 2.2)), 1.0); }
  `});
