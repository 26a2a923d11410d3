#!/usr/bin/python3
"""identification_report on small folders made here."""

import json
import math
import os
import tempfile
import unittest

from helpers import contents, run
from report_helpers import read_alone

# The loss at the disc: D_E in the source paper's formulas.
END_DAMPING = 'extensions.clamp_damping.b.torsion'

NOISE = 1e-5


def ring(name, length, delta, inertia=None, omega=30.0):
    made = {'experiment': name, 'channels': ['tip'], 'length': length, 'messages': [],
            'omega': [omega, 0.01], 'delta': [delta, 0.02 * delta], 'undamped': omega,
            'stiffness': [0.012, 1e-4], 'damping': [1e-4, 1e-6],
            'biases': [{'name': 'gravity', 'of': 'EI', 'relative': 0.22, 'order_only': False,
                        'text': 'the cable hangs: gravity stiffens it, [EI] +22 %'}]}
    if inertia:
        made['inertia'] = inertia
    else:
        made['plane'] = 'across'
    return made


def value(middle, sd):
    return {'value': middle, 'sd': sd, 'interval': [middle - 2 * sd, middle + 2 * sd], 'count': 3,
            'scatter': sd, 'scatters': True}


def channel(column, unit, misfit=1.0):
    return {'column': column, 'quantity': 'position', 'unit': unit, 'sigma': NOISE,
            'sigma_given': False, 'rms': NOISE * misfit, 'correlation_time': 0.002, 'misfit': misfit,
            'offset': None}


def answer():
    """As much as cable_identify can say."""
    grid = [0.0117 + 0.0001 * k for k in range(7)]
    candidates = [{'text': f'{n} repeats at {lengths}', 'lengths': lengths, 'inertia': 1e-4,
                   'repeats': n, 'predicted': {'eta_GJ': w / math.sqrt(n), END_DAMPING: 0.3}}
                  for lengths, w in (([0.1, 0.2], 0.6), ([0.05, 0.5], 0.25)) for n in (1, 3, 10)]
    return {
        'format': 1, 'set': 'made <up> & small', 'unheard_of': [1, 2],
        'parameters': {'EI': [0.012, 1e-4], 'eta_EI': [1e-4, 2e-6], 'eta_GJ': [4e-5, 2e-6],
                       END_DAMPING: [1e-4, 1e-5], 'GJ': None},
        'undetermined': {'GJ': '[GJ] moves no record of this set by more than its noise'},
        'units': {'EI': 'N m^2'}, 'intervals': {'EI': [0.0118, 0.0123]}, 'start': {'EI': 0.010},
        'defaults_kept': {'GJ': 0.009},
        'combinations': [{'text': 'eta_GJ/L + D_E', 'value': 3e-4, 'sd': 1e-5, 'unit': 'N m s'}],
        'noise': {'bend/tip': NOISE},
        'experiments': [
            {'name': 'bend', 'kind': 'ringdown', 'quasi_static': False, 'length': 0.2,
             'file': 'fit/bend.csv', 'rms': 1, 'channels': [channel('tip', 'm'),
                                                            channel('side', 'm', 2.5)]},
            {'name': 'pull', 'kind': 'bend', 'quasi_static': True, 'length': 0.2,
             'file': 'fit/pull.csv', 'rms': 1, 'channels': [channel('force', 'N')]}],
        'correlation': {'names': ['EI', 'eta_EI', 'eta_GJ', END_DAMPING],
                        'matrix': [[1, 0.1, 0, 0], [0.1, 1, 0, 0], [0, 0, 1, -0.9],
                                   [0, 0, -0.9, 1]]},
        'profiles': {'EI': {'value': grid,
                            'deviance': [10 + ((v - 0.012) / 1e-4) ** 2 for v in grid]}},
        'direct': {'bending': [ring('bend', 0.2, 1.5),
                               {'experiment': 'lost', 'channels': [], 'length': 0.2,
                                'messages': ['tip: no oscillation rises above the noise'],
                                'biases': [], 'refused': 'no channel shows a ring-down'}],
                   'torsion': [ring(f'twist{k}', length, (4e-5 / length + 1e-4) / 2e-4, 1e-4)
                               for k, length in enumerate((0.1, 0.2, 0.4))],
                   'values': {'EI': value(0.0147, 1e-4), 'eta_EI': value(1.02e-4, 2e-6),
                              'eta_GJ': value(4.4e-5, 5e-6), END_DAMPING: value(0.9e-4, 2e-5)},
                   'eta_GJ_D_E_correlation': -0.8, 'undetermined': {},
                   'critical': {'eta_GJ': 2e-4}, 'messages': []},
        'slips': [{'experiment': 'bend', 'column': 'side', 'kind': 'sign',
                   'text': 'side fits with its sign turned', 'factor': -1.0, 'constant': 0.0,
                   'delay': 0.0, 'misfit': 2.5, 'misfit_with': 1.04}],
        'warnings': ['bend: the record ends after two periods'], 'messages': ['11 steps of Ceres'],
        'plan': {'target': {'parameter': 'eta_GJ', 'accuracy': 0.1}, 'candidates': candidates,
                 'recommended': candidates[-1]},
        'seconds': 12.3,
        'stages': [{'stage': 'reading', 'seconds': 0.1, 'simulations': 0, 'steps': 0},
                   {'stage': 'search', 'seconds': 12.2, 'simulations': 584, 'steps': 144742}]}


