// What the tests of pages share: the programs under test, and pages made by the command.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

export const [ridgeline, chromium, examples] = process.argv.slice(2);
export const folder = mkdtempSync(join(tmpdir(), 'ridgeline-viewer-test-'));
process.on('exit', () => rmSync(folder, {recursive: true, force: true}));

export const compute = (arguments_) => execFileSync(ridgeline, [...arguments_, '--local', '--quiet'], {maxBuffer: 1 << 28}).toString();

/** The file of the page that a command makes. */
export function pageOf(command, name = 'page') {
  const file = join(folder, `${name}.html`);
  compute([...command, '--format', 'html', '-o', file]);
  return file;
}

/** The page asked the network for nothing but itself, said nothing on the console, and drew. */
export function loads({found, errors, asked}) {
  assert.deepEqual(asked, ['/', '/answer'], 'the page asks for more than itself');
  assert.deepEqual(errors, []);
  assert.equal(found.failed, undefined);
  assert.ok(found.drawn, 'nothing was drawn');
}

/** Numbers that JSON writes as null are gaps. */
export function same(shown, wanted, what) {
  assert.equal(shown.length, wanted.length, what);
  shown.forEach((v, i) => assert.equal(Number.isFinite(v) ? v : null, wanted[i], `${what} at ${i}`));
}
