// node first_drawing.mjs RIDGELINE CHROMIUM EXAMPLES [TIMES]: how long a page of a path of 10,000 points takes from being
// opened until its first picture is drawn, in a headless Chromium that has drawn before, with software rendering. Not a test.
import assert from 'node:assert/strict';
import {readFileSync, statSync, writeFileSync} from 'node:fs';
import {availableParallelism, loadavg} from 'node:os';
import {join} from 'node:path';
import {inBrowser} from './browser.mjs';
import {chromium, examples, folder, pageOf} from './pages.mjs';

const job = {...JSON.parse(readFileSync(join(examples, 'inline.json'), 'utf8')), points: 10000};
const file = join(folder, 'long.json');
writeFileSync(file, JSON.stringify(job));
const page = pageOf(['chamfer', file], 'long');
console.log(`page of ${(statSync(page).size / 1e6).toFixed(2)} MB`);

const visit = `async () => {
  const gl = document.querySelector('#scene canvas').getContext('webgl2');
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits for what is being drawn
  const all = performance.now();
  const marks = Object.fromEntries(performance.getEntriesByType('mark').map((m) => [m.name, Math.round(m.startTime)]));
  ridgeline.show(ridgeline.total / 2);
  ridgeline.picture();
  return {drawn: ridgeline.drawn, all: Math.round(all), marks, next: Math.round(performance.now() - all)};
}`;
console.log(`load of the machine ${loadavg()[0].toFixed(1)}, ${availableParallelism()} cores`);
for (let i = 0; i < Number(process.argv[5] ?? 5); ++i) {
  const {found, errors} = await inBrowser(chromium, page, visit, {isWarm: true});
  assert.ok(found.drawn && errors.length === 0, `${errors}`);
  const marks = Object.entries(found.marks).map(([name, at]) => `${name} ${at}`).join(', ');
  console.log(`first picture after ${found.all} ms (${marks}), the next ${found.next} ms`);
}
