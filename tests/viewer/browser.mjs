// A page in headless Chromium with software rendering: what it says on the console, what it asks of the network, and what
// a script finds in it.
import {spawn} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {createServer} from 'node:http';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

// Before the page's own scripts: errors of any kind.
const watch = `<script>
  window.seen = {errors: []};
  addEventListener('error', (e) => seen.errors.push(String(e.message)));
  addEventListener('unhandledrejection', (e) => seen.errors.push(String(e.reason)));
  for (const level of ['error', 'warn']) console[level] = (...all) => seen.errors.push(all.join(' '));
</script>`;

const patience = 90000;  // a loaded machine without a graphics card [ms]

// Brings up all that a browser starts with its first picture, then goes to the page.
const warmUp = `<!DOCTYPE html><html lang="en"><head><link rel="icon" href="data:,"></head><body><canvas></canvas><script>
  const gl = document.querySelector('canvas').getContext('webgl2');
  gl.clear(gl.COLOR_BUFFER_BIT);
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  setTimeout(() => { location.href = '/page'; }, 1000);
</script></body></html>`;

function answerOf(chromium, text, folder, size, options, isWarm) {
  return new Promise((resolve, reject) => {
    const asked = [];
    let browser = null;
    const server = createServer((request, response) => {
      asked.push(request.url);
      if (request.method !== 'POST') {
        response.setHeader('Content-Type', 'text/html; charset=utf-8');
        response.end(request.url === (isWarm ? '/page' : '/') ? text : isWarm && request.url === '/' ? warmUp : '');
        return;
      }
      let body = '';
      request.setEncoding('utf8');
      request.on('data', (piece) => { body += piece; });
      request.on('end', () => { response.end(); finish(() => resolve({...JSON.parse(body), asked})); });
    });
    const timer = setTimeout(() => finish(() => reject(new Error(`no answer from the browser; it asked for ${asked}`))), patience);
    const finish = (then) => {
      clearTimeout(timer);
      server.close();
      server.closeAllConnections();
      browser.once('exit', then);
      process.kill(-browser.pid, 'SIGKILL');  // all of its processes
    };
    server.listen(0, '127.0.0.1', () => {
      browser = spawn(chromium, ['--headless=new', '--no-sandbox', '--disable-dev-shm-usage', '--no-first-run',
        '--use-angle=swiftshader', '--enable-unsafe-swiftshader', `--user-data-dir=${join(folder, 'profile')}`,
        `--window-size=${size}`, ...options, `http://127.0.0.1:${server.address().port}/`],
      {stdio: 'ignore', detached: true});  // a process group of its own
      browser.once('error', reject);
    });
  });
}

/** Removes a profile, into which a dying process may write once more. What stays after a second harms no test. */
async function remove(folder) {
  for (let attempt = 0; attempt < 20; ++attempt) {
    try {
      return rmSync(folder, {recursive: true, force: true});
    } catch {
      await new Promise((done) => setTimeout(done, 50));
    }
  }
}

/** Runs `probe` (an async function in the page; its value must be JSON) after the page has loaded. `isWarm`: in a browser
 * that has drawn before. */
export async function inBrowser(chromium, page, probe, {size = '1280,900', options = [], isWarm = false} = {}) {
  const ask = `<script>(async () => {
    await new Promise((done) => addEventListener('load', () => requestAnimationFrame(() => requestAnimationFrame(done))));
    const found = await (${probe})().catch((e) => ({failed: String(e)}));
    await fetch('/answer', {method: 'POST', body: JSON.stringify({found, errors: seen.errors})});
  })();</script>`;
  const text = readFileSync(page, 'utf8')
    .replace('<meta charset="utf-8">', (tag) => tag + watch)
    .replace(/<\/body>\s*<\/html>\s*$/, () => `${ask}</body></html>`);
  const folder = mkdtempSync(join(tmpdir(), 'ridgeline-viewer-'));
  try {
    return await answerOf(chromium, text, folder, size, options, isWarm);
  } finally {
    await remove(folder);
  }
}
