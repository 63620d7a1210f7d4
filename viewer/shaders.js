// SPDX-License-Identifier: GPL-3.0-or-later
// The programs of the graphics processor. The build puts the file of that name in the place of each @FILE@.

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
