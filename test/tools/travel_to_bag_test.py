#!/usr/bin/python3
"""travel_to_bag on small recordings made here, and on real ones where there are any: in the folder
that COSSERAT_CABLE_RIDES names, or in shared/data/suspension_travel beside the package."""

import glob
import json
import math
import os
import tempfile
import unittest

import numpy as np

from helpers import ROOT, read_joints, run

RIDES = os.environ.get('COSSERAT_CABLE_RIDES', os.path.join(os.path.dirname(ROOT), 'shared', 'data',
                                                            'suspension_travel'))

# Positions pass as doubles through scale and offset: nothing but rounding is lost.
EXACT = 1e-12
# Stamps are doubles of about 1000 s in the reader, to the nanosecond in the bag.
STAMP = 1e-6


class TravelToBag(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.csv = os.path.join(self.folder.name, 'ride.csv')
        self.bag = os.path.join(self.folder.name, 'ride.bag')
        self.addCleanup(self.folder.cleanup)

    def write(self, *lines):
        with open(self.csv, 'w', encoding='utf-8') as out:
            out.write('\n'.join(lines) + '\n')

    def write_sine(self, hertz, amplitude, rate=500, seconds=4.0, skip=lambda t: False,
                   cell=lambda t, v: f'{v:.9f}'):
        times = [i / rate for i in range(int(seconds * rate) + 1)]
        rows = [f'{t:.4f},{cell(t, amplitude * math.sin(2 * math.pi * hertz * t))}' for t in times
                if not skip(t)]
        self.write('t,fork', *rows)

    def convert(self, *arguments):
        return run('travel_to_bag', self.csv, '-o', self.bag, *arguments)

    def refused(self, *arguments):
        """stderr of a run that must fail with 2 and leave nothing behind."""
        code, _, errors = self.convert(*arguments)
        self.assertEqual(code, 2, errors)
        self.assertEqual(sorted(os.listdir(self.folder.name)),
                         ['ride.csv'] if os.path.exists(self.csv) else [])
        self.assertNotIn('Traceback', errors)
        return errors

    def test_scale_and_offset(self):
        self.write('t,fork,shock', '5.0,0.00,10', '5.1,0.02,20', '5.2,0.10,30')
        code, out, errors = self.convert('--column', 'fl,fr=fork:0.5:-0.01', '--column', 'rl=shock',
                                         '--scale', '-0.001', '--cutoff', 'none')
        self.assertEqual(code, 0, errors)
        joints = read_joints(self.bag)
        for name in ('fl_travel', 'fr_travel'):
            np.testing.assert_allclose(joints[name][1], [-0.01, 0.0, 0.04], atol=EXACT)
        np.testing.assert_allclose(joints['rl_travel'][1], [-0.01, -0.02, -0.03], atol=EXACT)
        np.testing.assert_allclose(joints['fl_travel'][0], [1000.0, 1000.1, 1000.2], atol=STAMP)
        np.testing.assert_array_equal(joints['rr_travel'][1], [0, 0, 0])
        self.assertRegex(out, 'held at zero: .*rr_travel')

    def test_keeps_the_recordings_stamps(self):
        self.write('t,fork', '1700000000.0,0.0', '1700000000.5,0.01')
        code, _, errors = self.convert('--column', 'fl=fork', '--cutoff', 'none', '--keep-stamps',
                                       '--only-columns')
        self.assertEqual(code, 0, errors)
        joints = read_joints(self.bag)
        self.assertEqual(list(joints), ['fl_travel'])
        np.testing.assert_allclose(joints['fl_travel'][0], [1700000000.0, 1700000000.5], atol=STAMP)

    def test_low_pass_keeps_the_ride_and_drops_the_steps(self):
        # 5 Hz of 20 mm, rounded to steps of 0.2 mm, whose raw accelerations are 50 m/s^2 and more.
        self.write_sine(5, 0.020, cell=lambda t, v: f'{round(v / 2e-4) * 2e-4:.6f}')
        code, _, errors = self.convert('--column', 'fl=fork', '--cutoff', '40')
        self.assertEqual(code, 0, errors)
        times, smooth = read_joints(self.bag)['fl_travel']
        inner = slice(100, -100)
        truth = 0.020 * np.sin(2 * np.pi * 5 * (times - 1000))
        # Half a step: the smoothing adds no delay and no loss that could be told from the encoder's
        # own error.
        self.assertLess(np.abs(smooth - truth)[inner].max(), 1e-4)
        acceleration = np.diff(smooth, 2)[inner] * 500 ** 2
        true_acceleration = np.diff(truth, 2)[inner] * 500 ** 2
        # White rounding noise through 40 Hz has 0.7 m/s^2 rms; five times that is its largest.
        self.assertLess(np.abs(acceleration - true_acceleration).max(), 5 * 0.7)

    def test_low_pass_takes_out_what_is_faster(self):
        self.write_sine(120, 0.010)
        code, _, errors = self.convert('--column', 'fl=fork', '--cutoff', '40')
        self.assertEqual(code, 0, errors)
        _, smooth = read_joints(self.bag)['fl_travel']
        # Fourth order at three times the cutoff: 1/81.
        self.assertLess(np.abs(smooth[200:-200]).max(), 0.010 / 81 * 1.05)

    def test_rate(self):
        self.write_sine(5, 0.020)
        code, _, errors = self.convert('--column', 'fl=fork', '--cutoff', 'none', '--rate', '190')
        self.assertEqual(code, 0, errors)
        times, values = read_joints(self.bag)['fl_travel']
        np.testing.assert_allclose(np.diff(times), 1 / 190, atol=STAMP)
        # A cubic through samples 2 ms apart misses a 5 Hz sine by (w h)^4/40: 4e-7 of its
        # amplitude.
        np.testing.assert_allclose(values, 0.020 * np.sin(2 * np.pi * 5 * (times - 1000)),
                                   atol=1e-7)

    def test_short_gaps_are_interpolated_and_counted(self):
        summary = os.path.join(self.folder.name, 'summary.json')
        self.write_sine(1, 0.020, skip=lambda t: 1.0 < t < 1.1, cell=lambda t,
                        v: ' NaN' if 2.0 < t < 2.05 else f'{v:.9f}')
        code, out, errors = self.convert('--column', 'fl=fork', '--json', summary)
        self.assertEqual(code, 0, errors)
        self.assertIn('2 gaps of up to 0.25 s interpolated (0.150 s together)', out)
        with open(summary, encoding='utf-8') as source:
            fl = json.load(source)['joints']['fl_travel']
        self.assertEqual((fl['interpolated_gaps'], fl['missing_cells'], fl['open_gaps']),
                         (2, 24, []))
        times, _ = read_joints(self.bag)['fl_travel']
        np.testing.assert_allclose(np.diff(times), 0.002, atol=STAMP)

    def test_long_gaps_stay_open_for_that_joint_alone(self):
        rows = [f'{i / 100:.2f},{"" if 100 < i < 150 else 0.01},0.02' for i in range(301)]
        self.write('t,fork,shock', *rows)
        code, out, errors = self.convert('--column', 'fl=fork', '--column', 'rl=shock')
        self.assertEqual(code, 0, errors)
        self.assertIn('1 longer gaps left open: 1..1.5 s', out)
        joints = read_joints(self.bag)
        fl = joints['fl_travel'][0] - 1000
        self.assertFalse(np.any((fl > 1.0 + 1e-3) & (fl < 1.5 - 1e-3)))
        self.assertAlmostEqual(np.diff(fl).max(), 0.5, places=5)
        self.assertEqual(len(joints['rl_travel'][0]), 301)
        # Both sides of the gap are smoothed on their own: a constant stays one.
        np.testing.assert_allclose(joints['fl_travel'][1], 0.01, atol=EXACT)

    def test_time_jump_leaves_a_gap_in_all_joints(self):
        self.write('t,fork', *[f'{t:.2f},0.01' for t in [*np.arange(0, 1.005, 0.01), *np.arange(3,
            4.005, 0.01)]])
        code, _, errors = self.convert('--column', 'fl=fork', '--only-columns')
        self.assertEqual(code, 0, errors)
        self.assertAlmostEqual(np.diff(read_joints(self.bag)['fl_travel'][0]).max(), 2.0, places=5)

    def test_all_bad_rows_are_named(self):
        self.write('t,fork', '0.0,0.01', '0.1,abc', '0.1,0.01', '0.05,0.01', '0.3', ',0.01',
                   '0.5,inf', '0.6,0.01')
        errors = self.refused('--column', 'fl=fork')
        self.assertIn(f"{self.csv}:3: fork: got 'abc', expected a number", errors)
        self.assertIn(f'{self.csv}:5: t: got 0.05 after 0.1 on line 4, expected times that '
                      'increase', errors)
        self.assertIn(f'{self.csv}:6: got 1 cells, expected 2', errors)
        self.assertIn(f'{self.csv}:7: t: got no time', errors)
        self.assertIn(f"{self.csv}:8: fork: got 'inf'", errors)
        self.assertIn('5 problems found', errors)

    def test_nearest_column_and_joint_are_suggested(self):
        self.write('when,fork_travel', '0,0', '1,0')
        errors = self.refused('--column', 'fl=fork_travl', '--column', 'rl_travle=fork_travel',
                              '--column', 'rubbish')
        self.assertIn("fork_travl: no such column; did you mean 'fork_travel'?", errors)
        self.assertIn("no movable joint 'rl_travle'", errors)
        self.assertIn("did you mean 'rl_travel'?", errors)
        self.assertIn("t: no such column", errors)
        self.assertIn('--column rubbish: expected JOINTS=COLUMN', errors)

    def test_beyond_the_travel_a_fitting_scale_is_named(self):
        self.write('t,fork', *[f'{i / 100},{0.2 * i / 100:.4f}' for i in range(101)])
        errors = self.refused('--column', 'fl=fork')
        self.assertIn(f'{self.csv}:102: fork: fl_travel would be 0.2, '
                      'the vehicle has -0.12 to 0.12', errors)
        self.assertIn('a scale of 0.6 would fit', errors)
        self.assertEqual(self.convert('--column', 'fl=fork:0.6')[0], 0)
        code, out, _ = self.convert('--column', 'fl=fork', '--clip')
        self.assertEqual(code, 0)
        self.assertIn('40 rows cut at the limits', out)

    def test_inverted_column_gets_an_inverted_scale(self):
        self.write('t,fork', *[f'{i / 100},{0.2 * i / 100:.4f}' for i in range(101)])
        self.assertIn('a scale of -0.6 would fit', self.refused('--column', 'fl=fork:-1'))

    def test_bad_options(self):
        self.write('t,fork', '0,0', '0.1,0', '0.2,0')
        self.assertIn('--cutoff: got 40, expected less than 5', self.refused('--column', 'fl=fork',
                                                                         '--cutoff', '40'))
        self.assertIn('--max-gap: got -1.0', self.refused('--column', 'fl=fork', '--max-gap', '-1'))
        self.assertIn("scale: got 'x'", self.refused('--column', 'fl=fork:x'))

    def test_a_file_that_cannot_be_read_or_written_is_code_4(self):
        self.assertEqual(self.convert('--column', 'fl=fork')[0], 4)
        self.write('t,fork', '0,0', '1,0')
        self.bag = os.path.join(self.folder.name, 'missing', 'ride.bag')
        self.assertEqual(self.convert('--column', 'fl=fork', '--cutoff', 'none')[0], 4)

    def test_an_older_bag_survives_a_bad_input(self):
        self.write('t,fork', '0,0', '1,0')
        self.assertEqual(self.convert('--column', 'fl=fork', '--cutoff', 'none')[0], 0)
        size = os.path.getsize(self.bag)
        self.write('t,fork', '0,0', '1,x')
        self.assertEqual(self.convert('--column', 'fl=fork', '--cutoff', 'none')[0], 2)
        self.assertEqual(os.path.getsize(self.bag), size)

    def export(self, cells, head, separator=',', encoding='utf-8', end='\n'):
        """A file as a logger writes it: 200 rows at 200 Hz, 10 mm sin(6 t)."""
        rows = [(i * 0.005, 10 * math.sin(0.03 * i)) for i in range(200)]
        with open(self.csv, 'w', encoding=encoding, newline='') as out:
            out.write(head + ''.join(separator.join(cells(*row)) + end for row in rows))

    def expect_the_ride(self, *arguments, said=''):
        code, out, errors = self.convert('--cutoff', 'none', *arguments)
        self.assertEqual(code, 0, errors)
        self.assertIn(said, out)
        times, values = read_joints(self.bag)['fl_travel']
        np.testing.assert_allclose(times, 1000 + 0.005 * np.arange(200), atol=STAMP)
        # Two decimals of a mm.
        np.testing.assert_allclose(values, 0.010 * np.sin(0.03 * np.arange(200)), atol=6e-6)

    def test_exports_of_loggers(self):
        def point(t, v):
            return f'{t:.3f}', f'{v:.2f}'

        def milliseconds(t, v):
            return f'{1000 * t:.0f}', f'{v:.2f}'

        def quoted(t, v):
            return f'"{t:.3f}"', f'"{v:.2f}"'

        def german(t, v):
            return f'{1000 * t:.0f}', f'{v:.2f}'.replace('.', ',')

        def clock(t, v):
            return f'2025-01-01 10:00:{10 + t:06.3f}', f'{v:.2f}'

        fl = ('--column', 'fl=fl:0.001')
        self.export(quoted, '"Format","File",\r\n"Rate","200","Hz"\r\n\r\n"Time","FL"\r\n'
                    '"s","mm"\r\n\r\n', end='\r\n')
        self.expect_the_ride('--column', 'fl=FL:0.001', said='names on line 4, units on line 5')
        self.export(german, 'Zeit [ms];D\u00e4mpfer\r\n', ';', 'latin-1', '\r\n')
        self.expect_the_ride('--column', 'fl=D\u00e4mpfer:0.001',
                             said='semicolon separated, decimal comma, Latin-1')
        self.export(point, 't\tfl\n', '\t', 'utf-16')
        self.expect_the_ride(*fl, said='tab separated, decimal point, UTF-16')
        self.export(milliseconds, 'time_ms,fl\n')
        self.expect_the_ride(*fl, said="time 'time_ms' in ms (from the name)")
        self.export(milliseconds, 't,fl\n')
        self.expect_the_ride(*fl, said='in ms (from its step of 5)')
        self.export(clock, 'time,fl\n')
        self.expect_the_ride(*fl, said='as date and time')
        self.export(lambda t, v: (f'{v:.2f}',), 'fl\n')
        self.assertIn('--rate HZ', self.refused_again(*fl))
        self.expect_the_ride(*fl, '--rate', '200', said='no time: rows at 200 Hz')
        self.export(lambda t, v: (f'{200 * t:.0f}', f'{v:.2f}'), 't,fl\n')
        self.assertIn('--time none --rate HZ', self.refused_again(*fl))
        self.expect_the_ride(*fl, '--time', 'none', '--rate', '200')
        self.expect_the_ride(*fl, '--time-scale', '0.005')

    def refused_again(self, *arguments):
        code, _, errors = self.convert(*arguments)
        self.assertEqual(code, 2, errors)
        return errors

    def test_equal_times_are_left_out_and_counted(self):
        summary = os.path.join(self.folder.name, 'summary.json')
        self.write('t,fork', *[f'{i // 3 * 2 / 100:.2f},0.01' if i % 3 < 2 else
                               f'{i // 3 * 2 / 100 + 0.01:.2f},0.01' for i in range(30)])
        code, out, errors = self.convert('--column', 'fl=fork', '--json', summary)
        self.assertEqual(code, 0, errors)
        self.assertIn('10 rows with the same time', out)
        with open(summary, encoding='utf-8') as source:
            self.assertEqual(json.load(source)['csv']['equal_times_left_out'], 10)

    def test_words_below_the_rows_are_left_out_and_counted(self):
        rows = [f'{i / 100:.2f},0.01,0.02' for i in range(30)]
        self.write('t,fork,rear', *rows, '', 'End of file')
        code, out, errors = self.convert('--column', 'fl=fork')
        self.assertEqual(code, 0, errors)
        self.assertIn('a line of words below the rows left out', out)
        # In the middle, or numbers: something else is wrong.
        self.write('t,fork,rear', *rows, 'pause', *rows[-1:])
        self.assertIn('got 1 cells, expected 3', self.refused_again('--column', 'fl=fork'))
        self.write('t,fork,rear', *rows, '0.30,0.01', '')
        self.assertIn('got 2 cells, expected 3', self.refused_again('--column', 'fl=fork'))

    def test_default_cutoff_fits_the_rate(self):
        for step, said in ((0.02, 'low-pass 20 Hz'), (0.002, 'low-pass 40 Hz')):
            self.write('t,fork', *[f'{i * step:.3f},0.01' for i in range(50)])
            code, out, errors = self.convert('--column', 'fl=fork')
            self.assertEqual(code, 0, errors)
            self.assertIn(said, out)

    def test_units_need_a_scale(self):
        self.write('t,fork', 's,mm', *[f'{i / 100},0.01' for i in range(50)])
        self.assertIn("'fork' is in mm, fl_travel in m: say fork:0.001",
                      self.refused('--column', 'fl=fork'))
        self.assertEqual(self.convert('--column', 'fl=fork:1')[0], 0)

    def test_names_with_colons_and_twins(self):
        self.write('t,Susp:FL,x,x', *[f'{i / 100},0.01,0.02,0.03' for i in range(50)])
        errors = self.refused('--column', 'fl=x')
        self.assertIn('two columns have this name; say #3 or #4', errors)
        code, _, errors = self.convert('--column', 'fl=Susp:FL:0.5', '--column', 'fr=#4')
        self.assertEqual(code, 0, errors)
        joints = read_joints(self.bag)
        np.testing.assert_allclose(joints['fl_travel'][1], 0.005, atol=EXACT)
        np.testing.assert_allclose(joints['fr_travel'][1], 0.03, atol=EXACT)

    def test_what_is_no_table(self):
        for content in (b'', b'\n\n', b'PK\x03\x04' + b'0' * 99, bytes(range(256)) * 9,
                        b't,fork\n', b'1' * 2000000, b't,fork\n0,1,2\n0,1,2\n'):
            with open(self.csv, 'wb') as out:
                out.write(content)
            self.refused('--column', 'fl=fork')
        self.write('t,fork', '0,0', '0.1,0', '0.2,0')
        for option in (('--delimiter', 'x'), ('--decimal', ';'), ('--encoding', 'zlib'),
                       ('--skip', '-1'), ('--time-scale', '0'), ('--rate', '1e12'),
                       ('--time', 'none')):
            self.refused('--column', 'fl=fork', *option)

    def test_real_rides(self):
        rides = sorted(glob.glob(os.path.join(RIDES, 'ride_*.csv')))
        if not rides:
            self.skipTest(f'no ride_*.csv in {RIDES}: real recordings not tried')
        for self.csv in rides:
            code, out, errors = self.convert('--column', 'fl,fr=fork_travel:0.8:-0.05', '--column',
                                             'rl,rr=shock_travel:2.2:-0.032', '--rate', '100')
            self.assertEqual(code, 0, errors)
            travel = read_joints(self.bag)['fl_travel'][1]
            self.assertTrue(np.all(np.abs(travel) < 0.12))


if __name__ == '__main__':
    unittest.main()
