// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_VIEWER_PANEL_H
#define EQUIAFFINE_IO_INTERNAL_VIEWER_PANEL_H

#include <string_view>

/// \file
/// The page's script, fourth part: what is chosen, and the parts of the panel that change with it.

namespace equiaffine::internal {

inline constexpr std::string_view viewer_panel = R"js(
const clipSteps = [0, 0.1, 0.2, 0.5, 1, 2, 3, 5, 10, 15, 20, 25];
const canvas = byId('view'), stage = byId('stage');
const choice = {quantity: plain, isLog: false, isScaleChosen: false, clip: facts.clip, hasMarks: true, edges: false,
                isolines: false, vectors: null, picked: null};
// shown: {values, codes, sides, sorted, magnitudes} of the quantity.
let scene = null, range = null, shown = null, areas = null;
const aspect = () => canvas.width / canvas.height;

let isDrawPending = false;
function redraw() {
  if (isDrawPending || !scene) return;
  isDrawPending = true;
  requestAnimationFrame(() => { isDrawPending = false; drawNow(); });
}
function drawNow() {
  const {edges, picked} = choice, isDark = getComputedStyle(byId('panel')).color.match(/\d+/g)[0] > 128;
  scene.draw({edges, picked, isDark, pixels: canvas.width / canvas.clientWidth});
  drawAxes();
}

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
  const {quantity} = choice, values = quantity.values?.() ?? null;
  const withStatus = mesh.status.length && (quantity === statusQuantity || (values && choice.hasMarks));
  const sides = vertexSides(quantity), codes = vertexCodes(values, withStatus, sides);
  shown = {values, codes, sides, ...(values && summarize(values, codes))};
  byId('quantity').value = quantity.name;
  byId('mapping').hidden = byId('scale').hidden = !values;
  byId('marks-label').hidden = !mesh.status.length;
  if (values) showStatistics();
  showLegend();
  updateColors();
}

// The same numbers, other colors.
function updateColors() {
  const {values, codes, sides} = shown, levels = new Float32Array(mesh.size);
  range = values && colorRange(shown.sorted, shown.magnitudes, choice.clip, choice.quantity.resolution);
  if (values && !choice.isScaleChosen) choice.isLog = prefersLog(range);
  if (values)
    for (let i = 0; i < levels.length; ++i) if (codes[i] === 0) levels[i] = mapPosition(values[i], range, choice.isLog);
  scene.setColors({levels, codes, sides}, values && (range.isDiverging ? facts.diverging : facts.sequential));
  for (const [id, isOn] of [['scale-linear', !choice.isLog], ['scale-log', choice.isLog]])
    byId(id).setAttribute('aria-pressed', isOn);
  byId('clip').value = clipSteps.indexOf(choice.clip);
  byId('clip-text').value = choice.clip + ' %';
  for (const [id, isOn] of [['edges', choice.edges], ['isolines', choice.isolines], ['marks', choice.hasMarks]])
    byId(id).checked = isOn;
  byId('vectors').value = choice.vectors?.name ?? '';
  drawScale();
  showPicked();
  redraw();
}

function showStatistics() {
  const {sorted} = shown, table = byId('statistics');
  table.replaceChildren();
  for (const [name, percent] of [['minimum', 0], ['median', 50], ['maximum', 100]])
    addRow(table, element('span', 'quiet', name), sorted.length ? readable(quantile(sorted, percent)) : '–');
}

function showLegend() {
  const table = byId('legend'), total = mesh.size.toLocaleString('en');
  table.replaceChildren();
  addRow(table, element('span', 'quiet', 'vertices'), total);
  addRow(table, element('span', 'quiet', 'triangles'), (mesh.triangles.length / 3).toLocaleString('en'));
  const withColors = choice.quantity !== plain && (choice.hasMarks || choice.quantity === statusQuantity);
  const counts = facts.statuses.map(() => 0);
  for (const status of mesh.status) ++counts[status];
  const swatch = color => {
    const result = element('span', 'swatch');
    result.style.background = color;
    return result;
  };
  if (mesh.status.length)
    facts.statuses.forEach(({word, color}, i) => {
      const isColored = withColors && (i > 0 || choice.quantity === statusQuantity);
      if (counts[i] || i === 0) addRow(table, isColored ? [swatch(color), word] : word, counts[i].toLocaleString('en'));
    });
  if (shown.sides?.some(side => side < 0) && shown.sides.some(side => side >= 0))
    addRow(table, [swatch(facts.statuses[1].color), 'parabolic curve'], 'infinite');
  const missing = shown.codes.reduce((sum, code) => sum + (code === 5), 0);
  if (missing) addRow(table, [swatch(facts.undefined), 'no number'], missing.toLocaleString('en'));
}
)js";

} // namespace equiaffine::internal

#endif
