"""Latin hypercubes, and ranges that span decades."""

from math import copysign, exp, log

# ranges that span more than this are drawn by their logarithm
DECADES = 100.0
# if a range begins at zero, its logarithm begins this much below the start value, or below the end if there is no start value
BELOW_START, BELOW_END = 1e-3, 1e-9
# share of draws that are zero, where a logarithm cannot begin
AT_ZERO = 0.1


def latin(count, random):
    """Dimension of a Latin hypercube: one value in each of `count` equal parts of [0, 1), in random order."""
    return (random.permutation(count) + random.random(count)) / count


def spread(u, low, high, start):
    """Value at the fraction u of a range, by logarithm if the range spans decades, and with both signs if it has both."""
    start = abs(start)
    if low < 0.0 and high > DECADES * (start or high / DECADES):
        side = 2.0 * u - 1.0
        return copysign(spread(abs(side), 0.0, high if side > 0.0 else -low, start), side)
    if low == 0.0 and high > DECADES * (start or 0.5 * high / DECADES):
        if u < AT_ZERO:
            return 0.0
        return spread((u - AT_ZERO) / (1.0 - AT_ZERO), BELOW_START * start if start else BELOW_END * high, high, start)
    if low > 0.0 and high / low > DECADES:
        return min(max(exp(log(low) + u * log(high / low)), low), high)
    return low + u * (high - low)
