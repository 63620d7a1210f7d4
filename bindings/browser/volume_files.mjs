// SPDX-License-Identifier: GPL-3.0-or-later
// Reads scalar volumes: NRRD, MetaImage and NIfTI-1, compressed or not. Like the program, it converts them to ITK's
// frame (x to the left, y to the back, z up). It rejects files with unsupported fields.
import {Mistake, bytesOf} from './equiaffine.mjs';

const MOST_NODES = 2 ** 24;
export const isVolume = name => /\.(nrrd|mha|nii(\.gz)?)$/i.test(name);

// Throws a Mistake. The page shows its message.
function refuse(name, reason) {
  throw new Mistake(`cannot read the volume '${name}': ${reason}`, '', '');
}

// Decompresses at most `most` bytes, so that a small file cannot fill the memory.
async function decompressed(name, bytes, format, most) {
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream(format)).getReader();
  const result = new Uint8Array(most);
  let size = 0;
  try {
    for (let part = await reader.read(); !part.done && size < most; part = await reader.read()) {
      const taken = part.value.subarray(0, most - size);
      result.set(taken, size);
      size += taken.length;
    }
  } catch {
    if (size < most) refuse(name, 'its compressed data are damaged, or end before the size stated in the header');
  }
  reader.cancel().catch(() => {});
  return result.subarray(0, size);
}

const WIDTHS = {Int8: 1, Uint8: 1, Int16: 2, Uint16: 2, Int32: 4, Uint32: 4, Float32: 4, Float64: 8};

function nodesOf(name, size) {
  if (size.length !== 3) refuse(name, `the number of its axes is ${size.length}, but must be 3`);
  if (!size.every(n => Number.isInteger(n) && n >= 2))
    refuse(name, `it has ${size.join(' x ')} nodes, but at least 2 are needed along each axis`);
  const nodes = size[0] * size[1] * size[2];
  if (nodes > MOST_NODES)
    refuse(name, `it has ${size.join(' x ')} nodes, but at most ${MOST_NODES} can be sampled here; ` +
                 'use the program for more');
  return nodes;
}

// Returns the data as doubles. `type` is a key of WIDTHS.
function numbersOf(name, bytes, type, isLittle, nodes, slope = 1, intercept = 0) {
  const width = WIDTHS[type], view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (!width) refuse(name, 'its data type is not supported; use integers of at most 32 bits, float or double');
  if (bytes.length < width * nodes) refuse(name, 'the data end before the size stated in the header');
  const read = view['get' + type], values = new Float64Array(nodes);
  for (let i = 0; i < nodes; ++i) values[i] = slope * read.call(view, width * i, isLittle) + intercept;
  return values;
}

// `steps` are the vectors from a node to the next along each axis.
function placed(name, values, size, origin, steps) {
  const [[a, b, c], [d, e, f], [g, h, i]] = steps;
  const determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  if (!origin.every(Number.isFinite) || !Number.isFinite(determinant) || determinant === 0)
    refuse(name, 'its origin, spacings and directions do not define a grid; make them finite and the axes independent');
  return {values, size, origin, steps};
}

// Returns the fields of a header and the position after it. The first of several equal fields counts.
function fieldsOf(bytes, end, line) {
  const text = new TextDecoder('latin1').decode(bytes.subarray(0, 2 ** 20)), match = end.exec(text);
  if (!match) return null;
  const position = match.index + match[0].length, fields = Object.create(null);
  for (const each of text.slice(0, position).split(/\r?\n/)) {
    const [, key, value] = line.exec(each) ?? [];
    if (key) fields[key.trim().toLowerCase()] ??= value.trim();
  }
  return {fields, position};
}
// Words that are not numbers become NaN.
const numbersIn = text => (text ?? '').split(/[\s,()]+/).filter(Boolean).map(Number);
const isTrue = text => /^(true|t|1)/i.test(text ?? '');
const times = (spacing, k) => [0, 1, 2].map(axis => axis === k ? spacing : 0);

