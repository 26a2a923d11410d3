#!/usr/bin/python3
"""diagnosis_report on small folders made here."""

import json
import math
import os
import sys
import tempfile
import unittest

import numpy as np

from helpers import ROOT, contents, run
from report_helpers import read_alone

sys.path.insert(0, os.path.join(ROOT, 'scripts', 'pylib'))
import record_signals as signals  # noqa: E402

NOISE = 1e-5
RATE, OMEGA = 0.9, 25.0
# Where, spectra, decays, harmonics; and the proof.
OF_A_DECAY = 5


def candidate(cause, **told):
    made = {'cause': cause, 'causes': cause.split('+'), 'fitted': True, 'promise': 0.5, 'share': 0.998,
            'gain': 0.97, 'cost': [1000.0, 1000.0], 'worse': [0.0, 0.0], 'heldout': [0.0, 0.0],
            'adequate': True, 'parameters': {}, 'undetermined': {}, 'rejected': None}
    return {**made, **told}


def unfitted(cause, **told):
    return {**candidate(cause), 'fitted': False, 'promise': 0.03, 'share': None, 'gain': None,
            'cost': None, 'worse': None, 'heldout': None,
            'rejected': 'not fitted: to first order it explains 3 % of the misfit', **told}


def answer():
    """A named cause, and all that is told of it."""
    return {
        'format': 1, 'set': 'made <up> & small', 'verdict': 'named', 'causes': ['air_drag'],
        'sentence': 'The plain model leaves 9 times the noise; with air_drag it leaves 1.01.',
        'interrupted': False, 'noise_floor': NOISE, 'noise_known': True, 'seconds': 12.3,
        'warnings': ['bend: the record ends early'], 'unheard_of': 1,
        'baseline': {'parameters': {'EI': [0.012, 1e-5], 'eta_EI': None},
                     'undetermined': {'eta_EI': '[eta_EI] moves no record'}, 'times_noise': 9.0,
                     'rms_test': 9e-5},
        'extended': {'cable': 'extended_cable.yaml', 'measurement': 'extended_measurement.yaml',
                     'parameters': {'EI': [0.0121, 1e-6], 'eta_EI': None,
                                    'extensions.air_drag.Cd': [1.23, 0.02]},
                     'undetermined': {'eta_EI': 'too small'}, 'times_noise': 1.01, 'rms_test': 2e-5},
        'gain': {'value': 0.94, 'low': 0.91, 'high': 0.96},
        'candidates': [candidate('air_drag'),
                       candidate('maxwell', gain=-6e8, share=0.41, cost=[3e4, 1000.0],
                                 worse=[29000.0, 800.0], rejected='it explains 41 % of the misfit'),
                       unfitted('clock'), unfitted('contact', promise=0.0, rejected='cannot be seen')],
        'next_experiment': None,
        'records': [{'experiment': 'ring', 'file': 'fit/ring.csv', 'noise': {'tip': NOISE}}],
        'stages': [{'stage': 'baseline', 'seconds': 0.7, 'simulations': 584, 'steps': 144742}]}


