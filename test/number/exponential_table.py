# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of 2^(n / 128) as sums of two doubles: exponential_table.py ROOT says whether the header has it, and with
--write makes the header, by decimal numbers of 80 digits, so that its bits depend on no compiler."""
import decimal
import pathlib
import sys

HEADER = "include/equiaffine/number/internal/exponential_table.h"
SIZE = 128
TEXT = """// SPDX-License-Identifier: GPL-3.0-or-later
// Made by test/number/exponential_table.py.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_EXPONENTIAL_TABLE_H
#define EQUIAFFINE_NUMBER_INTERNAL_EXPONENTIAL_TABLE_H

#include <array>

// clang-format off

namespace equiaffine::internal {

/// 2^(n / 128), n = 0, ..., 127, as sums of two doubles.
struct Exponential_table {
  static constexpr int size = 128;
  std::array<double, size> high, low;
};
inline constexpr Exponential_table exponential_table = {
    {
@HIGH@
    },
    {
@LOW@
    }};

} // namespace equiaffine::internal

// clang-format on

#endif
"""


def text_of_header():
    decimal.getcontext().prec = 80
    powers = [decimal.Decimal(2) ** (decimal.Decimal(n) / SIZE) for n in range(SIZE)]
    high = [float(power) for power in powers]
    low = [float(power - decimal.Decimal(rounded)) for power, rounded in zip(powers, high)]

    def rows(numbers):
        words = [number.hex() + "," for number in numbers]
        return "\n".join("        " + " ".join(words[n:n + 4]) for n in range(0, SIZE, 4)).rstrip(",")

    return TEXT.replace("@HIGH@", rows(high)).replace("@LOW@", rows(low))


if __name__ == "__main__":
    path = pathlib.Path(sys.argv[1]) / HEADER
    if "--write" in sys.argv:
        path.write_text(text_of_header())
    sys.exit(path.read_text() != text_of_header() and f"{path} is not what this program makes: use --write")
