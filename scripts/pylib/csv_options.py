"""The options of every tool that reads a logger's CSV, and the rows that they give."""

import argparse
import math
from dataclasses import dataclass

import numpy as np

import csv_dialect
import csv_table
import csv_times
import tool
from csv_text import NotUnderstood

DELIMITER_WORDS = {'comma': ',', 'semicolon': ';', 'tab': '\t', '\\t': '\t', 'space': ' ',
                   'bar': '|', 'pipe': '|'}
DECIMAL_WORDS = {'point': '.', 'dot': '.', 'comma': ','}


def delimiter(text):
    found = DELIMITER_WORDS.get(text.lower(), text)
    if found not in csv_dialect.DELIMITERS:
        raise argparse.ArgumentTypeError(f"got '{text}', expected one of , ; | tab space")
    return found


def decimal(text):
    found = DECIMAL_WORDS.get(text.lower(), text)
    if found not in csv_table.DECIMALS:
        raise argparse.ArgumentTypeError(f"got '{text}', expected . or ,")
    return found


def lines(text):
    try:
        count = int(text)
    except ValueError:
        count = -1
    if count < 0:
        raise argparse.ArgumentTypeError(f"got '{text}', expected a number of lines")
    return count


def time_scale(text):
    if text == 'hhmmss':
        return text
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value > 0):
        raise argparse.ArgumentTypeError(f"got '{text}', expected a positive number or hhmmss")
    return value


def add_arguments(parser):
    """Adds what settles a file's dialect; all of it is found in the file where it is not given."""
    group = parser.add_argument_group('the CSV, where its own form is not clear')
    group.add_argument('--time', metavar='COLUMN',
                       help='times, increasing; `none`: rows come at --rate (default: t, or the '
                            'one column that is named as a time)')
    group.add_argument('--time-scale', type=time_scale, metavar='S',
                       help='seconds in a unit of the times, as 0.001 for ms; `hhmmss`: hours, '
                            'minutes and seconds in one number')
    group.add_argument('--date-order', choices=('dmy', 'mdy'), help='of dates like 02/03/2025')
    group.add_argument('--delimiter', type=delimiter, metavar='CHAR',
                       help='between columns: , ; | tab space')
    group.add_argument('--decimal', type=decimal, metavar='CHAR', help='decimal mark: . or ,')
    group.add_argument('--encoding', metavar='NAME', help='as utf-8, latin-1, utf-16')
    group.add_argument('--skip', type=lines, metavar='N', help='lines above the line of names')


def open_table(path, options, wanted, problems):
    """The table, or None and a problem."""
    try:
        return csv_table.CsvTable(path, options.encoding, options.delimiter, options.decimal,
                                  options.skip, wanted)
    except NotUnderstood as error:
        add(problems, path, error)
    return None


def add(problems, path, error):
    problems.add(f'{path}:{error.line}' if error.line else path, error.message)


def place_of(table, name, problems, remedy=''):
    """The place of the one column of this name, or None and a problem."""
    places = table.find(name)
    where = f'{table.path}:{table.dialect.names_line or 1}'
    if len(places) > 1:
        shown = ' or '.join(f'#{p + 1}' for p in places[:5])
        problems.add(where, f'{name}: two columns have this name; say {shown}'
                     if len(places) == 2 else
                     f'{name}: {len(places)} columns have this name; say {shown}')
    elif not places:
        names = list(dict.fromkeys(n for n in table.names if n))
        hint = (tool.nearest(name, names) if names else
                f'; the file has no line of names: say #1 to #{len(table.names)}, or --skip')
        if len(names) > 20 and hint.startswith('; there is'):
            hint = tool.nearest(name, names[:20]) + f' and {len(names) - 20} more'
        problems.add(where, f'{name}: no such column{hint}{remedy}')
    return places[0] if len(places) == 1 else None


