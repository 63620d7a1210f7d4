// SPDX-License-Identifier: GPL-3.0-or-later
// The values of the picked vertex, vectors, and visibility of the panel.

// All values of a vertex: [column, value, number of correct digits].
function numbersOf(vertex) {
  const fine = radius * 2 ** -24;
  const rows = ['x', 'y', 'z'].map((name, k) => {
    const value = facts.center[k] + mesh.positions[3 * vertex + k];
    return [{name, label: name}, value, Math.max(1, Math.min(15, Math.ceil(Math.log10(Math.abs(value) / fine)) || 1))];
  });
  for (const column of facts.columns) rows.push([column, column.values()[vertex], 7]);
  return rows;
}

// Lists the values of the picked vertex, that of the current quantity first.
function showPicked() {
  const {picked, origin, quantity} = choice;
  byId('picked').hidden = picked === null;
  if (picked === null) return;
  byId('picked-title').textContent = 'Vertex ' + picked;
  const table = byId('picked-table');
  table.replaceChildren();
  if (origin !== null && origin !== picked) {
    const distance = Math.hypot(...add(positionOf(picked), positionOf(origin), -1));
    addRow(table, element('span', 'quiet', 'distance from vertex ' + origin), readable(distance));
  }
  if (mesh.status.length) addRow(table, element('span', 'quiet', 'status'), facts.statuses[mesh.status[picked]].word);
  const rows = numbersOf(picked);
  rows.sort(([a], [b]) => Number(b === quantity) - Number(a === quantity));
  for (const [column, value, digits] of rows) {
    const {label, symbol, ranges} = column;
    addRow(table, element('span', 'quiet', label.replaceAll('_', ' ') + (symbol ? ' ' + symbol : '')),
           ranges ? readableWithin(value, errorColumn(column)?.values()[picked], rangeOf(column))
                  : readable(value, digits));
  }
}

function copyText(text, button) {
  const report = word => {
    const before = button.dataset.label ??= button.textContent;
    button.textContent = word;
    setTimeout(() => { button.textContent = before; }, 1200);
  };
  const byHand = () => {
    const area = element('textarea', '', text);
    document.body.append(area);
    area.select();
    report(document.execCommand('copy') ? 'copied' : 'blocked by the browser');
    area.remove();
  };
  if (navigator.clipboard) navigator.clipboard.writeText(text).then(() => report('copied'), byHand);
  else byHand();
}

function pick(vertex) {
  choice.picked = vertex;
  if (vertex === null) choice.origin = null;
  showPicked();
  drawScale();
  redraw();
  const top = byId('picked').getBoundingClientRect().top, panel = byId('panel').getBoundingClientRect();
  if (vertex !== null && !(panel.top <= top && top + 150 <= panel.bottom)) byId('picked').scrollIntoView();
}

function measureFromPicked() {
  choice.origin = choice.picked;
  showPicked();
  redraw();
}

function setVectors(vector) {
  choice.vectors = vector;
  scene.setNeedles(vector ? needles(vector) : new Float32Array(0), !vector?.isLine);
}

function showPanel(isShown) {
  document.body.classList.toggle('no-panel', !isShown);
  byId('panel-toggle').setAttribute('aria-expanded', isShown);
  if (isShown) byId('quantity').after(byId('scale'));
  else stage.append(byId('scale'));
  byId('hint').hidden = !isShown || isTouched;
  drawScale();
}
