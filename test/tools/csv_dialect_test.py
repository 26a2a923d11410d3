#!/usr/bin/python3
"""What scripts/pylib finds in the first lines of loggers' files, and in their cells."""

import io
import math
import os
import sys
import unittest
from types import SimpleNamespace

import numpy as np

from helpers import ROOT

sys.path.insert(0, os.path.join(ROOT, 'scripts', 'pylib'))
import clock_times  # noqa: E402
import csv_dialect  # noqa: E402
import csv_numbers  # noqa: E402
import csv_text  # noqa: E402
import csv_times  # noqa: E402
import tool  # noqa: E402
import units  # noqa: E402

ROWS = [(f'{i * 0.005:.3f}', f'{i * 0.25:.2f}', f'{-i * 0.5:.1f}') for i in range(30)]
# Dates as seconds from 1970 are doubles of 2e9 s.
EPOCH_ROUNDING = 1e-6


def text(head, delimiter=',', decimal='.', end=''):
    """Lines of a file with this head above ROWS."""
    body = ''.join(delimiter.join(c.replace('.', decimal) for c in row) + end + '\n'
                   for row in ROWS)
    return io.StringIO(head + body).readlines()


class Dialects(unittest.TestCase):
    def expect(self, lines, delimiter, names_line, data_line, units_line=0, **options):
        found = csv_dialect.detect(lines, **options)
        self.assertEqual((found.delimiter, found.names_line, found.data_line, found.units_line),
                         (delimiter, names_line, data_line, units_line))
        return found

    def refused(self, lines, expected, **options):
        with self.assertRaises(csv_text.NotUnderstood) as caught:
            csv_dialect.detect(lines, **options)
        self.assertRegex(caught.exception.message, expected)

    def test_delimiters(self):
        for delimiter, decimal in ((',', '.'), (';', '.'), (';', ','), ('\t', '.'), ('\t', ','),
                                   ('|', ','), (' ', '.'), ('   ', ',')):
            with self.subTest(delimiter=delimiter, decimal=decimal):
                found = self.expect(text(delimiter.join(['t', 'fl', 'fr']) + '\n', delimiter,
                                         decimal), delimiter[0], 1, 2)
                self.assertEqual(found.names, ['t', 'fl', 'fr'])
                self.assertEqual(csv_numbers.decide_decimal(found.decimal_evidence)[0], decimal)

    def test_header_blocks(self):
        block = '"Format","Some File",,,\n"Rate","200.0","Hz"\n\n"t","fl","fr"\n"s","mm","mm"\n\n'
        found = self.expect(text(block), ',', 4, 7, 5)
        self.assertEqual((found.names, found.units), (['t', 'fl', 'fr'], ['s', 'mm', 'mm']))
        padded = 'Format,X,\nRate,200,Hz\n,,\nt,fl,fr\ns,mm,mm\n,,\n'
        self.expect(text(padded), ',', 4, 7, 5)
        # A row that counts the columns, below the units.
        self.expect(text('A,B\n\nt,fl,fr\ns,mm,mm\n1,2,3\n\n'), ',', 3, 7, 4)
        self.expect(text('sep=;\nt;fl;fr\n', ';', ','), ';', 2, 3)
        self.expect(text('# made today\n# t fl fr\n', ' '), ' ', 2, 3)

    def test_sections(self):
        head = 'Made at 10:00\n\n[header]\ntime\nfl\n\n[column names]\nt fl fr\n\n[data]\n'
        found = self.expect(text(head, ' '), ' ', 8, 11)
        self.assertTrue(found.section_file)
        self.assertEqual(found.names, ['t', 'fl', 'fr'])

    def test_wanted_names_settle_the_line(self):
        head = 'Front,Front,Front\nt,fl,fr\nDouble,Double,Double\n'
        self.expect(text(head), ',', 2, 4, wanted=['fl'])
        self.expect(text('t,fl,fr\n'), ',', 1, 2, wanted=['nothing'])
        self.expect(text('no,names,yet\nt,fl,fr\n'), ',', 2, 3, skip=1)

    def test_trailing_delimiters_and_no_names(self):
        found = self.expect(text('t;fl;fr;\n', ';', ',', ';'), ';', 1, 2)
        self.assertEqual(found.names, ['t', 'fl', 'fr'])
        self.assertEqual(self.expect(text(''), ',', 0, 1).names, ['', '', ''])

    def test_one_column(self):
        lines = ['fl\n', *[f'1,{i}\n' for i in range(20)]]
        self.assertEqual(csv_dialect.detect(lines).names, ['fl'])
        self.assertEqual(csv_dialect.detect(['t,fl\n', *lines[1:]]).names, ['t', 'fl'])
        self.refused(lines[1:], '--delimiter')

    def test_no_table(self):
        self.refused(['t,fl\n'], '--delimiter or --skip')
        self.refused(['\n', ' \n'], 'no text')
        self.refused(['t,fl\n', '0,1,"2\n', *['0,1\n'] * 20], 'line 2 has a quote')


