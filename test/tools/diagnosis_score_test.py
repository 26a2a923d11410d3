#!/usr/bin/python3
"""scripts/diagnosis_score: what it counts, with a diagnosis that knows the answers it is to give."""

import json
import os
import stat
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPT = os.path.join(ROOT, 'scripts', 'diagnosis_score')
PROGRAMS = os.environ.get('COSSERAT_CABLE_TOOLS_DIR', '')
sys.path.insert(0, os.path.join(ROOT, 'scripts', 'pylib'))
import binomial  # noqa: E402
import diagnosis_case  # noqa: E402

# Answers by the first seeds: set folder's case to verdict; written where the fake one stands.
FAKE = '''#!/usr/bin/python3
import json, os, sys, time
answers = json.load(open(os.path.join(os.path.dirname(os.path.realpath(__file__)), 'answers.json')))
case = os.path.basename(os.path.dirname(os.path.realpath(sys.argv[1])))
assert sys.argv[2] == '--output' and sys.argv[4:] == ['--no-report']
assert not os.path.exists(os.path.join(sys.argv[1], 'truth.json'))
answer = answers[case]
if answer == 'slow':
    time.sleep(60)
if answer == 'crash':
    sys.exit('crashed')
os.makedirs(sys.argv[3])
json.dump(answer, open(os.path.join(sys.argv[3], 'verdict.json'), 'w'))
'''

# The generator's stand-in: a folder as it leaves one.
FAKE_RIGS = '''#!/usr/bin/python3
import json, os, sys
words = dict(zip(sys.argv[2::2], sys.argv[3::2]))
place = words['--output']
os.makedirs(os.path.join(place, 'set'))
truths = json.load(open(os.path.join(os.path.dirname(os.path.realpath(__file__)), 'truths.json')))
json.dump(truths[os.path.basename(place)], open(os.path.join(place, 'truth.json'), 'w'))
'''


def truth(label, verdict, causes=(), effects=None, **more):
    expected = {'verdict': verdict, 'causes': list(causes), 'also': [], 'tolerated': [],
                'undetermined': []}
    expected.update(more)
    return {'label': label, 'strength': {'reached': 5.0}, 'expected': expected,
            'effects': list(causes) if effects is None else effects,
            'parameters': {'EI': 1.0, 'GJ': 1.0},
            'effect_parameters': {'extensions.air_drag.Cd': 2.0}}


def verdict(kind, causes=(), gain=None, parameters=None):
    return {'verdict': kind, 'causes': list(causes), 'seconds': 3.0,
            'baseline': {'parameters': {'EI': [1.0, 0.1], 'GJ': None}},
            'gain': {'value': gain},
            'extended': {'parameters': parameters or {}}}


