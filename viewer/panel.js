// SPDX-License-Identifier: GPL-3.0-or-later
// The selected options, and the parts of the panel that depend on them.

const canvas = byId('view'), stage = byId('stage');
// scale: linear, logarithmic, equalized, or auto, which chooses one for each quantity.
const choice = {quantity: plain, scale: 'auto', clip: 0, hasMarks: true, edges: false, isolines: false,
                vectors: null, picked: null, origin: null, range: null, cut: ['none', 0.5]};
// shown: {values, codes, sides, errors} of the quantity. range, scale and place(number) define the color bar.
let scene = null, range = null, scale = 'linear', place = null, shown = null, areas = null;
const aspect = () => canvas.width / canvas.height;

let isDrawPending = false;
function redraw() {
  if (isDrawPending || !scene) return;
  isDrawPending = true;
  requestAnimationFrame(() => { isDrawPending = false; drawNow(); });
}
function drawNow() {
  const {edges} = choice, isDark = getComputedStyle(byId('panel')).color.match(/\d+/g)[0] > 128;
  scene.draw({edges, isDark, ringed: ringedVertices(), pixels: canvas.width / canvas.clientWidth});
  drawAxes();
}
const ringedVertices = () => [choice.origin, choice.picked].filter(vertex => vertex !== null);

function drawAxes() {
  const axes = byId('axes'), lines = axes.querySelectorAll('line'), names = axes.querySelectorAll('text');
  for (let k = 0; k < 3; ++k) {
    const x = camera.right[k], y = -camera.up[k], near = 0.65 + 0.35 * camera.back[k];
    lines[k].setAttribute('x2', 26 * x);
    lines[k].setAttribute('y2', 26 * y);
    names[k].setAttribute('x', 35 * x);
    names[k].setAttribute('y', 35 * y);
    for (const node of [lines[k], names[k]]) node.setAttribute('opacity', near);
  }
}

function addRow(table, ...cells) {
  const row = table.insertRow();
  for (const cell of cells) row.insertCell().append(...[cell].flat());
}
function element(tag, className, text = '') {
  const result = document.createElement(tag);
  result.className = className;
  result.textContent = text;
  return result;
}

// Updates the page after a change of the quantity or of choice.hasMarks.
function update() {
  const {quantity} = choice, numbers = quantity.ranges ? filled(quantity) : null, errors = errorColumn(quantity);
  const withStatus = mesh.status.length && (quantity === statusQuantity || (numbers && choice.hasMarks));
  const sides = vertexSides(quantity), codes = vertexCodes(numbers, withStatus, sides);
  const values = codes.includes(0) ? numbers : null;  // no color bar unless some vertex has a number
  shown = {values, codes, sides, errors: values && errors && filled(errors)};
  byId('quantity').value = quantity.name;
  byId('mapping').hidden = byId('scale').hidden = !values;
  byId('marks-label').hidden = !mesh.status.length;
  if (values) showStatistics();
  showLegend();
  updateColors();
}

// The range of a column for the selected clip, or its only range.
const rangeOf = column => column.ranges[facts.clipSteps.indexOf(choice.clip)] ?? column.ranges[0];

// Describes the quantity, and the colors of a range of one sign, which are not diverging.
function showMeaning() {
  const {meaning = ''} = choice.quantity;
  const isOfOneSign = meaning && range && !range.isDiverging;
  byId('meaning').textContent = meaning + (isOfOneSign ? ' Here, pale colors mean small values, dark ones large.' : '');
}

// Updates the colors, for the same numbers.
function updateColors() {
  const {values, codes, sides, errors} = shown, levels = new Float32Array(mesh.size);
  const doubts = new Float32Array(mesh.size), {quantity} = choice;
  range = values && (choice.range ? givenRange(...choice.range) : rangeOf(quantity));
  if (values) {
    scale = choice.scale === 'auto' ? range.scale : choice.scale;
    place = placesAlong(range, scale, quantity.knots);
    for (let i = 0; i < levels.length; ++i) {
      if (codes[i] !== 0) continue;
      levels[i] = Math.min(1, Math.max(0, place(values[i])));
      if (errors) doubts[i] = colorDoubt(values[i], errors[i], place);
    }
  }
  const region = quantity === statusQuantity ? facts.statuses[1].color : facts.region;
  const table = values && (range.isDiverging ? facts.diverging : facts.sequential);
  scene.setColors({levels, doubts, codes, sides, region}, table);
  for (const word of scales) byId(`scale-${word}`).setAttribute('aria-pressed', word === scale);
  byId('clip').value = facts.clipSteps.indexOf(choice.clip);
  byId('clip-text').value = choice.clip + ' %';
  for (const [id, isOn] of [['edges', choice.edges], ['isolines', choice.isolines], ['marks', choice.hasMarks]])
    byId(id).checked = isOn;
  byId('vectors').value = choice.vectors?.name ?? '';
  showMeaning();
  showRange();
  drawScale();
  showPicked();
  redraw();
}
const scales = ['linear', 'logarithmic', 'equalized'];

