"""The time column of a logger: numbers in whatever unit, clock times, counters that begin again."""

from dataclasses import dataclass, field

import numpy as np

import clock_times
import csv_dialect
import csv_numbers
import csv_table
import tool
import units
from csv_text import NotUnderstood

SHOWN = 50
FEW = 10  # rows; of fewer the step tells nothing about the unit
# What a logger of vehicles samples at [Hz]; outside a unit that was only guessed is refused.
SLOWEST, FASTEST = 0.9, 20e3
LONGEST_PAUSE = 3600.0  # [s] between two rows of one recording
# Of rows with equal stamps at least this share must remain: a counter of whole milliseconds read
# 2000 times a second keeps half, a clock of whole seconds next to nothing.
SHARE_KEPT = 0.4

NAMES = {'t', 'time', 'times', 'timestamp', 'timestamps', 'zeit', 'zeitstempel', 'uhrzeit', 'temps',
         'tiempo', 'tempo', 'elapsed', 'elapsed time', 'time stamp', 'datetime', 'date time',
         'date/time', 'log time', 'logtime', 'millis', 'micros', 'seconds', 'stamp',
         'utc time', 'utc', 'laptime', 'session time', 'zeit abs', 'zeit rel', 'x_value'}
LABELS = {1.0: 's', 1e-3: 'ms', 1e-6: 'us', 1e-9: 'ns', 60.0: 'min', 3600.0: 'h', 86400.0: 'days'}
COUNTERS = (2.0**16, 2.0**32)  # what whole-numbered counters begin again at


@dataclass
class Times:
    """seconds (n) of the rows `keep` (indices, n) of the file, and what was found on the way."""
    seconds: np.ndarray
    keep: np.ndarray
    unit: str
    dropped: int = 0
    empty: int = 0
    rollovers: list = field(default_factory=list)
    absolute: bool = True  # false where only the time of day is known


def candidates(names):
    """Places of the columns that are times by their name."""
    found = []
    for place, name in enumerate(names):
        unit = units.in_name(name)
        bare = units.without(name)
        if unit in units.TIME and bare.lower() not in NAMES:
            # time_ms, Zeit/ms, timeMs: the unit behind the word.
            cut = bare[:-len(unit)] if bare.lower().endswith(unit) else bare
            bare = cut.rstrip(' /_.')
        if bare.lower() in NAMES or (name and name.lower() in units.WHOLE):
            found.append(place)
    return found


def plausible(step):
    return 1 / FASTEST <= step <= 1 / SLOWEST


def spacing(raw):
    """The usual distance of instants that differ."""
    steps = np.diff(raw)
    steps = steps[steps > 0]
    return float(np.median(steps)) if len(steps) else 0.0


def offers(step, factors):
    return ', '.join(f'--time-scale {f:g} where they are {LABELS[f]} ({1 / (step * f):.4g} Hz)'
                     for f in factors)


def named_factor(row_unit, name):
    """(factor, where it says so) of the unit that is written, or (None, '')."""
    in_row = units.TIME.get(row_unit)
    in_name = units.TIME.get(units.in_name(name))
    if in_row and in_name and in_row != in_name:
        raise NotUnderstood(0, f"the unit is '{row_unit}' in the row of units, '"
                               f"{units.in_name(name)}' in the name: say --time-scale")
    return (in_row, 'the row of units') if in_row else (in_name, 'the name') if in_name else (None,
        '')


def factor_of(raw, row_unit, name):
    """(factor to seconds, how it is known), or NotUnderstood with the options that settle it."""
    factor, source = named_factor(row_unit, name)
    step = spacing(raw)
    if len(raw) < FEW or step == 0:
        return factor or 1.0, source
    likely = [f for f in LABELS if plausible(step * f)]
    if factor:
        if not plausible(step * factor):
            raise NotUnderstood(0, f'a step of {step:g} {LABELS[factor]} ({source}) would be '
                                   f'{1 / (step * factor):.3g} Hz: say '
                                + offers(step, dict.fromkeys([*likely, factor])))
        return factor, source
    epoch = next((f for f in (1.0, 1e-3, 1e-6, 1e-9) if 5e8 <= abs(raw[0]) * f <= 5e9), None)
    if epoch and plausible(step * epoch) and raw[0] > 1e9:
        return epoch, 'its size, a date'
    if 1 / FASTEST <= step < 1:
        return 1.0, ''
    for factor in (1e-3, 1e-6, 1e-9):
        # 5 Hz to 2 kHz. From 2 to 5 Hz the next smaller unit would fit as well, and a step of 1 is
        # as well a count of the rows.
        if step > 1 and 5e-4 <= step * factor <= 0.2:
            return factor, f'its step of {step:g}'
    raise NotUnderstood(0, f'a step of {step:g} would be {1 / step:.3g} Hz in s: say '
                        + offers(step, dict.fromkeys([*likely, 1.0]))
                        + (', --time none --rate HZ where they count the rows' if step == 1
                           else ''))


def unwrap(values, periods, step):
    """Adds the period where the values fall by about that; returns the indices where they do."""
    found = []
    falls = np.flatnonzero(np.diff(values) < 0)
    if len(falls) > 1000:
        return values, []
    values = values.copy()
    for i in falls:
        fall = values[i + 1] - values[i]
        period = next((p for p in periods if 0 < fall + p <= max(100 * step, 1e-3 * p)), None)
        if period:
            values[i + 1:] += period
            found.append(int(i) + 1)
    return values, found