class Encodings(unittest.TestCase):
    def found(self, data, asked=None):
        return csv_text.find_encoding(io.BytesIO(data), asked)[0]

    def test_encodings(self):
        words = ''.join(text('t,D\u00e4mpfer VL\n'))
        for encoding, codec in (('utf-8', 'utf-8'), ('utf-8-sig', 'utf-8-sig'),
                                ('utf-16', 'utf-16'), ('utf-16-le', 'utf-16-le'),
                                ('utf-16-be', 'utf-16-be'), ('latin-1', 'cp1252')):
            with self.subTest(encoding):
                self.assertEqual(self.found(words.encode(encoding)), codec)

    def test_what_is_no_text(self):
        for data in (b'PK\x03\x04' + b'a' * 99, b'\x1f\x8b' + b'a' * 99, bytes(range(256)) * 9,
                     b'0,1\n' * 9 + b'\0' * 9 + b'0,1\n', b'1' * (csv_text.LONGEST_LINE + 2)):
            with self.assertRaises(csv_text.NotUnderstood):
                self.found(data)
        self.assertEqual(self.found(b'0,1\n' * 9 + b'\0' * 999), 'utf-8')  # power went off

    def test_a_text_of_two_encodings_is_refused(self):
        with self.assertRaises(csv_text.NotUnderstood) as caught:
            self.found('t,\u00e4\n0,1\n'.encode() + b'0,\xe4\n')
        self.assertEqual(caught.exception.line, 3)
        self.assertIn('--encoding', caught.exception.message)

    def test_unknown_names(self):
        for name in ('foo', 'hex', 'zlib'):
            with self.assertRaises(csv_text.NotUnderstood):
                self.found(b't,fl\n0,1\n', name)


class Numbers(unittest.TestCase):
    def decimal(self, *cells):
        return csv_numbers.decide_decimal(csv_numbers.evidence(cells))[0]

    def test_decimal_mark(self):
        self.assertEqual(self.decimal('1,5', '2'), ',')
        self.assertEqual(self.decimal('0,005', '1,234'), ',')
        self.assertEqual(self.decimal('1.234,5'), ',')
        self.assertEqual(self.decimal('1,234.5'), '.')
        self.assertEqual(self.decimal('1,234,567'), '.')
        self.assertEqual(self.decimal('1', '2'), '.')
        self.assertIsNone(self.decimal('1,234'))
        self.assertIsNone(self.decimal('0.5', '0,5'))
        self.assertIn("1.234, --decimal . where it is 1234", csv_numbers.decide_decimal(
            csv_numbers.evidence(['1,234']))[1])

    def test_values(self):
        cases = {('1234.5', '.'): 1234.5, ('1,234.5', '.'): 1234.5, ('1.234,5', ','): 1234.5,
                 ('1\u00a0234,5', ','): 1234.5, ('1\u2009234.5', '.'): 1234.5, ("1'234", '.'): 1234,
                 ('\u22121,5', ','): -1.5, ('+.5e-1', '.'): 0.05, (' 7 ', '.'): 7}
        for (cell, decimal), value in cases.items():
            self.assertEqual(csv_numbers.plain_float(cell, decimal), value, cell)
        for cell, decimal in (('1.5', ','), ('1,5', '.'), ('1_0', '.'), ('0,500', '.'), ('x', '.'),
                              ('1 23', '.'), ('inf', '.')):
            self.assertIsNone(csv_numbers.plain_float(cell, decimal), cell)

    def test_columns(self):
        values, wrong = csv_numbers.to_numbers(['1,5', '', 'NaN', '1_0', '2', '1e999'], ',')
        np.testing.assert_array_equal(values[:3], [1.5, math.nan, math.nan])
        self.assertEqual((values[4], list(wrong)), (2, [3, 5]))
        self.assertEqual(list(csv_numbers.to_numbers(['1', 'inf'], '.')[1]), [1])


