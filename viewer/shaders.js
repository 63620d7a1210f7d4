// SPDX-License-Identifier: GPL-3.0-or-later
// The shaders. The build replaces each @FILE@ by the content of this file.

const placing = `@placing.glsl@
`;

const surfaceVertex = placing + `
@surface.vert.glsl@`;

const surfaceFragment = `@surface.frag.glsl@`;

const edgeVertex = placing + `
@edge.vert.glsl@`;
const edgeFragment = `@edge.frag.glsl@`;

const markVertex = placing + `
@mark.vert.glsl@`;
const markFragment = `@mark.frag.glsl@`;

const needleVertex = placing + `
@needle.vert.glsl@`;
const needleFragment = `@needle.frag.glsl@`;
