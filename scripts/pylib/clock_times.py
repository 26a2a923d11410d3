"""Times of day and dates as loggers write them, in seconds."""

import datetime
import re

import numpy as np

from csv_text import NotUnderstood

DAY, HALF_DAY, HOUR = 86400.0, 43200.0, 3600.0
MONTHS = {m: i for i, m in enumerate('jan feb mar apr may jun jul aug sep oct nov dec'.split(), 1)}
MONTHS.update({'mai': 5, 'okt': 10, 'dez': 12, 'm\u00e4r': 3})

DATE = (r'\d{4}[-/.]\d{1,2}[-/.]\d{1,2}|\d{1,2}[-/.]\d{1,2}[-/.](?:\d{4}|\d{2})'
        r'|\d{1,2}[- ][A-Za-z\u00e4]{3}[- ]\d{4}')
CLOCK = re.compile(rf'(?:({DATE})(?:T|,?[ \u00a0]+))?(\d{{1,3}}):(\d{{2}})(?::(\d{{2}}))?'
                   r'(?:([.,:])(\d{1,9}))?(?:\s*([AaPp])\.?[Mm]\.?)?'
                   r'\s*(Z|UTC|[+-]\d{2}:?\d{2})?')
ONLY_DATE = re.compile(DATE)


def is_clock(cell):
    return ':' in cell and CLOCK.fullmatch(cell.strip()) is not None


def is_date(cell):
    return ONLY_DATE.fullmatch(cell.strip()) is not None


def split_date(text):
    """(first, second, third field, kind), kind 'ymd', 'dmy' or '' where day and month may be
    either."""
    parts = re.split(r'[-/. ]', text)
    if parts[1].lower() in MONTHS:
        return int(parts[0]), MONTHS[parts[1].lower()], int(parts[2]), 'dmy'
    if not all(p.isdigit() for p in parts):
        return None
    a, b, c = map(int, parts)
    if len(parts[0]) == 4:
        return a, b, c, 'ymd'
    return a, b, c + (2000 if c < 100 else 0), 'dmy' if '.' in text else ''


def date_order(dates, absolute):
    """'dmy' or 'mdy' for those that do not tell; NotUnderstood where it matters and none does."""
    open_ones = [d for d in dates if d[3] == '']
    if any(d[0] > 12 for d in open_ones):
        return 'dmy'
    if any(d[1] > 12 for d in open_ones):
        return 'mdy'
    if len(open_ones) > 1 or (open_ones and absolute):
        a, b, c, _ = open_ones[0]
        raise NotUnderstood(0, f'got the date {a:02d}/{b:02d}/{c}: say --date-order dmy where the '
                               'day comes first, --date-order mdy where the month does')
    return 'dmy'


def day_numbers(texts, order, absolute):
    """{text: seconds from 1970 to that day}."""
    fields = {text: split_date(text) for text in texts}
    known = [f for f in fields.values() if f]
    order = order or date_order(known, absolute)
    days = {}
    for text, parts in fields.items():
        if not parts:
            continue
        a, b, c, kind = parts
        y, m, d = {'ymd': (a, b, c), 'dmy': (c, b, a), 'mdy': (c, a, b)}[kind or order]
        try:
            days[text] = (datetime.date(y, m, d).toordinal() - 719163) * DAY
        except ValueError:
            continue
    return days


def seconds_of(match):
    """Seconds after midnight, and None where the parts are beyond a clock's."""
    _, first, second, third, mark, fraction, half, zone = match.groups()
    if mark == ':' and len(fraction) != 3:
        return None
    part = int(fraction) / 10 ** len(fraction) if fraction else 0.0
    if third is None and fraction is not None:  # mm:ss.fff
        return 60 * int(first) + int(second) + part if int(second) < 60 else None
    hours, minutes, whole = int(first), int(second), int(third or 0)
    if minutes > 59 or whole > 60 or (half and not 1 <= hours <= 12):
        return None
    if half:
        hours = hours % 12 + (12 if half in 'Pp' else 0)
    shift = 0.0
    if zone and zone[0] in '+-':
        shift = int(zone[0] + '1') * (HOUR * int(zone[1:3]) + 60 * int(zone[-2:]))
    return HOUR * hours + 60 * minutes + whole + part - shift


class ClockTimes:
    """Cells of times of day, with dates or without. seconds (n), NaN where a cell is none; `dated`
    whether they count from 1970; `period` after which times without a date begin again [s]."""

    def __init__(self, cells, order=None, absolute=False):
        matches = [CLOCK.fullmatch(c.strip()) for c in cells]
        found = [m for m in matches if m]
        two_parts = next((m for m in found if m.group(4) is None and m.group(6) is None), None)
        if two_parts is not None:
            raise NotUnderstood(0, f"got '{two_parts.group(0)}': hours and minutes, or minutes and "
                                   'seconds? Export seconds with their fraction, or say --time '
                                   'none --rate HZ')
        days = day_numbers({m.group(1) for m in found if m.group(1)}, order, absolute)
        self.dated = any(m.group(1) for m in found)
        values = [seconds_of(m) if m else None for m in matches]
        if self.dated:
            values = [None if v is None or m.group(1) not in days else v + days[m.group(1)]
                      for v, m in zip(values, matches)]
        self.seconds = np.array([np.nan if v is None else v for v in values], dtype=float)
        minutes_only = bool(found) and all(m.group(4) is None for m in found)
        twelve = any(m.group(7) for m in found)
        highest = max((int(m.group(2)) for m in found), default=0)
        if self.dated:
            self.periods = ()
        elif minutes_only:
            self.periods = (HOUR,) if highest < 60 else ()
        else:
            self.periods = (DAY,) if highest > 12 or twelve else (HALF_DAY, DAY)


def from_digits(values):
    """Seconds of times written as the number hhmmss.fff, as in VBO files and in NMEA; NaN where the
    digits are none."""
    hours, rest = np.divmod(values, 10000.0)
    minutes, seconds = np.divmod(rest, 100.0)
    good = (values >= 0) & (hours < 24) & (minutes < 60) & (seconds < 60.999999)
    return np.where(good, HOUR * hours + 60 * minutes + seconds, np.nan)


def look_like_digits(values):
    """Whether the times skip 40 at each minute, as hhmmss does."""
    seconds = np.mod(values, 100.0)
    jumps = np.flatnonzero(np.diff(np.floor(values / 100.0)) > 0)
    if not len(jumps) or np.any(seconds >= 60.5) or np.any(values < 0) or np.any(values > 240000):
        return False
    steps = np.diff(values)
    return bool(np.all(steps[jumps] >= 40.0))
