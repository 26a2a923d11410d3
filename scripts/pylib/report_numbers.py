"""Numbers and units as reports write them."""

import math

NORMAL_95 = 1.959964  # half of a normal distribution's 95 % interval, in standard deviations
UNITS = {'EI': 'N m^2', 'EI1': 'N m^2', 'EI2': 'N m^2', 'GJ': 'N m^2', 'EA': 'N', 'GA': 'N',
         'eta_EI': 'N m^2 s', 'eta_EI1': 'N m^2 s', 'eta_EI2': 'N m^2 s', 'eta_GJ': 'N m^2 s',
         'eta_EA': 'N s', 'eta_GA': 'N s', 'extensions.clamp_damping.b.torsion': 'N m s/rad',
         'length': 'm', 'mass_per_length': 'kg/m'}


def number(value, sd=0.0):
    """As many digits as the standard deviation leaves meaning to."""
    if value is None:
        return '-'
    digits = 4
    if sd and value and math.isfinite(sd) and math.isfinite(value):
        digits = min(8, max(2, math.floor(math.log10(abs(value) / sd)) + 2))
    if value and not 1e-3 <= abs(value) < 1e5:
        return f'{value:.{digits - 1}e}'
    return f'{value:#.{digits}g}'.rstrip('.') if sd else f'{value:.{digits}g}'


def rounded(value, digits=3):
    """To so many significant digits: without an exponent from 1e-4 to below 1e6."""
    text = f'{value:.{digits}g}'
    if 'e+' in text and abs(float(text)) < 1e6:
        return f'{float(text):.0f}'
    return text


def percent(share):
    return f'{100 * share:.2g} %' if abs(share) < 0.1 else f'{100 * share:.0f} %'


def unit_of(name, data):
    return (data.get('units') or {}).get(name, UNITS.get(name, ''))
