"""Two wheel tracks of a random road after ISO 8608."""

import numpy as np

REFERENCE_WAVENUMBER = 0.1  # n0 [cycles/m]
# Gd(n0) [m^3], the geometric mean of each class.
CLASSES = {'A': 16e-6, 'B': 64e-6, 'C': 256e-6, 'D': 1024e-6, 'E': 4096e-6}
LONGEST, SHORTEST = 100.0, 0.1  # wavelengths that the profile holds [m]


def coherence(wavenumber, track):
    """Share of left and right in common (squared coherence, 0 to 1). Waves much longer than the
    track lift both wheels alike, shorter ones are independent; exponential in between."""
    return np.exp(-2 * np.pi * wavenumber * track / 2)


def profile(road_class, length, step, track, seed):
    """Heights [m] of the left and the right track, each `length` [m] in steps of `step` [m].

    Displacement spectrum Gd(n) = Gd(n0) (n/n0)^-2 (ISO 8608, waviness 2), one-sided; normally
    distributed.
    """
    count = 1 << int(np.ceil(np.log2(length / step + 1)))
    n = np.fft.rfftfreq(count, step)
    inside = (n >= 1 / LONGEST) & (n <= 1 / SHORTEST)
    density = np.zeros_like(n)
    density[inside] = CLASSES[road_class] * (n[inside] / REFERENCE_WAVENUMBER) ** -2
    normal = np.random.Generator(np.random.PCG64(seed)).standard_normal((3, 2, len(n)))
    common, left, right = (a + 1j * b for a, b in normal)
    # A one-sided density G over a bin 1/(count step) is a mean square of G/(count step); irfft
    # divides by count
    # and doubles each line.
    scale = np.sqrt(density / (count * step)) * count / 2
    share = np.sqrt(coherence(n, track))
    heights = [np.fft.irfft(scale * (np.sqrt(share) * common + np.sqrt(1 - share) * own), count)
               for own in (left, right)]
    return np.array(heights)[:, :int(round(length / step)) + 1]
