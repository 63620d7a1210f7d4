// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the module in node with the same functions as native code, alternately: run.mjs MODULE_FOLDER PEER PAGE.
import {spawn} from 'node:child_process';
import {readFileSync, statSync} from 'node:fs';
import {createInterface} from 'node:readline';
import {pathToFileURL} from 'node:url';
import {resolve} from 'node:path';

const [folder, program, page] = process.argv.slice(2);
const {load} = await import(pathToFileURL(resolve(folder, 'package/equiaffine.mjs')));
const equiaffine = await load();
const peer = spawn(program, {stdio: ['pipe', 'pipe', 'inherit']});
const answers = createInterface({input: peer.stdout})[Symbol.asyncIterator]();
const median = numbers => numbers.sort((a, b) => a - b)[numbers.length >> 1];
const figure = (name, value, unit, target = '') =>
    console.log(`figure ${name} ${Number(value.toPrecision(3))} ${unit}${target && ' target ' + target}`);

const blobby = '(3*x)^4+(3*y)^4+(3*z)^4-45*x^2-45*y^2-45*z^2+6', box = [-1.2, 1.2, -1.2, 1.2, -1.2, 1.2];
for (const [nodes, rounds] of [[64, 41], [128, 21], [256, 9]]) {
  const here = [], there = [];
  for (let round = 0; round < rounds; ++round) {
    const begin = performance.now();
    equiaffine.sample(blobby, {constants: {}, box, resolution: nodes, level: 0,
                               attributes: 'affine_gaussian_curvature,status'});
    here.push(performance.now() - begin);
    peer.stdin.write(`${nodes} ${blobby}\n`);
    there.push(Number((await answers.next()).value));
  }
  figure(`browser.module_${nodes}`, median(here), 'ms');
  figure(`browser.native_${nodes}`, median(there), 'ms');
  figure(`browser.module_over_native_${nodes}`, median(here) / median(there), 'ratio', '<=1.3');
}
peer.stdin.end();

// The computation of one frame of the playground while a slider moves.
const text = readFileSync(new URL('../../bindings/browser/examples.js', import.meta.url), 'utf8');
const examples = new Function(text + 'return examples;')();
let smooth = 0;
for (const {name, formula, names, box: place} of examples) {
  const [[first, [value, least, greatest]]] = Object.entries(names), times = [];
  for (let k = 0; k < 25; ++k) {
    const constants = Object.fromEntries(Object.entries(names).map(([key, [number]]) => [key, number]));
    constants[first] = value + (greatest - least) * k / 250;
    const begin = performance.now();
    equiaffine.sample(formula, {constants, box: typeof place === 'number' ? box.map(side => side / 1.2 * place) : place,
                                resolution: 64, level: 0,
                                attributes: 'normal,gaussian_curvature,affine_gaussian_curvature,status'});
    equiaffine.page();
    times.push(performance.now() - begin);
  }
  figure(`browser.frames_${name.replaceAll(' ', '_')}`, 1000 / median(times), 'per_second');
  smooth += 1000 / median(times) >= 20;
}
figure('browser.surfaces_with_20_frames_per_second', smooth, 'surfaces', '>=6');
figure('browser.page', statSync(page).size / 1000, 'kB', '<=600');
