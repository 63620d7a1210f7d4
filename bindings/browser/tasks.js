// SPDX-License-Identifier: GPL-3.0-or-later
// The tasks of the playground: a worker computes one while only the latest other one waits.

const LONG = 1500;  // milliseconds, after which a new task ends the running one
let worker = null, compiled = null, running = null, waiting = null, count = 0, change = 0, restTimer = 0, clock = 0;

async function startWorker() {
  compiled ??= WebAssembly.compile(wasmBytes);
  const address = URL.createObjectURL(new Blob([workerText], {type: 'text/javascript'})), created = new Worker(address);
  worker = created;
  worker.onmessage = ({data}) => { if (created === worker) finish(data); };
  worker.onerror = event => { if (created === worker) finish({mistake: {message: event.message, excerpt: '', isFatal: true}}); };
  const wasm = await compiled;
  created.postMessage({wasm});
  URL.revokeObjectURL(address);
}

// A new task ends a running one that takes long, and immediately one that computes a file no longer requested. The fine
// surface waits for the coarse one of the same change.
function request(task) {
  waiting = task;
  setBusy(true);
  clearTimeout(clock);
  if (!running) return runNext();
  if (running.file && running.file !== task.file) return restart();
  if (!running.file && running.change !== task.change)
    clock = setTimeout(() => { if (waiting) restart(); }, Math.max(0, LONG - (performance.now() - running.begin)));
}
function runNext() {
  clearTimeout(clock);
  running = waiting;
  waiting = null;
  if (!running) return;
  Object.assign(running, {id: ++count, begin: performance.now(), progress: ''});
  worker.postMessage(messageOf(running));
}
// Returns the message to the worker. It includes the bytes of the file unless the worker has already read them.
function messageOf({id, file, kind, formula, constants, box, resolution, level, smoothing, attributes}) {
  if (!file) return {id, kind, formula, constants, box, resolution, level, attributes};
  const isThere = file.worker === worker;
  return {id, kind: isThere ? 'level' : 'file', name: file.name, ...(isThere ? {} : {bytes: file.bytes}),
          level: file.level, smoothing, attributes};
}
function renewWorker() {
  worker.terminate();
  startWorker();
}
function restart() {
  renewWorker();
  running = null;
  runNext();
  showWork();
}
// Ends the running task, and starts the waiting one if any.
function stopTask() {
  if (!waiting) {
    clearTimeout(restTimer);
    askFor(shownFile);
    setBusy(false);
  }
  restart();
}

const setBusy = isBusy => byId('stage').setAttribute('aria-busy', isBusy);
function showWork() {
  const isLong = running && performance.now() - running.begin > 500;
  byId('working').hidden = !isLong;
  if (!isLong) return;
  const seconds = Math.round((performance.now() - running.begin) / 1000);
  byId('working-text').textContent = `${running.file?.name ?? 'computing'}: ${running.progress}${seconds} s`;
}
setInterval(showWork, 250);
