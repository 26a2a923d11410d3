#!/usr/bin/python3
"""cable_diagnose on data from a simulation that shares no code with it: hide an effect, find it."""

import csv
import json
import math
import os
import signal
import subprocess
import tempfile
import time
import unittest

BUILD = os.environ['COSSERAT_CABLE_TOOLS_DIR']
PROGRAMS = os.environ['COSSERAT_CABLE_PROGRAMS_DIR']

SEED = 3
LEAST_GAIN = 0.95   # of what the plain model gets wrong, at 40 dB
NOISE = 0.1         # what is left is the noise's rms within this part
NUMBER = 0.03       # of a cause's number: noise, and two simulations' discretisations
INTERRUPT = 5.0     # [s] in which Ctrl-C is obeyed, beside other work


def run(program, *arguments):
    done = subprocess.run([os.path.join(PROGRAMS, program), *map(str, arguments)],
                          capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


class Diagnose(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def generate(self, *arguments):
        """Makes a set; returns the truth, which is read before it is taken away."""
        subprocess.run([os.path.join(BUILD, 'rig_generator'), *map(str, arguments), '--output',
                        self.path('set')], check=True, capture_output=True)
        with open(self.path('set', 'truth.json')) as file:
            truth = json.load(file)
        os.remove(self.path('set', 'truth.json'))
        return truth

    def diagnose(self, *options):
        code, out, errors = run('cable_diagnose', self.path('set'), '--output',
                                self.path('answer'), '--no-report', *options)
        self.assertEqual(code, 0, errors)
        with open(self.path('answer', 'verdict.json')) as file:
            return json.load(file), out

    def check_named(self, cause, number):
        truth = self.generate('effects', '--effect', cause, '--seed', SEED, '--snr', 40)
        verdict, out = self.diagnose()
        self.assertEqual(verdict['verdict'], 'named', out)
        self.assertEqual(verdict['causes'], [cause], out)
        self.assertIn(cause, out)
        self.assertGreater(verdict['gain']['value'], LEAST_GAIN)
        self.assertGreater(verdict['baseline']['times_noise'], 2)
        self.assertAlmostEqual(verdict['extended']['times_noise'], 1, delta=NOISE)
        found = verdict['extended']['parameters'][number][0]
        true = truth['effect_parameters'][number]
        self.assertLess(abs(found / true - 1), NUMBER)
        for rival in verdict['candidates']:
            if rival['cause'] != cause:
                self.assertTrue(rival['rejected'], rival['cause'])
        return verdict

    def test_a_load_is_named_and_its_cable_predicts(self):
        verdict = self.check_named('air_drag', 'extensions.air_drag.Cd')
        # The extended cable is a file that the other tools take.
        cable = self.path('answer', verdict['extended']['cable'])
        rms = {}
        for name, arguments in {'extended': ['--cable', cable], 'plain': []}.items():
            code, _, errors = run('cable_identify' if name == 'plain' else 'cable_simulate',
                                  self.path('set'), '--output', self.path(name),
                                  *(arguments + ['--rms', '--json', self.path(name + '.json')]
                                    if name == 'extended' else
                                    ['--no-report', '--no-direct', '--no-slips', '--no-profiles']))
            self.assertEqual(code, 0, errors)
        with open(self.path('extended.json')) as file:
            rms['extended'] = json.load(file)['experiments']
        with open(self.path('plain', 'identification.json')) as file:
            for experiment in json.load(file)['experiments']:
                for channel in experiment['channels']:
                    if channel['misfit'] and channel['misfit'] > 3:
                        self.assertLess(
                            rms['extended'][experiment['name']]['rms'][channel['column']],
                            0.5 * channel['rms'])
        # And so is the set with its cause filled in.
        code, _, errors = run('cable_simulate', self.path('answer', 'extended_measurement.yaml'),
                              '--output', self.path('again'))
        self.assertEqual(code, 0, errors)
        # What the report draws: measured, plain and extended side by side.
        for record in verdict['records']:
            with open(self.path('answer', record['file'])) as file:
                header = next(csv.reader(file))
            for column in record['noise']:
                self.assertIn(column + '.plain', header)
                self.assertIn(column + '.extended', header)

    def test_a_law_with_memory_is_named(self):
        self.check_named('clamp_friction', 'extensions.clamp_friction.a.slip_moment')

    def test_a_fault_of_the_record_is_named_and_stands_in_the_set(self):
        verdict = self.check_named('clock', 'faults.clock.delay')
        self.assertEqual(verdict['extended']['measurement'], 'extended_measurement.yaml')
        with open(self.path('answer', 'extended_measurement.yaml')) as file:
            self.assertIn('clock', file.read())

    def test_nothing_is_accused_where_nothing_is_missing(self):
        self.generate('ringdowns', '--seed', SEED, '--snr', 40)
        verdict, out = self.diagnose()
        self.assertEqual(verdict['verdict'], 'none', out)
        self.assertEqual(verdict['causes'], [])
        self.assertIsNone(verdict['extended'])
        self.assertIsNone(verdict['gain'])
        self.assertFalse(os.path.exists(self.path('answer', 'extended_cable.yaml')))

    def test_a_law_outside_the_library_is_not_named(self):
        subprocess.run([os.path.join(BUILD, 'rig_generator'), 'blind', '--suite', 'outside',
                        '--effect', 'random_taps', '--seed', str(SEED), '--snr', '40',
                        '--strength', '5', '--output', self.path('blind')],
                       check=True, capture_output=True)
        os.rename(self.path('blind', 'set'), self.path('set'))
        verdict, out = self.diagnose('--time-budget', 60)
        self.assertEqual(verdict['verdict'], 'unexplained', out)
        self.assertGreater(verdict['baseline']['times_noise'], 2)

    def test_mistakes_are_told_and_nothing_is_written(self):
        self.generate('ringdowns', '--seed', SEED, '--snr', 40)
        before = sorted(os.listdir(self.path('set')))
        code, _, errors = run('cable_diagnose', self.path('set'), '--output', self.path('set'))
        self.assertEqual(code, 2)
        self.assertIn('would be lost', errors)
        self.assertEqual(sorted(os.listdir(self.path('set'))), before)
        with open(self.path('set', 'measurement.yaml')) as file:
            text = file.read()
        with open(self.path('set', 'measurement.yaml'), 'w') as file:
            file.write(text.replace('diameter', 'diametre'))
        code, _, errors = run('cable_diagnose', self.path('set'), '--output', self.path('answer'))
        self.assertEqual(code, 2)
        self.assertIn('diameter', errors)
        self.assertFalse(os.path.exists(self.path('answer')))

    def test_ctrl_c_leaves_what_was_found(self):
        self.generate('effects', '--effect', 'section_friction', '--seed', SEED, '--snr', 40)
        process = subprocess.Popen(
            [os.path.join(PROGRAMS, 'cable_diagnose'), self.path('set'), '--output',
             self.path('answer'), '--no-report'],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(6)
        process.send_signal(signal.SIGINT)
        begin = time.time()
        _, errors = process.communicate()
        self.assertLess(time.time() - begin, INTERRUPT)
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn('interrupted', errors)
        if os.path.exists(self.path('answer', 'verdict.json')):
            with open(self.path('answer', 'verdict.json')) as file:
                verdict = json.load(file)
            self.assertTrue(verdict['interrupted'])
            self.assertTrue(math.isfinite(verdict['baseline']['times_noise']))
        if os.path.exists(self.path('answer', 'fits.json')):
            verdict, out = self.diagnose()
            self.assertEqual(verdict['causes'], ['section_friction'], out)
            self.assertIn('taken over', ' '.join(verdict['warnings']))
            self.assertFalse(os.path.exists(self.path('answer', 'fits.json')))


if __name__ == '__main__':
    unittest.main()
