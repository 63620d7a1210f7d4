// SPDX-License-Identifier: GPL-3.0-or-later
// Tries the npm package as it is delivered: package_test.mjs TARBALL [PROGRAM]. With the program of the same library, the
// surfaces of both are compared bit by bit.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, mkdirSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {deflateSync, gzipSync} from 'node:zlib';

const [tarball, program] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), 'equiaffine-'));
process.on('exit', () => rmSync(folder, {recursive: true}));
mkdirSync(join(folder, 'node_modules'));
execFileSync('tar', ['-xzf', tarball, '-C', join(folder, 'node_modules'), '--transform', 's/^package/equiaffine/']);
writeFileSync(join(folder, 'use.mjs'), "export * from 'equiaffine';\n");
const {load, Mistake, readVolume} = await import(pathToFileURL(join(folder, 'use.mjs')));
const progress = [];
const equiaffine = await load({onProgress: (...step) => progress.push(step)});

const torus = '(sqrt(x^2 + y^2) - R)^2 + z^2 = r^2', box = [-3, 3, -3, 3, -1, 1];
{
  const {positions, triangles, status, attributes} = equiaffine.mesh(torus, {constants: {R: 2, r: 0.7}, box});
  const size = positions.length / 3;
  assert(size > 3000 && status.length === size && attributes.nx.length === size);
  assert.equal(size - triangles.length / 6, 0, 'the Euler characteristic of a torus');
  for (let i = 0; i < size; ++i) {
    const [x, y, z] = positions.subarray(3 * i), rho = Math.hypot(x, y);
    assert(Math.abs((rho - 2) ** 2 + z ** 2 - 0.49) < 1e-13, 'vertices lie on the surface');
    const gaussian = (rho - 2) / 0.7 / (0.7 * rho);
    assert(Math.abs(attributes.gaussian_curvature[i] - gaussian) < 1e-11, 'the Gaussian curvature is that of a torus');
  }
}
{
  const {attributes} = equiaffine.mesh('x^2 + y^2 + z^2', {box: [-1, 1, -1, 1, -1, 1], level: 0.25, resolution: 20});
  assert(attributes.affine_gaussian_curvature.every(K => Math.abs(K - 8) < 1e-9), 'K of a sphere is r^-3');
}
assert.throws(() => equiaffine.parse('x^2 + foo*y'), error =>
    error instanceof Mistake && error.unknownName === 'foo' && error.excerpt.endsWith('^'));