class Units(unittest.TestCase):
    def test_in_names(self):
        for name, unit in (('Zeit [ms]', 'ms'), ('Time (s)', 's'), ('t_us', 'us'),
                           ('millis', 'millis'), ('Zeit / ms', 'ms'), ('fork_mm', 'mm'),
                           ('timeMs', 'ms'), ('fork', ''),
                           ('time_min', ''), ('front_m', ''), ('FL/FR', '')):
            self.assertEqual(units.in_name(name), unit, name)

    def test_scales(self):
        self.assertEqual(units.proposed_scale('mm', False), 1e-3)
        self.assertIsNone(units.proposed_scale('m', False))
        self.assertIsNone(units.proposed_scale('mm', True))
        self.assertAlmostEqual(units.proposed_scale('deg', True), math.pi / 180, places=15)


class ClockTimes(unittest.TestCase):
    def seconds(self, *cells, **options):
        return list(clock_times.ClockTimes(cells, **options).seconds)

    def test_forms(self):
        for cell, seconds in (('01:02:03', 3723), ('1:02:03.250', 3723.25), ('01:02:03,5', 3723.5),
                              ('01:02:03:250', 3723.25), ('02:03.25', 123.25),
                              ('12:00:01 AM', 1), ('1:00:00 pm', 46800)):
            self.assertEqual(self.seconds(cell), [seconds], cell)
        # 2025-01-01 is 20089 days after 1970-01-01.
        for cell in ('2025-01-01 00:00:01.5', '2025-01-01T00:00:01.5Z', '01.01.2025 00:00:01,5',
                     '2025/1/1 00:00:01.5', '2025-01-01T02:00:01.5+02:00',
                     '01-Jan-2025 00:00:01.5'):
            self.assertAlmostEqual(self.seconds(cell)[0], 20089 * 86400 + 1.5, delta=EPOCH_ROUNDING)

    def test_what_is_none(self):
        self.assertTrue(all(map(math.isnan, self.seconds('25:61:00', '1:2:3', '30.02.2025 01:00:00',
                                                         'x'))))
        with self.assertRaises(csv_text.NotUnderstood):
            self.seconds('10:05')

    def test_day_or_month_first(self):
        pair = ('01/02/2025 23:59:59.5', '02/02/2025 00:00:00.5')
        with self.assertRaises(csv_text.NotUnderstood) as caught:
            self.seconds(*pair)
        self.assertIn('--date-order', caught.exception.message)
        a, b = self.seconds(*pair, order='dmy')
        self.assertAlmostEqual(b - a, 1, delta=EPOCH_ROUNDING)
        a, b = self.seconds('12/31/2024 23:59:59.5', '01/01/2025 00:00:00.5')
        self.assertAlmostEqual(b - a, 1, delta=EPOCH_ROUNDING)
        self.seconds('01/02/2025 10:00:00', '01/02/2025 10:00:01')  # one day: no matter which
        with self.assertRaises(csv_text.NotUnderstood):
            self.seconds('01/02/2025 10:00:00', '01/02/2025 10:00:01', absolute=True)

    def test_digits(self):
        np.testing.assert_allclose(clock_times.from_digits(np.array([101059.5, 101100.0])),
                                   [36659.5, 36660.0])
        self.assertTrue(clock_times.look_like_digits(np.array([101059.5, 101100.0, 101100.5])))
        self.assertFalse(clock_times.look_like_digits(np.arange(0, 300, 0.5)))


