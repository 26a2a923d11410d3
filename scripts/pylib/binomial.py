"""Intervals of rates that were counted."""

import math


def _tail(count, total, rate):
    """Probability of `count` or more of `total`."""
    if rate <= 0:
        return 1.0 if count == 0 else 0.0
    if rate >= 1:
        return 1.0
    logs = [math.lgamma(total + 1) - math.lgamma(k + 1) - math.lgamma(total - k + 1) +
            k * math.log(rate) + (total - k) * math.log1p(-rate) for k in range(count, total + 1)]
    return min(1.0, math.fsum(map(math.exp, logs)))


def clopper_pearson(count, total, confidence=0.95):
    """The rates at which a count as high, or as low, is as improbable as (1 - confidence)/2."""
    aside = 0.5 * (1 - confidence)

    def where(reached):
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if reached(middle) else (middle, high)
        return 0.5 * (low + high)

    low = where(lambda rate: _tail(count, total, rate) >= aside) if count > 0 else 0.0
    high = where(lambda rate: 1 - _tail(count + 1, total, rate) <= aside) if count < total else 1.0
    return low, high