const rounded = number => Number(number.toPrecision(4));
function shortText(number) {
  const text = String(rounded(number));
  return text.length <= 7 ? text : number.toExponential(1);
}
function showRange() {
  byId('clip').disabled = Boolean(choice.range) || choice.quantity.ranges?.length === 1;
  if (!range) return;
  [['lowest', range.lower], ['highest', range.upper]].forEach(([id, bound], k) => {
    byId(id).value = choice.range ? shortText(choice.range[k]) : '';
    byId(id).placeholder = shortText(bound);
    byId(id).removeAttribute('aria-invalid');
  });
}

// A bound that is empty or unchanged keeps its value.
function takeTypedRange() {
  const typed = ['lowest', 'highest'].map((id, k) => {
    const text = byId(id).value.trim(), bound = [range.lower, range.upper][k];
    return text && text !== shortText(bound) ? Number(text) : bound;
  });
  const isFine = typed.every(Number.isFinite) && typed[0] < typed[1];
  for (const id of ['lowest', 'highest']) byId(id).setAttribute('aria-invalid', !isFine);
  if (!isFine) return;
  setRange(typed);
}

// If there are errors, the statistics are those of the known numbers.
function showStatistics() {
  const {statistics, unknown} = choice.quantity, table = byId('statistics');
  table.replaceChildren();
  ['minimum', 'median', 'maximum'].forEach((name, k) => {
    const [number, error] = statistics[k];
    addRow(table, element('span', 'quiet', name),
           readableWithin(number ?? NaN, shown.errors ? error ?? Infinity : undefined, rangeOf(choice.quantity)));
  });
  if (shown.errors) addRow(table, element('span', 'quiet', 'unknown'), readable(100 * unknown, 3) + ' %');
}

// The legend of colors of points without a number: [color, text, number of points], without a number for curves.
function legendEntries() {
  const isStatus = choice.quantity === statusQuantity, {codes, sides} = shown, entries = [];
  const countOf = code => codes.reduce((sum, each) => sum + (each === code), 0);
  const regions = codes.reduce((sum, code, i) => sum + (code === 1 && mesh.parts[i] === 2), 0);
  facts.statuses.forEach(({word, color}, i) => {
    const number = isStatus || i > 1 ? countOf(i) : i === 1 && !sides ? countOf(1) - regions : 0;
    if (number && choice.quantity !== plain) entries.push([color, word, number]);
  });
  if (regions && !isStatus) entries.push([facts.region, facts.regionText, regions]);
  if (sides && hasParabolicLine(sides)) entries.push([facts.statuses[1].color, 'parabolic curve: no number there']);
  for (const sentence of facts.doubts) entries.push([facts.doubt, sentence]);
  if (shown.errors) entries.push([facts.doubt, 'grayer where the estimated error is larger']);
  if (countOf(5)) entries.push([facts.undefined, 'no number', countOf(5)]);
  return entries;
}

function showLegend() {
  const table = byId('legend'), count = number => number.toLocaleString('en');
  table.replaceChildren();
  addRow(table, element('span', 'quiet', 'vertices'), count(mesh.size));
  addRow(table, element('span', 'quiet', 'triangles'), count(mesh.triangles.length / 3));
  const entries = legendEntries(), words = entries.map(([, word]) => word);
  facts.statuses.forEach(({word}, i) => {
    const number = mesh.status.reduce((sum, status) => sum + (status === i), 0);
    if (mesh.status.length && (number || i === 0) && !words.includes(word)) addRow(table, word, count(number));
  });
  for (const [color, text, number] of entries) {
    const swatch = element('span', 'swatch');
    swatch.style.background = color;
    addRow(table, [swatch, text], number === undefined ? '' : count(number));
  }
}
