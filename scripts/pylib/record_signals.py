"""What a recorded signal shows: its swings, how they decay, their harmonics, and the spectrum of
what a model leaves of it."""

import collections
import math

import numpy as np

import series

FEWEST = 8         # half swings from which on a decay is evaluated
FADED = 3.0        # noise levels below which a swing is not evaluated
EVEN = 0.3         # of a half swing, how much the distance of extrema may vary
WINDOWS = 10       # about so many values of decay rate and frequency come from one record
HARMONIC_SWINGS = 20
SLOWEST = 2.0      # cycles of the slowest oscillation that a record is searched for

LOW_PASS = 2.5     # times its frequency: separates an oscillation from faster ones

# Extrema (times), size of each half swing (amplitude) and its time, the frequency of the largest
# line [Hz], and the noise that the low-pass leaves.
Swings = collections.namedtuple('Swings', 'extrema times sizes frequency noise')
# By window of a record: amplitude, decay rate [1/s], frequency [Hz], and what noise makes of them.
Decay = collections.namedtuple('Decay', 'amplitude rate frequency rate_sd frequency_sd')


def even(t, y):
    """(first, step, values) on even times; samples that are missing are bridged."""
    known = np.isfinite(y)
    t, y = t[known], y[known]
    if len(t) < 16:
        return None
    step = (t[-1] - t[0]) / (len(t) - 1)
    # Jitter of a sampled noise must not be smoothed; only gaps are bridged.
    if np.max(np.diff(t)) < 2 * step:
        return t[0], step, y
    step = float(np.median(np.diff(t)))
    grid = np.arange(t[0], t[-1], step)
    return t[0], step, np.interp(grid, t, y)


def main_frequency(step, values):
    """[Hz] of the largest line, or None."""
    count = len(values)
    line = values - np.polyval(np.polyfit(np.arange(count), values, 1), np.arange(count))
    power = np.abs(np.fft.rfft(line * np.hanning(count), 4 * count)) ** 2
    first = int(4 * SLOWEST)
    if len(power) <= first + 1 or not power[first:].max() > 0:
        return None
    k = first + int(np.argmax(power[first:]))
    return k / (4 * count * step)


def swings(t, y, sigma, frequency=None):
    """The half swings of the slowest strong oscillation, until they fade into the noise; None where
    there are too few."""
    sampled = even(t, y)
    if sampled is None:
        return None
    first, step, values = sampled
    frequency = frequency or main_frequency(step, values)
    if not frequency or 8 * step * frequency > 1:
        return None
    smooth = series.low_pass(values, step, LOW_PASS * frequency)
    slope = np.diff(smooth)
    turns = np.flatnonzero(slope[:-1] * slope[1:] < 0) + 1
    if len(turns) <= FEWEST:
        return None
    # The extremum of the parabola through three samples.
    left, middle, right = smooth[turns - 1], smooth[turns], smooth[turns + 1]
    bend = left - 2 * middle + right
    shift = np.where(bend != 0, 0.5 * (left - right) / np.where(bend != 0, bend, 1), 0)
    extrema = first + step * (turns + shift)
    heights = middle - 0.25 * (left - right) * shift
    sizes = np.abs(np.diff(heights)) / 2
    uneven = np.abs(np.diff(extrema) * 2 * frequency - 1) > EVEN
    bad = np.flatnonzero(uneven | (sizes < FADED * (sigma or 0)))
    # The start may be disturbed by faster modes: begin after what is uneven there.
    begin = next((k for k in range(min(4, len(sizes))) if k not in bad), None)
    if begin is None:
        return None
    end = next((k for k in bad if k > begin), len(sizes))
    if end - begin < FEWEST:
        return None
    return Swings(extrema[begin:end + 1], (extrema[begin:end] + extrema[begin + 1:end + 1]) / 2,
                  sizes[begin:end], frequency,
                  (sigma or 0) * math.sqrt(2 * LOW_PASS * frequency * step))


