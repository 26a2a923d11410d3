#!/usr/bin/python3
"""scripts/recovery: causes that the independent generator puts into records are found again.

One of each family: a load, a law of an end and one of the section, both with memory, and a fault of
the record.
"""

import os
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))),
                      'scripts', 'recovery')
PROGRAMS = os.environ.get('COSSERAT_CABLE_TOOLS_DIR', '')
CAUSES = ('air_drag', 'clamp_friction', 'section_friction', 'clock')
SEED = 3
# Of a number of the cause: noise at 40 dB, and the two simulations' different discretisations.
RELATIVE = 0.03
LEAST_GAIN = 0.95  # on a record that no fit has seen


class Recovery(unittest.TestCase):

    def test_causes_are_found_from_poor_starts(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                [sys.executable, SCRIPT, '--programs', PROGRAMS, '--output', folder, '--seed',
                 str(SEED)] + [word for cause in CAUSES for word in ('--cause', cause)],
                capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        seen = set()
        for line in done.stdout.splitlines()[2:]:
            cause, path, true, found, _, _, gain = [cell.strip() for cell in
                                                    line.strip('|').split('|')]
            self.assertGreater(float(gain), LEAST_GAIN, line)
            if '.' not in path:
                continue
            self.assertLess(abs(float(found.split()[0]) / float(true) - 1), RELATIVE, line)
            seen.add(cause)
        self.assertEqual(seen, set(CAUSES))


if __name__ == '__main__':
    unittest.main()
