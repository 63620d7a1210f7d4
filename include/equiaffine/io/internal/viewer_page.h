// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_VIEWER_PAGE_H
#define EQUIAFFINE_IO_INTERNAL_VIEWER_PAGE_H

#include <string_view>

/// \file
/// The fixed parts of the page of `write_HTML`: style and elements.

namespace equiaffine::internal {

inline constexpr std::string_view viewer_style = R"css(
:root {
  color-scheme: light dark;
  --stage-center: #ffffff; --stage-edge: #dfe5ee; --panel: #fbfcfe; --line: #d9dee7;
  --text: #1b2330; --quiet: #5c6778; --accent: #2557c7; --soft: #eef2f8;
}
@media (prefers-color-scheme: dark) {
  :root:not([data-theme="light"]) {
    --stage-center: #2b313c; --stage-edge: #14171d; --panel: #1b1f27; --line: #343b48;
    --text: #e8ecf3; --quiet: #98a3b5; --accent: #86aaff; --soft: #272d38;
  }
}
:root[data-theme="light"] { color-scheme: light; }
:root[data-theme="dark"] {
  color-scheme: dark;
  --stage-center: #2b313c; --stage-edge: #14171d; --panel: #1b1f27; --line: #343b48;
  --text: #e8ecf3; --quiet: #98a3b5; --accent: #86aaff; --soft: #272d38;
}
* { box-sizing: border-box; }
html, body { height: 100%; margin: 0; overflow: hidden; }
body {
  display: grid; grid-template: minmax(0, 1fr) / minmax(0, 1fr) 336px; color: var(--text); background: var(--panel);
  font: 14px/1.45 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif;
}
body.no-panel { grid-template-columns: minmax(0, 1fr); }
body.no-panel #panel, .no-scene #tools, .no-scene #axes, .no-scene #hint { display: none; }
[hidden] { display: none !important; }
#stage {
  position: relative; min-width: 0; min-height: 0; overflow: hidden;
  background: radial-gradient(ellipse at 50% 45%, var(--stage-center), var(--stage-edge));
}
#view { position: absolute; inset: 0; width: 100%; height: 100%; touch-action: none; cursor: grab; outline: none; }
#view:active { cursor: grabbing; }
#axes { position: absolute; left: 10px; bottom: 10px; width: 84px; height: 84px; pointer-events: none; }
#axes text {
  font-size: 12px; fill: var(--quiet); text-anchor: middle; dominant-baseline: central;
  paint-order: stroke; stroke: var(--stage-edge); stroke-width: 3px;
}
#axes line { stroke: var(--quiet); stroke-width: 1.6; stroke-linecap: round; }
#hint {
  position: absolute; left: 50%; bottom: 16px; transform: translateX(-50%); color: var(--quiet); font-size: 13px;
  pointer-events: none; transition: opacity .6s; text-align: center; width: max-content;
  max-width: calc(100% - 210px);
}
#tools { position: absolute; right: 10px; top: 10px; display: flex; gap: 6px; }
#tools button { width: 34px; height: 34px; padding: 0; font-size: 16px; }
#message {
  position: absolute; inset: 0; display: grid; place-content: center; padding: 2em; text-align: center; font-size: 17px;
  white-space: pre-line;
}
#help {
  position: absolute; right: 10px; top: 52px; max-width: min(430px, calc(100% - 20px)); max-height: calc(100% - 70px);
  overflow: auto; padding: 12px 16px; border: 1px solid var(--line); border-radius: 10px; background: var(--panel);
  box-shadow: 0 8px 30px #0004; font-size: 13px;
}
#help td { padding: 2px 14px 2px 0; vertical-align: top; text-align: left; }
#help td:first-child { white-space: nowrap; font-weight: 600; }
#help p { margin: 8px 0 0; color: var(--quiet); }
#panel {
  overflow-y: auto; padding: 16px 18px 22px; border-left: 1px solid var(--line); background: var(--panel);
  scrollbar-width: thin; scrollbar-color: var(--line) transparent;
}
h1 { margin: 0 0 12px; font-size: 17px; line-height: 1.3; overflow-wrap: anywhere; }
h2 {
  margin: 18px 0 6px; font-size: 11px; letter-spacing: .07em; text-transform: uppercase; color: var(--quiet);
  display: flex; justify-content: space-between; align-items: end;
}
button, select {
  font: inherit; color: inherit; background: var(--soft); border: 1px solid var(--line); border-radius: 7px;
  padding: 5px 10px; cursor: pointer;
}
select { width: 100%; min-width: 0; }
button:hover, select:hover { border-color: var(--quiet); }
input[type=number] {
  font: inherit; color: inherit; background: var(--panel); border: 1px solid var(--line); border-radius: 7px;
  padding: 4px 7px; width: 0; flex: 1; min-width: 0; appearance: textfield;
}
input[aria-invalid=true] { border-color: #c8102e; }
#range-auto { padding: 4px 8px; }
#cut { width: 88px; flex: none; }
#picture-message, #meaning { margin: 6px 0 0; }
#meaning { font-size: 13px; }
#hint .touch { display: none; }
@media (pointer: coarse) {
  #hint .mouse { display: none; }
  #hint .touch { display: inline; }
  #tools button { width: 44px; height: 44px; }
  #help { top: 62px; }
}
:focus-visible { outline: 2px solid var(--accent); outline-offset: 1px; }
#view:focus-visible { outline: 2px solid var(--accent); outline-offset: -3px; }
h2 button { padding: 1px 8px; font-size: 12px; letter-spacing: 0; text-transform: none; }
input { accent-color: var(--accent); }
.row { display: flex; align-items: center; gap: 10px; margin-top: 8px; }
.row > label:first-child, .row > span:first-child { flex: 0 0 64px; color: var(--quiet); }
.row input[type=range] { flex: 1; min-width: 0; }
.row output { flex: 0 0 42px; text-align: right; }
#lowest, #highest { appearance: textfield; padding: 4px; font-size: 13px; }
.segments { display: flex; flex: 1; }
.segments button { flex: 1; border-radius: 0; margin-left: -1px; padding: 4px 6px; }
.segments button:first-child { border-radius: 7px 0 0 7px; margin-left: 0; }
.segments button:last-child { border-radius: 0 7px 7px 0; }
.segments button[aria-pressed=true] { background: var(--accent); border-color: var(--accent); color: var(--panel); }
#scale { margin: 14px 0 0; }
#scale figcaption { display: flex; justify-content: space-between; gap: 8px; font-size: 13px; }
#scale figcaption span:last-child { color: var(--quiet); white-space: nowrap; }
#histogram { display: block; width: 100%; height: 132px; margin-top: 4px; }
#stage > #scale {
  position: absolute; right: 12px; bottom: 12px; width: min(310px, calc(100% - 24px)); padding: 8px 12px 4px;
  border-radius: 10px; background: color-mix(in srgb, var(--panel) 82%, transparent); pointer-events: none;
}
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
td { padding: 1px 0; }
td + td { text-align: right; padding-left: 8px; }
#statistics { margin-top: 8px; }
sup { line-height: 0; }
.quiet { color: var(--quiet); }
.swatch {
  display: inline-block; width: 11px; height: 11px; border-radius: 3px; margin-right: 7px; vertical-align: -1px;
  box-shadow: 0 0 0 1px #8886;
}
.checks { display: grid; grid-template-columns: 1fr 1fr; gap: 3px 8px; }
.checks label { display: flex; align-items: center; gap: 6px; cursor: pointer; }
.checks label.wide { grid-column: 1 / 3; }
.checks input { margin: 0; }
.buttons { display: flex; gap: 6px; margin-top: 10px; }
.buttons button { flex: 1; padding: 5px 4px; font-size: 13px; }
dl { display: grid; grid-template-columns: auto minmax(0, 1fr); gap: 2px 12px; margin: 0; }
dt { color: var(--quiet); }
dd { margin: 0; overflow-wrap: anywhere; }
@media print {
  html, body, #panel { height: auto; overflow: visible; }
  #tools, #hint, #help, .buttons, .row, .checks, #panel select, #panel input, h2:has(~ .buttons) { display: none; }
  body, body.no-panel { display: block; }
  #stage { height: 130mm; }
  #panel { border: 0; }
}
@media (max-width: 720px) {
  #view, #message { bottom: 26px; height: calc(100% - 26px); }
  #hint { bottom: 3px; max-width: 100%; white-space: nowrap; font-size: 12px; }
  #axes { bottom: 30px; width: 60px; height: 60px; }
  #help { position: fixed; inset: auto 0 0 0; max-width: none; height: 42%; max-height: none; z-index: 1; }
  body { grid-template-columns: 1fr; grid-template-rows: minmax(0, 1fr) 42%; }
  body.no-panel { grid-template-columns: 1fr; grid-template-rows: 1fr; }
  #panel { border-left: 0; border-top: 1px solid var(--line); }
}
)css";