def decays(found):
    """Whether the swings die away throughout."""
    quarter = len(found.sizes) // 4
    order = np.argsort(np.argsort(found.sizes))
    falling = np.corrcoef(order, np.arange(len(order)))[0, 1] < -0.8
    return bool(falling and found.sizes[:quarter].mean() > 1.3 * found.sizes[-quarter:].mean())


def decay_of(found):
    """Decay rate (from the logarithms of successive half swings) and frequency by amplitude."""
    count = len(found.sizes)
    width = max(4, round(2 * count / WINDOWS))
    # Standard deviation of a line's slope through evenly spaced points with errors of 1.
    slope = math.sqrt(12 / (width * (width ** 2 - 1)))
    half = 1 / (2 * found.frequency)
    rows = []
    for begin in range(0, count - width + 1, max(1, width // 2)):
        part = slice(begin, begin + width)
        rate = -np.polyfit(found.times[part], np.log(found.sizes[part]), 1)[0]
        turns = np.polyfit(found.extrema[begin:begin + width + 1], np.arange(width + 1), 1)[0]
        size = math.exp(np.log(found.sizes[part]).mean())
        noise = found.noise / size
        # An extremum comes early or late by the slope of the noise there over its curvature.
        late = noise * LOW_PASS / math.sqrt(3) / math.pi
        rows.append((size, rate, turns / 2, slope * noise / math.sqrt(2) / half,
                     slope * late * turns / 2))
    return Decay(*np.array(rows).T) if rows else None


def loss_of(decay):
    """Part of the energy that a cycle loses: it goes with the square of the amplitude."""
    return 1 - np.exp(-2 * decay.rate / decay.frequency)


def harmonics(t, y, found, sigma):
    """([amplitude of the 2nd and of the 3rd harmonic over the first's], their noise) in the
    largest swings, or None. Decay and change of frequency within them are allowed for."""
    last = min(len(found.extrema) - 1, HARMONIC_SWINGS)
    part = (t >= found.extrema[0]) & (t <= found.extrema[last]) & np.isfinite(y)
    if part.sum() < 24 or 8 * np.median(np.diff(t)) * 3 * found.frequency > 2:
        return None
    middle = found.extrema[:last + 1].mean()
    phase = np.polyval(np.polyfit(found.extrema[:last + 1] - middle, np.pi * np.arange(last + 1), 2),
                       t[part] - middle)
    size = np.exp(np.polyval(np.polyfit(found.times[:last] - middle, np.log(found.sizes[:last]), 1),
                             t[part] - middle))
    size /= size.max()
    columns = [np.ones(part.sum()), t[part] - middle]
    for h in (1, 2, 3):
        columns += [size * np.cos(h * phase), size * np.sin(h * phase)]
    fitted = np.linalg.lstsq(np.array(columns).T, y[part], rcond=None)[0]
    amplitude = [math.hypot(*fitted[2 * h:2 * h + 2]) for h in (1, 2, 3)]
    if not amplitude[0] > 0:
        return None
    noise = (sigma or 0) * math.sqrt(2 / np.sum(size ** 2)) / amplitude[0]
    return [amplitude[1] / amplitude[0], amplitude[2] / amplitude[0]], noise


def spectrum(t, residual, sigma):
    """(frequency [Hz], power density over that of white noise of this standard deviation), or
    None: mean of overlapping parts of the record."""
    sampled = even(t, residual)
    if sampled is None or not sigma:
        return None
    _, step, values = sampled
    length = max(16, len(values) // 4)
    window = np.hanning(length)
    powers = [np.abs(np.fft.rfft(window * (values[k:k + length] - values[k:k + length].mean()))) ** 2
              for k in range(0, len(values) - length + 1, length // 2)]
    power = np.mean(powers, axis=0) / np.sum(window ** 2) / sigma ** 2
    return np.fft.rfftfreq(length, step)[1:], power[1:]
