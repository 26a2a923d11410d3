#!/usr/bin/python3
"""scripts/coverage with programs that are made up: what it counts, and that it goes on."""

import json
import os
import stat
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))),
                      'scripts', 'coverage')

# EI is 1 in every set; set k says k/10 +- 0.1 (one standard deviation), with an interval twice as
# wide as the curvature's: of sets 1 to 20, those from 7 to 13 hold 1.
GENERATOR = '''#!/usr/bin/python3
import json, os, sys
folder = sys.argv[sys.argv.index('--output') + 1]
os.makedirs(folder)
with open(os.path.join(folder, 'truth.json'), 'w') as file:
    json.dump({'parameters': {'EI': 1.0}, 'arguments': sys.argv[1:]}, file)
'''
IDENTIFY = '''#!/usr/bin/python3
import json, os, sys
folder, answer = sys.argv[1], sys.argv[sys.argv.index('--output') + 1]
number = int(os.path.basename(folder))
if number == 20:
    sys.exit('does not converge')
os.makedirs(answer)
half = 2 * 1.959964 * 0.1
value = number / 10
with open(os.path.join(answer, 'identification.json'), 'w') as file:
    json.dump({'parameters': {'EI': [value, 0.1]}, 'seconds': 1.5,
               'intervals': {'EI': [value - half, value + half]}}, file)
'''


class Coverage(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        for name, text in (('rig_generator', GENERATOR), ('cable_identify', IDENTIFY)):
            with open(self.path(name), 'w') as file:
                file.write(text)
            os.chmod(self.path(name), stat.S_IRWXU)

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def coverage(self, *options):
        done = subprocess.run([sys.executable, SCRIPT, '--programs', self.folder.name, '--output',
                               self.path('sets'), *options], capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr

    def test_it_counts_and_goes_on_where_it_was_stopped(self):
        options = ('--rig', 'ringdowns', '--rig-option', 'start=unknown', '--jobs', '2')
        code, out, errors = self.coverage(*options, '--count', '5')
        self.assertEqual(code, 0, errors)
        self.assertIn('5 identified now', out)
        with open(self.path('sets', '3', 'truth.json')) as file:
            arguments = json.load(file)['arguments']
        self.assertEqual(arguments[0], 'ringdowns')
        self.assertEqual(arguments[arguments.index('--start') + 1], 'unknown')
        self.assertEqual(arguments[arguments.index('--seed') + 1], '3')

        code, out, errors = self.coverage(*options, '--count', '20', '--json', self.path('json'))
        self.assertEqual(code, 3, errors)  # one set fails, and is told
        self.assertIn('seed 20: does not converge', errors)
        self.assertIn('14 identified now', out)
        with open(self.path('json')) as file:
            numbers = json.load(file)
        self.assertEqual(numbers['failed'], [20])
        EI = numbers['parameters']['EI']
        self.assertEqual(EI['count'], 19)
        self.assertAlmostEqual(EI['covered'], 7 / 19)
        self.assertAlmostEqual(EI['covered_by_sd'], 3 / 19)
        for ratio in EI['half_width_by_sd']:
            self.assertAlmostEqual(ratio, 2)

    def test_sets_of_other_options_are_not_mixed(self):
        self.assertEqual(self.coverage('--count', '1')[0], 0)
        code, _, errors = self.coverage('--count', '1', '--snr', '20')
        self.assertEqual(code, 2)
        self.assertIn('options.json', errors)
        code, _, errors = self.coverage('--count', '1', '--rig-option', 'unknown')
        self.assertEqual(code, 2)
        self.assertIn('expected NAME=VALUE', errors)

    def test_programs_that_are_not_built_are_said_once(self):
        os.remove(self.path('rig_generator'))
        code, _, errors = self.coverage('--count', '5')
        self.assertEqual(code, 2)
        self.assertEqual(errors.count('no rig_generator in'), 1)
        self.assertNotIn('cable_identify', errors.replace(self.folder.name, '').split('error:')[1])


if __name__ == '__main__':
    unittest.main()
