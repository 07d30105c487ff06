// node units_test.mjs RIDGELINE CHROMIUM EXAMPLES: the page of machining units in a browser against the program.
import assert from 'node:assert/strict';
import {statSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {inBrowser} from './browser.mjs';
import {chromium, compute, examples, folder, loads, pageOf} from './pages.mjs';

const file = join(folder, 'program.json');
writeFileSync(file, compute(['units', 'plan', join(examples, 'units_shaft.json')]));
const program = JSON.parse(compute(['units', 'show', file, '--format', 'json']));

// Chooses a unit in the list, one in the picture and the next by the keyboard; cuts some; plays.
const visit = `async () => {
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const key = (name) => document.dispatchEvent(new KeyboardEvent('keydown', {key: name, cancelable: true, bubbles: true}));
  const chosen = () => ({
    state: ridgeline.state.chosen,
    list: [...document.querySelectorAll('#tree button[aria-pressed=true]')].map((b) => Number(b.dataset.unit)),
    picture: [...document.querySelectorAll('#picture .chosen')].map((p) => Number(p.dataset.unit)),
    now: document.getElementById('now').textContent,
    tools: [...document.querySelectorAll('#tree li > div:not([hidden]) tbody tr')].length,
  });
  const whole = ridgeline.picture();
  document.querySelector('#tree button[data-unit="4"]').click();
  const byList = chosen();
  const faded = ridgeline.picture();
  document.querySelector('#picture .unit[data-unit="7"]').dispatchEvent(new MouseEvent('click', {bubbles: true}));
  const byPicture = chosen();
  key('ArrowDown');
  const byKey = chosen();
  key('Escape');
  const none = chosen();
  ridgeline.show(3);
  const cut = {done: ridgeline.state.length, picture: document.querySelectorAll('#picture .done').length, list: document.querySelectorAll('#tree .done').length};
  const without = ridgeline.picture();
  key('c');
  const closed = ridgeline.picture();
  ridgeline.play();
  for (let i = 0; i < 100 && ridgeline.state.length < 5; ++i) await wait(100);
  return {
    drawn: ridgeline.drawn, byList, byPicture, byKey, none, cut, played: ridgeline.state.length,
    pictures: [whole, faded, without, closed].map((p, i, all) => all.indexOf(p) === i && p.length > 10000),
    units: [...document.querySelectorAll('#tree button')].map((b) => ({number: Number(b.dataset.unit), volume: Number(b.querySelector('output').title), text: b.textContent})),
    drawnUnits: [...document.querySelectorAll('#picture .unit')].filter((p) => p.getAttribute('d').length > 10).length,
    report: Object.fromEntries([...document.querySelectorAll('#report td[data-key]')].map((c) => [c.dataset.key, c.title])),
    width: document.documentElement.scrollWidth,
  };
}`;

const page = pageOf(['units', 'show', file], 'units');
assert.ok(statSync(page).size < 2e6, `${statSync(page).size} bytes`);
const seen = await inBrowser(chromium, page, visit);
loads(seen);
const {found} = seen;
assert.deepEqual(found.units.map((u) => [u.number, u.volume]).sort((a, b) => a[0] - b[0]), program.units.map((u) => [u.number, u.volume]));
for (const unit of found.units) assert.ok(unit.text.includes(program.units[unit.number - 1].kind), unit.text);
assert.equal(found.drawnUnits, program.units.length);
for (const [key, shown] of Object.entries(found.report)) {
  const wanted = key === 'revision' ? program.revision : program.volumes[key.split('/')[1]];
  assert.equal(Number(shown), wanted, key);
}
for (const [name, number] of [['byList', 4], ['byPicture', 7], ['byKey', 8]]) {
  const {state, list, picture, tools, now} = found[name];
  assert.deepEqual([state, list, picture], [number, [number], [number]], name);
  assert.equal(tools, program.units[number - 1].tools.length, name);
  assert.ok(now.includes(program.units[number - 1].kind), now);
}
assert.deepEqual([found.none.state, found.none.list, found.none.picture], [null, [], []]);
assert.deepEqual(found.cut, {done: 3, picture: 3, list: 3});
assert.ok(found.played >= 5, `playing stops at ${found.played}`);
assert.deepEqual(found.pictures, [true, true, true, true], 'pictures are alike');

// ---- planned at once, on a phone
const phone = await inBrowser(chromium, pageOf(['units', 'plan', join(examples, 'units_shaft.json')], 'plan'),
  'async () => ({drawn: ridgeline.drawn, width: document.documentElement.scrollWidth})', {size: '500,900', options: ['--force-dark-mode']});
loads(phone);
assert.ok(phone.found.width <= 500, `the page is ${phone.found.width} wide`);
console.log('ok');
