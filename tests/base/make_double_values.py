"""Writes tests/base/double_values.h: python3 tests/base/make_double_values.py > tests/base/double_values.h

Arguments and true values of lom_double_*, by decimal arithmetic with 900 digits and series that share nothing with the
library: sin, cos by Taylor after subtracting multiples of Machin's pi; exp, log by Python's decimal; atan by halving
the angle; erf by its series. A value is kept as hi + lo, two doubles, hence to 2^-106."""
from decimal import Decimal as D, getcontext
from fractions import Fraction
import random

getcontext().prec = 900
getcontext().Emin, getcontext().Emax = -10**9, 10**9
TINY = D(10) ** -880


def arc_cotangent(n):
    total, power, k = D(0), D(1) / n, 0
    while power > TINY:
        total += power / (2 * k + 1) * (-1) ** k
        power /= n * n
        k += 1
    return total


PI = 4 * (4 * arc_cotangent(5) - arc_cotangent(239))


def series(first, ratio):
    total, term, n = D(0), first, 0
    while abs(term) > TINY * max(abs(total), D(10) ** -400):
        total += term
        n += 1
        term = term * ratio(n)
    return total


def sin(x):
    x = x - 2 * PI * (x / (2 * PI)).to_integral_value()
    return series(x, lambda n: -x * x / (2 * n * (2 * n + 1)))


def cos(x):
    x = x - 2 * PI * (x / (2 * PI)).to_integral_value()
    return series(D(1), lambda n: -x * x / ((2 * n - 1) * 2 * n))


def atan(x):
    halvings = 0
    while abs(x) > D("0.001"):
        x = x / (1 + (1 + x * x).sqrt())
        halvings += 1
    total, power, k = D(0), x, 0
    while abs(power) > TINY * abs(x):
        total += power / (2 * k + 1) * (-1) ** k
        power *= x * x
        k += 1
    return total * 2 ** halvings


def atan2(y, x):
    if x > 0:
        return atan(y / x)
    return (PI if y > 0 else -PI) + atan(y / x) if x < 0 else (PI / 2).copy_sign(y)


def asin(x):
    return atan2(x, (1 - x * x).sqrt())


def acos(x):
    return atan2((1 - x * x).sqrt(), x)


def erf(x):
    total, term, n = D(0), x, 0
    while abs(term) > TINY:
        total += term / (2 * n + 1)
        n += 1
        term *= -x * x / n
    return 2 / PI.sqrt() * total


def log2(x):
    return x.ln() / D(2).ln()


UNARY = {
    "sin": sin, "cos": cos, "tan": lambda x: sin(x) / cos(x), "asin": asin, "acos": acos, "atan": atan,
    "exp": lambda x: x.exp(), "exp2": lambda x: (x * D(2).ln()).exp(), "expm1": lambda x: x.exp() - 1,
    "log": lambda x: x.ln(), "log2": log2, "log1p": lambda x: (1 + x).ln(),
    "sinh": lambda x: (x.exp() - (-x).exp()) / 2, "cosh": lambda x: (x.exp() + (-x).exp()) / 2,
    "tanh": lambda x: 1 - 2 / ((2 * x).exp() + 1), "erf": erf,
    "cbrt": lambda x: (abs(x).ln() / 3).exp().copy_sign(x),
}
# 6381956970095103 * 2^797 is the double nearest to a multiple of pi/2 (Muller, "Elementary functions", 10.2).
ANGLES = [1e-5, 0.5, 0.785398163397448, 0.7853981633974484, 1.5707963267948966, 3.141592653589793, 22.0, 355.0, 710.0,
          103993.0, 411557.98, 524287.9, 524288.0, 2.0**40, 2.0**40 - 0.5, 1e22, 6381956970095103.0 * 2.0**797, 1.7e308]