class TimeUnits(unittest.TestCase):
    def factor(self, step, start=0.0, row_unit='', name='t', count=50):
        return csv_times.factor_of(start + step * np.arange(count), row_unit, name)[0]

    def test_recognised(self):
        self.assertEqual(self.factor(0.005), 1)
        self.assertEqual(self.factor(5), 1e-3)
        self.assertEqual(self.factor(5000), 1e-6)
        self.assertEqual(self.factor(5e6), 1e-9)
        self.assertEqual(self.factor(1, 1.7e12), 1e-3)
        self.assertEqual(self.factor(0.01, 1.7e9), 1)
        self.assertEqual(self.factor(1, name='time_ms'), 1e-3)
        self.assertEqual(self.factor(1, row_unit='ms'), 1e-3)
        self.assertEqual(self.factor(1, count=3), 1)  # three rows tell nothing

    def test_refused_with_the_options(self):
        for arguments in ({'step': 1}, {'step': 300}, {'step': 6e-8}, {'step': 5, 'row_unit': 's'},
                          {'step': 0.005, 'name': 'time_ms'},
                          {'step': 5, 'row_unit': 's', 'name': 'time_ms'}):
            with self.subTest(arguments), self.assertRaises(csv_text.NotUnderstood) as caught:
                self.factor(**arguments)
            self.assertIn('--time-scale', caught.exception.message)

    def test_time_columns(self):
        names = ['Zeit [ms]', 'time_ms', 'timeMs', 'millis', 'Time', 'fork', 'lifetime', 'times_fl']
        self.assertEqual(csv_times.candidates(names), [0, 1, 2, 3, 4])


class TimesInOrder(unittest.TestCase):
    def order(self, values, **options):
        problems = tool.Problems()
        table = SimpleNamespace(
            path='x.csv', decimal='.', names=['t'], label=lambda place: 't',
            row_unit=lambda place: '', dialect=SimpleNamespace(section_file=False))
        settings = SimpleNamespace(**{'time_scale': None, 'date_order': None, 'keep_stamps': False,
                                      **options})
        cells = [str(v) for v in values]
        times = csv_times.in_order(table, 0, cells, list(range(2, 2 + len(cells))),
                                   np.ones(len(cells), bool), settings, problems)
        return times, problems.lines

    def test_equal_times_are_counted(self):
        times, lines = self.order([0, 0.1, 0.1, 0.2])
        self.assertEqual((lines, times.dropped, list(times.keep)), ([], 1, [0, 1, 3]))
        with self.assertRaises(csv_text.NotUnderstood) as caught:
            self.order([i // 50 / 2 for i in range(500)])
        self.assertIn('--time none --rate HZ', caught.exception.message)

    def test_midnight_and_counters(self):
        clock = ['23:59:59.0', '23:59:59.5', '00:00:00.0', '00:00:00.5']
        times, lines = self.order(clock)
        self.assertEqual((lines, times.rollovers), ([], [4]))
        np.testing.assert_allclose(np.diff(times.seconds), 0.5)
        counter = [(2**32 - 50000 + 5000 * i) % 2**32 for i in range(20)]
        times, lines = self.order(counter)
        np.testing.assert_allclose(np.diff(times.seconds), 0.005, rtol=1e-6)

    def test_times_that_go_back(self):
        ride = [i * 0.01 for i in range(50)]
        lines = self.order(ride + ride)[1]
        self.assertEqual(len(lines), 1)
        self.assertRegex(lines[0], r'^x.csv:52: t: got 0 after 0.49 on line 51.*second recording')
        self.assertRegex(self.order(['10:00:01.0', '10:00:00.5'])[1][0], 'times that increase')

    def test_jumps(self):
        lines = self.order([*np.arange(20) * 0.01, 1e6])[1]
        self.assertRegex(lines[0], '^x.csv:22: t: got 1e\\+06 s after line 21')


if __name__ == '__main__':
    unittest.main()
