// SPDX-License-Identifier: GPL-3.0-or-later
// The camera, the cutting plane, ray casting, edges and needles.

const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => { const n = Math.hypot(...a); return [a[0] / n, a[1] / n, a[2] / n]; };
const positionOf = i => Array.from(mesh.positions.subarray(3 * i, 3 * i + 3));
function rotated(v, axis, angle) {
  const c = Math.cos(angle), along = (1 - c) * dot(axis, v);
  return add(add(v.map(x => c * x), cross(axis, v), Math.sin(angle)), axis, along);
}

const tanHalfView = Math.tan(Math.PI / 14);
let radius = 1;
function radiusOfMesh() {
  const {positions, size} = mesh;
  let most = 0;
  for (let i = 0; i < size; ++i)
    most = Math.max(most, Math.hypot(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]));
  return most > 0 ? most : 1;
}

// Looks at `target` from `distance` along `back`. right, up, back are orthonormal. Dragging rotates around `axis`.
// Positions are relative to facts.center.
const camera = {
  target: [0, 0, 0], right: [1, 0, 0], up: [0, 1, 0], back: [0, 0, 1], distance: 4, axis: [0, 0, 1],
};

function lookFrom(back, up = camera.axis) {
  let right = cross(up, back);
  if (Math.hypot(...right) < 1e-6 * Math.hypot(...up) * Math.hypot(...back))
    right = cross(Math.abs(back[1]) < Math.abs(back[2]) ? [0, 1, 0] : [0, 0, 1], back);
  camera.back = unit(back);
  camera.right = unit(right);
  camera.up = cross(camera.back, camera.right);
}

function firstView() {
  const axis = camera.axis, front = unit(cross(Math.abs(axis[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0], axis));
  camera.target = [0, 0, 0];
  lookFrom(add(add(front, cross(axis, front), 0.5), axis, 0.62));
}

// Sets the smallest distance from which the whole surface is visible, with a margin.
function fitDistance(aspect) {
  const {positions} = mesh, {right, up, back, target} = camera;
  const wide = 1 / (tanHalfView * aspect), high = 1 / tanHalfView;
  let least = 0;
  for (let i = 0; i < positions.length; i += 3) {
    const x = positions[i] - target[0], y = positions[i + 1] - target[1], z = positions[i + 2] - target[2];
    const across = Math.abs(right[0] * x + right[1] * y + right[2] * z) * wide;
    const along = Math.abs(up[0] * x + up[1] * y + up[2] * z) * high;
    least = Math.max(least, back[0] * x + back[1] * y + back[2] * z + Math.max(across, along));
  }
  camera.distance = 1.1 * Math.max(least, 1.2 * radius);
}

function orbit(dx, dy) {
  const spin = dot(camera.up, camera.axis) < 0 ? dx : -dx;
  const right = rotated(camera.right, camera.axis, spin);
  const back = rotated(rotated(camera.back, camera.axis, spin), right, -dy);
  camera.right = unit(right);
  camera.back = unit(add(back, camera.right, -dot(back, camera.right)));
  camera.up = cross(camera.back, camera.right);
}

// Keeps the point at position (x, y) in [-1, 1] x [-1, 1] of the view, in the plane of the target, at this position.
function zoom(factor, x, y, aspect) {
  const before = camera.distance;
  camera.distance = Math.min(50 * radius, Math.max(1e-4 * radius, before * factor));
  const moved = tanHalfView * (before - camera.distance);
  camera.target = add(add(camera.target, camera.right, x * aspect * moved), camera.up, y * moved);
}

function pan(dx, dy, aspect) {
  const reach = tanHalfView * camera.distance;
  camera.target = add(add(camera.target, camera.right, -dx * aspect * reach), camera.up, -dy * reach);
}

// Points p with `cut.normal` * p > `cut.place` are not drawn.
const cut = {normal: [0, 0, 0], place: 1};
const isCutOff = p => dot(cut.normal, p) > cut.place;

// Cuts off the side of the surface in direction `word`, such as -x. `share` is the position of the cut: 0 cuts off
// everything, 1 nothing.
const cutWords = ['none', 'x', 'y', 'z', '-x', '-y', '-z'];
function setCut(word, share) {
  const k = 'xyz'.indexOf(word.at(-1)), sign = word.startsWith('-') ? -1 : 1;
  Object.assign(cut, {normal: [0, 0, 0], place: 1});
  if (k < 0 || word.length > 2) return;
  let low = Infinity, high = -Infinity;
  for (let i = k; i < mesh.positions.length; i += 3) {
    const height = sign * mesh.positions[i];
    low = Math.min(low, height);
    high = Math.max(high, height);
  }
  cut.normal[k] = sign;
  cut.place = low + share * (high - low);
}

// Intersects the surface with the ray through (x, y). Returns the first point and the nearest vertex, or null.
function cast(x, y, aspect) {
  const eye = add(camera.target, camera.back, camera.distance);
  const forward = camera.back.map(v => -v);
  const direction = add(add(forward, camera.right, x * aspect * tanHalfView), camera.up, y * tanHalfView);
  const [dx, dy, dz] = direction, [ex, ey, ez] = eye, {positions: p, triangles} = mesh;
  let nearest = Infinity, hit = null;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    const hx = dy * vz - dz * vy, hy = dz * vx - dx * vz, hz = dx * vy - dy * vx;
    const determinant = ux * hx + uy * hy + uz * hz;
    if (determinant === 0) continue;
    const sx = ex - p[a], sy = ey - p[a + 1], sz = ez - p[a + 2];
    const u = (sx * hx + sy * hy + sz * hz) / determinant;
    if (u < 0 || u > 1) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
    const v = (dx * qx + dy * qy + dz * qz) / determinant;
    if (v < 0 || u + v > 1) continue;
    const far = (vx * qx + vy * qy + vz * qz) / determinant;
    if (far <= 0 || far >= nearest || isCutOff(add(eye, direction, far))) continue;
    nearest = far;
    hit = t + (u > v ? (u > 1 - u - v ? 1 : 0) : (v > 1 - u - v ? 2 : 0));
  }
  return hit === null ? null : {point: add(eye, direction, nearest), vertex: triangles[hit]};
}