# name: truth, verdict, what it is to be counted as
CASES = {
    'single_seed1_snr40_x5': (
        truth('air_drag', 'named', ['air_drag']),
        verdict('named', ['air_drag'], 0.9,
                {'EI': [1.1, 0.1], 'extensions.air_drag.Cd': [3.0, 0.1]}), 'right'),
    'single_seed2_snr40_x5': (
        truth('air_drag', 'named', ['air_drag']), verdict('named', ['drift'], 0.5), 'wrong'),
    'single_seed3_snr40_x5': (
        truth('air_drag', 'named', ['air_drag']), verdict('ambiguous', ['air_drag', 'drift']),
        'cautious'),
    'single_seed4_snr40_x5': (truth('clock', 'named', ['clock']), verdict('none'), 'missed'),
    'single_seed5_snr40_x5': (truth('clock', 'named', ['clock']), 'crash', 'failed'),
    'single_seed6_snr40_x5': (
        truth('clamp_damping', 'named', ['clamp_damping'], also=['clamp_compliance']),
        verdict('named', ['clamp_damping', 'clamp_compliance'], 1.0), 'right'),
    'null_seed1_snr40': (truth('none', 'none'), verdict('none'), 'right'),
    'null_seed2_snr40': (truth('none', 'none'), verdict('named', ['clock']), 'wrong'),
    'null_seed3_snr40': (truth('none', 'none'), verdict('ambiguous', ['none', 'clock']),
                         'cautious'),
    'null_seed4_snr40': (truth('none', 'none'), verdict('unexplained'), 'wrong'),
    'outside_seed1_snr40_x5': (truth('magnet', 'unexplained', effects=['magnet']),
                               verdict('unexplained'), 'right'),
    'outside_seed2_snr40_x5': (truth('magnet', 'unexplained', effects=['magnet']),
                               verdict('named', ['contact']), 'wrong'),
    'pairs_seed1_snr40_x5': (truth('clock+contact', 'named', ['clock', 'contact']),
                             verdict('named', ['clock']), 'partial'),
    'twins-without_seed1_snr40_x5': (
        truth('clock', 'ambiguous', ['clock', 'sensor'], ['clock']),
        verdict('ambiguous', ['sensor', 'clock']), 'right'),
    'twins-without_seed2_snr40_x5': (
        truth('clock', 'ambiguous', ['clock', 'sensor'], ['clock']),
        verdict('named', ['clock']), 'lucky'),
    'twins-without_seed3_snr40_x5': (
        truth('clock', 'ambiguous', ['clock', 'sensor'], ['clock']),
        verdict('named', ['sensor']), 'wrong'),
    'twins-without_seed4_snr40_x5': (
        truth('clock', 'ambiguous', ['clock', 'sensor'], ['clock'], tolerated=['named']),
        verdict('named', ['clock']), 'right'),
    'unidentifiable_seed1_snr40': (truth('none', 'none', undetermined=['GJ']), verdict('none'),
                                   'right'),
    'unidentifiable_seed2_snr40': (truth('none', 'none', undetermined=['EI']), verdict('none'),
                                   'wrong'),
}


def write_program(path, text):
    with open(path, 'w') as file:
        file.write(text)
    os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)


