// SPDX-License-Identifier: GPL-3.0-or-later
// The JavaScript library: surfaces of formulas, and curvatures of meshes. See index.d.ts.
import createModule from './module.mjs';
export {readVolume} from './volume_files.mjs';

// An error in a formula, a file or an option. `excerpt` marks the place with a caret; `unknownName` is a name in the
// formula that has no value.
export class Mistake extends Error {
  constructor(message, excerpt, unknownName) {
    super(message);
    Object.assign(this, {name: 'Mistake', excerpt, unknownName});
  }
}

const MISTAKE = 1, MOST_PER_AXIS = 4096;
const isFinite = number => typeof number === 'number' && Number.isFinite(number);
function check(holds, message) {
  if (!holds) throw new Mistake(message, '', '');
}
export const bytesOf = data => data instanceof Uint8Array ? data : new Uint8Array(data.buffer ?? data);
const POSITIONS = 0, TRIANGLES = 1, STATUS = 2, PARTS = 3, POINTS = 4, FIRST_COLUMN = 5;

export class Equiaffine {
  #module;
  constructor(module) { this.#module = module; }

  // Throws a Mistake unless the formula is valid.
  parse(formula, constants = {}) {
    this.#call(pointers => this.#module._eq_parse(...this.#formula(pointers, formula, constants)));
  }

  mesh(formula, {constants = {}, box, resolution = 64, level = 0, attributes = 'basic'}) {
    this.sample(formula, {constants, box, resolution, level, attributes});
    return this.#surface();
  }

  // Meshes a level set of a volume, see readVolume().
  levelSet(volume, {level = 0, smoothing = 0, attributes = 'basic'} = {}) {
    this.takeVolume(volume, smoothing);
    const samples = this.extract({level, attributes});
    return {...this.#surface(), ...samples};
  }

  annotate(name, bytes, {scale = null, attributes = 'basic'} = {}) {
    this.fit(name, bytes, {scale, attributes});
    return this.#surface();
  }

  // sample(), takeVolume() with extract(), and fit() compute like mesh(), levelSet() and annotate(), but keep the
  // result for page().
  sample(formula, {constants, box, resolution, level, attributes}) {
    check(box?.length === 6 && [...box].every(isFinite), 'box: give six numbers: xmin, xmax, ymin, ymax, zmin, zmax');
    check(Number.isInteger(resolution) && resolution >= 2 && resolution <= MOST_PER_AXIS,
          `resolution: give a whole number from 2 to ${MOST_PER_AXIS}, not ${resolution}`);
    check(isFinite(level), `level: give a finite number, not ${level}`);
    this.#call(pointers => this.#module._eq_mesh(...this.#formula(pointers, formula, constants),
                                                 this.#doubles(pointers, box), resolution, level,
                                                 this.#text(pointers, attributes)));
  }
  takeVolume({values, size, origin, steps}, smoothing) {
    check(size?.length === 3 && values?.length === size[0] * size[1] * size[2],
          'volume: give three sizes, and one value for each node');
    check([origin, ...steps].length === 4 && [origin, ...steps].flat().length === 12,
          'volume: give an origin and three steps, each of three numbers');
    check(isFinite(smoothing) && smoothing >= 0, `smoothing: give a finite number, 0 or more, not ${smoothing}`);
    const pointer = this.#module._eq_values(values.length);
    if (!pointer) throw new Error('not enough memory for the volume; use a smaller one, or the program');
    this.#module.HEAPF64.set(values, pointer / 8);
    this.#call(pointers => this.#module._eq_volume(...size, this.#doubles(pointers, [origin, ...steps].flat()), smoothing));
  }
  extract({level, attributes}) {
    check(isFinite(level), `level: give a finite number, not ${level}`);
    this.#call(pointers => this.#module._eq_level_set(level, this.#text(pointers, attributes)));
    return {noise: this.#module._eq_noise(), distinctValues: this.#module._eq_distinct_values() || null};
  }
  fit(name, bytes, {scale, attributes}) {
    const data = bytesOf(bytes);
    this.#call(pointers => this.#module._eq_annotate(this.#text(pointers, name), this.#bytes(pointers, data), data.length,
                                                     scale ?? -1, this.#text(pointers, attributes)));
  }

  // Returns the data of a page of the last surface: facts as JSON, and arrays in single precision.
  page() {
    this.#call(() => this.#module._eq_page());
    const {_eq_facts, _eq_number_of_columns, _eq_size} = this.#module, size = _eq_size(POINTS);
    const floats = this.#copy(Float32Array, POSITIONS, size * (3 + _eq_number_of_columns()));
    return {
      facts: this.#string(_eq_facts()), positions: floats.subarray(0, 3 * size),
      triangles: this.#copy(Uint32Array, TRIANGLES, 3 * _eq_size(TRIANGLES)),
      status: this.#copy(Uint8Array, STATUS, _eq_size(STATUS)), parts: this.#copy(Uint8Array, PARTS, _eq_size(PARTS)),
      columns: floats.subarray(3 * size),
    };
  }

  #surface() {
    const {_eq_size, _eq_number_of_columns, _eq_column_name} = this.#module, size = _eq_size(POINTS);
    const attributes = {};
    for (let i = 0; i < _eq_number_of_columns(); ++i)
      attributes[this.#string(_eq_column_name(i))] = this.#copy(Float64Array, FIRST_COLUMN + i, size);
    return {
      positions: this.#copy(Float64Array, POINTS, 3 * size),
      triangles: this.#copy(Uint32Array, TRIANGLES, 3 * _eq_size(TRIANGLES)),
      status: this.#copy(Uint8Array, STATUS, _eq_size(STATUS)), attributes,
    };
  }

  // Calls use(pointers), which calls a function of the module and lists memory to free; throws the error if it fails.
  #call(use) {
    const pointers = [], module = this.#module;
    let outcome;
    try {
      outcome = use(pointers);
    } finally {
      pointers.forEach(pointer => module._free(pointer));
    }
    if (!outcome) return;
    const message = this.#string(module._eq_message());
    throw outcome === MISTAKE
        ? new Mistake(message, this.#string(module._eq_excerpt()), this.#string(module._eq_unknown_name()))
        : new Error(message);
  }

  #bytes(pointers, bytes) {
    const pointer = this.#module._malloc(bytes.length + 1);
    if (!pointer) throw new Error('not enough memory for the input; use a smaller one, or the program');
    pointers.push(pointer);
    this.#module.HEAPU8.set(bytes, pointer);
    this.#module.HEAPU8[pointer + bytes.length] = 0;
    return pointer;
  }
  #text(pointers, text) { return this.#bytes(pointers, new TextEncoder().encode(text)); }
  #doubles(pointers, numbers) {
    return this.#bytes(pointers, new Uint8Array(Float64Array.from(numbers).buffer));
  }
  #formula(pointers, formula, constants) {
    const names = Object.keys(constants);
    return [this.#text(pointers, formula), this.#text(pointers, names.map(name => name + '\0').join('')),
            this.#doubles(pointers, names.map(name => constants[name])), names.length];
  }
  #copy(Type, array, length) {
    const begin = this.#module._eq_data(array);
    return new Type(this.#module.HEAPU8.buffer, begin, length).slice();
  }
  #string(pointer) {
    const {HEAPU8} = this.#module;
    return new TextDecoder().decode(HEAPU8.subarray(pointer, HEAPU8.indexOf(0, pointer)));
  }
}

// `wasm` is the content of equiaffine.wasm or a WebAssembly.Module of it; by default the file next to this one is read.
// Long calls report to onProgress(stage, done, total).
export async function load({wasm, onProgress} = {}) {
  if (!wasm && globalThis.process?.versions?.node) {
    const {readFile} = await import('node:fs/promises');
    wasm = await readFile(new URL('equiaffine.wasm', import.meta.url));
  }
  wasm ??= await fetch(new URL('equiaffine.wasm', import.meta.url)).then(response => response.arrayBuffer());
  const compiled = wasm instanceof WebAssembly.Module ? wasm : await WebAssembly.compile(wasm);
  const module = await createModule({
    onProgress,
    instantiateWasm(imports, use) {
      WebAssembly.instantiate(compiled, imports).then(instance => use(instance, compiled));
      return {};
    },
  });
  return new Equiaffine(module);
}
