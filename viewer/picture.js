// SPDX-License-Identifier: GPL-3.0-or-later
// Saves pictures with a legend, and the values of the page as files.

// Files are named after the surface, and pictures also after the quantity.
function fileName(extension, ...parts) {
  const clean = text => text.replace(/[^\p{L}\p{N}_.]+/gu, '-').replace(/^-+|-+$/g, '');
  return [document.title, ...parts].map(clean).filter(Boolean).join('-') + '.' + extension;
}

function saveFile(blob, name) {
  const anchor = document.createElement('a');
  anchor.href = URL.createObjectURL(blob);
  anchor.download = name;
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(anchor.href), 10000);
}

// Resizes the canvas, draws the surface, calls use(canvas) and restores the canvas, in one task so that no frame shows
// it. Returns false, without calling `use`, if this size is not supported.
function drawSized(width, height, pixels, use) {
  const before = {width: canvas.width, height: canvas.height, distance: camera.distance};
  const widened = aspect() * height / width;
  [canvas.width, canvas.height] = [width, height];
  camera.distance *= Math.max(1, widened);
  scene.draw({edges: choice.edges, ringed: ringedVertices(), isDark: false, pixels});
  const isWhole = scene.gl.drawingBufferWidth === width && scene.gl.drawingBufferHeight === height;
  if (isWhole) use(canvas);
  [canvas.width, canvas.height] = [before.width, before.height];
  camera.distance = before.distance;
  drawNow();
  return isWhole;
}

const legendHeight = 62, noteHeight = 18;  // as in the program's pictures, for a width of 1000 pixels

// Draws notes, the name of the quantity and the color bar in the lower left corner of a picture of height `height`.
function drawLegend(pen, height, notes) {
  const left = 16, width = 320, top = height - 40;
  pen.font = '13px system-ui, "DejaVu Sans", sans-serif';
  pen.textAlign = 'left';
  notes.forEach(([color, text], k) => {
    const y = height - (range ? legendHeight : 8) - noteHeight * (notes.length - k) + 12;
    pen.fillStyle = color;
    pen.fillRect(left, y - 9, 14, 9);
    pen.fillStyle = '#1a1a1a';
    pen.fillText(text, left + 22, y);
  });
  if (!range) return;
  drawColorBar(pen, left + tail + 2, left + width - tail - 2, top);
  const pixel = t => tail + 2 + t * (width - 2 * tail - 4);
  const {labels, power} = labelledTicks(text => pen.measureText(text).width, pixel, width);
  pen.fillStyle = '#1a1a1a';
  pen.textAlign = 'left';
  pen.fillText(byId('scale-title').textContent + unitText(power), left, top - 7);
  pen.textAlign = 'center';
  for (const {x, middle, text} of labels) {
    pen.fillRect(left + x - 0.5, top + 12, 1, 4);
    pen.fillText(text, left + middle, top + 29);
  }
}

function savePicture() {
  const size = ['picture-width', 'picture-height'].map(id => Math.round(Number(byId(id).value)));
  if (!size.every(pixels => pixels >= 100 && pixels <= 10000))
    return sayAboutPicture('Enter a width and a height from 100 to 10000 pixels.');
  const [width, height] = size, scale = Math.max(1, width / 1000), notes = legendEntries();
  const legend = Math.round(scale * ((range ? legendHeight : 8) + noteHeight * notes.length));
  if (legend >= height)
    return sayAboutPicture(`The legend needs ${legend} of ${height} pixels of height; increase the height.`);
  const picture = document.createElement('canvas'), pen = picture.getContext('2d');
  Object.assign(picture, {width, height});
  pen.fillStyle = '#fff';
  pen.fillRect(0, 0, width, height);
  const isDrawn = drawSized(width, height - legend, scale, drawn => pen.drawImage(drawn, 0, 0));
  if (!isDrawn) return sayAboutPicture('The picture is too large for this device; reduce its size.');
  pen.scale(scale, scale);
  drawLegend(pen, height / scale, notes);
  sayAboutPicture('');
  picture.toBlob(blob => blob ? saveFile(blob, fileName('png', choice.quantity.name))
                              : sayAboutPicture('The picture is too large for this browser; reduce its size.'));
}
function sayAboutPicture(text) { byId('picture-message').textContent = text; }

// Calls use(vertex, x, y, z), in the coordinates of the surface.
function eachPosition(use) {
  const {positions} = mesh, [cx, cy, cz] = facts.center;
  for (let i = 0; i < mesh.size; ++i)
    use(i, cx + positions[3 * i], cy + positions[3 * i + 1], cz + positions[3 * i + 2]);
}

// Nine digits represent every number in single precision exactly.
const csvNumber = value =>
    isFinite(value) ? String(Number(value.toPrecision(9))) : isNaN(value) ? 'nan' : value > 0 ? 'inf' : '-inf';

function saveCSV() {
  const columns = facts.columns.map(column => column.values()), hasStatus = mesh.status.length > 0;
  const quoted = name => /[",\n]/.test(name) ? '"' + name.replaceAll('"', '""') + '"' : name;
  const names = ['x', 'y', 'z', ...facts.columns.map(({name}) => quoted(name)), ...(hasStatus ? ['status'] : [])];
  const parts = [names.join(',') + '\n'];
  let lines = '';
  eachPosition((i, ...position) => {
    const words = [...position, ...columns.map(values => csvNumber(values[i]))];
    if (hasStatus) words.push(facts.statuses[mesh.status[i]].word);
    lines += words.join(',') + '\n';
    if (i % 4096 === 4095) { parts.push(lines); lines = ''; }
  });
  saveFile(new Blob([...parts, lines], {type: 'text/csv'}), fileName('csv'));
}

function savePLY() {
  const columns = facts.columns.map(column => column.values()), hasStatus = mesh.status.length > 0;
  const property = (type, name) => `property ${type} ${name.replace(/\s+/g, '_')}\n`;
  const header = 'ply\nformat binary_little_endian 1.0\nelement vertex ' + mesh.size + '\n' +
      ['x', 'y', 'z'].map(name => property('double', name)).join('') +
      facts.columns.map(({name}) => property('float', name)).join('') + (hasStatus ? property('uchar', 'status') : '') +
      `element face ${mesh.triangles.length / 3}\nproperty list uchar uint vertex_indices\nend_header\n`;
  const stride = 24 + 4 * columns.length + Number(hasStatus);
  const vertices = new DataView(new ArrayBuffer(stride * mesh.size));
  eachPosition((i, ...position) => {
    position.forEach((value, k) => vertices.setFloat64(stride * i + 8 * k, value, true));
    columns.forEach((values, k) => vertices.setFloat32(stride * i + 24 + 4 * k, values[i], true));
    if (hasStatus) vertices.setUint8(stride * (i + 1) - 1, mesh.status[i]);
  });
  const faces = new DataView(new ArrayBuffer(13 * mesh.triangles.length / 3));
  mesh.triangles.forEach((vertex, k) => {
    const face = 13 * Math.floor(k / 3);
    faces.setUint8(face, 3);
    faces.setUint32(face + 1 + 4 * (k % 3), vertex, true);
  });
  saveFile(new Blob([header, vertices, faces], {type: 'application/octet-stream'}), fileName('ply'));
}
