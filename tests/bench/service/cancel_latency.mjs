// How long an instance goes on with a job of two million points after the command is interrupted: a service of its own on the loopback,
// the job cancelled at moments from 2.5 to 9 s. `node tests/bench/service/cancel_latency.mjs build/release`
import {spawn} from 'node:child_process';
import {mkdtempSync, openSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {setTimeout as sleep} from 'node:timers/promises';

const build = process.argv[2] ?? 'build/release';
const moments = [2.5, 3, 3.5, 4, 4.5, 5, 5.5, 6, 6.5, 7, 8, 9];
const folder = mkdtempSync(join(tmpdir(), 'ridgeline-cancel-'));
const log = join(folder, 'log'), job = join(folder, 'job.json');
const env = {...process.env, RIDGELINE_DOMAIN: '7'};
const answered = () => readFileSync(log, 'utf8').split('\n').filter((line) => line.includes('"event":"request"'));
writeFileSync(job, JSON.stringify({...JSON.parse(readFileSync('clients/examples/inline.json')), points: 2000000}));

const file = openSync(log, 'w');
const service = spawn(join(build, 'service/ridgelined'), ['--library', join(folder, 'library.db'), '--instance', 'cancel'],
  {env, stdio: ['ignore', file, file]});
try {
  await sleep(1000);
  for (const moment of moments) {
    const command = spawn(join(build, 'clients/ridgeline/ridgeline'), ['chamfer', job, '--quiet'], {env, stdio: 'ignore'});
    const ended = new Promise((resolve) => command.on('exit', resolve));
    await sleep(1e3 * moment);
    const before = answered().length, begin = performance.now();
    command.kill('SIGINT');
    while (answered().length === before && performance.now() - begin < 30e3) await sleep(1);
    const taken = performance.now() - begin, last = answered().at(-1) ?? '{}';
    console.log(`cancelled after ${moment} s: ${taken.toFixed(0)} ms, ${JSON.parse(last).code ?? 'no answer'}`);
    await ended;
  }
} finally {
  service.kill('SIGTERM');
  await new Promise((resolve) => service.on('exit', resolve));
  rmSync(folder, {recursive: true});
}
