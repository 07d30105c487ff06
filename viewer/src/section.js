// The half section: stock, product and units, Z to the right and X up.
import {pairsOf} from './solid.js';

const space = {left: 58, right: 14, top: 14, bottom: 42};

const number = (v) => String(Number(v.toPrecision(5)));

/** Draws data.units into `parent`; `choose(number)` hears a click on a unit. Returns mark(number, done). */
export function drawSection(parent, {box, stock, product, splits, list}, choose) {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('role', 'img');
  svg.setAttribute('aria-label', 'Half section with every unit in its colour');
  parent.append(svg);
  let width = 0;
  let chosen = {number: null, done: 0};

  function layOut() {
    const W = Math.max(260, Math.round(parent.clientWidth));
    if (W === width) return;
    width = W;
    const scale = Math.min((W - space.left - space.right) / (box.z1 - box.z0), 300 / box.r1);
    const left = space.left + (W - space.left - space.right - scale * (box.z1 - box.z0)) / 2;
    const H = space.top + scale * box.r1 + space.bottom;
    const axis = H - space.bottom;
    const x = (z) => (left + scale * (z - box.z0)).toFixed(1);
    const y = (r) => (axis - scale * r).toFixed(1);
    const outline = (loops) => loops.map((loop) => `M${pairsOf(loop).map(([z, r]) => `${x(z)} ${y(r)}`).join('L')}Z`).join('');
    const units = list.map((unit) => `<path class="unit" data-unit="${unit.number}" style="--hue:${unit.hue}" fill-rule="evenodd" d="${outline(unit.section)}"/>`);
    const marks = splits.filter((s, i) => s.z > box.z0 && s.z < box.z1 && splits.findIndex((other) => Math.abs(other.z - s.z) < 1e-6) === i)
      .map((s, i) => `<line class="axis" x1="${x(s.z)}" x2="${x(s.z)}" y1="${y(box.r1)}" y2="${y(0)}"/><text x="${x(s.z)}" y="${axis + 16 + 14 * (i % 2)}" text-anchor="middle">${s.name} Z ${number(s.z)}</text>`);
    svg.setAttribute('viewBox', `0 0 ${W} ${H.toFixed(0)}`);
    svg.innerHTML = `<path class="stock" d="${outline(stock)}"/><path class="product" fill-rule="evenodd" d="${outline(product)}"/>${units.join('')}
      <line class="axis" x1="${x(box.z0) - 8}" x2="${+x(box.z1) + 8}" y1="${axis}" y2="${axis}"/>${marks.join('')}
      <text x="${x(box.z0)}" y="${axis + 30}">Z ${number(box.z0)}</text><text x="${x(box.z1)}" y="${axis + 30}" text-anchor="end">Z ${number(box.z1)}</text>
      <text x="${left - 6}" y="${+y(box.r1) + 10}" text-anchor="end">X ${number(box.r1)}</text>`;
    for (const path of svg.querySelectorAll('.unit')) {
      const unit = list.find((one) => one.number === Number(path.dataset.unit));
      const title = document.createElementNS('http://www.w3.org/2000/svg', 'title');
      title.textContent = unit.label;
      path.append(title);
    }
    show();
  }
  function show() {
    for (const path of svg.querySelectorAll('.unit')) {
      const number = Number(path.dataset.unit);
      path.classList.toggle('chosen', number === chosen.number);
      path.classList.toggle('faded', chosen.number !== null && number !== chosen.number);
      path.classList.toggle('done', list.findIndex((unit) => unit.number === number) < chosen.done);
    }
    const front = svg.querySelector('.unit.chosen');
    if (front) svg.append(front);  // its border is not covered
  }
  svg.addEventListener('click', (event) => choose(event.target.closest('.unit') ? Number(event.target.closest('.unit').dataset.unit) : null));
  layOut();
  new ResizeObserver(() => requestAnimationFrame(layOut)).observe(parent);
  return (number, done) => { chosen = {number, done}; show(); };
}