def raw_seconds(table, place, cells, lines, options, problems):
    """Times (s) before they are put in order, as Times without `keep` applied."""
    name = table.label(place)
    filled = [c for c in cells[:200] if ':' in c]
    if options.time_scale is None and 2 * len(filled) > len(cells[:200]):
        clock = clock_times.ClockTimes(cells, options.date_order, options.keep_stamps)
        report_no_clock(table, name, cells, lines, clock.seconds, problems)
        words = 'as date and time' if clock.dated else 'as time of day'
        return clock.seconds, words, clock.periods, clock.dated
    raw = csv_table.numbers(cells, lines, name, table.decimal, table.path, problems)
    good = raw[np.isfinite(raw)]
    if not len(good):
        return raw, '', (), True
    digits = options.time_scale == 'hhmmss'
    if options.time_scale is None and clock_times.look_like_digits(good):
        if not table.dialect.section_file:
            raise NotUnderstood(0, f'the times skip 40 at each minute: say --time-scale hhmmss '
                                   'where they are hours, minutes and seconds in one number, '
                                   '--time-scale 1 where they are s')
        digits = True
    digits = digits or (table.dialect.section_file and options.time_scale is None
                        and name.lower() == 'time')
    if digits:
        return clock_times.from_digits(raw), 'as hhmmss', (clock_times.DAY,), False
    counters = COUNTERS if np.all(good == np.floor(good)) else ()
    if options.time_scale is not None:
        factor, source = options.time_scale, '--time-scale'
    else:
        factor, source = factor_of(good, table.row_unit(place), table.names[place])
    words = 'in ' + LABELS.get(factor, f'{factor:g} s')
    if source:
        words += f' (from {source})'
    return raw * factor, words, tuple(c * factor for c in counters), True


def report_no_clock(table, name, cells, lines, seconds, problems):
    wrong = [i for i in np.flatnonzero(np.isnan(seconds))
             if not csv_numbers.is_missing(cells[i])]
    for i in wrong[:SHOWN]:
        again = csv_dialect.clean_name(cells[i]) == name
        problems.add(f'{table.path}:{lines[i]}', f'{name}: ' + (
            'the names again: a second recording begins here, cut the file' if again
            else f"got '{cells[i].strip()[:80]}', expected a clock time"))
    if len(wrong) > SHOWN:
        problems.add(f'{table.path}:{lines[wrong[SHOWN]]}',
                     f'{name}: {len(wrong) - SHOWN} more cells are no clock time')


def in_order(table, place, cells, lines, others, options, problems):
    """Times that increase, from the cells of the time column, None with problems of it. `others`:
    whether any of the wanted columns has a value in that row (n)."""
    mine = tool.Problems()
    try:
        times = put_in_order(table, place, cells, lines, others, options, mine)
    except NotUnderstood as error:
        raise NotUnderstood(error.line, f'{table.label(place)}: {error.message}') from None
    problems.lines += mine.lines
    return None if mine else times


def put_in_order(table, place, cells, lines, others, options, problems):
    name = table.label(place)
    raw, words, periods, absolute = raw_seconds(table, place, cells, lines, options, problems)
    # A cell that is wrong is a problem already, and no reason to hide those of the others.
    others = others & np.array([csv_numbers.is_missing(c) for c in cells], bool) if problems \
        else others
    there = np.isfinite(raw)
    for i in np.flatnonzero(~there & others)[:SHOWN]:
        problems.add(f'{table.path}:{lines[i]}', f'{name}: got no time')
    keep = np.flatnonzero(there)
    seconds, rolled = unwrap(raw[keep], periods, spacing(raw[keep]))
    steps = np.diff(seconds)
    report_falls(table, name, lines, keep, seconds, options, problems)
    fresh = np.concatenate([[True], steps > 0]) if len(seconds) else np.zeros(0, bool)
    result = Times(seconds[fresh], keep[fresh], words, int((~fresh).sum()),
                   int((~there & ~others).sum()), [lines[keep[i]] for i in rolled], absolute)
    if problems:
        return result
    if len(seconds) >= FEW and len(result.seconds) < SHARE_KEPT * len(seconds):
        raise NotUnderstood(0, f'{result.dropped} of {len(seconds)} rows repeat the time '
                               'before: it is too coarse. Say --time none --rate HZ')
    pauses = np.flatnonzero(np.diff(result.seconds) > LONGEST_PAUSE)
    for i in pauses[:SHOWN]:
        problems.add(f'{table.path}:{lines[result.keep[i + 1]]}',
                     f'{name}: got {result.seconds[i + 1] - result.seconds[i]:.6g} s after line '
                     f'{lines[result.keep[i]]}, expected less than {LONGEST_PAUSE:g} s in one '
                     'recording: cut the file, or say --time-scale')
    return result


def report_falls(table, name, lines, keep, seconds, options, problems):
    falls = np.flatnonzero(np.diff(seconds) < 0)
    for i in falls[:SHOWN]:
        message = (f'{name}: got {seconds[i + 1]:.10g} after {seconds[i]:.10g} on line '
                   f'{lines[keep[i]]}, expected times that increase')
        if i > FEW and seconds[i + 1] <= seconds[0] + 10 * spacing(seconds[:i + 1]):
            message += '; a second recording begins here, cut the file'
        problems.add(f'{table.path}:{lines[keep[i + 1]]}', message)
    if len(falls) > SHOWN:
        problems.add(f'{table.path}:{lines[keep[falls[SHOWN] + 1]]}',
                     f'{name}: {len(falls) - SHOWN} more times go back (or say --time none '
                     '--rate HZ)')