inline constexpr std::string_view viewer_stage = R"html(
<main id="stage">
<canvas id="view" tabindex="0" aria-label="The surface. Drag to turn, wheel to zoom, click to read a point."></canvas>
<svg id="axes" viewBox="-42 -42 84 84" aria-hidden="true">
<line></line><line></line><line></line><text>x</text><text>y</text><text>z</text>
</svg>
<div id="hint"><span class="mouse">Drag to turn · wheel to zoom · click a point to read its numbers</span>
<span class="touch">Drag turns · pinch zooms · a tap reads numbers</span></div>
<div id="message" role="status">Loading the surface …</div>
<noscript>This page draws the surface with JavaScript and WebGL 2. Please allow scripts.</noscript>
<div id="tools">
<button id="help-toggle" title="Help (?)" aria-label="Help" aria-expanded="false">?</button>
<button id="panel-toggle" title="Show or hide the panel (h)" aria-label="Panel" aria-expanded="true">☰</button>
</div>
<div id="help" hidden>
<table>
<tr><td>drag, arrows</td><td>turn</td></tr>
<tr><td>wheel, pinch, + −</td><td>zoom, to the pointer</td></tr>
<tr><td>right or shift drag</td><td>move; with two fingers, too</td></tr>
<tr><td>click</td><td>read the numbers of a vertex; Esc lets go</td></tr>
<tr><td>double click</td><td>turn around this point</td></tr>
<tr><td>r</td><td>back to the first view</td></tr>
<tr><td>x y z</td><td>look along an axis; with shift, from the other side</td></tr>
<tr><td>n p</td><td>next, previous quantity</td></tr>
<tr><td>l</td><td>linear, logarithmic or equalized colors</td></tr>
<tr><td>e i v</td><td>edges, isolines, vectors</td></tr>
<tr><td>m</td><td>measure distances from the picked vertex</td></tr>
<tr><td>s</td><td>save the picture</td></tr>
<tr><td>h</td><td>show or hide the panel</td></tr>
</table>
<p>The address takes the same choices: #color=NAME, view=X,Y,Z (from where; three more numbers: what is up),
target=X,Y,Z, zoom=1, scale=linear, log, equalized or auto,
clip=PERCENT, edges=1, isolines=1, marks=0, vectors=NAME, up=z, pick=VERTEX,
from=VERTEX (to measure from), range=LOW,HIGH, cut=-x,0.5 (which side, and where), panel=0, theme=dark or light, joined
by &amp;.</p>
<p>Numbers are stored in single precision: seven digits are true.</p>
</div>
</main>
)html";

