// SPDX-License-Identifier: GPL-3.0-or-later
// The data of the surface, the quantities that can be shown, and the color map. Ranges, scales, ranks and colors are
// computed by Column_numbers.h and stored in `facts`.

const byId = id => document.getElementById(id);
let facts, mesh, spots, vectors, quantities;  // of the current surface, see takeSurface

function takeBytes(id) {
  const node = byId(id), text = node.textContent;
  node.remove();
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

// The surface stored in the elements of this page. Columns are functions, since most of them are never shown.
const surfaceOfPage = () => ({
  facts: byId('facts').textContent,
  positions: new Float32Array(takeBytes('positions').buffer),
  triangles: new Uint32Array(takeBytes('triangles').buffer),
  status: takeBytes('status'),
  parts: takeBytes('parts'),  // Parabolic_part of every vertex, or empty
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
// The values of a column, with interpolated values in parabolic spots.
function filled(column) {
  if (!spots.length) return column.values();
  const result = column.values().slice();
  spots.forEach((vertex, k) => { result[vertex] = column.spots[k] ?? NaN; });
  return result;
}
const columnNamed = name => facts.columns.find(column => column.name === name);

// Three columns NAME_x, NAME_y, NAME_z (or nx, ny, nz) form a vector.
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

// Scalars. Components of vectors and of the metric have ranges only if the page was created with that color.
const plain = {name: 'plain', label: 'No color', group: 'Surface'};
const statusQuantity = {name: 'status', label: 'Status', group: 'Surface'};
const findQuantities = () => [
  ...facts.columns.filter(column => column.ranges).sort((a, b) => a.order - b.order),
  ...(mesh.status.length ? [statusQuantity] : []), plain,
];

// Calls use(index of the first corner in `triangles`, x, y, z) for every face. The normal x, y, z has twice the face's
// area as length.
function faceNormals(p, triangles, use) {
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    use(t, uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
  }
}

// Unit normals, scaled to 16 bits: the attributes nx, ny, nz, or mean normals of the faces where these are undefined.
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

// Duplicates vertices at creases, like pictures of the program. If the normals of a triangle and of its corner differ
// by more than 40 degrees, the corner becomes a copy of the vertex, whose normal is the mean of those faces that are
// within 40 degrees of the triangle. The copies of the vertices `origins` follow the vertices.
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

// A third of the area of the faces around each vertex; all 1 if the area of the mesh is 0.
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

// For a quantity that is undefined where the Gaussian curvature changes its sign, returns that curvature, scaled: 0 on
// parabolic curves, NaN in parabolic regions and where it is unknown. Otherwise returns null.
function vertexSides(quantity) {
  const curvature = quantity.isUndefinedAtParabolicPoints && columnNamed('gaussian_curvature')?.values();
  if (!curvature) return null;
  const sides = curvature.map((value, i) => mesh.parts[i] === 2 ? NaN : mesh.status[i] === 1 ? 0 : value);
  spots.forEach((vertex, k) => { sides[vertex] = facts.spotSides[k] ?? NaN; });
  const largest = sides.reduce((most, side) => isFinite(side) ? Math.max(most, Math.abs(side)) : most, 0) || 1;
  return sides.map(side => isFinite(side) ? side / largest : NaN);
}

// Whether the sides of some triangle are all known and have different signs.
function hasParabolicLine(sides) {
  for (let t = 0; t < mesh.triangles.length; t += 3) {
    const corners = [0, 1, 2].map(k => sides[mesh.triangles[t + k]]);
    if (!corners.some(isNaN) && corners.some(side => side < 0) && corners.some(side => side >= 0)) return true;
  }
  return false;
}

const errorColumn = quantity => columnNamed(quantity.name + '_error');

// The uncertainty of a color, 0 to 1: color_doubt of display/internal/trust.h.
function colorDoubt(value, error, place) {
  if (!isFinite(error)) return 1;
  const clamped = number => Math.min(1, Math.max(0, place(number)));
  return Math.min(1, 2 * (clamped(value + error) - clamped(value - error)));
}

// How each vertex is colored: 0 by its number, 1 to 4 by its status, 5 as one without a number. With `sides`, a line is
// drawn through parabolic vertices outside of parabolic regions.
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

// The range for typed bounds: given_range of display/color_map.h. It does not depend on the data, so different pages
// can use the same colors.
const givenRange = (lower, upper) => ({lower, upper, knee: Math.max(Math.abs(lower), Math.abs(upper)) / 100,
                                       isDiverging: lower === -upper, scale: 'linear'});

// The relative rank in [-1, 1] of a number among ascending ones: Equalization of display/color_map.h.
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

// Returns the function from numbers to positions along the color bar: 0 and 1 at the ends of the range, not clipped
// outside. Inside it is Color_mapping of display/color_map.h, with [-1, 1] of the diverging map mapped to [0, 1].
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

// Round numbers inside the range, about `most` at most.
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
// Shows at most `digits` digits. Numbers with more digits before the decimal point use a power of ten.
function readable(value, digits = 6) {
  if (Number.isNaN(value)) return '–';
  if (!isFinite(value)) return value > 0 ? '∞' : '−∞';
  const rounded = Number(value.toPrecision(digits)), places = rounded.toExponential().split('e')[1];
  return scientific(places >= digits || places < -5 ? rounded.toExponential() : String(rounded));
}
// Shows the digits that are significant given the estimated error; 'unknown' if the error exceeds the column's range.
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
