// SPDX-License-Identifier: GPL-3.0-or-later
// The arrays, what can be shown, and the color map. Ranges, scales, ranks and colors are numbers of `facts`, by the
// rules of io/Column_numbers.h; here they are only looked up.

const byId = id => document.getElementById(id);
let facts, mesh, spots, vectors, quantities;  // of the surface that is shown, see takeSurface

function takeBytes(id) {
  const node = byId(id), text = node.textContent;
  node.remove();
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

// The surface in the elements of this page. Columns are functions, since most of them are not looked at.
const surfaceOfPage = () => ({
  facts: byId('facts').textContent,
  positions: new Float32Array(takeBytes('positions').buffer),
  triangles: new Uint32Array(takeBytes('triangles').buffer),
  status: takeBytes('status'),
  parts: takeBytes('parts'),  // Parabolic_part of every vertex, or nothing
  column: i => new Float32Array(takeBytes('column-' + i).buffer),
});

function takeSurface({facts: text, column: valuesOf, ...arrays}) {
  facts = JSON.parse(text);
  mesh = {...arrays, size: arrays.positions.length / 3};
  facts.columns.forEach((column, i) => {
    let values = null;
    column.values = () => values ??= valuesOf(i);
  });
  spots = [...mesh.parts.keys()].filter(i => mesh.parts[i] === 1);
  vectors = findVectors();
  quantities = findQuantities();
  radius = radiusOfMesh();
}
// With the numbers that pictures interpolate in parabolic spots.
function filled(column) {
  if (!spots.length) return column.values();
  const result = column.values().slice();
  spots.forEach((vertex, k) => { result[vertex] = column.spots[k] ?? NaN; });
  return result;
}
const columnNamed = name => facts.columns.find(column => column.name === name);

// Three columns NAME_x, NAME_y, NAME_z (or nx, ny, nz) are a vector.
const vectorLabels = {
  n: 'Normal', conormal: 'Co-normal', affine_normal: 'Affine normal',
  direction1: 'Principal direction 1', direction2: 'Principal direction 2',
  affine_frame1: 'Affine frame, e₁', affine_frame2: 'Affine frame, e₂', affine_frame3: 'Affine frame, ξ',
};
function findVectors() {
  const result = [];
  for (const column of facts.columns) {
    const stem = /^(n|.+_)x$/.exec(column.name)?.[1];
    const parts = stem && ['x', 'y', 'z'].map(axis => columnNamed(stem + axis));
    if (!parts || parts.includes(undefined)) continue;
    const name = stem.replace(/_$/, '');
    result.push({name, parts, label: vectorLabels[name] ?? name, isLine: /^direction/.test(name)});
  }
  return result;
}

// Scalars; components of vectors and of the metric, which have no colors, only when the page was asked for them.
const plain = {name: 'plain', label: 'No color', group: 'Surface'};
const statusQuantity = {name: 'status', label: 'Status of the points', group: 'Surface'};
const findQuantities = () => [
  ...facts.columns.filter(column => column.ranges).sort((a, b) => a.order - b.order),
  ...(mesh.status.length ? [statusQuantity] : []), plain,
];

// Calls use(first corner in `triangles`, normal with twice the face's area as length) for every face.
function faceNormals(p, triangles, use) {
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    use(t, uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
  }
}

// Unit normals: the attributes nx ny nz, where there are none the mean of the faces'.
function vertexNormals() {
  const {positions, triangles} = mesh, sums = new Float32Array(positions.length);
  faceNormals(positions, triangles, (t, x, y, z) => {
    for (let k = t; k < t + 3; ++k) {
      const i = 3 * triangles[k];
      sums[i] += x; sums[i + 1] += y; sums[i + 2] += z;
    }
  });
  const given = vectors.find(vector => vector.name === 'n')?.parts.map(part => part.values());
  const result = new Int16Array(4 * mesh.size);
  for (let i = 0; i < mesh.size; ++i) {
    let x = sums[3 * i], y = sums[3 * i + 1], z = sums[3 * i + 2];
    if (given && isFinite(given[0][i] + given[1][i] + given[2][i]))
      [x, y, z] = [given[0][i], given[1][i], given[2][i]];
    const scale = 32767 / (Math.hypot(x, y, z) || 1);
    result[4 * i] = x * scale; result[4 * i + 1] = y * scale; result[4 * i + 2] = z * scale;
  }
  return result;
}

// Where a triangle bends away from the normal of a corner, as at a crease, a copy of the vertex takes its place there,
// lit by the mean of the faces that do not bend away from the triangle, as in pictures. The copies, of the vertices
// `origins`, follow after the vertices.
function splitAtCreases(normals) {
  const {positions, triangles, size} = mesh, bent = [], greatestBend = Math.cos(40 * Math.PI / 180);
  const faces = new Float32Array(triangles.length);
  const bends = (p, i, q, k) => {
    const ps = p[i] * p[i] + p[i + 1] * p[i + 1] + p[i + 2] * p[i + 2];
    const qs = q[k] * q[k] + q[k + 1] * q[k + 1] + q[k + 2] * q[k + 2];
    return p[i] * q[k] + p[i + 1] * q[k + 1] + p[i + 2] * q[k + 2] < greatestBend * Math.sqrt(ps * qs);
  };
  faceNormals(positions, triangles, (t, x, y, z) => {
    faces[t] = x; faces[t + 1] = y; faces[t + 2] = z;
    for (let k = t; k < t + 3; ++k) if (bends(faces, t, normals, 4 * triangles[k])) bent.push(k);
  });
  if (!bent.length) return {normals, triangles, origins: []};
  const facesAt = new Map(bent.map(k => [triangles[k], []]));
  triangles.forEach((i, k) => facesAt.get(i)?.push(k - k % 3));
  const all = new Int16Array(4 * (size + bent.length)), corners = triangles.slice();
  all.set(normals);
  bent.forEach((k, copy) => {
    const sum = [0, 0, 0], t = k - k % 3;
    for (const other of facesAt.get(triangles[k]))
      if (!bends(faces, t, faces, other)) for (let c = 0; c < 3; ++c) sum[c] += faces[other + c];
    const scale = 32767 / (Math.hypot(...sum) || 1);
    all.set(sum.map(x => x * scale), 4 * (size + copy));
    corners[k] = size + copy;
  });
  return {normals: all, triangles: corners, origins: bent.map(k => triangles[k])};
}

// A third of the area of the faces around each vertex; equal shares for a mesh without area.
function vertexAreas() {
  const areas = new Float64Array(mesh.size);
  let total = 0;
  faceNormals(mesh.positions, mesh.triangles, (t, x, y, z) => {
    const share = Math.hypot(x, y, z) / 6;
    total += share;
    for (let k = t; k < t + 3; ++k) areas[mesh.triangles[k]] += share;
  });
  return total > 0 ? areas : areas.fill(1);
}

// The Gaussian curvature, scaled, 0 on parabolic curves and NaN in such regions and where it is not known, if the
// quantity does not exist where that changes its sign; else null.
function vertexSides(quantity) {
  const curvature = quantity.isUndefinedAtParabolicPoints && columnNamed('gaussian_curvature')?.values();
  if (!curvature) return null;
  const sides = curvature.map((value, i) => mesh.parts[i] === 2 ? NaN : mesh.status[i] === 1 ? 0 : value);
  spots.forEach((vertex, k) => { sides[vertex] = facts.spotSides[k] ?? NaN; });
  const largest = sides.reduce((most, side) => isFinite(side) ? Math.max(most, Math.abs(side)) : most, 0) || 1;
  return sides.map(side => isFinite(side) ? side / largest : NaN);
}

// Whether the sides have different signs in a triangle where all three are known.
function hasParabolicLine(sides) {
  for (let t = 0; t < mesh.triangles.length; t += 3) {
    const corners = [0, 1, 2].map(k => sides[mesh.triangles[t + k]]);
    if (!corners.some(isNaN) && corners.some(side => side < 0) && corners.some(side => side >= 0)) return true;
  }
  return false;
}

const errorColumn = quantity => columnNamed(quantity.name + '_error');

// color_doubt of io/trust.h.
function colorDoubt(value, error, place) {
  if (!isFinite(error)) return 1;
  const clamped = number => Math.min(1, Math.max(0, place(number)));
  return Math.min(1, 2 * (clamped(value + error) - clamped(value - error)));
}

// What every vertex is drawn as: 0 by its number, 1 to 4 by its status, 5 because it has no number. With sides,
// parabolic vertices outside of regions are those that a line is drawn through.
function vertexCodes(numbers, withStatus, sides) {
  const codes = new Uint8Array(mesh.size);
  if (!numbers) return withStatus ? mesh.status.slice() : codes;
  for (let i = 0; i < codes.length; ++i) {
    if (isFinite(numbers[i])) continue;
    const isLine = sides && mesh.status[i] === 1 && mesh.parts[i] !== 2;
    codes[i] = ((withStatus || isLine) && mesh.status[i]) || 5;
  }
  return codes;
}

function quantile(sorted, percent) {
  const rank = percent / 100 * (sorted.length - 1), below = Math.floor(rank);
  if (below + 1 === sorted.length) return sorted[below];
  return sorted[below] + (rank - below) * (sorted[below + 1] - sorted[below]);
}

// A range that was typed, as given_range of display/color_map.h: it depends on nothing else, so that two pages can
// share it.
const givenRange = (lower, upper) => ({lower, upper, knee: Math.max(Math.abs(lower), Math.abs(upper)) / 100,
                                       isDiverging: lower === -upper, scale: 'linear'});

// The place in [-1, 1] of a number among ascending ones: an Equalization of display/color_map.h.
function rankAmong(knots, number) {
  const last = knots.length - 1;
  let first = 0, end = last + 1;
  while (first < end) {
    const middle = (first + end) >> 1;
    if (knots[middle] < number) first = middle + 1;
    else end = middle;
  }
  if (first > last) return 1;
  while (end <= last && knots[end] === number) ++end;
  if (end > first) return (first + end - 1) / last - 1;
  if (first === 0) return -1;
  return 2 * (first - 1 + (number - knots[first - 1]) / (knots[first] - knots[first - 1])) / last - 1;
}

// The function from numbers to places along the bar: 0 and 1 at the ends of the range, not clipped beyond. Inside, this
// is Color_mapping of display/color_map.h, with [-1, 1] of the diverging map brought to [0, 1].
function placesAlong({lower, upper, knee, isDiverging}, scale, knots) {
  const scaled = {linear: x => x, logarithmic: x => Math.asinh(x / knee), equalized: x => rankAmong(knots, x)}[scale];
  const part = (begin, end) => {
    const from = scaled(begin), to = scaled(end);
    return from === to ? x => (x - begin) / (end - begin) : x => (scaled(x) - from) / (to - from);
  };
  if (!isDiverging) return part(lower, upper);
  const down = part(0, lower), up = part(0, upper);
  return x => x < 0 ? 0.5 - down(x) / 2 : 0.5 + up(x) / 2;
}

function colorAt(position, range) {
  const table = range.isDiverging ? facts.diverging : facts.sequential;
  return table[Math.round(position * (table.length - 1))];
}

// Round numbers inside the range, at most about `most` of them.
function ticks(range, scale, place, most) {
  const result = [];
  if (scale === 'linear') {
    const raw = (range.upper - range.lower) / most, power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find(factor => factor * power >= raw * (1 - 1e-9));
    for (let k = Math.ceil(range.lower / step - 1e-6); k * step <= range.upper + 1e-6 * step; ++k)
      result.push(Number((k * step).toPrecision(12)));
    return result;
  }
  const largest = Math.floor(Math.log10(Math.max(Math.abs(range.lower), Math.abs(range.upper)))), decades = 12;
  const taken = [];
  const offer = value => {
    const t = place(value), isInside = value >= range.lower && value <= range.upper;
    if (!isInside || taken.some(other => Math.abs(other - t) < 0.9 / most)) return;
    taken.push(t);
    result.push(value);
  };
  offer(0);
  for (let power = largest; power > largest - decades; --power)
    for (const factor of [1, 5, 2]) {
      const value = Number(factor + 'e' + power);
      offer(value);
      offer(-value);
    }
  return result.length > 1 ? result.sort((a, b) => a - b) : ticks(range, 'linear', place, most);
}

const superscript = text => text.replace(/./g, c => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]);
const powerOfTen = exponent => '10' + superscript(String(Number(exponent)));
// No digit beyond those asked for is shown: what has more places before the point gets a power of ten.
function readable(value, digits = 6) {
  if (Number.isNaN(value)) return '–';
  if (!isFinite(value)) return value > 0 ? '∞' : '−∞';
  const rounded = Number(value.toPrecision(digits)), places = rounded.toExponential().split('e')[1];
  return scientific(places >= digits || places < -5 ? rounded.toExponential() : String(rounded));
}
// With the digits that the estimated error leaves; an error of more than the column's range leaves none.
function readableWithin(value, error, range) {
  if (error === undefined || !isFinite(value)) return readable(value);
  if (!(error <= range.upper - range.lower)) return 'unknown';
  if (error === 0) return readable(value);
  const place = number => Math.floor(Math.log10(Math.abs(number))), digits = place(value) - place(error) + 1;
  return (digits >= 1 ? readable(value, Math.min(digits, 6)) : '0') + ' ± ' + readable(error, 2);
}
function scientific(text) {
  const [mantissa, exponent] = text.split('e');
  const signed = mantissa.replace('-', '−');
  return exponent ? signed.replace(/^(−?)1$/, '$1').replace(/\d$/, '$&·') + powerOfTen(exponent) : signed;
}
