#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes benchmark/hand_derived.h: all partial derivatives up to order 4 of five functions, differentiated symbolically
and freed of common subexpressions, which is what a careful person would write by hand. Needs python3-sympy."""
import itertools
import sympy
from sympy.printing.c import C99CodePrinter

x, y, z = sympy.symbols("x y z", real=True)

CENTERS = [(-0.55, -0.45, -0.5), (0.5, -0.55, -0.4), (-0.45, 0.5, -0.55), (0.6, 0.45, -0.5),
           (-0.5, -0.6, 0.45), (0.45, -0.5, 0.55), (-0.6, 0.55, 0.5), (0.55, 0.6, 0.6)]

number = lambda v: sympy.Rational(str(v))
ball = lambda c: sympy.exp(-4 * sum((v - number(a)) ** 2 for v, a in zip((x, y, z), c)))

FUNCTIONS = {
    "sphere": x**2 + y**2 + z**2 - 1,
    "blobby": sum(81 * v**4 - 45 * v**2 for v in (x, y, z)) + 6,
    "sine": 2 * z**2 - sympy.sin(5 * x + 3 * y**2 - 1),
    "torus": (sympy.sqrt(x**2 + y**2) - number(0.5)) ** 2 + z**2 - number(0.04),
    "metaballs": number(0.4) - sum(ball(c) for c in CENTERS),
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


def code(name, f):
    # The exponentials are symbols with known derivatives, as a person would have it.
    taylor = [coefficient(f, *m) for m in monomials()]
    if name == "metaballs":
        taylor = [t.xreplace({ball(c): sympy.Symbol(f"e{n}") for n, c in enumerate(CENTERS)}) for t in taylor]
        taylor = [sympy.expand(t, power_base=False, mul=False) for t in taylor]
    else:
        taylor = [sympy.simplify(t) for t in taylor]
    symbols = (sympy.Symbol(f"t{n}") for n in itertools.count())
    common, results = sympy.cse(taylor, symbols)
    printer = Printer({"precision": 17})
    lines = []
    if name == "metaballs":
        lines += [f"  const T e{n} = exp({printer.doprint(ball(c).args[0])});" for n, c in enumerate(CENTERS)]
    lines += [f"  const T {symbol} = {printer.doprint(value)};" for symbol, value in common]
    lines += [f"  c[{n}] = {printer.doprint(value)};" for n, value in enumerate(results)]
    functions = "".join(f"  using std::{f};\n" for f in ("exp", "sin", "cos", "sqrt"))
    return (f"template <class T>\nvoid {name}([[maybe_unused]] const T& x, [[maybe_unused]] const T& y, "
            f"[[maybe_unused]] const T& z, std::array<T, 35>& c) {{\n" + functions + "\n".join(lines) + "\n}\n")


with open("benchmark/hand_derived.h", "w") as out:
    out.write("// SPDX-License-Identifier: GPL-3.0-or-later\n"
              "// Written by generate_hand_derived.py. The Taylor coefficients of five functions up to order 4.\n"
              "// clang-format off\n"
              "#ifndef EQUIAFFINE_BENCHMARK_HAND_DERIVED_H\n#define EQUIAFFINE_BENCHMARK_HAND_DERIVED_H\n\n"
              "#include <array>\n#include <cmath>\n\nnamespace hand_derived {\n\n")
    out.write("\n".join(code(name, f) for name, f in FUNCTIONS.items()))
    out.write("\n} // namespace hand_derived\n\n#endif\n")
