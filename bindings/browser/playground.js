// SPDX-License-Identifier: GPL-3.0-or-later
// The playground: shows the surface of a formula, with a slider for each name in it. A worker computes a coarse surface
// while the input changes, and a fine one afterwards; the last surface stays visible meanwhile. boot.js passes
// `wasmBytes` and `workerText`.

const COARSE = 64, REST = 250;  // nodes of the coarse surface; milliseconds before the fine one
const MOST_BYTES = 2 ** 29;  // of a file
const ATTRIBUTES = 'all,quadric_defect,shape_index,curvedness';
// The requested formula; names: {NAME: [value, minimum, maximum]}.
const state = {formula: '', names: Object.create(null), box: [-1, 1, -1, 1, -1, 1], nodes: 96, level: 0};
// The requested file, and the file whose surface is shown; null for a formula. A file is {name, bytes, level, worker};
// the last two are the level of a volume and the worker that has read it.
let askedFile = null, shownFile = null;

function finish({id, page, volume, progress, mistake, unknownNames, milliseconds}) {
  if (id !== undefined && running?.id !== id) return;
  if (progress) {
    running.progress = `step ${progress.stage}, ${Math.floor(100 * progress.done / progress.total)} %, `;
    return;
  }
  const task = running;
  running = null;
  showWork();
  if (!waiting && (mistake || task?.isFine)) setBusy(false);
  if (mistake?.isFatal) renewWorker();  // the memory of a worker does not shrink
  if (task && task.file === askedFile) {
    if (unknownNames) addNames(unknownNames);
    else if (mistake) fail(task, mistake);
    else succeed(task, page, volume, milliseconds);
  }
  if (!running) runNext();
}
function addNames(names) {
  for (const name of names) state.names[name] ??= [1, 0, 2];
  fillNames();
  if (!waiting) requestBoth();
}
function fail(task, mistake) {
  say(mistake, task);
  if (task.file && task.file !== shownFile) askFor(shownFile);
  if (!scene) byId('message').textContent = 'No surface yet; correct the formula or choose an example';
}
function succeed(task, page, volume, milliseconds) {
  say(null);
  if (volume) Object.assign(task.file, {level: volume.level, worker});
  shownFile = task.file;
  showLevel();
  show(page, task);
  const size = task.file ? '' : `${task.resolution}³ nodes: `;
  const time = `${mesh.size.toLocaleString('en')} vertices in ${Math.max(1, Math.round(milliseconds))} ms`;
  byId('cost').textContent = [size + time, ...volume ? textOfSamples(volume) : []].join('; ');
}
function textOfSamples({noise, smoothing, distinctValues}) {
  const text = [`noise in the samples: ${Number(noise.toPrecision(3))}, smoothing: ${smoothing} voxels`];
  if (distinctValues && smoothing === 0)
    text.push(`the samples have only ${distinctValues} distinct value${distinctValues === 1 ? '' : 's'}, and the ` +
              'curvatures show the steps between them; increase the smoothing');
  return text;
}

// Requests a file, or the formula if `file` is null. The controls of a formula are hidden for a file.
function askFor(file) {
  askedFile = file;
  byId('formula-part').classList.toggle('has-file', Boolean(file));
  showLevel();
}
function showLevel() {
  byId('level-row').hidden = Boolean(askedFile) && askedFile.level === undefined;
  byId('smoothing-row').hidden = askedFile?.level === undefined;
  if (document.activeElement !== byId('level')) byId('level').value = Number((askedFile?.level ?? state.level).toPrecision(6));
}

function say(mistake, task) {
  byId('mistake').hidden = !mistake;
  byId('formula').setAttribute('aria-invalid', Boolean(mistake && !task.file));
  if (mistake) byId('mistake').replaceChildren(element('b', '', mistake.message), mistake.excerpt);
}

// Shows a new surface, and keeps the selection and the camera.
function show(page, task) {
  const old = facts, {quantity, range: typed} = choice, wasEmpty = !mesh?.size;
  const name = wanted.quantity ?? quantity.name, vectorName = wanted.vectors ?? choice.vectors?.name;
  const column = i => page.columns.subarray(i * page.positions.length / 3, (i + 1) * page.positions.length / 3);
  takeSurface({facts: page.facts, positions: page.positions, triangles: page.triangles, status: page.status,
               parts: page.parts, column});
  document.title = shownFile?.name ?? exampleOf()?.name ?? 'Surface';
  byId('title').textContent = shownFile?.name ?? 'Equi-affine curvatures of a formula';
  byId('message').hidden = mesh.size > 0;
  byId('message').textContent = 'No point of the surface lies in the box; enlarge or move the box.';
  if (!scene) {
    document.body.classList.remove('is-empty');
    start();
    choice.picked = choice.origin = null;
    return;
  }
  areas = null;
  choice.picked = choice.origin = null;
  if (task.isFine && isAddressNew) pickAsAsked();
  camera.target = add(camera.target, add(old.center, facts.center, -1));
  scene.fillSurface();
  if (task.isFine) fillQuantities();
  setCut(...choice.cut);
  setVectors(vectors.find(each => each.name === vectorName) ?? null);
  setQuantity(quantities.find(each => each.name === name) ?? quantities[0], name === quantity.name ? typed : null);
  Object.assign(wanted, task.isFine ? {quantity: undefined, vectors: undefined} : {quantity: name, vectors: vectorName});
  if (task.isNew || wasEmpty) resetView();
  if (task.isFine && !shownFile) history.replaceState(null, '', fragment());
}

