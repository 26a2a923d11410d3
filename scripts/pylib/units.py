"""Units that loggers write: in a row of their own, or in the name of a column."""

import re

TIME = {}
for factor, words in ((1.0, 's sec secs second seconds sek sekunde sekunden seconde secondes'),
                      (1e-3, 'ms msec msecs milli millis millisecond milliseconds millisekunden '
                             'millisecondes'),
                      (1e-6, 'us \u00b5s \u03bcs usec usecs micro micros microsecond microseconds '
                             'mikrosekunden microsecondes'),
                      (1e-9, 'ns nsec nsecs nano nanos nanosecond nanoseconds nanosekunden'),
                      (60.0, 'min mins minute minutes minuten'),
                      (3600.0, 'h hr hrs hour hours stunden heures'), (86400.0, 'd day days tage')):
    TIME.update(dict.fromkeys(words.split(), factor))
LENGTH = {'m': 1.0, 'meter': 1.0, 'metre': 1.0, 'meters': 1.0, 'metres': 1.0, 'mm': 1e-3,
          'millimeter': 1e-3, 'millimetre': 1e-3, 'cm': 1e-2, 'dm': 0.1, 'um': 1e-6,
          '\u00b5m': 1e-6, '\u03bcm': 1e-6, 'in': 0.0254, 'inch': 0.0254, 'inches': 0.0254,
          '"': 0.0254, 'ft': 0.3048}
ANGLE = {'rad': 1.0, 'mrad': 1e-3, 'deg': 0.017453292519943295, 'degree': 0.017453292519943295,
         'degrees': 0.017453292519943295, '\u00b0': 0.017453292519943295,
         'grad': 0.017453292519943295}  # German for degree
OTHER = {'v', 'mv', 'volt', 'volts', '%', 'pct', 'percent', 'a', 'ma', 'bit', 'bits', 'count',
         'counts', 'n', 'kn', 'nm', 'bar', 'psi', 'g', 'hz', '1/min', 'rpm', 'km/h', 'kmh', 'm/s',
         'm/s2', 'm/s\u00b2', 'm/s^2', 'deg/s', 'rad/s', '\u00b0c', 'c', 'mph', 'kpa', 'pa', '-',
         '1', 'none', 'no unit', '\u00b0/s', 'mm/s', 'kg', 'l', 'date', 'time', 'km', 'hh:mm:ss'}
# A signal, not a motion yet: without a scale it is nothing.
SENSOR = {'v', 'mv', 'volt', 'volts', '%', 'pct', 'percent', 'a', 'ma', 'bit', 'bits', 'count',
          'counts'}
KNOWN = set(TIME) | set(LENGTH) | set(ANGLE) | OTHER

BRACKETS = re.compile(r'[\[({<]\s*([^\[\](){}<>]*?)\s*[\])}>]\s*$')
SLASH = re.compile(r'\S\s*/\s*([^\s/]+)\s*$')
SUFFIX = re.compile(r'[_ .]([^\W_]+)$')
CAMEL = re.compile(r'[a-z](Ms|Us|Ns|Sec|Millis|Micros|Nanos)$')
# As the last word of a name the others mean something else as often: time_min, fork_m, travel_in.
SUFFIXES = {'s', 'sec', 'secs', 'seconds', 'ms', 'msec', 'millis', 'milliseconds', 'us', 'usec',
            '\u00b5s', '\u03bcs', 'micros', 'microseconds', 'ns', 'nsec', 'nanos', 'nanoseconds',
            'mm', 'cm', 'deg', 'rad'}
WHOLE = {'millis', 'milliseconds', 'ms', 'msec', 'micros', 'microseconds', 'us', 'usec', 'nanos',
         'nanoseconds', 'ns', 'seconds', 'sec', 's', 'secs'}


def clean(unit):
    """A unit as the tables above spell it."""
    return unit.strip().strip('[](){}<>').strip().lower()


def in_name(name):
    """The unit that a column's name ends with, or ''."""
    bracket = BRACKETS.search(name)
    if bracket:
        return clean(bracket.group(1))
    slash = SLASH.search(name)
    if slash and clean(slash.group(1)) in KNOWN:
        return clean(slash.group(1))
    suffix, camel = SUFFIX.search(name), CAMEL.search(name)
    word = suffix.group(1).lower() if suffix else camel.group(1).lower() if camel else ''
    if word in SUFFIXES:
        return word
    return name.strip().lower() if name.strip().lower() in WHOLE else ''


def without(name):
    """The name without its unit in brackets."""
    return BRACKETS.sub('', name).strip()


def proposed_scale(unit, revolute):
    """Factor from `unit` to what a joint is given in (m, or rad where it turns); None where the
    unit is none of length or angle, or is already the joint's own."""
    factor = (ANGLE if revolute else LENGTH).get(unit)
    return None if factor in (None, 1.0) else factor


def is_unit_row(cells):
    """Whether these cells are units: most that are not empty, and one at least."""
    words = [clean(c) for c in cells if c.strip()]
    return bool(words) and 2 * sum(w in KNOWN for w in words) > len(words)
