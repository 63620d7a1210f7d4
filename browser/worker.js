// SPDX-License-Identifier: GPL-3.0-or-later
// The worker of the playground, behind module.mjs and equiaffine.mjs in one text: it computes while the page is used.

let use, current = null;
const library = new Promise(resolve => { use = resolve; });
const report = (stage, done, total) => self.postMessage({id: current, progress: {stage, done, total}});
const taken = {volume: null, smoothing: 0};  // the volume of the module, and the scale of its smoothing

// Where a level set of a volume is to be, as long as nobody says: at 0, or half-way if all numbers are on one side.
function levelIn(values) {
  let least = Infinity, greatest = -Infinity;
  for (const value of values) {
    if (value < least) least = value;
    if (value > greatest) greatest = value;
  }
  return least < 0 && greatest > 0 ? 0 : (least + greatest) / 2;
}

async function compute(ea, {kind, ...task}) {
  if (kind === 'sample') return ea.sample(task.formula, task);
  if (kind === 'file' && !isVolume(task.name)) return ea.fit(task.name, task.bytes, {scale: null, ...task});
  if (kind === 'file') taken.volume = await readVolume(task.name, task.bytes);
  if (kind === 'file' || task.smoothing !== taken.smoothing) ea.takeVolume(taken.volume, task.smoothing);
  taken.smoothing = task.smoothing;
  const level = task.level ?? levelIn(taken.volume.values);
  ea.extract({...task, level});
  return level;
}

self.onmessage = async ({data: {id, wasm, ...task}}) => {
  if (wasm) return use(load({wasm, onProgress: report}));
  try {
    const ea = await library, begin = performance.now();
    current = id;
    const level = await compute(ea, task), page = ea.page();
    self.postMessage({id, page, level, milliseconds: performance.now() - begin},
                     [page.positions.buffer, page.triangles.buffer, page.status.buffer, page.parts.buffer]);
  } catch (error) {
    const {message, excerpt = '', unknownName = ''} = error;
    self.postMessage({id, mistake: {message, excerpt, unknownName, isFatal: !(error instanceof Mistake)}});
  }
};
