# SPDX-License-Identifier: GPL-3.0-only
"""Elementary functions and random numbers that give the same bits on every machine.

They are made of additions, multiplications, divisions, square roots and roundings alone, which
IEEE 754 defines to the last bit. Their error is a few units in the last place.
"""

import math

import numpy as np

Array = np.ndarray
PI = math.pi
LOG_2 = 0.6931471805599453


def _polynomial(x: Array, coefficients: list[float]) -> Array:
    """Horner's scheme; the coefficient of the highest power comes first."""
    value = np.full_like(x, coefficients[0])
    for coefficient in coefficients[1:]:
        value = value * x + coefficient
    return value


def _taylor(exponents: range) -> list[float]:
    """Coefficients 1/n!, those of sine and cosine with alternating signs, highest power first."""
    sign = -1 if exponents.step == 2 else 1
    return [sign**i / math.factorial(n) for i, n in enumerate(exponents)][::-1]


def cos(angle: Array | float) -> Array:
    """Cosine of an angle in radians."""
    return sin(np.asarray(angle, dtype=float), 1)


def sin(angle: Array | float, quarter_turns: int = 0) -> Array:
    """Sine of an angle in radians plus a number of quarter turns."""
    angle = np.asarray(angle, dtype=float)
    nearest = np.rint(angle * (2 / PI))
    rest = angle - nearest * (PI / 2)  # in [-pi/4, pi/4]
    squared = rest * rest
    sine = rest * _polynomial(squared, _taylor(range(1, 18, 2)))
    cosine = _polynomial(squared, _taylor(range(0, 18, 2)))
    quadrant = (nearest.astype(np.int64) + quarter_turns) % 4
    return np.choose(quadrant, [sine, cosine, -sine, -cosine])


def exp(x: Array | float) -> Array:
    x = np.asarray(x, dtype=float)
    exponent = np.rint(x / LOG_2)
    rest = x - exponent * LOG_2
    return np.ldexp(_polynomial(rest, _taylor(range(0, 18))), exponent.astype(np.int64))


def log(x: Array | float) -> Array:
    """Natural logarithm of positive numbers."""
    mantissa, exponent = np.frexp(np.asarray(x, dtype=float))
    low = mantissa < math.sqrt(0.5)
    mantissa, exponent = np.where(low, 2 * mantissa, mantissa), exponent - low
    t = (mantissa - 1) / (mantissa + 1)  # log(m) = 2 artanh(t)
    series = _polynomial(t * t, [1 / n for n in range(23, 0, -2)])
    return exponent * LOG_2 + 2 * t * series


def power(base: Array | float, exponent: float) -> Array:
    """base to the power of exponent, for bases that are not negative."""
    base = np.asarray(base, dtype=float)
    positive = np.where(base > 0, base, 1)
    return np.where(base > 0, exp(exponent * log(positive)), 0.0)


def angle(x: Array, y: Array) -> Array:
    """Angle of the vector (x, y) from the x axis, -pi to pi; 0 for the vector of length 0."""
    low, high = np.minimum(np.abs(x), np.abs(y)), np.maximum(np.abs(x), np.abs(y))
    t = low / np.where(high > 0, high, 1)
    for _ in range(2):  # arctan(t) = 2 arctan(t / (1 + sqrt(1 + t²)))
        t = t / (1 + np.sqrt(1 + t * t))
    coefficients = [(-1)**i / (2 * i + 1) for i in range(11)]
    arctangent = 4 * t * _polynomial(t * t, coefficients[::-1])
    arctangent = np.where(np.abs(y) > np.abs(x), PI / 2 - arctangent, arctangent)
    arctangent = np.where(np.asarray(x) < 0, PI - arctangent, arctangent)
    return np.where(np.asarray(y) < 0, -arctangent, arctangent)


def smoothstep(low: float, high: float, x: Array | float) -> Array:
    """0 below low, 1 above high, with a horizontal tangent at both."""
    t = np.clip((np.asarray(x, dtype=float) - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


class Random:
    """Random numbers from a seed, by the generator that numpy promises to keep as it is."""

    def __init__(self, seed: int):
        self._state = np.random.RandomState(seed)

    def uniform(self, low: Array | float, high: Array | float, shape=()) -> Array:
        return low + (np.asarray(high) - low) * self._state.random_sample(shape)

    def normal(self, shape=()) -> Array:
        """Standard normal distribution, by the method of Box and Muller."""
        radius = np.sqrt(-2 * log(1 - self._state.random_sample(shape)))
        return radius * cos(2 * PI * self._state.random_sample(shape))

    def integers(self, end: int, shape=()) -> Array:
        """Whole numbers from 0 to end - 1."""
        return np.minimum((self._state.random_sample(shape) * end).astype(np.int64), end - 1)

    def direction(self, count: int) -> Array:
        """Unit vectors, uniformly distributed on the sphere."""
        z = self.uniform(-1, 1, count)
        angle = self.uniform(0, 2 * PI, count)
        radius = np.sqrt(np.maximum(0, 1 - z * z))
        return np.stack([radius * cos(angle), radius * sin(angle), z], axis=-1)
