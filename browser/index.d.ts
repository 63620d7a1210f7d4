// SPDX-License-Identifier: GPL-3.0-or-later

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

export class Equiaffine {
  /** Throws a Mistake unless the formula can be read. */
  parse(formula: string, constants?: Record<string, number>): void;
  /** Meshes formula = level by Marching Cubes: every vertex lies on the surface to rounding. */
  mesh(formula: string, options: MeshOptions): Surface;
  /** Curvatures of a mesh or of points, at most 50000, by polynomials that are fitted around each: `bytes` are those of a
   *  file whose name ends with .ply, .off, .xyz or .csv. */
  annotate(name: string, bytes: Uint8Array, options?: AnnotateOptions): Surface;
}

/** Loads the module. `wasm` is the content of equiaffine.wasm, or a WebAssembly.Module of it; by default it is read from
 *  beside equiaffine.mjs. */
export function load(options?: {wasm?: BufferSource | WebAssembly.Module}): Promise<Equiaffine>;
