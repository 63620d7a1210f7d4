// SPDX-License-Identifier: GPL-3.0-or-later
/// <reference lib="dom" />

/** A surface. All arrays are copies, which the caller may keep or transfer. */
export interface Surface {
  /** x y z of each vertex. */
  positions: Float64Array;
  /** Three vertices each, counterclockwise seen from the side to which normals point. */
  triangles: Uint32Array;
  /** Of each vertex: 0 regular, 1 parabolic, 2 singular, 3 outside, 4 unconverged. */
  status: Uint8Array;
  /** Numbers of the vertices by name, such as affine_gaussian_curvature, nx, ny, nz; NaN where one does not exist. */
  attributes: Record<string, Float64Array>;
}

export interface MeshOptions {
  /** xmin, xmax, ymin, ymax, zmin, zmax. */
  box: ArrayLike<number>;
  /** The numbers of names in the formula. */
  constants?: Record<string, number>;
  /** Nodes of the grid along each axis; 64 by default. */
  resolution?: number;
  /** The surface is formula = level; 0 by default. */
  level?: number;
  /** "basic" (the default), "all", or names with commas between them. */
  attributes?: string;
}

/** Samples at the nodes of a lattice: node (i, j, k) is at origin + i * steps[0] + j * steps[1] + k * steps[2]. */
export interface Volume {
  /** One number for each node, i fastest. NaN: none. */
  values: Float64Array;
  /** The nodes along each axis, two or more. */
  size: [number, number, number];
  origin: number[];
  steps: [number[], number[], number[]];
}

export interface LevelSetOptions {
  /** The surface is volume = level; 0 by default. */
  level?: number;
  /** The scale of a smoothing of the samples, in steps; 0, the default: none. */
  smoothing?: number;
  attributes?: string;
}

export interface LevelSet extends Surface {
  /** The standard deviation of the noise of the samples beside the level set. */
  noise: number;
  /** The number of distinct values of the samples if it is 256 or less: then unsmoothed curvatures are those of the steps
   *  between them; else null. */
  distinctValues: number | null;
}

export interface AnnotateOptions {
  /** The scale of curvatures, a length; 0: the surface's own; null (the default): the data choose. */
  scale?: number | null;
  /** As for a mesh; estimates of errors come with them as NAME_error. */
  attributes?: string;
}

/** A formula, file or option that cannot be used: `message` is one sentence. */
export class Mistake extends Error {
  /** The place in the formula with a caret under it, or an empty text. */
  excerpt: string;
  /** A name in the formula that has no value, or an empty text. */
  unknownName: string;
}

/** The library; load() makes it. */
export class Equiaffine {
  private constructor();
  /** Throws a Mistake unless the formula can be read. */
  parse(formula: string, constants?: Record<string, number>): void;
  /** Meshes formula = level by Marching Cubes: every vertex lies on the surface to rounding. */
  mesh(formula: string, options: MeshOptions): Surface;
  /** Meshes a level set of the spline through the samples of a volume, on its own lattice. Affine curvatures come with
   *  estimates of their errors as NAME_error. */
  levelSet(volume: Volume, options?: LevelSetOptions): LevelSet;
  /** Curvatures of a mesh or of points, at most 50000, by polynomials that are fitted around each: `bytes` are those of a
   *  file whose name ends with .ply, .off, .obj, .stl, .xyz or .csv. */
  annotate(name: string, bytes: Uint8Array | ArrayBuffer, options?: AnnotateOptions): Surface;
}

/** Reads a volume of up to 2^24 nodes from the bytes of a file whose name ends with .nrrd, .mha, .nii or .nii.gz. */
export function readVolume(name: string, bytes: Uint8Array | ArrayBuffer): Promise<Volume>;

/** Loads the module. `wasm` is the content of equiaffine.wasm, or a WebAssembly.Module of it; by default it is read from
 *  beside equiaffine.mjs. `onProgress` is called five times a second while a function computes. */
export function load(options?: {
  wasm?: BufferSource | WebAssembly.Module;
  onProgress?: (stage: number, done: number, total: number) => void;
}): Promise<Equiaffine>;