def time_place(table, options, problems):
    """The place of the time column; None where rows come at options.rate, or with a problem."""
    if options.time == 'none' and not table.find('none'):
        if options.rate is None:
            problems.add('--time none', 'expected --rate HZ as well')
        return None
    if options.time is not None:
        return place_of(table, options.time, problems,
                        '; or say --rate HZ and --time none where there is no time')
    if len(table.find('t')) == 1:
        return table.find('t')[0]
    found = csv_times.candidates(table.names)
    if len(found) == 1:
        return found[0]
    where = f'{table.path}:{table.dialect.names_line or 1}'
    if found:
        problems.add(where, 'got the time columns ' + ', '.join(
            f"'{table.label(p)}'" for p in found[:10]) + ': say --time COLUMN')
    elif options.rate is None:
        named = list(dict.fromkeys(n for n in table.names if n))
        problems.add(where, 't: no such column, and none that is named as a time'
                     + (f" among {', '.join(repr(n) for n in named[:20])}" if named else '')
                     + '; say --time COLUMN, or --rate HZ where rows come at a fixed rate')
    return None


@dataclass
class Rows:
    """times [s] (n), values {place: (n), NaN where missing}, lines (n)."""
    times: np.ndarray
    values: dict
    lines: np.ndarray
    words: list  # what was detected
    notes: list  # what was left out or mended
    numbers: dict  # the same for --json
    absolute: bool


def read_rows(table, time, places, options, problems):
    """The rows of the columns at `places`, in the order of time; None with problems."""
    wanted = [*dict.fromkeys(p for p in [time, *places] if p is not None)]
    try:
        columns, line_numbers = table.read(wanted, problems)
        columns = dict(zip(wanted, columns))
        table.settle_decimal(columns.values())
        values = {p: csv_table.numbers(columns[p], line_numbers, table.label(p), table.decimal,
                                       table.path, problems) for p in dict.fromkeys(places)}
        filled = np.zeros(len(line_numbers), bool)
        for p in values:
            filled |= np.isfinite(values[p])
        if time is None:
            # Rows of a fixed rate count also where they are empty.
            times = csv_times.Times(np.arange(len(line_numbers)) / options.rate,
                                    np.arange(len(line_numbers)), '')
        else:
            # A cell that is no number still is a value that has a time.
            reported = np.array([any(c.strip() for c in row) for row in
                                 zip(*(columns[p] for p in values))], bool) if problems else filled
            times = csv_times.in_order(table, time, columns[time], line_numbers,
                                       filled | reported, options, problems)
    except NotUnderstood as error:
        add(problems, table.path, error)
        return None
    if times is not None and not problems and len(times.seconds) < 2:
        problems.add(f'{table.path}:{line_numbers[-1] if line_numbers else 1}',
                     f'got {len(times.seconds)} rows of data, expected at least two')
    return None if problems else arrange(table, time, values, line_numbers, times, options)


def arrange(table, time, values, line_numbers, times, options):
    words = table.words()
    words.append(f"time '{table.label(time)}' {times.unit}" if time is not None
                 else f'no time: rows at {options.rate:g} Hz')
    notes = []
    if times.dropped:
        notes.append(f'{times.dropped} rows with the same time as the row before left out')
    if times.empty:
        notes.append(f'{times.empty} empty rows left out')
    if table.left_out:
        notes.append('the last row, which ends in the middle, left out')
    if table.footer:
        lines = 'a line' if table.footer == 1 else f'{table.footer} lines'
        notes.append(f'{lines} of words below the rows left out')
    if times.rollovers:
        notes.append('times begin again at line ' + ', '.join(map(str, times.rollovers[:5]))
                     + (', ...' if len(times.rollovers) > 5 else '')
                     + ': taken for midnight or the end of a counter, and continued')
    d = table.dialect
    numbers = {'delimiter': d.delimiter, 'decimal': table.decimal, 'encoding': table.encoding,
               'header_lines': max(d.data_line - 1, 0), 'names_line': d.names_line,
               'units_line': d.units_line, 'time_column': None if time is None
               else table.label(time), 'time': times.unit, 'equal_times_left_out': times.dropped,
               'empty_rows_left_out': times.empty, 'cut_rows_left_out': table.left_out,
               'lines_below_left_out': table.footer,
               'time_begins_again_at_lines': times.rollovers}
    return Rows(times.seconds, {p: v[times.keep] for p, v in values.items()},
                np.array(line_numbers)[times.keep], words, notes, numbers, times.absolute)
