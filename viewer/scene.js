// SPDX-License-Identifier: GPL-3.0-or-later
// WebGL 2 objects and drawing.

const bytesOfColor = text => [1, 3, 5].map(i => parseInt(text.slice(i, i + 2), 16));
const channels = text => bytesOfColor(text).map(byte => byte / 255);

// A shader program; at(name) returns the location of a uniform.
function createProgram(gl, ...sources) {
  const result = gl.createProgram();
  sources.forEach((source, i) => {
    const shader = gl.createShader(i ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(result, shader);
  });
  gl.linkProgram(result);
  if (!gl.getProgramParameter(result, gl.LINK_STATUS))
    throw new Error(gl.getProgramInfoLog(result) + gl.getAttachedShaders(result).map(s => gl.getShaderInfoLog(s)));
  const places = new Map();
  const at = name => {
    if (!places.has(name)) places.set(name, gl.getUniformLocation(result, name));
    return places.get(name);
  };
  return {use: () => gl.useProgram(result), at};
}

// A scene has four programs: the surface, its edges, marks on points, and needles for vectors.
class Scene {
  constructor(gl, canvas) {
    Object.assign(this, {gl, canvas, buffers: {}, arrays: {}, needleCount: 0, markedCount: 0, edgeCount: 0});
    this.surface = createProgram(gl, surfaceVertex, surfaceFragment);
    this.edge = createProgram(gl, edgeVertex, edgeFragment);
    this.mark = createProgram(gl, markVertex, markFragment);
    this.needle = createProgram(gl, needleVertex, needleFragment);
    this.colors = {statuses: facts.statuses.slice(1).flatMap(s => channels(s.color)), isMapped: false,
                   hasSides: false, region: channels(facts.region), isolines: []};
    this.fillSurface();
    this.bindBuffers();
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    this.setMap([facts.plain]);
  }

  // Uploads the mesh, without colors.
  fillSurface() {
    const {gl} = this;
    const {normals, triangles, origins} = splitAtCreases(vertexNormals());
    this.origins = origins;
    this.fill('normal', normals);
    this.fillVertices('position', mesh.positions);
    for (const name of ['level', 'side', 'doubt']) this.fillVertices(name, new Float32Array(mesh.size));
    for (const name of ['code', 'hasNoSide']) this.fillVertices(name, new Uint8Array(mesh.size));
    this.fill('triangles', triangles, gl.ELEMENT_ARRAY_BUFFER);
    this.fill('marked', new Uint32Array(0), gl.ELEMENT_ARRAY_BUFFER);
    this.fill('needles', new Float32Array(0));
    Object.assign(this, {needleCount: 0, markedCount: 0});
    gl.deleteVertexArray(this.arrays.edges ?? null);
    delete this.arrays.edges;
  }

  bindBuffers() {
    const {gl} = this, position = [0, 'position', 3, gl.FLOAT], code = [3, 'code', 1, gl.UNSIGNED_BYTE];
    this.bind('surface', [position, [1, 'normal', 3, gl.SHORT, 8], [2, 'level', 1, gl.FLOAT], code,
                          [4, 'side', 1, gl.FLOAT], [5, 'doubt', 1, gl.FLOAT],
                          [6, 'hasNoSide', 1, gl.UNSIGNED_BYTE]], 'triangles');
    this.bind('marks', [position, code], 'marked');
    this.bind('needles', [[0, 'needles', 3, gl.FLOAT, 24, 0, 1], [1, 'needles', 3, gl.FLOAT, 24, 12, 1]]);
  }

  fill(name, data, target = this.gl.ARRAY_BUFFER) {
    const {gl} = this;
    gl.bindVertexArray(null);
    gl.bindBuffer(target, this.buffers[name] ??= gl.createBuffer());
    gl.bufferData(target, data, gl.STATIC_DRAW);
  }

  // Fills a buffer with data of the vertices and of their copies at creases.
  fillVertices(name, data) {
    const {origins} = this, count = data.length / mesh.size;
    const all = origins.length ? new data.constructor(data.length + count * origins.length) : data;
    if (origins.length) all.set(data);
    for (let copy = 0, k = data.length; copy < origins.length; ++copy)
      for (let c = 0; c < count; ++c) all[k++] = data[count * origins[copy] + c];
    this.fill(name, all);
  }

  // attributes: [location, buffer, components, type, stride, offset, divisor]
  bind(name, attributes, indexBuffer) {
    const {gl} = this;
    gl.bindVertexArray(this.arrays[name] = gl.createVertexArray());
    for (const [place, buffer, components, type, stride = 0, offset = 0, divisor = 0] of attributes) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[buffer]);
      gl.enableVertexAttribArray(place);
      if (type === gl.UNSIGNED_BYTE) gl.vertexAttribIPointer(place, components, type, stride, offset);
      else gl.vertexAttribPointer(place, components, type, type === gl.SHORT, stride, offset);
      gl.vertexAttribDivisor(place, divisor);
    }
    if (indexBuffer) gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers[indexBuffer]);
    gl.bindVertexArray(null);
  }

  setMap(table) {
    const {gl} = this, texels = new Uint8Array(table.flatMap(text => [...bytesOfColor(text), 255]));
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, table.length, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels);
  }

  // `levels` are positions in [0, 1] along the colors of `table`; without a table the surface has one color. Colors are
  // grayer where `doubts` are near 1. `sides` is null, or divides the surface where it is 0; NaN means unknown.
  setColors({levels, doubts, codes, sides, region}, table) {
    this.fillVertices('level', levels);
    this.fillVertices('doubt', doubts);
    this.fillVertices('code', codes);
    const hasNoSide = Uint8Array.from({length: mesh.size}, (_, i) => Number(sides !== null && isNaN(sides[i])));
    this.fillVertices('side', sides?.map(side => isNaN(side) ? 0 : side) ?? new Float32Array(mesh.size));
    this.fillVertices('hasNoSide', hasNoSide);
    Object.assign(this.colors, {isMapped: Boolean(table), hasSides: Boolean(sides), region: channels(region)});
    if (table) this.setMap(table);
    const marked = [];
    const isMarked = (code, i) => code === 1 ? !sides && mesh.parts[i] !== 2 : code >= 2 && code <= 4;
    codes.forEach((code, i) => { if (isMarked(code, i)) marked.push(i); });
    this.markedCount = marked.length <= 3000 ? marked.length : 0;  // more are visible without dots
    this.fill('marked', new Uint32Array(marked.slice(0, this.markedCount)), this.gl.ELEMENT_ARRAY_BUFFER);
  }

  setIsolines(levels) { this.colors.isolines = levels.slice(0, 24); }

  setNeedles(data, hasHeads) {
    this.hasHeads = hasHeads;
    this.needleCount = data.length / 6;
    this.fill('needles', data);
  }

  // Uses a program with the current camera.
  place(program) {
    const {gl, canvas} = this, {right, up, back, target, distance} = camera;
    const center = Math.hypot(...target), far = distance + center + 1.5 * radius;
    const near = Math.max(distance - center - 1.5 * radius, 0.004 * distance), aspect = canvas.width / canvas.height;
    program.use();
    gl.uniformMatrix3fv(program.at('turn'), true, [...right, ...up, ...back]);
    gl.uniform3fv(program.at('target'), target);
    gl.uniform4f(program.at('lens'), 1 / (tanHalfView * aspect), 1 / tanHalfView, -(far + near) / (far - near),
                 -2 * far * near / (far - near));
    gl.uniform1f(program.at('viewDistance'), distance);
    gl.uniform4f(program.at('cut'), ...cut.normal, cut.place);
  }

  drawSurface(pixels) {
    const {gl, surface, colors} = this;
    this.place(surface);
    gl.uniform1f(surface.at('pixels'), pixels);
    gl.uniform1i(surface.at('hasSides'), colors.hasSides);
    gl.uniform1i(surface.at('isMapped'), colors.isMapped);
    gl.uniform3fv(surface.at('plain'), channels(facts.plain));
    gl.uniform3fv(surface.at('undefinedColor'), channels(facts.undefined));
    gl.uniform3fv(surface.at('statusColors'), colors.statuses);
    gl.uniform3fv(surface.at('regionColor'), colors.region);
    gl.uniform1i(surface.at('isolineCount'), colors.isolines.length);
    if (colors.isolines.length) gl.uniform1fv(surface.at('isolines'), colors.isolines);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    gl.bindVertexArray(this.arrays.surface);
    gl.drawElements(gl.TRIANGLES, mesh.triangles.length, gl.UNSIGNED_INT, 0);
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }

  drawEdges() {
    const {gl, arrays} = this;
    if (!arrays.edges) {
      const indices = uniqueEdges();
      this.edgeCount = indices.length;
      this.fill('edges', indices, gl.ELEMENT_ARRAY_BUFFER);
      this.bind('edges', [[0, 'position', 3, gl.FLOAT]], 'edges');
    }
    this.place(this.edge);
    gl.bindVertexArray(arrays.edges);
    gl.drawElements(gl.LINES, this.edgeCount, gl.UNSIGNED_INT, 0);
  }

  drawNeedles(pixels, isDark) {
    const {gl, canvas, needle} = this;
    this.place(needle);
    gl.uniform2f(needle.at('viewport'), canvas.width, canvas.height);
    gl.uniform1f(needle.at('width'), 3.8 * pixels);
    gl.uniform1i(needle.at('hasHeads'), this.hasHeads);
    gl.uniform1i(needle.at('isDark'), isDark);
    gl.bindVertexArray(this.arrays.needles);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, this.hasHeads ? 7 : 4, this.needleCount);
  }

  // Draws dots at `count` marked points, or a ring at the point `first`.
  drawMarks(size, isRing, opacity, count, first) {
    const {gl, mark} = this;
    gl.uniform1f(mark.at('size'), size);
    gl.uniform1i(mark.at('isRing'), isRing);
    gl.uniform1f(mark.at('opacity'), opacity);
    gl.uniform3fv(mark.at('statusColors'), this.colors.statuses);
    gl.bindVertexArray(this.arrays.marks);
    if (isRing) gl.drawArrays(gl.POINTS, first, 1);
    else gl.drawElements(gl.POINTS, count, gl.UNSIGNED_INT, 0);
  }

  // Draws dots and rings. A ring that is hidden by the surface remains faintly visible.
  drawAllMarks(ringed, pixels) {
    const {gl, markedCount} = this;
    this.place(this.mark);
    if (markedCount) this.drawMarks(5 * pixels, false, 1, markedCount, 0);
    for (const vertex of ringed) {
      gl.disable(gl.DEPTH_TEST);
      this.drawMarks(20 * pixels, true, 0.35, 1, vertex);
      gl.enable(gl.DEPTH_TEST);
      this.drawMarks(20 * pixels, true, 1, 1, vertex);
    }
  }

  draw({edges, ringed, pixels, isDark}) {
    const {gl, canvas} = this;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.disable(gl.BLEND);
    this.drawSurface(pixels);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    if (edges) this.drawEdges();
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    if (this.needleCount) this.drawNeedles(pixels, isDark);
    this.drawAllMarks(ringed, pixels);
  }
}

// Returns null without WebGL 2.
function createScene(canvas) {
  const gl = canvas.getContext('webgl2', {antialias: true, alpha: true, powerPreference: 'high-performance'});
  return gl && new Scene(gl, canvas);
}