async function readNRRD(name, bytes) {
  const {fields, position} = fieldsOf(bytes, /^NRRD\d{4}[^]*?\r?\n\r?\n/, /^([^#:][^:]*):(?!=)(.*)$/) ??
      refuse(name, 'it is not an NRRD file');
  if (fields['data file'] || fields.datafile) refuse(name, 'its data are in another file; convert it to one file');
  for (const skip of ['byte skip', 'byteskip', 'line skip', 'lineskip'])
    if (Number(fields[skip] ?? 0) !== 0) refuse(name, `its field '${skip}' is not supported`);
  const size = numbersIn(fields.sizes), nodes = nodesOf(name, size);
  if (Number(fields.dimension) !== 3) refuse(name, 'its dimension is not 3');
  const words = (fields.type ?? '').toLowerCase().replace(/_t$| int$/, '');
  const type = {'signed char': 'Int8', int8: 'Int8', uchar: 'Uint8', 'unsigned char': 'Uint8', uint8: 'Uint8',
                short: 'Int16', int16: 'Int16', 'signed short': 'Int16', ushort: 'Uint16', 'unsigned short': 'Uint16',
                uint16: 'Uint16', int: 'Int32', int32: 'Int32', 'signed int': 'Int32', uint: 'Uint32',
                'unsigned int': 'Uint32', uint32: 'Uint32', float: 'Float32', double: 'Float64'}[words];
  const encoding = (fields.encoding ?? 'raw').toLowerCase();
  if (!['raw', 'gzip', 'gz'].includes(encoding)) refuse(name, `its encoding ${encoding} is not supported; use raw or gzip`);
  let data = bytes.subarray(position);
  if (encoding !== 'raw') data = await decompressed(name, data, 'gzip', (WIDTHS[type] ?? 1) * nodes);
  const vectors = (fields['space directions'] ?? '').match(/\([^)]*\)/g)?.map(numbersIn);
  if (fields['space directions'] && vectors?.length !== 3) refuse(name, 'its space directions are not three vectors');
  const spacings = numbersIn(fields.spacings);
  const toLPS = /^(RAS|right-anterior)/i.test(fields.space ?? '') ? [-1, -1, 1]
      : /^(LAS|left-anterior)/i.test(fields.space ?? '') ? [1, -1, 1] : [1, 1, 1];
  const turned = vector => vector.map((x, axis) => x * toLPS[axis]);
  const steps = vectors?.length === 3 && vectors.every(v => v.length === 3) ? vectors.map(turned)
      : [0, 1, 2].map(k => times(Number.isFinite(spacings[k]) ? spacings[k] : 1, k));
  const origin = numbersIn(fields['space origin']), least = numbersIn(fields['axis mins'] ?? fields.axismins);
  return placed(name, numbersOf(name, data, type, !/^big$/i.test(fields.endian ?? ''), nodes), size,
                origin.length === 3 ? turned(origin) : least.length === 3 && !vectors ? least : [0, 0, 0], steps);
}

async function readMetaImage(name, bytes) {
  const {fields, position} = fieldsOf(bytes, /^\s*ElementDataFile\s*=[^\n]*\n/im, /^\s*(\w+)\s*=(.*)$/) ??
      refuse(name, 'it is not a MetaImage file');
  if (!/^local$/i.test(fields.elementdatafile)) refuse(name, 'its data are in another file; convert it to one file');
  if (Number(fields.elementnumberofchannels ?? 1) !== 1) refuse(name, 'it has several channels; extract one of them');
  if (Number(fields.ndims) !== 3) refuse(name, 'its NDims is not 3');
  if (fields.binarydata && !isTrue(fields.binarydata)) refuse(name, 'its data are text; convert them to binary data');
  const size = numbersIn(fields.dimsize), nodes = nodesOf(name, size);
  const type = {MET_CHAR: 'Int8', MET_UCHAR: 'Uint8', MET_SHORT: 'Int16', MET_USHORT: 'Uint16', MET_INT: 'Int32',
                MET_UINT: 'Uint32', MET_FLOAT: 'Float32', MET_DOUBLE: 'Float64'}[fields.elementtype];
  let data = bytes.subarray(position);
  if (isTrue(fields.compresseddata)) data = await decompressed(name, data, 'deflate', (WIDTHS[type] ?? 1) * nodes);
  const isBig = isTrue(fields.elementbyteordermsb ?? fields.binarydatabyteordermsb);
  const origin = numbersIn(fields.offset ?? fields.position ?? fields.origin), spacings = numbersIn(fields.elementspacing ?? fields.elementsize);
  const matrix = numbersIn(fields.transformmatrix ?? fields.rotation ?? fields.orientation);
  const steps = [0, 1, 2].map(k => {
    const direction = matrix.length === 9 ? matrix.slice(3 * k, 3 * k + 3) : times(1, k);
    return direction.map(x => x * (Number.isFinite(spacings[k]) ? spacings[k] : 1));
  });
  return placed(name, numbersOf(name, data, type, !isBig, nodes), size, origin.length === 3 ? origin : [0, 0, 0], steps);
}

async function readNIfTI(name, given) {
  const header = 352, most = header + 8 * MOST_NODES;
  const isZipped = given[0] === 0x1f && given[1] === 0x8b;
  let bytes = isZipped ? await decompressed(name, given, 'gzip', header) : given;
  if (bytes.length < header) refuse(name, 'it ends within its header');
  const view = new DataView(bytes.buffer, bytes.byteOffset, header), isLittle = view.getInt16(40, true) < 8;
  const short = at => view.getInt16(at, isLittle), float = at => view.getFloat32(at, isLittle);
  if (view.getInt32(0, isLittle) !== 348) refuse(name, 'it is not a NIfTI-1 file');
  if (view.getUint8(345) !== 0x2b) refuse(name, 'its data are in another file; convert it to one file');  // n+1
  const dimensions = Array.from({length: Math.min(7, Math.max(0, short(40)))}, (_, k) => short(42 + 2 * k));
  while (dimensions.length > 3 && dimensions.at(-1) === 1) dimensions.pop();
  const nodes = nodesOf(name, dimensions);
  const type = {2: 'Uint8', 4: 'Int16', 8: 'Int32', 16: 'Float32', 64: 'Float64', 256: 'Int8', 512: 'Uint16', 768: 'Uint32'}[short(70)];
  const begin = float(108) || header;
  if (!(begin >= 348 && begin <= most)) refuse(name, `its field vox_offset is ${begin}, but must be 348 to ${most}`);
  if (isZipped) bytes = await decompressed(name, given, 'gzip', begin + (WIDTHS[type] ?? 1) * nodes);
  const values = numbersOf(name, bytes.subarray(begin), type, isLittle, nodes, float(112) || 1, (float(112) && float(116)) || 0);
  const spacings = [80, 84, 88].map(float);
  let rows = [0, 1, 2].map(axis => [...times(spacings[axis], axis), 0]);
  // Of two frames, the program uses the second (sform) if it is that of the scanner.
  const hasSecond = short(254) > 0 && (short(252) <= 0 || short(254) === 1);
  if (hasSecond) {
    rows = [280, 296, 312].map(at => [0, 4, 8, 12].map(k => float(at + k)));
  } else if (short(252) > 0) {
    const [b, c, d] = [256, 260, 264].map(float), a = Math.sqrt(Math.max(0, 1 - b * b - c * c - d * d));
    const [sx, sy, sz] = [spacings[0], spacings[1], spacings[2] * (float(76) < 0 ? -1 : 1)];
    rows = [[(a * a + b * b - c * c - d * d) * sx, 2 * (b * c - a * d) * sy, 2 * (b * d + a * c) * sz, float(268)],
            [2 * (b * c + a * d) * sx, (a * a + c * c - b * b - d * d) * sy, 2 * (c * d - a * b) * sz, float(272)],
            [2 * (b * d - a * c) * sx, 2 * (c * d + a * b) * sy, (a * a + d * d - b * b - c * c) * sz, float(276)]];
  }
  const toLPS = short(252) > 0 || short(254) > 0 ? [-1, -1, 1] : [1, 1, 1];
  const unit = {1: 1e3, 3: 1e-3}[view.getUint8(123) & 7] ?? 1;  // meters and micrometers to millimeters
  const column = k => rows.map((row, axis) => unit * toLPS[axis] * row[k]);
  return placed(name, values, dimensions, column(3), [0, 1, 2].map(column));
}

export function readVolume(name, data) {
  const bytes = bytesOf(data);
  if (/\.nrrd$/i.test(name)) return readNRRD(name, bytes);
  return /\.mha$/i.test(name) ? readMetaImage(name, bytes) : readNIfTI(name, bytes);
}
