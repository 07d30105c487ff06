// The 3D view: renderer, camera and lights, drawn when something has changed.
import * as THREE from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {lightFrom} from './surface.js';

// Without a graphics card smooth edges cost more than all else: there edges are plain, and pixels are those of the page.
function makeRenderer() {
  const canvas = document.createElement('canvas');
  const plain = {alpha: true, antialias: false, powerPreference: 'high-performance'};
  const context = canvas.getContext('webgl2', plain);
  const told = context?.getExtension('WEBGL_debug_renderer_info');
  const isSoftware = told && /swiftshader|llvmpipe|software|basic render/i.test(context.getParameter(told.UNMASKED_RENDERER_WEBGL));
  const renderer = isSoftware ? new THREE.WebGLRenderer({canvas, context, ...plain}) : new THREE.WebGLRenderer({alpha: true, antialias: true});
  renderer.setPixelRatio(isSoftware ? 1 : Math.min(2, window.devicePixelRatio));
  return renderer;
}

/** A view in `host`; `frame` {centre: Vector3, size} is what is looked at, from `view`, with `up` upwards. */
export function makeStage(host, {frame, view, up}) {
  const renderer = makeRenderer();
  host.prepend(renderer.domElement);
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1e5);
  camera.up.set(...(up ?? [0, 0, 1]));
  lightFrom.copy(camera.up);
  const orbit = new OrbitControls(camera, renderer.domElement);
  const resizing = [];
  const stage = {scene, drawn: false};

  let size = {w: 0, h: 0};
  let waiting = false;
  stage.draw = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      renderer.render(scene, camera);
      if (!stage.drawn) performance.mark('frame');
      stage.drawn = true;
    });
  };
  stage.picture = () => { renderer.render(scene, camera); return renderer.domElement.toDataURL(); };
  stage.onResize = (told) => resizing.push(told);
  stage.resize = () => {
    const {clientWidth: w, clientHeight: h} = host;
    if (!(w > 0 && h > 0) || (w === size.w && h === size.h)) return;
    size = {w, h};
    renderer.setSize(w, h);
    camera.aspect = w / h;
    camera.updateProjectionMatrix();
    for (const told of resizing) told(w, h);
    stage.draw();
  };
  stage.resetView = () => {
    const {centre, size} = frame;
    const narrow = Math.max(1, 1 / camera.aspect);  // a phone is higher than wide
    camera.position.copy(centre).addScaledVector(new THREE.Vector3(...view).normalize(), 2.6 * size * narrow);
    camera.near = size / 200;
    camera.far = size * 50;
    camera.updateProjectionMatrix();
    orbit.target.copy(centre);
    orbit.update();
    stage.draw();
  };
  stage.ready = () => {
    orbit.addEventListener('change', stage.draw);
    new ResizeObserver(stage.resize).observe(host);
    stage.resize();
    stage.resetView();
  };
  return stage;
}