assert.throws(() => equiaffine.mesh('x +', {box}), /unexpected end/);
for (const wrong of [{resolution: 5000}, {resolution: 2 ** 32 + 10}, {resolution: 1}, {level: NaN}, {box: [-1, 1, -1]},
                     {box: [0, 0, 0, 0, 0, 0]}, {box: [NaN, 1, -1, 1, -1, 1]}, {box: undefined}])
  assert.throws(() => equiaffine.mesh('x', {box, ...wrong}), Mistake, JSON.stringify(wrong));
{
  // A paraboloid as points: H = 0 and H_e is known.
  const lines = [];
  for (let i = -12; i <= 12; ++i)
    for (let j = -12; j <= 12; ++j) lines.push(`${i / 12} ${j / 12} ${(i * i + j * j) / 288}`);
  const fit = equiaffine.annotate('paraboloid.xyz', new TextEncoder().encode(lines.join('\n')), {scale: 0});
  const middle = lines.indexOf('0 0 0'), H = fit.attributes.mean_curvature[middle];
  assert(Math.abs(Math.abs(H) - 1) <= fit.attributes.mean_curvature_error[middle] + 1e-9, 'H_e of a paraboloid');
  assert(Math.abs(fit.attributes.affine_mean_curvature[middle]) < 1e-3, 'H of a paraboloid is zero');
}
{
  // A ball as a volume, in a header of each format.
  const n = 24, values = new Float32Array(n ** 3);
  for (let k = 0; k < n ** 3; ++k)
    values[k] = Math.hypot(k % n - 11.5, Math.floor(k / n) % n - 11.4, Math.floor(k / n / n) - 11.3) ** 2 / 400;
  const data = Buffer.from(values.buffer);
  const nifti = Buffer.alloc(352);
  nifti.writeInt32LE(348, 0);
  [3, n, n, n].forEach((number, k) => nifti.writeInt16LE(number, 40 + 2 * k));
  nifti.writeInt16LE(16, 70);
  [0.1, 0.1, 0.1].forEach((step, k) => nifti.writeFloatLE(step, 80 + 4 * k));
  nifti.writeFloatLE(352, 108);
  nifti.write('n+1', 344);
  const nrrd = encoding => Buffer.from(`NRRD0004\n# a comment\ntype: float\ndimension: 3\nsizes: ${n} ${n} ${n}\n` +
      `spacings: 0.1 0.1 0.1\nendian: little\nencoding: ${encoding}\n\n`);
  const meta = isZipped => Buffer.from(`ObjectType = Image\nNDims = 3\nCompressedData = ${isZipped}\nDimSize = ${n} ${n} ${n}\n` +
      'ElementSpacing = 0.1 0.1 0.1\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n');
  const files = {
    'a.nrrd': Buffer.concat([nrrd('raw'), data]), 'b.nrrd': Buffer.concat([nrrd('gzip'), gzipSync(data)]),
    'a.mha': Buffer.concat([meta('False'), data]), 'b.mha': Buffer.concat([meta('True'), deflateSync(data)]),
    'a.nii': Buffer.concat([nifti, data]), 'a.nii.gz': gzipSync(Buffer.concat([nifti, data])),
  };
  for (const [name, bytes] of Object.entries(files)) {
    const {attributes, triangles, noise, distinctValues} = equiaffine.levelSet(await readVolume(name, bytes), {level: 0.25});
    assert(triangles.length > 3000, name);
    assert(noise < 1e-6 && distinctValues === null, `${name}: no noise and many values`);
    assert(attributes.affine_gaussian_curvature_error.every(error => error < 0.1), `${name}: K is known`);
    assert(attributes.affine_mean_curvature_error.every(error => error < 0.1), `${name}: H is known`);
    assert(attributes.affine_gaussian_curvature.every(K => Math.abs(K - 1) < 0.01), `${name}: K of a unit ball is 1`);
    for (const part of [bytes.subarray(0, bytes.length / 2), bytes.subarray(0, 100), bytes.subarray(0, 4), Buffer.alloc(0)])
      await assert.rejects(readVolume(name, part), error => error instanceof Mistake && error.message.includes(name));
  }
  const mask = await readVolume('a.nrrd', files['a.nrrd']);
  mask.values.forEach((value, k) => mask.values[k] = value < 0.25 ? 1 : 0);
  const steps = equiaffine.levelSet(mask, {level: 0.5}), K = steps.attributes.affine_gaussian_curvature;
  assert.equal(steps.distinctValues, 2);
  const unknown = steps.attributes.affine_gaussian_curvature_error.filter((error, k) => !(error < Math.abs(K[k]) / 2)).length;
  assert(unknown > K.length / 2, 'K of a mask is unknown at most vertices');
  const bomb = Buffer.concat([Buffer.from('NRRD0004\ntype: double\ndimension: 3\nsizes: 3000 3000 3000\nencoding: gzip\n\n')]);
  await assert.rejects(readVolume('bomb.nrrd', bomb), /at most 16777216 can be sampled/);
}
{
  const bytes = new TextEncoder().encode('OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n');
  assert.equal(equiaffine.annotate('a.off', bytes.buffer).positions.length, 9, 'an ArrayBuffer will do');
}
assert.throws(() => equiaffine.annotate('a.ply', new Uint8Array([1, 2, 3])), /a\.ply/);
{
  const before = process.memoryUsage().rss;
  for (let i = 0; i < 200; ++i) equiaffine.mesh('x^2 + y^2 + z^2 - 1', {box: [-2, 2, -2, 2, -2, 2], resolution: 24});
  assert(process.memoryUsage().rss < before + 2 ** 26, 'memory does not grow from call to call');
}
assert(progress.length > 0 && progress.every(([stage, done, total]) => stage > 0 && done < total), 'progress is told');
console.log('the package works');

// The numbers of a binary PLY file that the program wrote.
function readPLY(path) {
  const bytes = readFileSync(path), end = bytes.indexOf('end_header\n') + 11, header = bytes.subarray(0, end).toString();
  const count = name => Number(new RegExp(`element ${name} (\\d+)`).exec(header)[1]);
  const names = [...header.matchAll(/property double (\S+)/g)].map(([, name]) => name);
  const size = count('vertex'), faces = count('face'), stride = 8 * names.length + 1;
  const view = new DataView(bytes.buffer, bytes.byteOffset + end);
  const columns = names.map((name, k) => Float64Array.from({length: size},
                                                           (_, i) => view.getFloat64(stride * i + 8 * k, true)));
  const status = Uint8Array.from({length: size}, (_, i) => view.getUint8(stride * (i + 1) - 1));
  const triangles = Uint32Array.from({length: 3 * faces}, (_, k) =>
      view.getUint32(stride * size + 13 * Math.floor(k / 3) + 1 + 4 * (k % 3), true));
  return {names, columns, status, triangles};
}