class DiagnosisReport(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = os.environ.get('COSSERAT_CABLE_KEEP', folder.name)
        self.at = lambda name: os.path.join(self.folder, name)
        os.makedirs(self.at('fit'), exist_ok=True)

    def write(self, data, extended=True):
        """The verdict, with a decay that falls faster where it is large; the plain model does not."""
        with open(self.at('verdict.json'), 'w', encoding='utf-8') as out:
            json.dump(data, out)
        with open(self.at('fit/ring.csv'), 'w', encoding='utf-8') as out:
            out.write('t,tip,tip.plain' + ',tip.extended' * extended + '\n')
            for i in range(1000):
                t = 0.004 * i
                swing = math.cos(OMEGA * t) * math.exp(-RATE * t)
                true = 0.002 * swing / (1 + 0.4 * (1 - math.exp(-RATE * t)))
                noise = NOISE * math.sqrt(2) * math.sin(1e3 * i * i)
                out.write(f'{t},{true + noise},{0.0017 * swing}' + f',{true}' * extended + '\n')

    def write_loop(self, folder=''):
        """A quasi-static record, and its set in a folder."""
        data = answer()
        data.update(set=folder, records=[{'experiment': 'pull', 'file': 'fit/pull.csv',
                                          'noise': {'tip': NOISE, 'unknown': None}}])
        with open(self.at('verdict.json'), 'w', encoding='utf-8') as out:
            json.dump(data, out)
        with open(self.at('fit/pull.csv'), 'w', encoding='utf-8') as out:
            out.write('step,tip,tip.plain,tip.extended,unknown,unknown.plain,unknown.extended\n')
            for i in range(41):
                load = math.sin(math.pi * i / 10)
                loop = 0.1 * load + 1e-3 * math.cos(math.pi * i / 10)
                out.write(f'{i},{loop + 1e-5 * (-1) ** i},{0.1 * load},{loop},1,1,1\n')
        if not folder:
            return
        os.makedirs(folder)
        with open(os.path.join(folder, 'load.csv'), 'w', encoding='utf-8') as out:
            out.write('step,s,fx,fy,fz\n')
            out.writelines(f'{i},0.2,0,{math.sin(math.pi * i / 10)},0\n' for i in range(41))
        with open(os.path.join(folder, 'measurement.yaml'), 'w', encoding='utf-8') as out:
            out.write('format: 1\nexperiments:\n'
                      '  - {name: pull, a: {pose: [0, 0, 0, 0, 0, 0, 1]}, b: free, load: load.csv,\n'
                      '     channels: [{column: tip, quantity: position},\n'
                      '                {column: unknown, quantity: force}]}\n'
                      '  - {name: damaged}\n')

    def report(self, *arguments):
        code, out, errors = run('diagnosis_report', self.folder, *arguments)
        self.assertEqual((code, errors), (0, ''))
        self.assertEqual(out.split('\n')[0], self.at('report.html'))
        self.page = contents(self.at('report.html')).decode('utf-8')
        return read_alone(self, self.page)

    def assert_told(self, page, *texts):
        for text in texts:
            self.assertIn(text, page.text)

    def test_named(self):
        self.write(answer())
        self.report()
        first = contents(self.at('report.html'))
        page = self.report('--pdf')
        self.assertEqual(contents(self.at('report.html')), first)
        self.assertEqual(contents(self.at('report.pdf'))[:5], b'%PDF-')
        self.assertEqual(len(page.pictures), OF_A_DECAY)
        self.assert_told(
            page, 'made <up> & small', 'Cause: air_drag. The plain model leaves 9 times the noise',
            '94 % is gone', '91 % to 96 %', 'These records exclude every rival that was fitted',
            'ring / tip: where the plain model is off most', 'Loops: no record is quasi-static',
            'the verdict', 'it explains 41 % of the misfit', 'worse than plain', '29000 ± 800',
            '2 causes that were not fitted', 'cannot be seen', 'extensions.air_drag.Cd',
            'undetermined: [eta_EI] moves no record', 'undetermined: too small', '144,742',
            'bend: the record ends early', '12.3 s', 'extended_cable.yaml and extended_measurement')
        self.assertNotIn('-60000000000 %', page.text)
        self.assertIn('<details>', self.page)
        verdict, proof, candidates = (self.page.index(text) for text in (
            'class="headline"', '<img', '<h2>Candidates'))
        self.assertTrue(verdict < proof < candidates)

    def test_none(self):
        data = answer()
        data.update(verdict='none', causes=[], extended=None, gain=None, sentence='It leaves noise.',
                    candidates=[unfitted('clock')])
        self.write(data, extended=False)
        page = self.report('--pdf')
        self.assertEqual(len(page.pictures), OF_A_DECAY)
        self.assert_told(page, 'No cause: It leaves noise.', 'Gain: none is claimed',
                         'No cause was fitted.', 'larger motion')
        self.assertNotIn('best candidate', page.text)

    def test_ambiguous(self):
        data = answer()
        data.update(verdict='ambiguous', causes=['air_drag', 'maxwell'], extended=None, gain=None,
                    next_experiment='the same ring-down with twice the amplitude')
        data['candidates'][1]['rejected'] = None
        self.write(data)
        page = self.report()
        self.assert_told(page, 'Ambiguous:', 'cannot be excluded', 'best candidate: air_drag',
                         'What would change the verdict: the same ring-down with twice the amplitude')
        self.assertNotIn('exclude every rival', page.text)
        data['next_experiment'] = None
        self.write(data)
        self.assert_told(self.report(), 'no experiment was proposed.')

    def test_unexplained(self):
        data = answer()
        data.update(verdict='unexplained', causes=[], extended=None, gain=None, interrupted=True,
                    noise_known=False)
        data['candidates'][2]['rejected'] = 'not fitted: the time budget was spent'
        self.write(data)
        self.assert_told(self.report(), 'Unexplained:', 'the best there is; not enough',
                         'The work was interrupted', 'The noise of a channel is not known',
                         'may be at work: clock (3 %).')

    def test_a_gain_that_is_not_shown(self):
        data = answer()
        data['gain'] = {'value': 0.1, 'low': -0.24, 'high': 0.51}
        self.write(data)
        self.assert_told(self.report(), 'The interval includes zero')

    def test_without_the_extended_simulation(self):
        self.write(answer(), extended=False)
        page = self.report()
        self.assertEqual(len(page.pictures), OF_A_DECAY)

    def test_quasi_static_only(self):
        self.write_loop()
        page = self.report()
        self.assertEqual(len(page.pictures), 3)
        self.assert_told(page, 'At which frequency: there is no record over time',
                         'At which amplitude: no record is a free decay',
                         'Harmonics: no record is a free decay')
        drawn = b''.join(page.pictures)
        self.assertIn(b'SI unit', drawn)
        self.assertNotIn(b'unknown', drawn)
        self.write_loop(self.at('set'))
        drawn = b''.join(self.report().pictures)
        self.assertIn(b'load: fy [N]', drawn)
        self.assertNotIn(b'SI unit', drawn)

    def test_the_least_that_can_be_said(self):
        self.write({'format': 1, 'verdict': 'unexplained'})
        page = self.report('--pdf')
        self.assertEqual(page.pictures, [])
        self.assert_told(page, 'Unexplained:', 'there is no picture')

    def test_parts_may_be_missing(self):
        whole = answer()
        optional = [part for part in whole if part not in ('format', 'verdict')]
        for missing in (optional[::2], optional[1::2]):
            with self.subTest(missing):
                self.write({key: kept for key, kept in whole.items() if key not in missing})
                self.report()

    def test_bad_input_is_named(self):
        self.write(answer())
        for text, message in (('{}', 'not written by cable_diagnose'), ('{', 'no JSON'),
                              ('{"format": 7, "verdict": "none"}', 'format: got 7, expected 1')):
            with open(self.at('verdict.json'), 'w', encoding='utf-8') as out:
                out.write(text)
            code, _, errors = run('diagnosis_report', self.folder)
            self.assertEqual(code, 2)
            self.assertIn(message, errors)
        self.write(answer())
        with open(self.at('fit/ring.csv'), 'w', encoding='utf-8') as out:
            out.write('t,tip,tip.plain\n0,1\n')
        code, _, errors = run('diagnosis_report', self.folder)
        self.assertEqual(code, 2)
        self.assertIn('fit/ring.csv: expected a header and rows of as many numbers', errors)
        os.unlink(self.at('fit/ring.csv'))
        self.assertEqual(run('diagnosis_report', self.folder)[0], 4)
        self.assertEqual(run('diagnosis_report', self.at('nowhere'))[0], 4)


class Signals(unittest.TestCase):
    """Against signals whose answer is known."""

    def setUp(self):
        random = np.random.default_rng(7)
        self.t = np.sort(0.004 * np.arange(3000) + random.uniform(-4e-4, 4e-4, 3000))
        self.noise = random.normal(0, NOISE, 3000)

    def decay(self, y):
        found = signals.swings(self.t, y + self.noise, NOISE)
        self.assertTrue(signals.decays(found))
        return signals.decay_of(found)

    def within(self, values, sd, expected, least):
        off = np.abs(values - expected) / (4 * sd + least * expected)
        self.assertLess(off.max(), 1, (values, sd, expected))

    def test_linear_decay(self):
        found = self.decay(0.3 + 0.002 * np.exp(-0.4 * self.t) * np.cos(OMEGA * self.t))
        self.within(found.rate, found.rate_sd, 0.4, 0.01)
        self.within(found.frequency, found.frequency_sd, OMEGA / 2 / np.pi, 1e-3)
        loss = 1 - np.exp(-2 * 0.4 * 2 * np.pi / OMEGA)
        self.assertLess(np.abs(signals.loss_of(found) / loss - 1)[0], 0.02)
        self.assertGreater(found.amplitude[0] / found.amplitude[-1], 5)

    def test_decay_that_grows_with_the_amplitude(self):
        # A' = -b A^2, as quadratic drag has it.
        size = 0.002 / (1 + 0.8 * self.t)
        found = self.decay(size * np.cos(OMEGA * self.t))
        self.within(found.rate, found.rate_sd, 0.8 * found.amplitude / 0.002, 0.02)

    def test_faster_modes_do_not_matter(self):
        found = self.decay(0.002 * np.exp(-0.4 * self.t) * np.cos(OMEGA * self.t)
                           + 2e-4 * np.cos(6.3 * OMEGA * self.t))
        self.within(found.rate, found.rate_sd, 0.4, 0.02)

    def test_what_is_no_decay(self):
        found = signals.swings(self.t, 0.002 * np.cos(OMEGA * self.t) + self.noise, NOISE)
        self.assertFalse(signals.decays(found))
        for nothing in (self.noise, np.zeros(3000), 0.3 + 0.1 * self.t):
            self.assertIsNone(signals.swings(self.t, nothing, NOISE))
        self.assertIsNone(signals.swings(self.t[:10], self.noise[:10], NOISE))

    def test_harmonics(self):
        phase, size = OMEGA * self.t, np.exp(-0.4 * self.t)
        y = 0.002 * size * (np.cos(phase) + 0.03 * np.cos(2 * phase + 1) + 0.01 * np.cos(3 * phase))
        found = signals.swings(self.t, y + self.noise, NOISE)
        (second, third), sd = signals.harmonics(self.t, y + self.noise, found, NOISE)
        self.assertLess(sd, 1e-3)
        self.assertLess(abs(second - 0.03), 4 * sd + 1e-3)
        self.assertLess(abs(third - 0.01), 4 * sd + 1e-3)

    def test_spectrum(self):
        frequency, power = signals.spectrum(self.t, self.noise, NOISE)
        self.assertLess(abs(power.mean() - 1), 0.1)
        line = 1e-4 * np.sin(2 * np.pi * 20 * self.t)
        frequency, power = signals.spectrum(self.t, self.noise + line, NOISE)
        self.assertLess(abs(frequency[power.argmax()] - 20), 0.5)
        self.assertIsNone(signals.spectrum(self.t, self.noise, 0))


if __name__ == '__main__':
    unittest.main()
