#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes benchmark/hand_derived.h: all Taylor coefficients up to order 4 of five functions, differentiated
symbolically, with common subexpressions eliminated and manual optimizations: (r - R)^2 is a polynomial except for r,
and a Gaussian is a product of three. Needs python3-sympy."""
import itertools
import sympy
from sympy.printing.c import C99CodePrinter

x, y, z = sympy.symbols("x y z", real=True)

CENTERS = [(-0.55, -0.45, -0.5), (0.5, -0.55, -0.4), (-0.45, 0.5, -0.55), (0.6, 0.45, -0.5),
           (-0.5, -0.6, 0.45), (0.45, -0.5, 0.55), (-0.6, 0.55, 0.5), (0.55, 0.6, 0.6)]

number = lambda v: sympy.Rational(str(v))

FUNCTIONS = {
    "sphere": x**2 + y**2 + z**2 - 1,
    "blobby": sum(81 * v**4 - 45 * v**2 for v in (x, y, z)) + 6,
    "sine": 2 * z**2 - sympy.sin(5 * x + 3 * y**2 - 1),
}


class Printer(C99CodePrinter):
    """Small integer powers as products, numbers as doubles."""

    def _print_Pow(self, expr):
        base, exponent = expr.as_base_exp()
        if exponent.is_Integer and 2 <= abs(exponent) <= 8:
            product = "*".join([self.parenthesize(base, 50)] * abs(int(exponent)))
            return f"({product})" if exponent > 0 else f"(1.0/({product}))"
        return super()._print_Pow(expr)

    def _print_Integer(self, expr):
        return f"{int(expr)}.0"

    def _print_Rational(self, expr):
        return repr(float(expr))


def monomials():
    for degree in range(5):
        for i in range(degree, -1, -1):
            for j in range(degree - i, -1, -1):
                yield i, j, degree - i - j


def coefficient(f, i, j, k):
    derivative = f
    for variable, order in ((x, i), (y, j), (z, k)):
        if order:
            derivative = sympy.diff(derivative, variable, order)
    return derivative / (sympy.factorial(i) * sympy.factorial(j) * sympy.factorial(k))


def torus():
    """Coefficients of the distance r from the axis, with the cosine and sine of the angle around it and k = 1 / r."""
    r, k, c, s = sympy.symbols("r k c s", positive=True)
    def of_angle(derivative):
        return sympy.expand(derivative.subs(x**2 + y**2, r**2).subs({x: c * r, y: s * r})).subs(r, 1 / k)
    polynomial = x**2 + y**2 + z**2 + number(0.5) ** 2 - number(0.04)
    first = ["r = sqrt(x*x + y*y)", "k = 1.0/r", "c = x*k", "s = y*k"]
    taylor = [coefficient(polynomial, *m) for m in monomials()]
    for n, m in enumerate(monomials()):
        if m == (0, 0, 0):
            taylor[n] -= r
        elif m[2] == 0:
            taylor[n] -= sympy.factor(of_angle(coefficient(sympy.sqrt(x**2 + y**2), *m)))
    return first, taylor


def metaballs():
    """Coefficients of a Gaussian, each of which is a product of three, as the Gaussian is."""
    first, taylor = [], [sympy.Integer(0)] * 35
    taylor[0] = number(0.4)
    u = sympy.Symbol("u")
    factors = [sympy.expand(sympy.diff(sympy.exp(-4 * u**2), u, n) / sympy.exp(-4 * u**2)) / sympy.factorial(n)
               for n in range(5)]
    for n, center in enumerate(CENTERS):
        offsets = [v - number(a) for v, a in zip((x, y, z), center)]
        first.append(f"e{n} = exp(-4.0*({' + '.join(f'({v} - {a})*({v} - {a})' for v, a in zip('xyz', center))}))")
        for position, m in enumerate(monomials()):
            taylor[position] -= sympy.Symbol(f"e{n}") * sympy.prod(
                sympy.horner(factors[order]).subs(u, offset) for order, offset in zip(m, offsets))
    return first, taylor


def code(name, first, taylor):
    symbols = (sympy.Symbol(f"t{n}") for n in itertools.count())
    common, results = sympy.cse(taylor, symbols)
    printer = Printer({"precision": 17})
    lines = [f"  const T {line};" for line in first]
    lines += [f"  const T {symbol} = {printer.doprint(value)};" for symbol, value in common]
    lines += [f"  result[{n}] = {printer.doprint(value)};" for n, value in enumerate(results)]
    text = "\n".join(lines)
    assert "pow(" not in text and text.count("exp(") == (len(CENTERS) if name == "metaballs" else 0)
    functions = "".join(f"  using std::{f};\n" for f in ("exp", "sin", "cos", "sqrt") if f + "(" in text)
    return (f"template <class T>\nvoid {name}([[maybe_unused]] const T& x, [[maybe_unused]] const T& y, "
            f"[[maybe_unused]] const T& z, std::array<T, 35>& result) {{\n" + functions + text + "\n}\n")


functions = {name: ([], [coefficient(f, *m) for m in monomials()]) for name, f in FUNCTIONS.items()}
functions |= {"torus": torus(), "metaballs": metaballs()}
with open("benchmark/hand_derived.h", "w") as out:
    out.write("// SPDX-License-Identifier: GPL-3.0-or-later\n"
              "// Written by generate_hand_derived.py. The Taylor coefficients of five functions up to order 4.\n"
              "// clang-format off\n"
              "#ifndef EQUIAFFINE_BENCHMARK_HAND_DERIVED_H\n#define EQUIAFFINE_BENCHMARK_HAND_DERIVED_H\n\n"
              "#include <array>\n#include <cmath>\n\nnamespace hand_derived {\n\n")
    out.write("\n".join(code(name, *of) for name, of in functions.items()))
    out.write("\n} // namespace hand_derived\n\n#endif\n")
