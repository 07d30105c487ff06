// The 3D view: renderer, camera and lights, drawn when something has changed.
import * as THREE from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';

/** A view in `host`; `frame` {centre: Vector3, size} is what is looked at, from `view`, with `up` upwards. */
export function makeStage(host, {frame, view, up}) {
  const renderer = new THREE.WebGLRenderer({antialias: true, alpha: true});
  renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
  host.prepend(renderer.domElement);
  const scene = new THREE.Scene();
  scene.add(new THREE.HemisphereLight(0xffffff, 0x667080, 2.2));
  const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1e5);
  camera.up.set(...(up ?? [0, 0, 1]));
  camera.add(new THREE.DirectionalLight(0xffffff, 1.6));
  scene.add(camera);
  const orbit = new OrbitControls(camera, renderer.domElement);
  const resizing = [];
  const stage = {scene, drawn: false};

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
    if (!(w > 0 && h > 0)) return;
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
    camera.near = size / 500;
    camera.far = size * 100;
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
