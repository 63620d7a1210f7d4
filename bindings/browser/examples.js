// SPDX-License-Identifier: GPL-3.0-or-later
// Example surfaces: formula, names: {NAME: [value, minimum, maximum]}, box (its six numbers, or half the side of a
// cube), and a remark.

const examples = [
  {name: 'Blobby', formula: '(3*x)^4 + (3*y)^4 + (3*z)^4 - 45*(x^2 + y^2 + z^2) + 6*c', names: {c: [1, 0.2, 30]}, box: 1.2,
   text: 'From the paper. K is infinite along the parabolic curves, which separate caps from saddles.'},
  {name: 'Torus', formula: '(sqrt(x^2 + y^2) - R)^2 + z^2 = r^2', names: {R: [2, 0.5, 3], r: [0.7, 0.1, 1.5]},
   box: [-4.5, 4.5, -4.5, 4.5, -1.6, 1.6],
   text: 'Two parabolic circles, on the top and the bottom, separate the outer part from the inner part.'},
  {name: 'Ellipsoid', formula: '(x/a)^2 + (y/b)^2 + (z/c)^2 = 1', names: {a: [1, 0.3, 2], b: [0.7, 0.3, 2], c: [0.5, 0.3, 2]},
   box: 2.1, text: 'An affine image of a sphere: K and H are constant and J is 0 for all a, b and c.'},
  {name: 'Hyperboloid', formula: 'x^2 + y^2 - (z/c)^2 = 1', names: {c: [1, 0.3, 3]}, box: 2,
   text: 'A quadric like the ellipsoid: K and H are constant and J is 0, but every point is a saddle point.'},
  {name: 'Tangle', formula: 'x^4 - 5*x^2 + y^4 - 5*y^2 + z^4 - 5*z^2 + c = 0', names: {c: [11.8, 6, 16]}, box: 3,
   text: 'Drag c: the eight balls grow together, and holes close.'},
  {name: 'Gyroid', formula: 'sin(k*x)*cos(k*y) + sin(k*y)*cos(k*z) + sin(k*z)*cos(k*x) = t',
   names: {k: [1, 0.5, 2], t: [0, -1.2, 1.2]}, box: 4.5,
   text: 'Nearly a minimal surface. At its flat points the affine normal differs widely from the Euclidean normal.'},
  {name: 'Superquadric', formula: 'abs(x)^p + abs(y)^p + abs(z)^p = 1', names: {p: [3, 1.5, 8]}, box: 1.3,
   text: 'Varies from an octahedron to a cube. For p = 2 it is a sphere, with constant affine curvatures.'},
  {name: 'Three waves', formula: 'z = a*sin(k*x)*cos(k*y)', names: {a: [0.5, 0.05, 1.5], k: [2, 0.5, 4]},
   box: [-3, 3, -3, 3, -1.6, 1.6], text: 'The graph of a function. Its parabolic curves form a net.'},
  {name: 'Heart', formula: '(x^2 + 9/4*y^2 + z^2 - 1)^3 = x^2*z^3 + a*y^2*z^3', names: {a: [0.1, 0, 0.5]}, box: 1.5,
   text: 'Taubin\'s heart. Its curvature is undefined at the sharp points.'},
  {name: 'Goursat', formula: 'x^4 + y^4 + z^4 + a*(x^2 + y^2 + z^2)^2 + b*(x^2 + y^2 + z^2) = 1',
   names: {a: [-0.3, -0.32, 1], b: [0, -2, 2]}, box: 1.9, text: 'Quartics with the full symmetry group of the cube.'},
  {name: 'Barth sextic', formula: '4*(w^2*x^2 - y^2)*(w^2*y^2 - z^2)*(w^2*z^2 - x^2) - (1 + 2*w)*(x^2 + y^2 + z^2 - s)^2 = t',
   names: {w: [1.618, 1.2, 2], s: [1, 0.7, 1.2], t: [0, -0.5, 0.5]}, box: 2,
   text: 'For w = golden ratio, s = 1 and t = 0 it has 65 nodes, which are shown as singular.'},
  {name: 'Metaballs', formula: 'exp(-4*((x - d)^2 + y^2 + z^2)) + exp(-4*((x + d)^2 + y^2 + z^2)) = t',
   names: {d: [0.6, 0, 1.2], t: [0.4, 0.05, 0.95]}, box: [-2.2, 2.2, -1.2, 1.2, -1.2, 1.2],
   text: 'Drag d and t: two balls merge, and a parabolic curve appears around the neck.'},
];
