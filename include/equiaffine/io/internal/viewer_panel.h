// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_VIEWER_PANEL_H
#define EQUIAFFINE_IO_INTERNAL_VIEWER_PANEL_H

#include <string_view>

/// \file
/// The page's script, fifth part: what is chosen, and the parts of the panel that change with it.

namespace equiaffine::internal {

inline constexpr std::string_view viewer_panel = R"js(
const clipSteps = [0, 0.1, 0.2, 0.5, 1, 2, 3, 5, 10, 15, 20, 25];
const canvas = byId('view'), stage = byId('stage');
const choice = {quantity: plain, isLog: false, isScaleChosen: false, clip: facts.clip, hasMarks: true, edges: false,
                isolines: false, vectors: null, picked: null, origin: null, range: null, cut: ['none', 0.5]};
// shown: {values, codes, sides, errors, sorted, magnitudes} of the quantity.
let scene = null, range = null, shown = null, areas = null;
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

// The quantity changed, or which points count.
function update() {
  const {quantity} = choice, numbers = quantity.values?.() ?? null;
  const withStatus = mesh.status.length && (quantity === statusQuantity || (numbers && choice.hasMarks));
  const sides = vertexSides(quantity), codes = vertexCodes(numbers, withStatus, sides);
  const values = codes.includes(0) ? numbers : null;  // no bar without a color that shows a number
  shown = {values, codes, sides, errors: values && errorsOf(quantity), ...(values && summarize(values, codes))};
  byId('quantity').value = quantity.name;
  byId('mapping').hidden = byId('scale').hidden = !values;
  byId('marks-label').hidden = !mesh.status.length;
  if (values) showStatistics();
  showLegend();
  updateColors();
}

// The same numbers, other colors.
function updateColors() {
  const {values, codes, sides, errors} = shown, levels = new Float32Array(mesh.size);
  const doubts = new Float32Array(mesh.size);
  const {quantity, clip} = choice;
  range = values && (choice.range ? givenRange(...choice.range)
                                  : colorRange(shown.sorted, shown.magnitudes, clip, quantity.resolution));
  if (values && !choice.isScaleChosen) choice.isLog = prefersLog(range);
  if (values)
    for (let i = 0; i < levels.length; ++i) {
      if (codes[i] !== 0) continue;
      levels[i] = mapPosition(values[i], range, choice.isLog);
      if (errors) doubts[i] = colorDoubt(values[i], errors[i], range, choice.isLog);
    }
  scene.setColors({levels, doubts, codes, sides}, values && (range.isDiverging ? facts.diverging : facts.sequential));
  for (const [id, isOn] of [['scale-linear', !choice.isLog], ['scale-log', choice.isLog]])
    byId(id).setAttribute('aria-pressed', isOn);
  byId('clip').value = clipSteps.indexOf(choice.clip);
  byId('clip-text').value = choice.clip + ' %';
  for (const [id, isOn] of [['edges', choice.edges], ['isolines', choice.isolines], ['marks', choice.hasMarks]])
    byId(id).checked = isOn;
  byId('vectors').value = choice.vectors?.name ?? '';
  showRange();
  drawScale();
  showPicked();
  redraw();
}

function showRange() {
  byId('clip').disabled = Boolean(choice.range);
  if (!range) return;
  [['lowest', range.lower], ['highest', range.upper]].forEach(([id, bound], k) => {
    byId(id).value = choice.range ? choice.range[k] : '';
    byId(id).placeholder = bound.toPrecision(3);
    byId(id).removeAttribute('aria-invalid');
  });
}

// A bound that is left empty stays what it is.
function takeTypedRange() {
  const typed = ['lowest', 'highest'].map((id, k) => {
    const text = byId(id).value.trim();
    return text ? Number(text) : [range.lower, range.upper][k];
  });
  const isFine = typed.every(Number.isFinite) && typed[0] < typed[1];
  for (const id of ['lowest', 'highest']) byId(id).setAttribute('aria-invalid', !isFine);
  if (!isFine) return;
  setRange(typed);
}

function showStatistics() {
  const {sorted, values, errors} = shown, table = byId('statistics');
  const errorOf = number => errors?.[values.indexOf(number)];  // of the vertex that has the extreme
  table.replaceChildren();
  for (const [name, percent] of [['minimum', 0], ['median', 50], ['maximum', 100]]) {
    const number = sorted.length ? quantile(sorted, percent) : NaN;
    const error = percent === 50 && errors ? quantile(errors.slice().sort(), 50) : errorOf(number);
    addRow(table, element('span', 'quiet', name), readableWithin(number, error));
  }
}

// The colors of points without a number, as [color, text, number of points]; the last is missing for a curve.
function legendEntries() {
  const isStatus = choice.quantity === statusQuantity, counts = facts.statuses.map(() => 0), entries = [];
  for (const status of mesh.status) ++counts[status];
  if (choice.quantity !== plain && (choice.hasMarks || isStatus))
    facts.statuses.forEach(({word, color}, i) => {
      if (counts[i] && (i > 0 || isStatus)) entries.push([color, word, counts[i]]);
    });
  if (shown.sides && hasParabolicLine(shown.sides))
    entries.push([facts.statuses[1].color, 'parabolic curve: no number there']);
  for (const sentence of facts.doubts) entries.push([facts.doubt, sentence]);
  if (shown.errors) entries.push([facts.doubt, 'grayer where the estimated error is larger']);
  const missing = shown.codes.reduce((sum, code) => sum + (code === 5), 0);
  if (missing) entries.push([facts.undefined, 'no number', missing]);
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
)js";

} // namespace equiaffine::internal

#endif