inline constexpr std::string_view viewer_controls = R"html(
<select id="quantity" aria-label="Quantity"></select>
<figure id="scale">
<figcaption><span id="scale-title"></span><span id="scale-unit"></span></figcaption>
<canvas id="histogram" role="img" aria-label="Histogram and color bar"></canvas>
</figure>
<p id="meaning" class="quiet"></p>
<div id="mapping">
<div class="row"><div class="segments" aria-label="Colors">
<button id="scale-linear" aria-pressed="true">linear</button>
<button id="scale-logarithmic" aria-pressed="false">logarithmic</button>
<button id="scale-equalized" aria-pressed="false"
title="Equal areas of the surface have equal parts of the bar">equalized</button>
</div></div>
<div class="row"><label for="clip">Clip</label><input type="range" id="clip" min="0" step="1">
<output id="clip-text" for="clip"></output></div>
<div class="row"><label for="lowest">Range</label>
<input type="number" step="any" id="lowest" aria-label="Lowest number">
<input type="number" step="any" id="highest" aria-label="Highest number">
<button id="range-auto" title="Quantiles of the numbers">auto</button></div>
<table id="statistics"></table>
</div>
<section id="picked" aria-live="polite" hidden>
<h2><span id="picked-title"></span><span><button id="picked-measure">measure from here</button>
<button id="picked-copy">copy</button></span></h2>
<table id="picked-table"></table>
</section>
<h2>Points</h2>
<table id="legend"></table>
<h2>View</h2>
<div class="checks">
<label><input type="checkbox" id="edges"> edges</label>
<label><input type="checkbox" id="isolines"> isolines at ticks</label>
<label id="marks-label" class="wide"><input type="checkbox" id="marks"> why there is no number</label>
</div>
<div class="row" id="vectors-row"><label for="vectors">Vectors</label><select id="vectors"></select></div>
<div class="row"><span>Up</span><div class="segments" id="up">
<button>x</button><button>y</button><button>z</button>
</div></div>
<div class="row"><label for="cut">Cut off</label><select id="cut"></select>
<input type="range" id="cut-place" min="0" max="1" step="0.002" aria-label="Place of the cut"></div>
<div class="buttons"><button id="reset">Reset view</button><button id="link">Copy link</button></div>
<h2>Save</h2>
<div class="row"><label for="picture-width">Pixels</label>
<input type="number" id="picture-width" min="100" max="10000" value="1600" aria-label="Width in pixels">
<input type="number" id="picture-height" min="100" max="10000" value="1200" aria-label="Height in pixels"></div>
<div class="buttons"><button id="save">Picture</button><button id="save-csv">CSV</button>
<button id="save-ply">PLY</button></div>
<p id="picture-message" class="quiet" role="status"></p>
)html";

} // namespace equiaffine::internal

#endif
