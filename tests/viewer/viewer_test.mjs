// node viewer_test.mjs RIDGELINE CHROMIUM EXAMPLES: the page of a path in a browser against the JSON result.
import assert from 'node:assert/strict';
import {readFileSync, statSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {inBrowser} from './browser.mjs';
import {chromium, compute, examples, folder, loads, pageOf} from './pages.mjs';

// Everything that one visit can tell.
const visit = `async () => {
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const at = ridgeline.state.length;
  ridgeline.show(0);
  const before = ridgeline.picture();
  ridgeline.show(ridgeline.total / 2);
  const after = ridgeline.picture();
  ridgeline.show(0);
  ridgeline.play();
  await wait(400);
  const played = ridgeline.state.length;
  const key = (name) => document.dispatchEvent(new KeyboardEvent('keydown', {key: name, cancelable: true, bubbles: true}));
  key(' ');
  const stopped = !ridgeline.state.playing;
  key('ArrowRight');
  const stepped = ridgeline.state.length;
  const cutaway = ridgeline.state.cutaway;
  key('c');
  const svg = document.querySelector('#charts svg');
  const box = svg?.getBoundingClientRect();
  svg?.dispatchEvent(new PointerEvent('pointerdown', {clientX: box.left + 0.6 * box.width, clientY: box.top + 40, bubbles: true}));
  return {
    drawn: ridgeline.drawn, at, pictures: [before.length, after.length, before === after], played, stopped, stepped,
    cutawayTurned: ridgeline.state.cutaway !== cutaway, picked: ridgeline.state.length, total: ridgeline.total,
    cursor: Number(document.querySelector('#charts .cursor')?.getAttribute('x1')),
    curves: [...document.querySelectorAll('#charts path.curve')].map((c) => c.getAttribute('d').length),
    now: document.getElementById('now').textContent,
    report: Object.fromEntries([...document.querySelectorAll('#report td[data-key]')].map((c) => [c.dataset.key, c.title])),
    charts: ridgeline.data.charts.map((c) => ({title: c.title, x: [...c.x.values], series: c.series.map((s) => [...s.values])})),
    width: document.documentElement.scrollWidth,
  };
}`;

// ---- a chamfer, wide and dark
const job = join(examples, 'inline.json');
const result = JSON.parse(compute(['chamfer', job]));
const page = pageOf(['chamfer', job]);
const seen = await inBrowser(chromium, page, visit);
loads(seen);
const {found} = seen;
assert.ok(found.pictures[0] > 10000 && found.pictures[1] > 10000, `the pictures are empty: ${found.pictures}`);
assert.equal(found.pictures[2], false, 'the tool did not move in the picture');
assert.ok(found.played > 0, 'playing does not move the tool');
assert.ok(found.stopped && found.stepped > 0 && found.cutawayTurned, 'the keyboard does nothing');
assert.ok(found.picked > 0 && found.picked < found.total && found.cursor > 100, 'picking in a chart does not move the tool');
assert.ok(found.now.includes('cut'), found.now);
assert.ok(found.curves.length >= 5 && found.curves.every((length) => length > 100), `${found.curves}`);

// The report is the JSON's.
for (const [key, shown] of Object.entries(found.report)) assert.equal(shown === '' ? null : Number(shown), result.report[key], key);
assert.equal(Object.keys(found.report).length, 12);

// The charts are the JSON's: the computed widths are those of "ends" by ascending parameter, the feeds those of "moves".
const chart = (title) => found.charts.find((c) => c.title === title);
const order = result.parameter.map((u, i) => [u, i]).sort((a, b) => a[0] - b[0]).map(([, i]) => i);
const ends = order.map((i) => { const [a, b, c, d, e, f] = result.ends[i]; return Math.hypot(a - d, b - e, c - f); });
const [measured, computed] = chart('Chamfer width').series;
const shown = computed.filter((v) => v !== null && Number.isFinite(v));
assert.equal(shown.length, ends.length);
shown.forEach((v, i) => assert.ok(Math.abs(v - ends[i]) < 1e-12, `width at point ${i}: ${v} and ${ends[i]}`));
const slack = 1e-9;
assert.ok(Math.min(...measured) >= result.report.width_min - slack && Math.max(...measured) <= result.report.width_max + slack);
const feeds = new Set(result.moves.filter((m) => m.kind === 'cut').map((m) => m.feed.toFixed(3)));
for (const feed of chart('Feed of the control point').series[0]) assert.ok(feeds.has(feed.toFixed(3)), `feed ${feed}`);
const error = Math.max(...chart('Distance of the path from the ideal one').series[0]);
assert.ok(error <= result.report.chord_error + 1e-3, `error ${error}`);  // the page's path is rounded as the program
const clear = chart('Clearance of neck and shank').series[0].filter((v) => v !== null && Number.isFinite(v));
assert.ok(clear.length > 10 && Math.min(...clear) >= 0.98 * result.report.neck_clearance - 1e-5, `${Math.min(...clear)}`);  // clearance_relative

// ---- a phone
const phone = await inBrowser(chromium, page, visit, {size: '500,900', options: ['--force-dark-mode']});
loads(phone);
assert.ok(phone.found.width <= 500, `the page is ${phone.found.width} wide`);

// ---- other motions, and a long path in a small page
const program = join(folder, 'program.nc');
writeFileSync(program, 'O1\nG90 G0 X10 Y0 Z5\nG1 Z0 F200\nG2 X0 Y-10 I-10 J0 F300\nG1 X-10\nG0 Z5\nM30\n%\n');
loads(await inBrowser(chromium, pageOf(['macro', 'run', program], 'macro'), `async () => ({drawn: ridgeline.drawn})`));
const standing = join(folder, 'standing.nc');
writeFileSync(standing, 'O2\n#100=1\nM30\n%\n');
const drawn = 'async () => ({drawn: ridgeline.drawn})';
loads(await inBrowser(chromium, pageOf(['macro', 'run', standing], 'standing'), drawn));

const long = JSON.parse(readFileSync(job, 'utf8'));
long.points = 10000;
const longJob = join(folder, 'long.json');
writeFileSync(longJob, JSON.stringify(long));
const longPage = pageOf(['chamfer', longJob], 'long');
assert.ok(statSync(longPage).size < 2e6, `${statSync(longPage).size} bytes`);
loads(await inBrowser(chromium, longPage, drawn));
console.log('ok');
