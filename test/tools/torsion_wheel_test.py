#!/usr/bin/python3
"""cable_diagnose on a heavy wheel that turns to and fro on a wire: data from its closed form.

Between two reversals J a" + c a' + k a = -M sign(a'), M the friction of the bearing: half a damped
swing about -M sign(a')/k."""

import csv
import json
import math
import os
import random
import subprocess
import tempfile
import unittest

PROGRAMS = os.environ['COSSERAT_CABLE_PROGRAMS_DIR']

LENGTH, GJ, INERTIA = 0.8, 0.0031, 2.4e-3   # of the wire [m], [N m^2]; of the wheel [kg m^2]
STIFFNESS = GJ / LENGTH
FREQUENCY = math.sqrt(STIFFNESS / INERTIA)  # [rad/s]
LOSS = 0.004                                # of critical damping
SAMPLE, DURATION, NOISE = 0.02, 20.0, 2e-4  # [s], [s], [rad]
BEFORE = 0.37                               # [s] of the swing that the record has missed
NUMBER = 0.01                               # of a number, at 75 dB

SET = """format: 1
cable:
  length: %g
  diameter: 0.003
  mass_per_length: 0.05
  EI: 0.004
  GJ: 0.0027
  eta_EI: null
  eta_GJ: null
experiments:
""" % LENGTH
EXPERIMENT = """  - name: %(name)s
    a: {pose: [0, 0, 0,  1, 0, 0, 0]}
    b: {disc: {inertia: %(inertia)g, mass: 0.9, guided: true}}
    start: {unknown: true}
    record: %(name)s.csv
    channels:
      - {column: angle, quantity: angle, s: %(length)g}
"""


def turned(amplitude, friction, t):
    """The wheel's angle, let go at `amplitude`."""
    delta = LOSS * FREQUENCY
    omega = math.sqrt(FREQUENCY ** 2 - delta ** 2)
    half = math.pi / omega
    peak = amplitude
    while t > half and abs(peak) * STIFFNESS > friction:
        middle = math.copysign(friction / STIFFNESS, peak)
        peak = middle - (peak - middle) * math.exp(-delta * half)
        t -= half
    if abs(peak) * STIFFNESS <= friction:
        return peak
    middle = math.copysign(friction / STIFFNESS, peak)
    return middle + (peak - middle) * math.exp(-delta * t) * (
        math.cos(omega * t) + delta / omega * math.sin(omega * t))


class TorsionWheel(unittest.TestCase):

    def diagnose(self, friction):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        text, noise = SET, random.Random(1)
        for name, amplitude in (('large', 1.2), ('small', 0.35)):
            text += EXPERIMENT % {'name': name, 'inertia': INERTIA, 'length': LENGTH}
            with open(os.path.join(folder.name, name + '.csv'), 'w', newline='') as file:
                writer = csv.writer(file)
                writer.writerow(['t', 'angle'])
                for i in range(int(DURATION / SAMPLE)):
                    angle = turned(amplitude, friction, i * SAMPLE + BEFORE)
                    writer.writerow(['%.6g' % (i * SAMPLE), '%.9g' % (angle + noise.gauss(0, NOISE))])
        with open(os.path.join(folder.name, 'measurement.yaml'), 'w') as file:
            file.write(text)
        done = subprocess.run(
            [os.path.join(PROGRAMS, 'cable_diagnose'), folder.name, '--output',
             os.path.join(folder.name, 'answer'), '--no-report', '--no-advice'],
            capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(folder.name, 'answer', 'verdict.json')) as file:
            return json.load(file), done.stdout

    def test_a_bearing_that_runs_freely_lacks_nothing(self):
        verdict, out = self.diagnose(0)
        self.assertEqual(verdict['verdict'], 'none', out)
        found = verdict['baseline']['parameters']['GJ'][0]
        self.assertLess(abs(found / GJ - 1), NUMBER)

    def test_a_bearing_that_rubs_is_named(self):
        friction = 0.004 * STIFFNESS
        verdict, out = self.diagnose(friction)
        self.assertEqual(verdict['verdict'], 'named', out)
        self.assertEqual(verdict['causes'], ['clamp_friction'], out)
        found = verdict['extended']['parameters']
        number = 'extensions.clamp_friction.b_torsion.slip_moment'
        self.assertLess(abs(found[number][0] / friction - 1), NUMBER)
        self.assertLess(abs(found['eta_GJ'][0] / (2 * LOSS * FREQUENCY * INERTIA * LENGTH) - 1),
                        NUMBER)


if __name__ == '__main__':
    unittest.main()