# Two experiments, profiles, correlation, direct beside full, torsion over 1/L, plan.
ALL_FIGURES = 7


class IdentificationReport(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = os.environ.get('COSSERAT_CABLE_KEEP', folder.name)
        self.at = lambda name: os.path.join(self.folder, name)
        os.makedirs(self.at('fit'), exist_ok=True)

    def write(self, data):
        with open(self.at('identification.json'), 'w', encoding='utf-8') as out:
            json.dump(data, out)
        with open(self.at('fit/bend.csv'), 'w', encoding='utf-8') as out:
            out.write('t,tip,tip.fit,side,side.fit\n')
            for i in range(600):
                t = 0.005 * i
                fit = 0.002 * math.exp(-1.5 * t) * math.cos(30 * t)
                noise = NOISE * math.sin(1e3 * i * i)
                out.write(f'{t},{fit + noise},{fit},{0.3 * fit + 3 * noise},{0.3 * fit}\n')
        with open(self.at('fit/pull.csv'), 'w', encoding='utf-8') as out:
            out.write('step,force,force.fit\n')
            for i in range(12):
                out.write(f'{i},{0.1 * i + 1e-5 * (-1) ** i},{0.1 * i}\n')

    def report(self, *arguments):
        code, out, errors = run('identification_report', self.folder, *arguments)
        self.assertEqual((code, errors), (0, ''))
        self.assertEqual(out.split('\n')[0], self.at('report.html'))
        page = contents(self.at('report.html')).decode('utf-8')
        return read_alone(self, page)

    def test_all_that_can_be_said(self):
        self.write(answer())
        self.report()
        first = contents(self.at('report.html'))
        page = self.report('--pdf')
        self.assertEqual(contents(self.at('report.html')), first)
        self.assertEqual(len(page.pictures), ALL_FIGURES)
        for text in ('made <up> & small', 'They do not determine GJ',
                     '[GJ] moves no record of this set by more than its noise; default 0.009 kept',
                     'does not explain 1 of 3 channels', 'NOT EXPLAINED', '0.01180 to 0.01230',
                     'EI to ±2.1 %', 'eta_GJ/L + D_E', 'gravity stiffens it', 'two periods',
                     'no channel shows a ring-down', 'For ±10 % on eta_GJ: 10 repeats',
                     'bend: side fits with its sign turned. It would leave 1 times the noise '
                     'instead of 2.5.', '11 steps of Ceres', '+22 %', 'Identified in 12.3 s',
                     '144,742'):
            self.assertIn(text, page.text)
        self.assertEqual(contents(self.at('report.pdf'))[:5], b'%PDF-')

    def test_the_least_that_can_be_said(self):
        self.write({'format': 1, 'parameters': {'EI': None}, 'undetermined': {'EI': 'noise only'}})
        page = self.report('--pdf')
        self.assertEqual(page.pictures, [])
        self.assertIn('The data determine no parameter.', page.text)
        self.assertIn('noise only', page.text)

    def test_parts_may_be_missing(self):
        whole = answer()
        optional = [part for part in whole if part not in ('format', 'parameters')]
        # Every other one, so that each is missing once beside what refers to it.
        for missing in (optional[::2], optional[1::2]):
            with self.subTest(missing):
                self.write({key: kept for key, kept in whole.items() if key not in missing})
                self.report()
        for entry in whole['experiments']:
            entry['channels'] = [{'column': each['column']} for each in entry['channels']]
        self.write(whole)
        self.assertEqual(len(self.report().pictures), ALL_FIGURES)

    def test_one_length_has_no_line(self):
        data = answer()
        direct = data['direct']
        del direct['values']['eta_GJ'], direct['values'][END_DAMPING], direct['eta_GJ_D_E_correlation']
        direct['combination'] = dict(value(3e-4, 1e-5), text='eta_GJ/L + D_E', unit='N m s',
                                     length=0.2)
        self.write(data)
        page = self.report()
        self.assertEqual(len(page.pictures), ALL_FIGURES - 1)
        self.assertIn('one length determines no more', page.text)

    def test_bad_input_is_named(self):
        for text, message in (('{}', 'not written by cable_identify'), ('{', 'no JSON'),
                              ('{"format": 7, "parameters": {}}', 'format: got 7, expected 1')):
            with open(self.at('identification.json'), 'w', encoding='utf-8') as out:
                out.write(text)
            code, _, errors = run('identification_report', self.folder)
            self.assertEqual(code, 2)
            self.assertIn(message, errors)
        self.write(answer())
        with open(self.at('fit/pull.csv'), 'w', encoding='utf-8') as out:
            out.write('step,force,force.fit\n0,1\n')
        code, _, errors = run('identification_report', self.folder)
        self.assertEqual(code, 2)
        self.assertIn('fit/pull.csv: expected a header and rows of as many numbers', errors)
        os.unlink(self.at('fit/pull.csv'))
        self.assertEqual(run('identification_report', self.folder)[0], 4)
        self.assertEqual(run('identification_report', self.at('nowhere'))[0], 4)


if __name__ == '__main__':
    unittest.main()