// Picked vertices in the address are indices of the fine surface.
let isAddressNew = true;
function pickAsAsked() {
  const words = new URLSearchParams(location.hash.slice(1));
  choice.picked = vertexAsked(words.get('pick'));
  choice.origin = vertexAsked(words.get('from'));
  isAddressNew = false;
}

// The coarse surface has few columns; the fine one shows a column that is missing. `wanted` has the names of such
// columns.
const wanted = {};
const chooseAtOnce = chooseByName;
chooseByName = (kind, name) => {
  const isThere = {quantity: quantities, vectors}[kind].some(each => each.name === name);
  wanted[kind] = undefined;
  if (!name || isThere) return chooseAtOnce(kind, name);
  wanted[kind] = name;
  requestBoth();
};

// Coloring needs the quantity, the sign of the Gaussian curvature, normals, and the selected vectors.
function attributesOfDrag() {
  const names = ['normal', 'gaussian_curvature', 'status'];
  const quantity = wanted.quantity ?? choice.quantity.name, vector = wanted.vectors ?? choice.vectors?.name;
  if (quantity !== 'plain' && quantity !== 'status') names.push(quantity);
  if (vector && vector !== 'n') names.push(vector);
  return names.join(',');
}
function taskOf(isFine, isNew) {
  const constants = Object.fromEntries(Object.entries(state.names).map(([name, [value]]) => [name, value]));
  return {kind: 'sample', file: null, change, formula: state.formula, constants, box: state.box, level: state.level, isFine, isNew,
          resolution: isFine ? state.nodes : Math.min(COARSE, state.nodes),
          attributes: isFine || !scene ? ATTRIBUTES : attributesOfDrag()};
}
// Requests the coarse surface now, and the fine one after REST milliseconds without a change.
function requestBoth(isNew = false) {
  if (askedFile) askFor(null);
  ++change;
  request(taskOf(false, isNew));
  clearTimeout(restTimer);
  restTimer = setTimeout(() => request(taskOf(true, false)), REST);
}

// A name in the formula gets a slider. It keeps its numbers if it disappears from the formula and returns.
const namesInFormula = () => new Set(state.formula.match(/[A-Za-z_]\w*/g));
function fillNames() {
  const used = namesInFormula();
  byId('names').replaceChildren(...Object.keys(state.names).filter(name => used.has(name)).map(rowOfName));
}
function rowOfName(name) {
  const row = element('div', 'row'), label = element('label', '', name), entry = state.names[name];
  const input = (type, value, title) =>
      Object.assign(document.createElement('input'), {type, step: 'any', value, title, ariaLabel: `${title} of ${name}`});
  const least = input('number', entry[1], 'minimum'), greatest = input('number', entry[2], 'maximum');
  const slider = input('range', entry[0], 'value'), typed = input('number', entry[0], 'value');
  slider.id = label.htmlFor = 'name-' + name;
  const bound = () => Object.assign(slider, {min: entry[1], max: entry[2], value: entry[0]});
  const change = (k, node) => {
    const number = Number(node.value), isFine = node.value.trim() !== '' && Number.isFinite(number);
    const isOrdered = k === 0 || (k === 1 ? number < entry[2] : number > entry[1]);
    node.setAttribute('aria-invalid', !(isFine && isOrdered));
    if (!isFine || !isOrdered) return;
    entry[k] = number;
    if (node === typed) [entry[1], entry[2]] = [Math.min(entry[1], number), Math.max(entry[2], number)];
    if (node !== slider) bound();
    [least.value, greatest.value] = [entry[1], entry[2]];
    if (node !== typed) typed.value = Number(entry[0].toPrecision(6));
    if (k === 0) requestBoth();
  };
  slider.addEventListener('input', () => change(0, slider));
  typed.addEventListener('input', () => change(0, typed));
  least.addEventListener('change', () => change(1, least));
  greatest.addEventListener('change', () => change(2, greatest));
  bound();
  row.append(label, slider, typed);
  const bounds = element('div', 'row bounds');
  bounds.append(element('span', ''), least, greatest);
  const both = element('div', '');
  both.append(row, bounds);
  return both;
}

const wholeBox = box => typeof box === 'number' ? [-box, box, -box, box, -box, box] : box;
function isBox(box) {
  return box.length === 6 && box.every(Number.isFinite) && [0, 2, 4].every(k => box[k] < box[k + 1]);
}
function takeBox() {
  const words = byId('box').value.trim().split(/[\s,;]+/).map(Number);
  const box = words.length === 1 ? wholeBox(Math.abs(words[0])) : words;
  byId('box').setAttribute('aria-invalid', !isBox(box));
  if (!isBox(box)) return;
  state.box = box;
  requestBoth();
}
const exampleOf = () => examples.find(({formula}) => formula === state.formula);

