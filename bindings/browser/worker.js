// SPDX-License-Identifier: GPL-3.0-or-later
// The worker of the playground. make_page.py puts module.mjs and equiaffine.mjs before it.

let use, current = null;
const library = new Promise(resolve => { use = resolve; });
const report = (stage, done, total) => self.postMessage({id: current, progress: {stage, done, total}});
const taken = {volume: null, smoothing: 0};  // the volume in the module, and its smoothing

// Returns the default level of a volume: 0 if it is between the minimum and the maximum, otherwise their mean.
function levelIn(values) {
  let least = Infinity, greatest = -Infinity;
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < least) least = value;
    if (value > greatest) greatest = value;
  }
  if (least > greatest) throw new Mistake('the volume has no finite values; use another one', '', '');
  return least < 0 && greatest > 0 ? 0 : (least + greatest) / 2;
}

// Returns the names in a formula that have no value yet.
function unknownNames(ea, {formula, constants}) {
  const names = [], all = {...constants};
  for (let error = null; names.length < 1000; names.push(error.unknownName), all[error.unknownName] = 1) {
    try {
      ea.parse(formula, all);
      return names;
    } catch (mistake) {
      if (!mistake.unknownName) return names;
      error = mistake;
    }
  }
  return names;
}

// Computes a surface; returns level, smoothing, noise and distinct values of a volume.
async function compute(ea, {kind, ...task}) {
  if (kind === 'sample') return ea.sample(task.formula, task);
  if (kind === 'file' && !isVolume(task.name)) {
    if (!/\.(ply|off|obj|stl|xyz|csv)$/i.test(task.name))
      throw new Mistake(`cannot read '${task.name}': unknown extension; use .ply .off .obj .stl .xyz .csv for a mesh or points, ` +
                        '.nrrd .mha .nii .nii.gz for a volume', '', '');
    return ea.fit(task.name, task.bytes, {scale: null, ...task});
  }
  if (kind === 'file') taken.volume = await readVolume(task.name, task.bytes);
  if (kind === 'file' || task.smoothing !== taken.smoothing) ea.takeVolume(taken.volume, task.smoothing);
  taken.smoothing = task.smoothing;
  const level = task.level ?? levelIn(taken.volume.values);
  return {level, smoothing: task.smoothing, ...ea.extract({...task, level})};
}

self.onmessage = async ({data: {id, wasm, ...task}}) => {
  if (wasm) return use(load({wasm, onProgress: report}));
  try {
    const ea = await library, begin = performance.now();
    current = id;
    const volume = await compute(ea, task), page = ea.page();
    self.postMessage({id, page, volume, milliseconds: performance.now() - begin},
                     [page.positions.buffer, page.triangles.buffer, page.status.buffer, page.parts.buffer]);
  } catch (error) {
    const {message, excerpt = '', unknownName = ''} = error;
    self.postMessage({id, mistake: {message, excerpt, isFatal: !(error instanceof Mistake)},
                      unknownNames: unknownName ? unknownNames(await library, task) : undefined});
  }
};
