// Bundles the viewer into one page: `node build.mjs SOURCES TARGET` writes TARGET/page.html, where RIDGELINE_DATA waits
// for the data, and TARGET/page.cpp, the same text for viewer/page.hpp.
import {build} from 'esbuild';
import {readFile, writeFile} from 'node:fs/promises';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const [sources, target] = process.argv.slice(2);
const bundle = await build({
  entryPoints: [join(sources, 'main.js')],
  nodePaths: [join(dirname(fileURLToPath(import.meta.url)), 'node_modules')],
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: 'es2020',
  charset: 'ascii',
  legalComments: 'none',
});
const script = bundle.outputFiles[0].text.replaceAll('</script', '<\\/script');
const style = await readFile(join(sources, 'style.css'), 'utf8');
const frame = await readFile(join(sources, 'page.html'), 'utf8');
const page = frame.replace('/* STYLE */', () => style).replace('/* SCRIPT */', () => script);
if (page.split('RIDGELINE_DATA').length !== 2) throw new Error('the page must hold RIDGELINE_DATA once');

// Raw literals of a length that every compiler takes; a piece holds whole characters.
const pieces = Array.from({length: Math.ceil(page.length / 12000)}, (_, i) => page.slice(12000 * i, 12000 * (i + 1)));
const literals = pieces.map((piece) => `R"page(${piece})page"`).join('\n');
await writeFile(join(target, 'page.html'), page);
await writeFile(join(target, 'page.cpp'), `#include "viewer/page.hpp"

namespace ridgeline::viewer {

std::string_view page() {
  return
${literals};
}

}  // namespace ridgeline::viewer
`);
