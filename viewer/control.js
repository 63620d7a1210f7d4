// SPDX-License-Identifier: GPL-3.0-or-later
// Pointer, keyboard and controls, and the start of the page.

let isTouched = false;  // until the first interaction, the camera keeps the whole surface visible
function touched() {
  isTouched = true;
  byId('hint').style.opacity = 0;
}

// Moves the camera's target and distance to `goal` within a quarter of a second.
let flight = 0;
function flyTo(goal) {
  const begin = performance.now(), from = {target: camera.target, distance: camera.distance}, current = ++flight;
  const step = now => {
    if (current !== flight) return;
    const t = Math.min(1, Math.max(0, (now - begin) / 250)), s = t * t * (3 - 2 * t);
    camera.target = add(from.target, add(goal.target, from.target, -1), s);
    camera.distance = from.distance + s * (goal.distance - from.distance);
    redraw();
    if (t < 1) requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

function resetView() {
  ++flight;
  firstView();
  fitDistance(aspect());
  redraw();
}

// One pointer rotates, or pans with the right button or shift. Two pointers pan and zoom.
const pointers = new Map();
let drag = null;
function placeOf(event) {
  const box = canvas.getBoundingClientRect();
  return [2 * (event.clientX - box.left) / box.width - 1, 1 - 2 * (event.clientY - box.top) / box.height];
}
canvas.addEventListener('pointerdown', event => {
  canvas.setPointerCapture(event.pointerId);
  canvas.focus({preventScroll: true});
  pointers.set(event.pointerId, placeOf(event));
  const isPan = event.button !== 0 || event.shiftKey;
  drag = {isPan, isClick: pointers.size === 1 && !isPan, x: event.clientX, y: event.clientY};
  ++flight;
});
canvas.addEventListener('pointermove', event => {
  const before = pointers.get(event.pointerId);
  if (!before) return;
  const now = placeOf(event), dx = now[0] - before[0], dy = now[1] - before[1];
  if (Math.hypot(event.clientX - drag.x, event.clientY - drag.y) > 4) drag.isClick = false;
  if (drag.isClick) return;
  touched();
  if (pointers.size === 2) {
    const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
    const spread = place => Math.hypot((place[0] - other[0]) * aspect(), place[1] - other[1]);
    zoom(spread(before) / Math.max(spread(now), 1e-3), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2, aspect());
    pan(dx / 2, dy / 2, aspect());
  } else if (drag.isPan) {
    pan(dx, dy, aspect());
  } else {
    orbit(dx * 1.8 * Math.min(1.6, aspect()), -dy * 1.8);
  }
  pointers.set(event.pointerId, now);
  redraw();
});
function release(event) {
  if (pointers.delete(event.pointerId) && drag?.isClick && event.type === 'pointerup') {
    touched();
    pick(cast(...placeOf(event), aspect())?.vertex ?? null);
  }
  if (drag) drag.isClick = false;
}
canvas.addEventListener('pointerup', release);
canvas.addEventListener('pointercancel', release);
canvas.addEventListener('contextmenu', event => event.preventDefault());
canvas.addEventListener('dblclick', event => {
  const hit = cast(...placeOf(event), aspect());
  if (!hit) return;
  const depth = dot(camera.back, add(eye(), hit.point, -1));
  flyTo({target: hit.point, distance: Math.min(camera.distance, 0.7 * depth)});
});
const eye = () => add(camera.target, camera.back, camera.distance);
canvas.addEventListener('wheel', event => {
  event.preventDefault();
  touched();
  ++flight;
  const lines = event.deltaMode === 1 ? 24 : event.deltaMode === 2 ? 400 : 1;
  zoom(Math.exp(Math.max(-1, Math.min(1, event.deltaY * lines * 0.0014))), ...placeOf(event), aspect());
  redraw();
}, {passive: false});

function setQuantity(quantity, range = null) {
  Object.assign(choice, {quantity, range});
  update();
}
function setRange(range) {
  choice.range = range;
  updateColors();
}
function chooseCut(word, share) {
  choice.cut = [word, share];
  [byId('cut').value, byId('cut-place').value] = choice.cut;
  byId('cut-place').disabled = word === 'none';
  setCut(word, share);
  redraw();
}
let chooseByName = (kind, name) => {  // quantity or vectors
  if (kind === 'quantity') return setQuantity(quantities.find(quantity => quantity.name === name));
  setVectors(vectors.find(vector => vector.name === name) ?? null);
  redraw();
};
function stepQuantity(step) {
  const n = quantities.length;
  setQuantity(quantities[(quantities.indexOf(choice.quantity) + step + n) % n]);
}
function setClip(percent) {
  const distance = step => Math.abs(step - percent);
  choice.clip = facts.clipSteps.reduce((best, step) => distance(step) < distance(best) ? step : best);
}
function setUp(letter) {
  camera.axis = ['x', 'y', 'z'].map(axis => Number(axis === letter));
  showUp();
}
function showUp() {
  [...byId('up').children].forEach((button, k) => button.setAttribute('aria-pressed', camera.axis[k] === 1));
}
function toggle(name) {
  choice[name] = !choice[name];
  if (name === 'hasMarks') update();
  else updateColors();
}
// Choosing the current scale again selects the automatic one.
function chooseScale(word) {
  choice.scale = word === choice.scale ? 'auto' : word;
  updateColors();
}
function nextScale() {
  choice.scale = scales[(scales.indexOf(scale) + 1) % scales.length];
  updateColors();
}
function toggleHelp() {
  const isHidden = byId('help').hidden = !byId('help').hidden;
  byId('help-toggle').setAttribute('aria-expanded', !isHidden);
}
const togglePanel = () => showPanel(document.body.classList.contains('no-panel'));
function nextVectors() {
  setVectors(vectors[vectors.indexOf(choice.vectors) + 1] ?? null);
  updateColors();
}
function lookAlong(k, sign) {
  ++flight;
  camera.target = [0, 0, 0];
  lookFrom([0, 1, 2].map(i => i === k ? sign : 0));
  fitDistance(aspect());
  redraw();
}

const keys = {
  ArrowLeft: () => orbit(-0.1, 0), ArrowRight: () => orbit(0.1, 0),
  ArrowUp: () => orbit(0, -0.1), ArrowDown: () => orbit(0, 0.1),
  '+': () => zoom(0.85, 0, 0, aspect()), '=': () => zoom(0.85, 0, 0, aspect()),
  '-': () => zoom(1 / 0.85, 0, 0, aspect()),
  r: resetView, e: () => toggle('edges'), i: () => toggle('isolines'), l: nextScale,
  v: nextVectors, m: measureFromPicked, n: () => stepQuantity(1), p: () => stepQuantity(-1), s: savePicture,
  h: togglePanel, '?': toggleHelp,
  x: () => lookAlong(0, 1), y: () => lookAlong(1, 1), z: () => lookAlong(2, 1),
  X: () => lookAlong(0, -1), Y: () => lookAlong(1, -1), Z: () => lookAlong(2, -1), Escape: () => pick(null),
};
document.addEventListener('keydown', event => {
  const isTyping = /^(SELECT|TEXTAREA)$/.test(event.target.tagName) || /^(range|number|text)$/.test(event.target.type);
  if (!scene || isTyping || event.ctrlKey || event.metaKey || event.altKey || !Object.hasOwn(keys, event.key)) return;
  event.preventDefault();
  keys[event.key]();
  redraw();
});

const on = (id, type, act) => byId(id).addEventListener(type, act);
for (const kind of ['quantity', 'vectors']) on(kind, 'change', event => chooseByName(kind, event.target.value));
on('clip', 'input', event => { choice.clip = facts.clipSteps[event.target.value]; updateColors(); });
for (const word of scales) on(`scale-${word}`, 'click', () => chooseScale(word));
on('edges', 'change', () => toggle('edges'));
on('isolines', 'change', () => toggle('isolines'));
on('marks', 'change', () => toggle('hasMarks'));
on('reset', 'click', resetView);
on('cut', 'change', event => chooseCut(event.target.value, Number(byId('cut-place').value)));
on('cut-place', 'input', event => chooseCut(choice.cut[0], Number(event.target.value)));
on('lowest', 'change', takeTypedRange);
on('highest', 'change', takeTypedRange);
on('range-auto', 'click', () => setRange(null));
on('save', 'click', savePicture);
on('save-csv', 'click', saveCSV);
on('save-ply', 'click', savePLY);
on('picked-measure', 'click', measureFromPicked);
on('link', 'click', event => copyText(location.href.split('#')[0] + fragment(), event.target));
on('help-toggle', 'click', toggleHelp);
on('panel-toggle', 'click', togglePanel);
on('picked-copy', 'click', event => copyText(
    numbersOf(choice.picked).map(([{name}, value, digits]) => `${name}\t${value.toPrecision(digits)}`).join('\n'),
    event.target));
for (const button of byId('up').children)
  button.addEventListener('click', () => { setUp(button.textContent); resetView(); });

function resize() {
  const pixels = Math.min(window.devicePixelRatio || 1, 3);
  const width = Math.max(1, Math.round(canvas.clientWidth * pixels));
  const height = Math.max(1, Math.round(canvas.clientHeight * pixels));
  if (canvas.width === width && canvas.height === height) return;
  [canvas.width, canvas.height] = [width, height];
  if (!shown) return;
  if (!isTouched && !/[#&]zoom=/.test(location.hash)) fitDistance(aspect());
  drawNow();
}

function fillQuantities() {
  let group = null;
  byId('quantity').replaceChildren();
  for (const {name, label, symbol, group: title} of quantities) {
    if (group?.label !== (title || 'Other'))
      byId('quantity').append(group = Object.assign(document.createElement('optgroup'), {label: title || 'Other'}));
    group.append(new Option(symbol ? `${label} ${symbol}` : label, name));
  }
  byId('vectors').replaceChildren(new Option('none', ''), ...vectors.map(({label, name}) => new Option(label, name)));
  byId('vectors-row').hidden = !vectors.length;
}
function fillSelects() {
  fillQuantities();
  byId('clip').max = facts.clipSteps.length - 1;
  byId('cut').append(...cutWords.map(word => new Option(word.replace('-', '−'), word)));
  chooseCut(...choice.cut);
}

// Prints with the light theme, since paper is white.
function printLight() {
  const root = document.documentElement;
  let onScreen;
  const setTheme = theme => {
    if (theme) root.dataset.theme = theme;
    else delete root.dataset.theme;
    drawScale();
    drawNow();
  };
  window.addEventListener('beforeprint', () => { onScreen = root.dataset.theme; setTheme('light'); });
  window.addEventListener('afterprint', () => setTheme(onScreen));
}

function start() {
  const say = text => { byId('message').hidden = false; byId('message').textContent = text; };
  try {
    scene = createScene(canvas);
  } catch (error) {
    return say('The graphics driver of this browser cannot draw the surface; try another browser.\n' + error.message);
  }
  if (!scene) {
    document.body.classList.add('no-panel', 'no-scene');
    return say('This page needs WebGL 2, which this browser does not support.\nUse a current browser, or enable '
               + 'hardware acceleration.');
  }
  canvas.addEventListener('webglcontextlost', () => say('The graphics driver was reset; reload the page.'));
  Object.assign(choice, {scale: facts.scale, clip: facts.clip});
  camera.axis = unit(facts.up);
  fillSelects();
  showUp();
  followAddress();
  byId('message').hidden = mesh.size > 0;
  if (!mesh.size) say('This surface has no points.');
  new ResizeObserver(resize).observe(canvas);
  new ResizeObserver(drawScale).observe(byId('histogram'));
  window.addEventListener('hashchange', followAddress);
  printLight();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { drawScale(); redraw(); });
}
if (byId('facts')) {
  takeSurface(surfaceOfPage());
  start();
}