// Those of the report of the paper, and others whose operations are exact or the library's own: equal in every bit.
const exact = {
  'the ellipsoid': ['x^2 + 2*y^2 + 3*z^2 = 1', [-1.2, 1.2, -1.2, 1.2, -1.2, 1.2]],
  'the blobby surface': ['(3*x)^4+(3*y)^4+(3*z)^4-45*x^2-45*y^2-45*z^2+6', [-1.2, 1.2, -1.2, 1.2, -1.2, 1.2]],
  'the torus': ['(x^2+y^2+z^2+3.51)^2 = 16*(x^2+y^2)', [-3, 3, -3, 3, -1, 1]],
  'a tangle': ['x^4-5*x^2+y^4-5*y^2+z^4-5*z^2+11.8', [-3, 3, -3, 3, -3, 3]],
  'a gyroid': ['sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)', [-4, 4, -4, 4, -4, 4]],
  'metaballs': ['exp(-x^2-y^2-z^2)+exp(-(x-1)^2-y^2-z^2)-0.7', [-3, 3, -3, 3, -3, 3]],
  'planes that cross': ['x*y*z', [-1, 1, -1, 1, -1, 1]],
};
// Functions of the C library differ in their last bits: K to within 1e-10 of its size, and 1e-8 beside parabolic curves,
// where it goes to infinity.
const close = {
  'a power': ['abs(x)^2.3+abs(y)^2.3+abs(z)^2.3-1', [-1.5, 1.5, -1.5, 1.5, -1.5, 1.5]],
  'a logarithm': ['log(1+x^2)+y^2+z^2-1', [-2, 2, -2, 2, -2, 2]],
  'hyperbolic functions': ['tanh(x)+tan(y/3)+cosh(z)-1.6', [-2, 2, -2, 2, -2, 2]],
};

// Calls the function with two numbers that are not equal in their bits, for each such pair.
function eachDifference(numbers, others, use) {
  numbers.forEach((number, i) => { if (!Object.is(number, others[i])) use(number, others[i]); });
}

function compare(name, [formula, place], resolution, isExact) {
  const file = join(folder, 'native.ply');
  execFileSync(program, ['mesh', '--function', formula, '--box', ...place.map(String), '--resolution', String(resolution),
                         '-o', file]);
  const native = readPLY(file), here = equiaffine.mesh(formula, {box: place, resolution});
  assert.deepEqual(here.triangles, native.triangles, `${name}: triangles`);
  assert.deepEqual(here.status, native.status, `${name}: statuses`);
  native.names.forEach((column, k) => {
    const numbers = 'xyz'.includes(column) ? here.positions.filter((_, i) => i % 3 === k) : here.attributes[column];
    const isAngle = column === 'affine_normal_angle';  // is an arc tangent
    if (isExact)
      eachDifference(numbers, native.columns[k], (here, there) =>
          assert(isAngle && Math.abs(here - there) < 1e-12, `${name}: ${column} ${here} is not ${there}`));
    else if (column === 'affine_gaussian_curvature')
      eachDifference(numbers, native.columns[k], (here, there) =>
          assert(Math.abs(here - there) <= (Math.abs(there) < 1e6 ? 1e-10 : 1e-8) * Math.abs(there), `${name}: K ${here} is not ${there}`));
  });
}
// Samples of a function without symmetries, in frames that headers state in each way.
function framedFiles() {
  const [nx, ny, nz] = [20, 16, 12], values = new Float32Array(nx * ny * nz);
  for (let k = 0; k < values.length; ++k) {
    const x = k % nx / 8 - 1.2, y = Math.floor(k / nx) % ny / 7 - 1.1, z = Math.floor(k / nx / ny) / 6 - 0.9;
    values[k] = x * x + 2 * y * y + 3 * z * z + x * y * z + 0.3 * x;
  }
  const data = Buffer.from(values.buffer), files = {};
  const nifti = write => {
    const header = Buffer.alloc(352);
    header.writeInt32LE(348, 0);
    [3, nx, ny, nz].forEach((number, k) => header.writeInt16LE(number, 40 + 2 * k));
    header.writeInt16LE(16, 70);
    header.writeInt16LE(32, 72);
    [1, 0.5, 0.6, 0.7].forEach((step, k) => header.writeFloatLE(step, 76 + 4 * k));
    header.writeFloatLE(352, 108);
    header.write('n+1', 344);
    write(header);
    return Buffer.concat([header, data]);
  };
  const qform = header => {
    header.writeInt16LE(1, 252);
    [0.5, 0.5, 0.5, 3, 4, 5].forEach((number, k) => header.writeFloatLE(number, 256 + 4 * k));
  };
  const sform = header => {
    header.writeInt16LE(1, 254);
    [0, -0.6, 0, 1, 0.5, 0, 0, 2, 0, 0, 0.7, 3].forEach((number, k) => header.writeFloatLE(number, 280 + 4 * k));
  };
  files['none.nii'] = nifti(() => {});
  files['q.nii'] = nifti(qform);
  files['s.nii'] = nifti(sform);
  files['both.nii'] = nifti(header => { qform(header); sform(header); });
  files['micrometers.nii'] = nifti(header => { sform(header); header.writeUInt8(3, 123); });
  const nrrd = lines => Buffer.concat([Buffer.from(`NRRD0004\ntype: float\ndimension: 3\nsizes: ${nx} ${ny} ${nz}\n` +
      `${lines}endian: little\nencoding: raw\n\n`), data]);
  files['ras.nrrd'] = nrrd('space: right-anterior-superior\nspace directions: (0,0.5,0) (-0.6,0,0) (0,0,0.7)\nspace origin: (1,2,3)\n');
  files['lps.nrrd'] = nrrd('space: left-posterior-superior\nspace directions: (0.5,0.1,0) (0,0.6,0.1) (0,0,0.7)\nspace origin: (1,2,3)\n');
  files['spacings.nrrd'] = nrrd('spacings: 0.5 0.6 0.7\n');
  files['a.mha'] = Buffer.concat([Buffer.from('ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n' +
      'TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 1 2 3\nElementSpacing = 0.5 0.6 0.7\n' +
      `DimSize = ${nx} ${ny} ${nz}\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n`), data]);
  return files;
}

