// node predict_test.mjs RIDGELINE CHROMIUM EXAMPLES: the pages of predictions in a browser against the JSON results.
import assert from 'node:assert/strict';
import {readFileSync, statSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {inBrowser} from './browser.mjs';
import {chromium, compute, examples, folder, loads, pageOf, same} from './pages.mjs';

const library = join(folder, 'library.db');
compute(['library', 'import', join(examples, 'library.json'), '--library', library]);

// An example, made quick by fewer samples; the arithmetic is the same.
function jobOf(name, change) {
  const job = JSON.parse(readFileSync(join(examples, 'predict', `${name}.json`), 'utf8'));
  change(job);
  const file = join(folder, `${name}.json`);
  writeFileSync(file, JSON.stringify(job));
  const command = ['predict', file, '--library', library];
  return {result: JSON.parse(compute(command)), page: pageOf(command, name)};
}

// Picks in the first chart, steps by the keyboard, and tells what is shown.
const visit = `async () => {
  const frame = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  await frame();  // a scroll bar that came with the last chart has made all of them narrower
  const svg = document.querySelector('#charts svg');
  const box = svg.getBoundingClientRect();
  const cursors = () => [...document.querySelectorAll('#charts .cursor')].map((c) => Number(c.getAttribute('x1')));
  const readings = () => [...document.querySelectorAll('#charts output')].map((o) => o.textContent);
  svg.dispatchEvent(new PointerEvent('pointerdown', {clientX: box.left + 0.6 * box.width, clientY: box.top + 40, bubbles: true}));
  const picked = {cursors: cursors(), readings: readings(), now: document.getElementById('now').textContent, length: ridgeline.state.length};
  document.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight', cancelable: true, bubbles: true}));
  const color = document.getElementById('color');
  const plain = ridgeline.total > 0 ? ridgeline.picture() : '';
  if (ridgeline.total > 0) {
    color.value = '';
    color.dispatchEvent(new Event('change'));
  }
  await frame();
  return {
    drawn: ridgeline.drawn, picked, stepped: {cursors: cursors(), now: document.getElementById('now').textContent},
    recolored: ridgeline.total > 0 && ridgeline.picture() !== plain, total: ridgeline.total,
    report: Object.fromEntries([...document.querySelectorAll('#report td[data-key]')].map((c) => [c.dataset.key, c.textContent])),
    charts: ridgeline.data.charts.map((c) => ({title: c.title, x: [...c.x.values], series: c.series.map((s) => ({name: s.name, values: [...s.values]}))})),
    shown: document.querySelectorAll('#charts svg .series').length,
    width: document.documentElement.scrollWidth,
  };
}`;

function seriesOf(found, title, name) {
  const chart = found.charts.find((c) => c.title.startsWith(title));
  assert.ok(chart, `no chart ${title} among ${found.charts.map((c) => c.title)}`);
  return chart.series.find((s) => s.name === name).values;
}
const column = (rows, i) => rows.map((row) => row[i]);

// ---- one engagement
const slope = jobOf('slope', (job) => { job.case.N = 256; job.case.tool.nq = 64; });
const one = await inBrowser(chromium, slope.page, visit);
loads(one);
['Fx', 'Fy', 'Fz'].forEach((name, i) => same(seriesOf(one.found, 'Force', name), column(slope.result.F, i), name));
['Dx', 'Dy'].forEach((name, i) => same(seriesOf(one.found, 'Deflection of the tool', name), column(slope.result.D, i), name));
same(seriesOf(one.found, 'Error after each loop', 'error'), slope.result.e_hist, 'e_hist');
assert.ok(seriesOf(one.found, 'Deflection out', 'error').every((e) => e === slope.result.e_mm));
assert.ok(Number(one.found.report.loops) === slope.result.loops && one.found.report.stability === slope.result.stability);
// The three charts over the revolution have one cursor; that of the loops has its own.
const [first, ...others] = one.found.picked.cursors;
assert.ok(first > 100 && others[0] === first && others[1] === first && others[2] !== first, `${one.found.picked.cursors}`);
assert.notEqual(one.found.stepped.cursors[0], first, 'the keyboard does not move the cursor');
assert.ok(one.found.picked.readings.slice(0, 5).every((reading) => reading !== ''), `${one.found.picked.readings}`);

// ---- over the speed, on a phone
const speeds = jobOf('speeds', (job) => { job.case.N = 256; job.case.tool.nq = 64; job.speeds_rpm = {from: 4000, to: 12000, step: 1000}; });
const sweep = await inBrowser(chromium, speeds.page, visit, {size: '500,900', options: ['--force-dark-mode']});
loads(sweep);
assert.ok(sweep.found.width <= 500, `the page is ${sweep.found.width} wide`);
same(seriesOf(sweep.found, 'Machining error', 'error'), speeds.result.e_mm, 'e_mm');
const chatters = speeds.result.stability.map((word, i) => (word === null || word === 'stable' ? null : speeds.result.e_mm[i]));
same(seriesOf(sweep.found, 'Machining error', 'chatters'), chatters, 'chatter');
assert.deepEqual(sweep.found.charts[0].x, speeds.result.speed_rpm);
assert.match(sweep.found.picked.now, /^\d+ rev\/min: (stable|flip|unstable), /);

// ---- along the edge of a port
const port = jobOf('port', (job) => { Object.assign(job, {N: 256, nq: 64, uncertainty: {Kc: 0.1}}); job.along.points = 24; });
assert.ok(statSync(port.page).size < 2e6);
const path = await inBrowser(chromium, port.page, visit);
loads(path);
const {found} = path;
same(seriesOf(found, 'Machining error', 'predicted'), port.result.error, 'error');
same(seriesOf(found, 'Width', 'predicted'), port.result.width, 'width');
const close = (values, wanted, what) => values.forEach((v, i) => assert.ok(Math.abs(v - wanted[i]) <= 1e-12 * Math.abs(wanted[i]), `${what} at ${i}`));
close(found.charts[0].x, port.result.way, 'way');
close(seriesOf(found, 'Greatest force', 'force'), port.result.force.map((f) => Math.hypot(...f)), 'force');
close(seriesOf(found, 'Greatest deflection', 'deflection'), port.result.deflection.map((d) => Math.hypot(...d)), 'deflection');
const wide = seriesOf(found, 'Machining error', '+ spread');
assert.ok(wide.every((v, i) => Math.abs(v - port.result.error[i] - port.result.spread[i]) < 1e-12), 'spread');
same(seriesOf(found, 'Growth', 'multiplier'), port.result.multiplier, 'multiplier');
assert.ok(found.recolored, 'the colour of the path does not change');
assert.ok(found.picked.length > 0 && found.picked.length < found.total, 'picking in a chart does not move the tool');
assert.equal(Number(found.report['report/stations']), port.result.report.stations);

// ---- through a block of stock
const block = jobOf('program', (job) => { Object.assign(job, {N: 256, nq: 64, stability: 'none'}); job.along.step = 4; job.along.stock.cell = 0.2; });
const cut = await inBrowser(chromium, block.page, `async () => ({drawn: ridgeline.drawn, box: ridgeline.data.box})`);
loads(cut);
assert.deepEqual(cut.found.box, {min: [0, 0, -10], max: [20, 20, 0]});
console.log('ok');
