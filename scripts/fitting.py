"""Least squares, quantiles, and the tails of Student's t and Fisher's F, without packages."""

import math

Vector = list[float]


def solve(matrix: list[Vector], right: Vector) -> Vector | None:
    """Gaussian elimination with pivoting; None where the matrix is singular to rounding."""
    n = len(right)
    rows = [[*matrix[i], right[i]] for i in range(n)]
    scale = max((abs(v) for row in matrix for v in row), default=0.0)
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        if abs(rows[i][i]) <= 1e-11 * scale:
            return None
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
    return x


def least_squares(terms: list[Vector], values: Vector, weights: Vector) -> Vector | None:
    n = len(terms[0])
    normal = [[sum(w * t[i] * t[j] for t, w in zip(terms, weights)) for j in range(n)] for i in range(n)]
    return solve(normal, [sum(w * t[i] * v for t, v, w in zip(terms, values, weights)) for i in range(n)])


def squares(terms: list[Vector], values: Vector, fit: Vector) -> float:
    """Sum of the squared residuals."""
    return sum((v - sum(f * t for f, t in zip(fit, term))) ** 2 for term, v in zip(terms, values))


def quantile(values: Vector, q: float) -> float:
    ordered, at = sorted(values), q * (len(values) - 1)
    below = math.floor(at)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (at - below) * (ordered[above] - ordered[below])


def f_tail(f: float, d1: int, d2: int) -> float:
    """P(F > f) of Fisher's F with d1 and d2 degrees of freedom: the regularised incomplete beta function I_x(d2/2, d1/2)
    at x = d2 / (d2 + d1 f), by its integral over t = x s^(2/d2), which has no singularity."""
    if f <= 0.0:
        return 1.0
    a, b, x = d2 / 2.0, d1 / 2.0, d2 / (d2 + d1 * f)
    steps = 2000
    # Integral of t^(a-1) (1-t)^(b-1) over [0, x] = x^a / a * integral over s in [0, 1] of (1 - x s^(1/a))^(b-1).
    total = sum((1.0 - x * ((i + 0.5) / steps) ** (1.0 / a)) ** (b - 1.0) for i in range(steps)) / steps
    log_beta = math.lgamma(a) + math.lgamma(b) - math.lgamma(a + b)
    return min(1.0, math.exp(a * math.log(x) - math.log(a) - log_beta) * total)


def t_quantile_975(freedom: int) -> float:
    """The 97.5 % quantile of Student's t, by bisection: t^2 is distributed as F(1, freedom)."""
    low, high = 1.9, 13.0  # of infinitely many degrees of freedom, and of one
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f_tail(middle * middle, 1, freedom) > 0.05 else (low, middle)
    return 0.5 * (low + high)


def mean_interval(values: Vector) -> tuple[float, float, float]:
    """Mean and its 95 % interval by Student's t; the interval of one value is that value."""
    n, mean = len(values), math.fsum(values) / len(values)
    if n < 2:
        return mean, mean, mean
    deviation = math.sqrt(math.fsum((v - mean) ** 2 for v in values) / (n - 1))
    half = t_quantile_975(n - 1) * deviation / math.sqrt(n)
    return mean, mean - half, mean + half