class Score(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.programs = os.path.join(folder.name, 'programs')
        self.output = os.path.join(folder.name, 'output')
        os.mkdir(self.programs)
        write_program(os.path.join(self.programs, 'cable_diagnose'), FAKE)
        write_program(os.path.join(self.programs, 'rig_generator'), FAKE_RIGS)
        write_program(os.path.join(self.programs, 'cable_simulate'), '#!/usr/bin/false\n')
        self.tell('truths', {name: case[0] for name, case in CASES.items()})
        self.tell('answers', {name: case[1] for name, case in CASES.items()})
        self.list = os.path.join(folder.name, 'cases')
        with open(self.list, 'w') as file:
            for name in CASES:
                suite, seed = name.split('_')[:2]
                file.write('%s %s 40 5  # a case\n' % (suite, seed[4:]))

    def tell(self, what, content):
        with open(os.path.join(self.programs, what + '.json'), 'w') as file:
            json.dump(content, file)

    def score(self, *arguments):
        done = subprocess.run(
            [sys.executable, SCRIPT, '--programs', self.programs, '--output', self.output, '--json',
             self.output + '.json'] + list(arguments), capture_output=True, text=True)
        rows = {}
        if os.path.exists(self.output + '.json'):
            with open(self.output + '.json') as file:
                rows = {row['name']: row for row in json.load(file)}
        return done, rows

    def test_judgements_and_tables(self):
        done, rows = self.score('--cases', self.list, '--jobs', '3')
        self.assertEqual(done.returncode, 0, done.stderr)
        for name, (_, _, judgement) in CASES.items():
            self.assertEqual(rows[name]['judgement'], judgement, name)
        self.assertEqual(rows['single_seed1_snr40_x5']['covered'],
                         {'EI': True, 'extensions.air_drag.Cd': False})
        for line in ('| right cause named | 2/6 | 33.3 | 4.3 to 77.7 |',
                     '| null sets accused | 2/4 | 50.0 | 6.8 to 93.2 |',
                     '| outside the library refused | 1/2 | 50.0 | 1.3 to 98.7 |',
                     '| two causes, both found | 0/1 | 0.0 | 0.0 to 97.5 |',
                     '| failed | 1/19 | 5.3 | 0.1 to 26.0 |'):
            self.assertIn(line, done.stdout)
        self.assertRegex(done.stdout, r'\| air_drag \| 3 \|')
        self.assertRegex(done.stdout, r'1 of 2 parameters')

    def test_resumes_where_it_was_stopped(self):
        self.score('--cases', self.list)
        right = {name: verdict('none') for name in CASES}
        self.tell('answers', right)
        _, rows = self.score('--cases', self.list, '--resume')
        self.assertEqual(rows['single_seed2_snr40_x5']['judgement'], 'wrong')  # kept
        self.assertEqual(rows['single_seed5_snr40_x5']['judgement'], 'missed')  # tried again
        _, rows = self.score('--cases', self.list)
        self.assertEqual(rows['single_seed2_snr40_x5']['judgement'], 'missed')  # all anew

    def test_time_limit(self):
        self.tell('answers', {'null_seed1_snr40': 'slow'})
        done, rows = self.score('--suite', 'null', '--limit', '1')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(rows['null_seed1_snr40']['judgement'], 'failed')

    def test_bounds(self):
        done, _ = self.score('--cases', self.list, '--floor', 'right cause named=0.3', '--ceiling',
                             'null sets accused=0.5')
        self.assertEqual(done.returncode, 0, done.stderr)
        done, _ = self.score('--cases', self.list, '--resume', '--floor', 'right cause named=0.4',
                             '--ceiling', 'null sets accused=0.1')
        self.assertEqual(done.returncode, 3)
        self.assertIn('right cause named: out of bounds', done.stderr)
        self.assertIn('null sets accused: out of bounds', done.stderr)

    def test_sets_that_cannot_be_made(self):
        self.tell('truths', {})
        done, rows = self.score('--suite', 'null')
        self.assertEqual(done.returncode, 3)
        self.assertEqual(rows['null_seed1_snr40']['judgement'], 'unmade')


class Covered(unittest.TestCase):

    def hits(self, true, found):
        truth = {'parameters': {}, 'effect_parameters': true}
        return diagnosis_case.covered(truth, {'extended': {'parameters': found}})

    def test_an_angle_comes_round_again(self):
        path = 'extensions.contact.plane.azimuth'
        self.assertEqual(self.hits({path: -3.1}, {path: [3.19, 0.01]}), {path: True})
        self.assertEqual(self.hits({path: -3.1}, {path: [3.1, 0.01]}), {path: False})

    def test_a_section_may_be_named_by_either_axis(self):
        difference, roll = 'extensions.anisotropy.difference', 'extensions.anisotropy.roll'
        true = {difference: 0.02, roll: 0.3}
        self.assertEqual(self.hits(true, {difference: [-0.02, 1e-4], roll: [0.3 - 1.5708, 1e-3]}),
                         {difference: True, roll: True})
        self.assertEqual(self.hits(true, {difference: [-0.02, 1e-4], roll: [0.3, 1e-3]}),
                         {difference: True, roll: False})


class Binomial(unittest.TestCase):

    def test_intervals_of_the_tables(self):  # R: binom.test
        for count, total, low, high in ((0, 200, 0.0, 0.01827533), (9, 10, 0.5549839, 0.9974714),
                                        (98, 100, 0.9296161, 0.9975684), (5, 5, 0.4781762, 1.0)):
            found = binomial.clopper_pearson(count, total)
            self.assertAlmostEqual(found[0], low, places=6)
            self.assertAlmostEqual(found[1], high, places=6)


class Unseen(unittest.TestCase):

    @unittest.skipUnless(os.path.exists(os.path.join(PROGRAMS, 'rig_generator')), 'not built')
    def test_the_truth_leaves_only_noise_on_the_unseen_record(self):
        case = diagnosis_case.Case('null', 4, 40, 5)
        with tempfile.TemporaryDirectory() as folder:
            diagnosis_case.run(case.generator(PROGRAMS, folder), 300)
            known = diagnosis_case.load(folder, 'truth.json')['parameters']
            self.assertFalse(os.path.exists(os.path.join(folder, 'set', 'truth.json')))
            values = {key: [value, 0.0] for key, value in known.items()}
            simulate = os.path.join(os.environ['COSSERAT_CABLE_PROGRAMS_DIR'], 'cable_simulate')
            squares, channels = diagnosis_case.unseen_errors(simulate, folder, 300, values)
        # Mean squares over hundreds of samples whose noise may be correlated, and two discretisations.
        self.assertAlmostEqual(squares / channels, 1.0, delta=0.2)


if __name__ == '__main__':
    unittest.main()
