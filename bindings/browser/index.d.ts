// SPDX-License-Identifier: GPL-3.0-or-later
/// <reference lib="dom" />

/** A surface. All arrays are copies, which you can keep or transfer. */
export interface Surface {
  /** x, y, z of each vertex. */
  positions: Float64Array;
  /** Three vertex indices per triangle, counterclockwise seen from the side to which the normals point. */
  triangles: Uint32Array;
  /** Status of each vertex: 0 regular, 1 parabolic, 2 singular, 3 outside, 4 unconverged. */
  status: Uint8Array;
  /** Values at the vertices by name, such as affine_gaussian_curvature, nx, ny, nz; NaN where undefined. */
  attributes: Record<string, Float64Array>;
}

export interface MeshOptions {
  /** xmin, xmax, ymin, ymax, zmin, zmax. */
  box: ArrayLike<number>;
  /** Values of the constants in the formula, by name. */
  constants?: Record<string, number>;
  /** Number of grid nodes along each axis; 64 by default. */
  resolution?: number;
  /** The surface is formula = level; 0 by default. */
  level?: number;
  /** "basic" (the default), "all", or comma-separated names. */
  attributes?: string;
}

/** Samples at the nodes of a lattice: node (i, j, k) is at origin + i * steps[0] + j * steps[1] + k * steps[2]. */
export interface Volume {
  /** One value per node; i runs fastest. NaN marks a missing sample. */
  values: Float64Array;
  /** Number of nodes along each axis, at least 2. */
  size: [number, number, number];
  origin: number[];
  steps: [number[], number[], number[]];
}

export interface LevelSetOptions {
  /** The surface is volume = level; 0 by default. */
  level?: number;
  /** Scale of the smoothing of the samples, in steps; 0, the default, means none. */
  smoothing?: number;
  attributes?: string;
}

export interface LevelSet extends Surface {
  /** Standard deviation of the noise of the samples near the level set. */
  noise: number;
  /** Number of distinct sample values if at most 256, otherwise null. With few values, unsmoothed curvatures show the
   *  steps between them. */
  distinctValues: number | null;
}

export interface AnnotateOptions {
  /** Scale of the curvatures, a length; 0 for the surface's own; null (the default) to choose it from the data. */
  scale?: number | null;
  /** See MeshOptions. Estimates of the errors are added as NAME_error. */
  attributes?: string;
}

/** An error in a formula, file or option; `message` explains it in one sentence. */
export class Mistake extends Error {
  /** The place in the formula, marked with a caret, or an empty string. */
  excerpt: string;
  /** A name in the formula that has no value, or an empty string. */
  unknownName: string;
}

/** The library. Use load() to create it. */
export class Equiaffine {
  private constructor();
  /** Throws a Mistake unless the formula is valid. */
  parse(formula: string, constants?: Record<string, number>): void;
  /** Meshes formula = level by Marching Cubes. Vertices lie on the surface up to rounding. */
  mesh(formula: string, options: MeshOptions): Surface;
  /** Meshes a level set of the spline through the samples of a volume, on its own lattice. Estimates of the errors of
   *  affine curvatures are added as NAME_error. */
  levelSet(volume: Volume, options?: LevelSetOptions): LevelSet;
  /** Computes curvatures at the vertices of a mesh or at points, at most 50000, from polynomials fitted around each of
   *  them. `bytes` is the content of a file whose name ends with .ply, .off, .obj, .stl, .xyz or .csv. */
  annotate(name: string, bytes: Uint8Array | ArrayBuffer, options?: AnnotateOptions): Surface;
}

/** Reads a volume of at most 2^24 nodes from the content of a file with the extension .nrrd, .mha, .nii or .nii.gz. */
export function readVolume(name: string, bytes: Uint8Array | ArrayBuffer): Promise<Volume>;

/** Loads the library. `wasm` is the content of equiaffine.wasm, or a WebAssembly.Module of it; by default the file next
 *  to equiaffine.mjs is read. `onProgress` is called five times a second during a computation. */
export function load(options?: {
  wasm?: BufferSource | WebAssembly.Module;
  onProgress?: (stage: number, done: number, total: number) => void;
}): Promise<Equiaffine>;
