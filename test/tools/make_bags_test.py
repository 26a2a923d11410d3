#!/usr/bin/python3
"""The generated recordings: the same bytes on each run, the spectrum of ISO 8608, the sweep's law
of motion."""

import os
import tempfile
import unittest

import numpy as np
import rosbag

from helpers import ROOT, contents, read_joints, run

SWEEP = os.path.join(ROOT, 'test', 'data', 'sweep.bag')
RIDE = os.path.join(ROOT, 'test', 'data', 'ride.bag')
CORNERS = ('fl', 'fr', 'rl', 'rr')
# They are kept in the repository.
MOST_BYTES = 3e6
# Sums of the ride differ in their last bits between processors; the bag holds nine decimals.
REPRODUCED = 2e-9


def read_transforms(path):
    """Times, translations (n, 3), quaternions (n, 4) of /tf."""
    rows = []
    with rosbag.Bag(path) as bag:
        for _, message, recorded in bag.read_messages(topics=['/tf']):
            [pose] = message.transforms
            assert recorded == pose.header.stamp
            p, q = pose.transform.translation, pose.transform.rotation
            rows.append([pose.header.stamp.to_sec(), p.x, p.y, p.z, q.x, q.y, q.z, q.w])
    rows = np.array(rows)
    return rows[:, 0], rows[:, 1:4], rows[:, 4:]