function showExample() {
  const example = exampleOf();
  byId('example').value = example?.name ?? '';
  byId('example-text').textContent = example?.text ?? '';
}
// Updates the controls from the state.
function showState() {
  byId('formula').value = state.formula;
  byId('box').value = state.box.join(' ');
  showLevel();
  byId('nodes').value = state.nodes;
  byId('nodes-text').value = state.nodes + '³';
  showExample();
  fillNames();
}
const withoutPrototype = names => Object.assign(Object.create(null), names);
function takeExample({formula, names, box}) {
  Object.assign(state, {formula, names: withoutPrototype(structuredClone(names)), box: wholeBox(box), level: 0});
  showState();
  requestBoth(true);
}

// The address: f=FORMULA, box=SIX NUMBERS, nodes=N, level=NUMBER, names=NAME:VALUE:MINIMUM:MAXIMUM,...
moreOfAddress = () => shownFile ? {} : {
  f: encodeURIComponent(state.formula), box: state.box.join(','), nodes: state.nodes, level: state.level,
  names: [...namesInFormula()].filter(name => name in state.names)
      .map(name => [name, ...state.names[name]].join(':')).join(','),
};
// Takes the state from the address; returns whether it differs from what is shown.
function followFormula() {
  const words = new URLSearchParams(location.hash.slice(1)), formula = words.get('f');
  if (!formula) return false;
  const before = JSON.stringify(state), box = (words.get('box') ?? '').split(',').map(Number);
  const nodes = Number(words.get('nodes') || 96), level = Number(words.get('level') || 0);
  isAddressNew = true;
  Object.assign(state, {formula, names: Object.create(null), level: Number.isFinite(level) ? level : 0,
                        nodes: Number.isFinite(nodes) ? Math.min(256, Math.max(16, Math.round(nodes))) : 96});
  if (isBox(box)) state.box = box;
  for (const part of (words.get('names') ?? '').split(',')) {
    const [name, ...numbers] = part.split(':'), [value, least, greatest] = numbers.map(Number);
    if (/^[A-Za-z_]\w*$/.test(name) && [value, least, greatest].every(Number.isFinite) && least < greatest)
      state.names[name] = [value, least, greatest];
  }
  return Boolean(askedFile) || JSON.stringify(state) !== before;
}

// Requests the surface of the file, or another level set of its volume.
function requestFile(isNew) {
  request({file: askedFile, smoothing: Math.max(0, byId('smoothing').valueAsNumber || 0), attributes: ATTRIBUTES, isFine: true,
           isNew});
}
async function openFile(file) {
  const opened = {name: file.name};
  clearTimeout(restTimer);
  askFor(opened);
  byId('smoothing').value = 0;
  try {
    if (file.size > MOST_BYTES) throw new Error(`it has more than ${MOST_BYTES / 2 ** 20} MB; use the program`);
    opened.bytes = new Uint8Array(await file.arrayBuffer());
    if (askedFile === opened) requestFile(true);
  } catch (error) {
    if (askedFile === opened) fail({file: opened}, {message: `cannot read '${file.name}': ${error.message}`, excerpt: ''});
  }
}

byId('example').append(new Option('your own formula', ''), ...examples.map(({name}) => new Option(name, name)));
on('example', 'change', event => {
  const example = examples.find(({name}) => name === event.target.value);
  if (example) takeExample(example);
  else byId('formula').focus();
});
on('formula', 'input', () => {
  state.formula = byId('formula').value;
  showExample();
  fillNames();
  requestBoth();
});
on('box', 'change', takeBox);
on('level', 'input', event => {
  if (!Number.isFinite(event.target.valueAsNumber)) return;
  (askedFile ?? state).level = event.target.valueAsNumber;
  if (askedFile) requestFile(false);
  else requestBoth();
});
on('nodes', 'input', event => {
  state.nodes = Number(event.target.value);
  byId('nodes-text').value = state.nodes + '³';
  requestBoth();
});
on('file', 'change', event => { if (event.target.files[0]) openFile(event.target.files[0]); });
on('smoothing', 'change', () => { if (askedFile) requestFile(false); });
on('stop', 'click', stopTask);
on('formula-again', 'click', () => requestBoth(true));
for (const type of ['dragover', 'dragleave', 'drop'])
  document.addEventListener(type, event => {
    event.preventDefault();
    document.body.classList.toggle('is-dropping', type === 'dragover');
    if (type === 'drop' && event.dataTransfer.files[0]) openFile(event.dataTransfer.files[0]);
  });
window.addEventListener('hashchange', () => {
  if (!followFormula()) return;
  showState();
  requestBoth(true);
});

document.body.classList.add('is-empty');
startWorker();
if (followFormula()) {
  showState();
  requestBoth();
} else {
  takeExample(examples[0]);
}
