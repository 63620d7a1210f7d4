// SPDX-License-Identifier: GPL-3.0-or-later
// The address of the page, which stores the view and the selected options.

// Unknown parameters of the address are ignored.
let moreOfAddress = () => ({});  // parameters added by the playground
function fragment() {
  const list = (values, digits) => values.map(value => Number(value.toPrecision(digits))).join(',');
  const parts = {
    color: encodeURIComponent(choice.quantity.name), clip: choice.clip,
    scale: choice.scale === 'logarithmic' ? 'log' : choice.scale,
    up: ['x', 'y', 'z'][camera.axis.indexOf(1)] ?? '',
    view: list([...camera.back, ...camera.up], 5), target: list(add(facts.center, camera.target), 9),
    zoom: list([4 * radius / camera.distance], 5), edges: Number(choice.edges),
    isolines: Number(choice.isolines), marks: Number(choice.hasMarks),
    vectors: encodeURIComponent(choice.vectors?.name ?? ''), pick: choice.picked ?? '', from: choice.origin ?? '',
    range: choice.range?.join(',') ?? '', cut: choice.cut.join(','),
    panel: Number(!document.body.classList.contains('no-panel')), ...moreOfAddress(),
  };
  return '#' + Object.entries(parts).map(([name, value]) => name + '=' + value).join('&');
}

function vertexAsked(text) {
  const vertex = Number(text || 'none');
  return Number.isInteger(vertex) && vertex >= 0 && vertex < mesh.size ? vertex : null;
}

function followAddress() {
  const asked = new URLSearchParams(location.hash.slice(1));
  const isOn = (name, otherwise) => asked.has(name) ? asked.get(name) === '1' : otherwise;
  const numbers = name => asked.has(name) ? asked.get(name).split(',').map(Number) : [];
  const isFine = (values, ...sizes) => sizes.includes(values.length) && values.every(Number.isFinite);
  if (/^(dark|light)$/.test(asked.get('theme') ?? '')) document.documentElement.dataset.theme = asked.get('theme');
  showPanel(isOn('panel', true));
  resize();
  if (/^[xyz]$/.test(asked.get('up') ?? '')) setUp(asked.get('up'));
  firstView();
  const view = numbers('view'), target = numbers('target'), zoomed = Number(asked.get('zoom'));
  if (isFine(view, 3, 6) && Math.hypot(...view.slice(0, 3)) > 0)
    lookFrom(view.slice(0, 3), view.length === 6 ? view.slice(3) : camera.axis);
  fitDistance(aspect());
  if (isFine(target, 3)) camera.target = add(target, facts.center, -1);
  if (zoomed > 0) camera.distance = 4 * radius / zoomed;
  const word = asked.get('scale') === 'log' ? 'logarithmic' : asked.get('scale');
  choice.scale = [...scales, 'auto'].includes(word) ? word : facts.scale;
  if (Number(asked.get('clip') ?? NaN) >= 0) setClip(Number(asked.get('clip')));
  choice.edges = isOn('edges', false);
  choice.isolines = isOn('isolines', false);
  choice.hasMarks = isOn('marks', true);
  setVectors(vectors.find(vector => vector.name === asked.get('vectors')) ?? null);
  const [side, share] = (asked.get('cut') ?? '').split(',');
  if (cutWords.includes(side)) chooseCut(side, Math.min(1, Math.max(0, Number(share ?? 0.5) || 0)));
  choice.picked = vertexAsked(asked.get('pick'));
  choice.origin = vertexAsked(asked.get('from'));
  const named = name => quantities.find(quantity => quantity.name === name);
  const first = named(facts.color) ?? quantities[0], quantity = named(asked.get('color')) ?? first;
  const range = numbers('range');
  setQuantity(quantity, isFine(range, 2) && range[0] < range[1] ? range : quantity === first ? facts.range : null);
}