function uniqueEdges() {
  const {triangles, size} = mesh, starts = new Uint32Array(size + 1), ends = new Uint32Array(triangles.length);
  const each = use => {
    for (let t = 0; t < triangles.length; ++t) {
      const a = triangles[t], b = triangles[t % 3 === 2 ? t - 2 : t + 1];
      use(Math.min(a, b), Math.max(a, b));
    }
  };
  each(a => ++starts[a + 1]);
  for (let i = 0; i < size; ++i) starts[i + 1] += starts[i];
  const next = starts.slice(), edges = new Uint32Array(2 * triangles.length);
  each((a, b) => { ends[next[a]++] = b; });
  let count = 0;
  for (let a = 0; a < size; ++a) {
    const around = ends.subarray(starts[a], starts[a + 1]).sort();
    for (let k = 0; k < around.length; ++k)
      if (k === 0 || around[k] !== around[k - 1]) { edges[count++] = a; edges[count++] = around[k]; }
  }
  return edges.slice(0, count);
}

// Needles at vertices that are distributed evenly: at most one in each cell of a grid.
function needles(vector, cells = 22) {
  const [vx, vy, vz] = vector.parts.map(part => part.values()), cell = 2 * radius / cells;
  const chosen = new Map();
  for (let i = 0; i < mesh.size; ++i) {
    if (!isFinite(vx[i] + vy[i] + vz[i])) continue;
    const [a, b, c] = [0, 1, 2].map(k => Math.floor((mesh.positions[3 * i + k] + radius) / cell));
    const key = (c * 64 + b) * 64 + a;
    if (!chosen.has(key)) chosen.set(key, i);
  }
  const indices = [...chosen.values()], lengths = indices.map(i => Math.hypot(vx[i], vy[i], vz[i]));
  const longest = indices.length ? quantile(lengths.slice().sort((a, b) => a - b), 90) || 1 : 1;
  const result = new Float32Array(6 * indices.length);
  indices.forEach((i, k) => {
    const scale = 1.4 * cell / Math.max(longest, lengths[k]) * (vector.isLine ? 0.6 : 1);
    const span = [vx[i] * scale, vy[i] * scale, vz[i] * scale];
    result.set([...(vector.isLine ? add(positionOf(i), span, -0.5) : positionOf(i)), ...span], 6 * k);
  });
  return result;
}