SPREAD = {
    "sin": ANGLES, "cos": ANGLES, "tan": ANGLES,
    "asin": [1e-9, 1e-3, 0.03, 0.5, 0.70710678, 0.99, 1 - 2.0**-53], "atan": [1e-9, 1e-3, 0.031, 0.5, 1 - 2.0**-53, 3e5],
    "acos": [1e-9, 1e-3, 0.5, 0.70710678, 0.99, 1 - 2.0**-53],
    "exp": [1e-17, 1e-9, 0.3466, 1.0, 709.78, 745.1, 708.5], "exp2": [1e-17, 0.5, 1023.99, 1074.4, 1022.3],
    "expm1": [1e-15, 1e-9, 0.0027, 0.0028, 0.5, 36.0, 700.0],
    "log": [5e-324, 3e-310, 0.5, 1 - 2.0**-53, 1 + 2.0**-52, 1.0078, 0.9961, 1e300],
    "log2": [5e-324, 0.7, 1 - 2.0**-53, 1 + 2.0**-52, 1.0078, 1e300],
    "log1p": [1e-15, 1e-9, 0.0078, 0.5, 1e10, 1e300], "sinh": [1e-7, 0.01, 0.3, 20.0, 41.0, 710.4],
    "cosh": [1e-7, 0.01, 0.3, 20.0, 41.0, 710.4], "tanh": [1e-7, 0.01, 0.3, 5.0, 18.9],
    "erf": [1e-300, 1e-9, 0.4999, 0.5, 0.5624, 2.0, 5.8], "cbrt": [5e-324, 1e-310, 0.5, 7.999, 27.0, 1.7e308],
}
POSITIVE = {"log", "log2"}
BINARY = {
    "pow": (lambda x, y: (x.ln() * y).exp(),
            [(2.0, 0.5), (10.0, 308.0), (0.1, 307.0), (1 + 2.0**-52, 3e18), (1 - 2.0**-53, 6e18), (1.0001, 7e6),
             (0.5, 1073.5), (5e-324, 0.3), (1.7e308, 0.99), (0.99999, 200.0), (3.0, -20.25), (0.7, 2.2),
             (1e-5, 61.7)]),
    "atan2": (atan2, [(1.0, 2.0), (2.0, 1.0), (-1.0, 2.0), (1.0, -2.0), (-3.0, -0.1), (1e-300, 1e-305),
                      (1e308, 1.5e308), (5e-324, 5e-324), (1e-310, 1.0), (1.0, -1e-200), (1.0, 1.0000000001)]),
}


def rounded(value):
    """The double nearest to a Decimal, as a Fraction, denormals included."""
    f = Fraction(value)
    if f == 0:
        return f
    e = max(abs(f.numerator).bit_length() - f.denominator.bit_length() - 54, -1074)
    unit = Fraction(2) ** e
    while abs(round(f / unit)) > 2**53:
        unit *= 2
    while unit > Fraction(1, 2**1074) and abs(round(f / unit)) < 2**52:
        unit /= 2
    return round(f / unit) * unit


def row(arguments, value):
    hi = rounded(value)
    numbers = [float(x) for x in arguments] + [float(hi), float(rounded(D(0) + value - exact(hi)))]
    print("    { " + ", ".join(x.hex() for x in numbers) + " },")


def exact(f):
    return D(f.numerator) / D(f.denominator)


random.seed(1)
print("/* Made by tests/base/make_double_values.py, which says how: { x, (y,) hi, lo }, the true value being hi + lo. */")
print("/* clang-format off */")
for name, function in UNARY.items():
    print(f"static const double {name.upper()}_VALUES[][3] = {{")
    for x in SPREAD[name]:
        for signed in [x] if name in POSITIVE or (name == "expm1" and x > 100) else [x, -x]:
            if not (name == "log1p" and signed <= -1 or name in ("exp", "exp2") and signed > 1000):
                if not (name == "exp" and signed > 709.8):
                    row([signed], function(D(signed)))
    print("};")
for name, (function, arguments) in BINARY.items():
    print(f"static const double {name.upper()}_VALUES[][4] = {{")
    for x, y in arguments:
        row([x, y], function(D(x), D(y)))
    print("};")
