// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces to begin with: a formula, its names with value, least and greatest, half the side of the box or the six
// numbers of it, and what there is to see.

const examples = [
  {name: 'Blobby', formula: '(3*x)^4 + (3*y)^4 + (3*z)^4 - 45*(x^2 + y^2 + z^2) + 6*c', names: {c: [1, 0.2, 30]}, box: 1.2,
   text: 'Of the paper. K is infinite along the parabolic curves, where the surface turns from a cap to a saddle.'},
  {name: 'Torus', formula: '(sqrt(x^2 + y^2) - R)^2 + z^2 = r^2', names: {R: [2, 0.5, 3], r: [0.7, 0.1, 1.5]},
   box: [-4.5, 4.5, -4.5, 4.5, -1.6, 1.6],
   text: 'The two parabolic circles on its top and its bottom part the outside from the inside.'},
  {name: 'Ellipsoid', formula: '(x/a)^2 + (y/b)^2 + (z/c)^2 = 1', names: {a: [1, 0.3, 2], b: [0.7, 0.3, 2], c: [0.5, 0.3, 2]},
   box: 2.1, text: 'An affine image of a sphere: K and H are the same everywhere, and J is 0, whatever a, b and c are.'},
  {name: 'Hyperboloid', formula: 'x^2 + y^2 - (z/c)^2 = 1', names: {c: [1, 0.3, 3]}, box: 2,
   text: 'A quadric like the ellipsoid: K, H are constant and J is 0, although it is a saddle everywhere.'},
  {name: 'Tangle', formula: 'x^4 - 5*x^2 + y^4 - 5*y^2 + z^4 - 5*z^2 + c = 0', names: {c: [11.8, 6, 16]}, box: 3,
   text: 'Drag c: the eight balls of the tangle grow together, and holes close.'},
  {name: 'Gyroid', formula: 'sin(k*x)*cos(k*y) + sin(k*y)*cos(k*z) + sin(k*z)*cos(k*x) = t',
   names: {k: [1, 0.5, 2], t: [0, -1.2, 1.2]}, box: 4.5,
   text: 'Nearly a minimal surface. At its flat points the affine normal is far from the Euclidean one.'},
  {name: 'Superquadric', formula: 'abs(x)^p + abs(y)^p + abs(z)^p = 1', names: {p: [3, 1.5, 8]}, box: 1.3,
   text: 'From an octahedron over a ball to a cube: with p = 2 it is a sphere, and the affine curvatures are constant.'},
  {name: 'Three waves', formula: 'z = a*sin(k*x)*cos(k*y)', names: {a: [0.5, 0.05, 1.5], k: [2, 0.5, 4]},
   box: [-3, 3, -3, 3, -1.6, 1.6], text: 'The graph of a function; its parabolic curves are a net.'},
  {name: 'Heart', formula: '(x^2 + 9/4*y^2 + z^2 - 1)^3 = x^2*z^3 + a*y^2*z^3', names: {a: [0.1, 0, 0.5]}, box: 1.5,
   text: 'Taubin\'s heart. Where it has a sharp point there is no curvature.'},
  {name: 'Goursat', formula: 'x^4 + y^4 + z^4 + a*(x^2 + y^2 + z^2)^2 + b*(x^2 + y^2 + z^2) = 1',
   names: {a: [-0.3, -0.32, 1], b: [0, -2, 2]}, box: 1.9, text: 'Quartics with all symmetries of the cube.'},
  {name: 'Barth sextic', formula: '4*(w^2*x^2 - y^2)*(w^2*y^2 - z^2)*(w^2*z^2 - x^2) - (1 + 2*w)*(x^2 + y^2 + z^2 - s)^2 = t',
   names: {w: [1.618, 1.2, 2], s: [1, 0.7, 1.2], t: [0, -0.5, 0.5]}, box: 2,
   text: 'With w the golden ratio, s = 1 and t = 0 it has 65 nodes, which are shown as singular.'},
  {name: 'Metaballs', formula: 'exp(-4*((x - d)^2 + y^2 + z^2)) + exp(-4*((x + d)^2 + y^2 + z^2)) = t',
   names: {d: [0.6, 0, 1.2], t: [0.4, 0.05, 0.95]}, box: [-2.2, 2.2, -1.2, 1.2, -1.2, 1.2],
   text: 'Drag d and t: two balls meet, and a parabolic curve appears around the neck.'},
];