class Bags(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.at = lambda name: os.path.join(folder.name, name)

    def make(self, script, name, *options):
        code, _, errors = run(script, self.at(name), *options)
        self.assertEqual(code, 0, errors)
        return self.at(name)

    def test_same_bytes_on_each_run(self):
        for script, options in (('make_sweep_bag', ['--duration', '0.5']),
                                ('make_ride_bag', ['--duration', '2'])):
            first, second = (contents(self.make(script, name, *options))
                             for name in ('a.bag', 'b.bag'))
            self.assertEqual(first, second, script)

    def test_committed_bags_are_small(self):
        self.assertLess(os.path.getsize(SWEEP) + os.path.getsize(RIDE), MOST_BYTES)

    def test_committed_bags_are_what_the_scripts_write(self):
        self.assertEqual(contents(SWEEP), contents(self.make('make_sweep_bag', 'sweep.bag')))
        ride = self.make('make_ride_bag', 'ride.bag')
        for made, kept in zip(read_transforms(ride), read_transforms(RIDE)):
            np.testing.assert_allclose(made, kept, rtol=0, atol=REPRODUCED)
        made, kept = read_joints(ride), read_joints(RIDE)
        self.assertEqual(list(made), list(kept))
        for name in made:
            np.testing.assert_allclose(made[name][1], kept[name][1], rtol=0, atol=REPRODUCED)

    def test_sweep(self):
        times, p, q = read_transforms(SWEEP)
        np.testing.assert_allclose(np.diff(times), 0.002, atol=1e-6)
        self.assertAlmostEqual(times[-1] - times[0], 7.0, places=6)
        np.testing.assert_array_equal(p[:, 1:], 0)
        np.testing.assert_array_equal(q, np.broadcast_to([0, 0, 0, 1], q.shape))
        self.assertAlmostEqual(np.abs(p[:, 0]).max(), 1.5e-3, delta=1.5e-6)
        # From 10 to 38 Hz evenly: 24 Hz on average, 168 periods in 7 s; 16 Hz in the first 3 s, 48
        # periods.
        x = p[:-1, 0]  # the last sample is zero but for rounding
        upward = np.flatnonzero((x[:-1] < 0) & (x[1:] >= 0))
        self.assertEqual(len(upward), 167)  # the ends of all periods but the last
        self.assertEqual(np.count_nonzero(times[upward] - 1000 < 3.01), 48)
        # The period around 6 s is that of 34 Hz, to the resolution of the crossings.
        near = upward[np.abs(times[upward] - 1006) < 0.25]
        self.assertAlmostEqual((len(near) - 1) / (times[near[-1]] - times[near[0]]), 34, delta=0.3)

    def test_road_has_the_spectrum_of_class_c(self):
        csv = self.at('road.csv')
        self.make('make_ride_bag', 'long.bag', '--duration', '60', '--rate', '20', '--profile', csv)
        x, left, right = np.loadtxt(csv, delimiter=',', skiprows=1).T
        step = x[1] - x[0]
        size = 4096  # 28 m: some 55 half-overlapping pieces
        window = np.hanning(size)

        def pieces(z):
            return np.array([np.fft.rfft((z[i:i + size] - z[i:i + size].mean()) * window)
                             for i in range(0, len(z) - size, size // 2)])

        n = np.fft.rfftfreq(size, step)
        unit = 2 * step / (window ** 2).sum()
        a, b = pieces(left), pieces(right)
        for track in (a, b):
            density = (np.abs(track) ** 2).mean(0) * unit
            for low, high in ((0.25, 0.5), (0.5, 1), (1, 2), (2, 4)):
                band = (n >= low) & (n < high)
                # ISO 8608: Gd(n) = 256e-6 m^3 (n / 0.1)^-2. At least 7 lines of some 30 independent
                # pieces: 7 % standard deviation; the
                # window's leakage on a slope of -2 adds a few per cent.
                ratio = (density[band] * (n[band] / 0.1) ** 2).mean() / 256e-6
                self.assertAlmostEqual(ratio, 1, delta=0.25, msg=f'{low} to {high} cycles/m')
        # Long waves lift both wheels, short ones do not.
        coherence = np.abs((a * b.conj()).mean(0)) ** 2 / ((np.abs(a) ** 2).mean(0)
                                                           * (np.abs(b) ** 2).mean(0))
        self.assertGreater(coherence[(n > 0.05) & (n < 0.15)].mean(), 0.3)
        self.assertLess(coherence[(n > 2) & (n < 4)].mean(), 0.1)

    def test_ride(self):
        joints = read_joints(RIDE)
        self.assertEqual(list(joints), [f'{c}_travel' for c in CORNERS] + ['fl_steer', 'fr_steer']
                         + [f'{c}_wheel_spin' for c in CORNERS])
        for corner in CORNERS:
            times, travel = joints[f'{corner}_travel']
            self.assertAlmostEqual(times[-1] - times[0], 20, places=6)
            np.testing.assert_allclose(np.diff(times), 0.005, atol=1e-6)
            self.assertLess(np.abs(travel).max(), 0.080)
            # White noise of velocity on a quarter-car: rms^2 = G (ms + mu) / (4 c), with G = (2 pi
            # 0.1)^2 256e-6 v, is 10 mm;
            # the slalom adds about as much again. Twice and half of it bound a wrong unit.
            self.assertTrue(0.005 < travel.std() < 0.020, travel.std())
            # At rest at first: 1/20 of the later motion in the first tenth of a second.
            self.assertLess(np.abs(travel[:20]).max(), np.abs(travel).max() / 20)
        # The rear wheels ride in the front ones' tracks 2.70 m later.
        front, rear = joints['fl_travel'][1][200:], joints['rl_travel'][1][200:]
        lags = np.arange(0, 80)
        match = [np.corrcoef(front[:len(front) - k], rear[k:])[0, 1] for k in lags]
        self.assertAlmostEqual(lags[int(np.argmax(match))] * 0.005, 2.70 / (50 / 3.6), delta=0.015)
        times, p, q = read_transforms(RIDE)
        np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1, atol=1e-9)
        path = np.linalg.norm(np.diff(p[:, :2], axis=0), axis=1).sum()
        self.assertAlmostEqual(path, 20 * 50 / 3.6, delta=0.01)

    def test_bad_options_leave_nothing_behind(self):
        for script, options in (('make_sweep_bag', ['--rate', '50']),
                                ('make_sweep_bag', ['--amplitude', 'nan']),
                                ('make_ride_bag', ['--rate', '300']),
                                ('make_ride_bag', ['--speed', '0'])):
            code, _, errors = run(script, self.at('bad.bag'), *options)
            self.assertEqual(code, 2, errors)
            self.assertIn('expected', errors)
            self.assertEqual(os.listdir(os.path.dirname(self.at(''))), [])

    def test_a_road_too_rough_for_the_car_is_refused(self):
        code, _, errors = run('make_ride_bag', self.at('rough.bag'), '--road', 'E', '--duration',
                              '5')
        self.assertEqual(code, 3)
        self.assertIn('the car has 80', errors)
        self.assertFalse(os.path.exists(self.at('rough.bag')))


if __name__ == '__main__':
    unittest.main()
