// node bench.mjs BUILD OUT: runs every benchmark of BUILD and writes OUT, ratios first. Called by scripts/bench.
import {execFileSync, spawn, spawnSync} from 'node:child_process';
import {mkdtempSync, readFileSync, writeFileSync} from 'node:fs';
import {cpus, tmpdir, totalmem} from 'node:os';
import {join} from 'node:path';

const [build, out] = process.argv.slice(2);
const bench = (name) => `${build}/tests/bench/${name}`;
const show = (text) => text.replace(/\n+$/, '');
const told = [];  // sections, in the order of the runs
const ratios = [];

function run(command, arguments_, allowed = [0]) {
  process.stderr.write(`${command} ${arguments_.join(' ')}\n`);
  const {status, stdout, error} = spawnSync(command, arguments_, {maxBuffer: 1 << 28, encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit']});
  if (error) throw error;
  if (!allowed.includes(status)) throw new Error(`${command} ended with ${status}`);
  return stdout;
}

function section(title, command, ...parts) {
  told.push(`## ${title}\n\n    ${command}\n\n${parts.join('\n\n')}\n`);
}

const rounded = (value) => Number(value.toPrecision(3)).toString();

/** A Google Benchmark program as a table: a row a benchmark, its counters; those named as ratios go to the front page too. */
function googleBenchmark(title, name, ratioNames) {
  const command = bench(name);
  const all = JSON.parse(run(command, ['--benchmark_format=json', '--benchmark_min_time=0.3'])).benchmarks;
  const standard = new Set(['name', 'family_index', 'per_family_instance_index', 'run_name', 'run_type', 'repetitions', 'repetition_index',
    'threads', 'iterations', 'real_time', 'cpu_time', 'time_unit', 'label', 'items_per_second', 'bytes_per_second']);
  const rows = all.map((b) => {
    const counters = Object.entries(b).filter(([key, value]) => !standard.has(key) && typeof value === 'number');
    for (const [key, value] of counters)
      if (ratioNames[key]) ratios.push([`${ratioNames[key]} (${b.name})`, rounded(value), command]);
    return `| \`${b.name}\` | ${rounded(b.real_time)} ${b.time_unit} | ${counters.map(([key, value]) => `${key} ${rounded(value)}`).join(', ')} |`;
  });
  section(title, command, ['| benchmark | time of one iteration | counters |', '|---|---|---|', ...rows].join('\n'));
  return all;
}

function versions() {
  const installed = (name) => execFileSync('dpkg-query', ['-W', '-f=${Version}', name], {encoding: 'utf8'});
  return ['cyclonedds-dev', 'libocct-data-exchange-dev', 'linuxcnc-uspace', 'libeigen3-dev', 'libsqlite3-dev', 'g++']
    .map((name) => `${name} ${installed(name)}`).join(', ');
}

/** Latency of the transport's own tool for messages of `size` bytes, median of its reports [us]. */
async function ddsperf(size) {
  const pong = spawn('ddsperf', ['-Q', 'minmatch:1', 'pong'], {stdio: 'ignore'});
  try {
    const text = run('ddsperf', ['-D', '6', '-Q', 'minmatch:1', 'ping', 'size', String(size)]);
    const medians = [...text.matchAll(/50% ([\d.]+)us/g)].map((match) => Number(match[1])).sort((a, b) => a - b);
    if (medians.length === 0) throw new Error(`ddsperf says no latency:\n${text}`);
    return medians[medians.length >> 1];
  } finally {
    pong.kill('SIGTERM');
  }
}

// ---- hole edges
const peers = run(bench('peers/hole_edge_peer'), ['9']);
for (const line of peers.split('\n').slice(2).filter(Boolean)) {
  const cells = line.split('|').map((cell) => cell.trim());
  ratios.push([`Open CASCADE's chamfer of the edge / swept path of the edge (${cells[1]})`, cells[5].replace(' x', ''), 'hole_edge_peer']);
}
section('Hole edge beside Open CASCADE', bench('peers/hole_edge_peer'), show(peers),
  'Times are processor time on one core, medians of 9. Widths are against the asked one, sqrt(2) x leg: ours measured on the motion with its\n' +
  'chord error (tolerance 0.002 mm), Open CASCADE\'s on its faces. A symmetric chamfer has the asked leg on both faces and so, where the edge\n' +
  'is not square, another width.');
googleBenchmark('Chamfer points', 'chamfer/chamfer_bench', {
  section_per_unit: 'section point / (sine, cosine, two roots); limit 10', swept_per_section: 'swept point / section point; limit 12',
  points_per_optimum: 'points / optimum; limit 1.03'});

const freecad = spawnSync('which', ['freecadcmd'], {encoding: 'utf8'}).stdout.trim();
if (freecad) {
  const peer = 'tests/bench/peers/freecad_peer.py';
  const file = join(mkdtempSync(join(tmpdir(), 'ridgeline-bench-')), 'out.md');
  process.env.RIDGELINE_PEER_OUT = file;
  run(freecad, [peer]);
  section('FreeCAD on the same work', `RIDGELINE_PEER_OUT=out.md freecadcmd ${peer}`, show(readFileSync(file, 'utf8')),
    'Bore 40, hole 10 square through both walls. The edges are not plane: its Deburr makes no path of them, and of the hole\'s face straight\n' +
    'moves at one height. It plans no turning; what it shares with `units plan` is reading STEP files.');
} else {
  told.push('## FreeCAD on the same work\n\nNot measured: there is no `freecadcmd` on this machine (`apt-get install freecad-python3`).\n');
}

// ---- macro programs
const macro = googleBenchmark("Macro programs beside LinuxCNC's rs274", 'macro/macro_bench', {});
for (const b of macro)
  if (b.rs274_per_second > 0) ratios.push([`our interpreter / LinuxCNC's (${b.name}); limit 5`, rounded(b.per_second / b.rs274_per_second), bench('macro/macro_bench')]);

// ---- machining error and units
googleBenchmark('Machining error', 'cutting/cutting_bench', {ratio: 'iteration / rigid method over a path; limit 1.2'});
googleBenchmark('Units', 'units/units_bench', {ratio: "reading a part / Open CASCADE's load; limit 1.3"});

// ---- start of the command
const starts = ['--help', 'chamfer clients/examples/inline.json --local --quiet'].map((arguments_) => {
  const command = `${build}/clients/ridgeline/ridgeline ${arguments_}`;
  const runs = 30;
  const {stderr} = spawnSync('bash', ['-c', `TIMEFORMAT='%3U %3S'; time for ((i = 0; i < ${runs}; ++i)); do ${command} >/dev/null; done`],
    {encoding: 'utf8'});
  const [user, system] = stderr.trim().split(/\s+/).slice(-2).map(Number);
  return `| \`ridgeline ${arguments_}\` | ${rounded(1e3 * (user + system) / runs)} ms |`;
});
section('Start of the command', "time for i in {1..30}; do ...; done", ['| command | processor time, mean of 30 |', '|---|---|', ...starts].join('\n'));

// ---- service
const service = run(bench('service/bench_service'), ['3000'], [0, 1]);
for (const [, what, value] of service.matchAll(/^(\(job - the job in-process\) \/ empty): p50 ([\d.]+)/gm)) ratios.push([`${what}; limit 1.5`, value, bench('service/bench_service')]);
for (const [, value] of service.matchAll(/^empty \/ bare echo: p50 ([\d.]+)/gm)) ratios.push(['empty request / bare echo, p50', value, bench('service/bench_service')]);
const small = await ddsperf(100), large = await ddsperf(100000);
const empty = Number(service.match(/^empty request and reply +p50 +([\d.]+) us/m)[1]);
ratios.push(["empty request and reply / ddsperf's round trip of 100 bytes, p50", rounded(empty / (2 * small)), '`ddsperf ping`']);
section('Service beside a bare echo and ddsperf', `${bench('service/bench_service')} 3000`, '```\n' + show(service) + '\n```',
  `\`ddsperf ping\` (half a round trip, median): ${small} us for 100 bytes, ${large} us for 100,000 bytes.`);

// ---- cancel
const gaps = run(bench('jobs/cancel_gaps'), []);
const [, longestGap] = gaps.match(/longest of all: ([\d.]+) ms/);
ratios.push(['longest that a large job goes without a look for a cancel / 100 ms; limit 1', rounded(Number(longestGap) / 100), bench('jobs/cancel_gaps')]);
section('How soon a cancel stops a job', bench('jobs/cancel_gaps'), show(gaps).trim(),
  'Wall-clock time of one run of each job; the longest of a job varies from run to run by 100 ms and more, where the system is given memory\n' +
  'back (57, 166 and 272 ms for the 60,000 arcs). The command writes JSON and packs answers after the last look.');

// ---- growth
section('Growth', bench('service/bench_growth'), show(run(bench('service/bench_growth'), [])).trim(),
  'Exponents are of the first figure over the row before.');

const commit = execFileSync('git', ['rev-parse', '--short', 'HEAD'], {encoding: 'utf8'}).trim();
const cpu = cpus();
writeFileSync(out, `# Benchmarks

Written by \`scripts/bench\` in one run on one machine: ${cpu.length} cores (${cpu[0].model.trim()}), ${Math.round(totalmem() / 2 ** 30)} GB,
${readFileSync('/etc/os-release', 'utf8').match(/PRETTY_NAME="(.*)"/)[1]}; commit ${commit}; ${new Date().toISOString().slice(0, 10)}.
${versions()}.

## Ratios

| ratio | figure | from |
|---|---|---|
${ratios.map(([what, value, from]) => `| ${what} | ${value} | ${from.startsWith('`') ? from : `\`${from.split('/').pop()}\``} |`).join('\n')}

${told.join('\n')}`);
