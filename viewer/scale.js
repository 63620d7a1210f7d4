// SPDX-License-Identifier: GPL-3.0-or-later
// The histogram above the color bar, with ticks and unit.

const dimensionOf = weight => (weight % 2 ? `${weight}/2` : `${weight / 2}`).replace('-', '−');
function showUnit(power) {
  const {weight} = choice.quantity, unit = byId('scale-unit');
  unit.replaceChildren(power ? '· ' + powerOfTen(power) + ' ' : '');
  if (weight) unit.append('length', element('sup', '', dimensionOf(weight)));
}
// The power of ten and the unit as text, for the title of a color bar.
function unitText(power) {
  const {weight} = choice.quantity, dimension = dimensionOf(weight);
  return (power ? ' · ' + powerOfTen(power) : '') +
         (weight ? ', length' + (weight % 2 ? `^(${dimension})` : superscript(dimension.replace('−', '-'))) : '');
}

// Uses powers of ten for very large and small ticks of a nonlinear scale, to avoid long sequences of zeros.
function compact(value) {
  const size = Math.abs(value), isNear = value === 0 || (size >= 1e-3 && size < 1e5);
  return isNear || scale === 'linear' ? readable(value, 12) : scientific(value.toExponential());
}

// The largest number of ticks whose labels do not overlap. On a linear scale, large and small numbers share a power of
// ten.
function labelledTicks(widthOf, pixel, width) {
  for (let most = 6;; --most) {
    const values = ticks(range, scale, place, most);
    const size = Math.floor(Math.log10(Math.max(...values.map(Math.abs)))), isFar = size < -3 || size > 4;
    const power = isFar && isFinite(size) && scale === 'linear' ? size : 0;
    const labels = values.map(value => {
      const t = place(value), x = pixel(t);
      const text = power ? readable(value / 10 ** power, 12) : compact(value), half = widthOf(text) / 2;
      return {t, x, text, half, middle: Math.min(width - half - 1, Math.max(half + 1, x))};
    });
    const gap = (a, b) => b.middle - b.half - a.middle - a.half;
    if (most === 1 || labels.every((label, k) => !k || gap(labels[k - 1], label) > 6)) return {labels, power};
  }
}

// The area of each bar inside the range and of the two tails outside, as fractions of the total.
function areaShares(count) {
  areas ??= vertexAreas();
  const bars = new Float64Array(count), tails = [0, 0];
  let total = 0;
  for (let i = 0; i < mesh.size; ++i) {
    if (shown.codes[i] !== 0) continue;
    const value = shown.values[i];
    total += areas[i];
    if (value < range.lower || value > range.upper) tails[value < range.lower ? 0 : 1] += areas[i];
    else bars[Math.min(count - 1, Math.floor(place(value) * count))] += areas[i];
  }
  total ||= 1;
  return {bars: bars.map(area => area / total), tails: tails.map(area => area / total)};
}

const tail = 14;  // width of the parts for clipped values at both ends of the bar

function drawHistogram(pen, left, right, base, quiet) {
  const {bars, tails} = areaShares(64), step = (right - left) / bars.length, highest = Math.max(...bars) || 1;
  const bar = (x, width, share, t) => {
    if (!(share > 0)) return;
    const height = Math.max(1, Math.min(1, share / highest) * (base - 16));
    pen.fillStyle = colorAt(t, range);
    pen.fillRect(x, base - height, width, height);
    pen.strokeRect(x + 0.25, base - height + 0.25, width - 0.5, height);
  };
  pen.lineWidth = 0.5;
  pen.strokeStyle = '#8888';
  bars.forEach((share, k) => bar(left + k * step, step, share, (k + 0.5) / bars.length));
  bar(left - tail - 2, tail - 4, tails[0], 0);
  bar(right + 6, tail - 4, tails[1], 1);

  pen.fillStyle = pen.strokeStyle = quiet;
  pen.lineWidth = 1;
  pen.setLineDash([3, 3]);
  for (const x of [left - 3, right + 3]) { pen.beginPath(); pen.moveTo(x, 14); pen.lineTo(x, base); pen.stroke(); }
  pen.setLineDash([]);
  [['left', left - tail - 2], ['right', right + tail + 2]].forEach(([align, x], k) => {
    pen.textAlign = align;
    if (tails[k]) pen.fillText(readable(100 * tails[k], 3) + ' %', x, 10);
  });
}

function drawColorBar(pen, left, right, top) {
  const strip = pen.createLinearGradient(left, 0, right, 0);
  for (let k = 0; k <= 32; ++k) strip.addColorStop(k / 32, colorAt(k / 32, range));
  pen.fillStyle = colorAt(0, range);
  pen.fillRect(left - tail - 2, top, tail + 4, 12);
  pen.fillStyle = colorAt(1, range);
  pen.fillRect(right - 2, top, tail + 4, 12);
  pen.fillStyle = strip;
  pen.fillRect(left, top, right - left, 12);
}

// Draws a triangle that points to the value of the picked vertex.
function drawPointer(pen, x, base, rim) {
  pen.beginPath();
  pen.moveTo(x, base + 1); pen.lineTo(x - 5, base - 8); pen.lineTo(x + 5, base - 8); pen.closePath();
  pen.fill();
  pen.strokeStyle = rim;
  pen.stroke();
}

// Draws the histogram and the color bar on the same axis, with a bar for clipped values at each end.
function drawScale() {
  const {quantity, picked} = choice, canvas = byId('histogram');
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (!range || !width) return;
  byId('scale-title').textContent = quantity.label + (quantity.symbol ? ' ' + quantity.symbol : '');
  const pixels = window.devicePixelRatio || 1, pen = canvas.getContext('2d'), style = getComputedStyle(document.body);
  [canvas.width, canvas.height] = [width * pixels, height * pixels];
  pen.scale(pixels, pixels);
  pen.font = `11px ${style.fontFamily}`;
  const left = tail + 6, right = width - tail - 6, base = height - 40, pixel = t => left + t * (right - left);
  drawHistogram(pen, left, right, base, style.getPropertyValue('--quiet'));
  drawColorBar(pen, left, right, base + 3);

  pen.fillStyle = style.color;
  pen.textAlign = 'center';
  const {labels, power} = labelledTicks(text => pen.measureText(text).width, pixel, width);
  for (const {x, middle, text} of labels) {
    pen.fillRect(x - 0.5, base + 15, 1, 4);
    pen.fillText(text, middle, base + 31);
  }
  if (picked !== null && shown.codes[picked] === 0) {
    const x = pixel(place(shown.values[picked]));
    drawPointer(pen, Math.min(right + 4, Math.max(left - 4, x)), base, style.getPropertyValue('--panel'));
  }
  showUnit(power);
  scene.setIsolines(choice.isolines ? labels.map(({t}) => t).filter(t => t > 0.002 && t < 0.998) : []);
}
