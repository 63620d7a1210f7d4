// SPDX-License-Identifier: GPL-3.0-or-later
// The worker of the playground, behind module.mjs and equiaffine.mjs in one text: it computes while the page is used.

let use;
const library = new Promise(resolve => { use = resolve; });
self.onmessage = async ({data: {id, wasm, kind, ...task}}) => {
  if (wasm) return use(load({wasm}));
  try {
    const ea = await library, begin = performance.now();
    if (kind === 'fit') ea.fit(task.name, task.bytes, task);
    else ea.sample(task.formula, task);
    const page = ea.page();
    self.postMessage({id, page, milliseconds: performance.now() - begin},
                     [page.positions.buffer, page.triangles.buffer, page.status.buffer, page.parts.buffer]);
  } catch (error) {
    const {message, excerpt = '', unknownName = ''} = error;
    self.postMessage({id, mistake: {message, excerpt, unknownName, isFatal: !(error instanceof Mistake)}});
  }
};