// What headers say that would make other samples of the data is refused.
async function refuseOddHeaders() {
  const nrrd = lines => Buffer.concat([Buffer.from(`NRRD0004\ntype: uchar\nsizes: 4 4 4\n${lines}encoding: raw\n\n`), Buffer.alloc(64)]);
  const meta = lines => Buffer.concat([Buffer.from(`ElementType = MET_UCHAR\n${lines}ElementDataFile = LOCAL\n`), Buffer.alloc(64)]);
  await readVolume('good.nrrd', nrrd('dimension: 3\n'));
  await readVolume('good.mha', meta('NDims = 3\nDimSize = 4 4 4\nComment = ElementDataFile = x\n'));
  const odd = {
    'skip.nrrd': nrrd('dimension: 3\nbyte skip: 4\n'), 'line.nrrd': nrrd('dimension: 3\nline skip: 1\n'),
    'dimension.nrrd': nrrd('dimension: 4\n'), 'direction.nrrd': nrrd('dimension: 3\nspace directions: none (0,1,0) (0,0,1)\n'),
    'spacing.nrrd': nrrd('dimension: 3\nspacings: 0 1 1\n'), 'text.mha': meta('NDims = 3\nDimSize = 4 4 4\nBinaryData = False\n'),
    'axes.mha': meta('NDims = 4\nDimSize = 4 4 4\n'), 'size.mha': meta('NDims = 3\n'),
  };
  for (const [name, bytes] of Object.entries(odd))
    await assert.rejects(readVolume(name, bytes), error => error instanceof Mistake && error.message.includes(name), name);
}
await refuseOddHeaders();

// The level set of a volume is the same here and there. Without bytes the program writes the volume.
async function compareVolume(name, bytes) {
  const file = join(folder, name), output = join(folder, 'native.ply');
  if (bytes) writeFileSync(file, bytes);
  else
    execFileSync(program, ['sample', '--function', '(x^2 + 2*y^2 + 3*z^2)*exp(x*y)', '--box', '-1', '1', '-1', '1', '-1', '1',
                           '--resolution', '40', '30', '20', '--type', 'float', '-o', file]);
  execFileSync(program, ['mesh', '--volume', file, '--level', '0.4', '-o', output]);
  const native = readPLY(output), here = equiaffine.levelSet(await readVolume(name, readFileSync(file)), {level: 0.4});
  assert.deepEqual(here.triangles, native.triangles, `${name}: triangles`);
  assert.deepEqual(here.status, native.status, `${name}: statuses`);
  native.names.forEach((column, k) => {
    const isPosition = 'xyz'.includes(column);
    if (bytes && !isPosition) return;  // ITK rounds the steps of frames
    const numbers = isPosition ? here.positions.filter((_, i) => i % 3 === k) : here.attributes[column];
    eachDifference(numbers, native.columns[k], (here, there) =>
        assert((bytes || column === 'affine_normal_angle') && Math.abs(here - there) < 1e-12,
               `${name}: ${column} ${here} is not ${there}`));
  });
}

if (program) {
  for (const name of ['v.nrrd', 'v.mha', 'v.nii', 'v.nii.gz']) await compareVolume(name);
  for (const [name, bytes] of Object.entries(framedFiles())) await compareVolume(name, bytes);
  for (const resolution of [64, 128]) {
    for (const [name, surface] of Object.entries(exact)) compare(name, surface, resolution, true);
    for (const [name, surface] of Object.entries(close)) compare(name, surface, resolution, false);
  }
  console.log('its surfaces are those of the program');
}
