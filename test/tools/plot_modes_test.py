#!/usr/bin/python3
"""plot_modes on a small folder made here."""

import json
import math
import os
import tempfile
import unittest

from helpers import contents, run

MODE = {'frequency': 5.0, 'frequency_damped': 4.9, 'damping_ratio': 0.1, 'unstable': False,
        'direction': 'in plane'}


class PlotModes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.at = lambda name: os.path.join(folder.name, name)

    def write(self, directions):
        """A half circle with one mode per direction."""
        modes = [dict(MODE, direction=d) for d in directions]
        with open(self.at('modes.json'), 'w', encoding='utf-8') as out:
            json.dump({'cables': {'hose': {'failure': None, 'modes': modes},
                                  'lost': {'failure': 'no equilibrium', 'modes': []}}}, out)
        fields = [f'{v}{n}' for n in range(1, len(modes) + 1)
                  for v in ('ux', 'uy', 'uz', 'rx', 'ry', 'rz')]
        with open(self.at('hose.csv'), 'w', encoding='utf-8') as out:
            out.write(','.join(['s', 'x', 'y', 'z'] + fields) + '\n')
            for i in range(21):
                a = math.pi * i / 20
                row = [0.1 * a, 0.1 * math.cos(a), 0, -0.1 * math.sin(a)]
                for direction in directions:
                    swing = math.sin(a)
                    row += {'in plane': [swing, 0, 0], 'out of plane': [0, swing, 0],
                            'torsion': [0, 0, 0]}[direction] + [swing, 0, 0]
                out.write(','.join(str(v) for v in row) + '\n')

    def test_draws_each_cable_that_has_modes(self):
        self.write(['in plane', 'out of plane', 'torsion', 'in plane'])
        code, out, errors = run('plot_modes', self.folder)
        self.assertEqual(code, 0, errors)
        self.assertEqual(out, self.at('hose.png') + '\n')
        self.assertEqual(contents(self.at('hose.png'))[:8], b'\x89PNG\r\n\x1a\n')
        code, _, errors = run('plot_modes', self.folder, '--format', 'svg')
        self.assertEqual(code, 0, errors)
        self.assertIn(b'<svg', contents(self.at('hose.svg')))

    def test_bad_input_is_named(self):
        self.write(['in plane'])
        code, _, errors = run('plot_modes', self.folder, '--cable', 'hos', '--format', 'gif')
        self.assertEqual(code, 2)
        self.assertIn("no cable 'hos'; did you mean 'hose'?", errors)
        self.assertIn('expected png, svg, pdf', errors)
        with open(self.at('modes.json'), 'w', encoding='utf-8') as out:
            out.write('{}')
        self.assertEqual(run('plot_modes', self.folder)[0], 2)
        self.assertEqual(run('plot_modes', self.at('nowhere'))[0], 4)


if __name__ == '__main__':
    unittest.main()
