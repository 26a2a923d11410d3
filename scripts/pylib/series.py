"""Sampled signals: where they have gaps, and smoothing that shifts nothing in time."""

import numpy as np


def segments(times, longest_gap):
    """Slices of `times` (increasing) between the gaps longer than `longest_gap`."""
    breaks = np.flatnonzero(np.diff(times) > longest_gap) + 1
    edges = [0, *breaks.tolist(), len(times)]
    return [slice(a, b) for a, b in zip(edges, edges[1:]) if b > a]


def low_pass(values, step, cutoff):
    """`values`, `step` [s] apart, without what is faster than `cutoff` [Hz].

    Magnitude of a fourth-order Butterworth (-3 dB at the cutoff), zero phase. The ends are
    continued point-symmetrically, so that a constant slope passes unchanged.
    """
    count = len(values)
    if count < 3:
        return values.copy()
    # Farther than this the filter's answer to a step has died away.
    margin = min(count - 1, int(np.ceil(3 / cutoff / step)))
    padded = np.pad(values, margin, mode='reflect', reflect_type='odd')
    line = np.linspace(padded[0], padded[-1], len(padded))  # the rest is periodic without a jump
    frequency = np.fft.rfftfreq(len(padded), step)
    spectrum = np.fft.rfft(padded - line) / np.sqrt(1 + (frequency / cutoff) ** 8)
    return (np.fft.irfft(spectrum, len(padded)) + line)[margin:margin + count]


def sample(values, first, step, times):
    """Values at `times` from those at first, first + step, ...: a cubic through the four
    nearest."""
    count = len(values)
    if count < 4:
        return np.interp(times, first + step * np.arange(count), values)
    position = (np.asarray(times) - first) / step
    i = np.clip(np.floor(position).astype(int), 1, count - 3)
    u = position - i
    return (-u * (u - 1) * (u - 2) / 6 * values[i - 1] + (u + 1) * (u - 1) * (u - 2) / 2 * values[i]
            - (u + 1) * u * (u - 2) / 2 * values[i + 1] + (u + 1) * u * (u - 1) / 6 * values[i + 2])
