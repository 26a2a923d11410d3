#!/usr/bin/python3
"""cable_modes: what it finds of the shipped cables, and what it refuses."""
import json
import os
import sys
import unittest

from command_line import CAR_URDF, CAR_YAML, CommandLine, SWEEP_URDF, SWEEP_YAML, run


class Modes(CommandLine):

    SPECIMEN = 'format: 1\ncable: {length: 0.2, diameter: 0.008, mass_per_length: 0.22, ' \
               'EI: 0.012, GJ: 0.009, eta_EI: 1.2e-5, eta_GJ: 6.0e-6}\n'

    def specimen(self):
        with open(self.path('specimen.yaml'), 'w') as target:
            target.write(self.SPECIMEN)
        return self.path('specimen.yaml')

    def test_modes_of_the_shipped_car(self):
        folder = os.path.join(self.output_folder, 'modes')
        code, text = run('cable_modes', CAR_YAML, '--vehicle', CAR_URDF, '--output', folder)
        self.assertEqual(code, 0, text)
        self.assertIn('8 cables in', text)
        with open(os.path.join(folder, 'modes.json')) as file:
            cables = json.load(file)['cables']
        self.assertEqual(len(cables), 8)
        for name, cable in cables.items():
            modes = cable['modes']
            self.assertEqual(len(modes), 6, name)
            # What config/cables/car.yaml says of a U of these, to about a tenth.
            first, second = (13, 27) if name.startswith('brake') else (5, 10)
            self.assertEqual([m['direction'] for m in modes[:2]], ['out of plane', 'in plane'])
            self.assertAlmostEqual(modes[0]['frequency'] / first, 1, delta=0.15)
            self.assertAlmostEqual(modes[1]['frequency'] / second, 1, delta=0.15)
            with open(os.path.join(folder, name + '.csv')) as file:
                rows = file.read().splitlines()
            self.assertEqual(len(rows), 42)  # header and nodes
            self.assertEqual(len(rows[0].split(',')), 4 + 6 * 6)
        code, text = run('cable_check', '--vehicle', CAR_URDF, '--cables',
                         os.path.join(folder, 'cables.yaml'))
        self.assertEqual(code, 0, text)

    def test_modes_of_a_specimen(self):
        numbers = self.path('numbers.json')
        code, text = run('cable_modes', self.specimen(), '--a', '-0.05,0,0,0,0,0,1', '--b',
                         '0.05,0,0,0,1,0,0', '--count', '3', '--json', numbers)
        self.assertEqual(code, 0, text)
        with open(numbers) as file:
            modes = json.load(file)['cables']['cable']['modes']
        # The paper's arch P1 at a tenth of its damping: resonance in its plane near 33 Hz.
        self.assertEqual(modes[1]['direction'], 'in plane')
        self.assertAlmostEqual(modes[1]['frequency'], 33.2, delta=0.3)

    def test_modes_refuses_bad_input_all_at_once(self):
        folder = os.path.join(self.output_folder, 'modes')
        for words, arguments in (
                (['vehicle: missing'], [SWEEP_YAML]),
                (['a: missing', 'b: a cable with a free end'], [self.specimen(), '--b', 'free']),
                (['a: got', 'b: got a quaternion', 'count: got 0'],
                 [self.specimen(), '--a', '1,2', '--b', '0,0,0,0,0,0,2', '--count', '0']),
                (['a: the vehicle'], [SWEEP_YAML, '--vehicle', SWEEP_URDF, '--a',
                                      '0,0,0,0,0,0,1']),
                (['apart'], [self.specimen(), '--a', '0,0,0,0,0,0,1', '--b', '1,0,0,0,0,0,1']),
                (['lenght'], [self.cables(('length:', 'lenght:')), '--vehicle', SWEEP_URDF])):
            code, text = run('cable_modes', *arguments, '--output', folder)
            self.assertEqual(code, 2, text)
            for word in words:
                self.assertIn(word, text)
            self.assertEqual(os.listdir(self.output_folder), [])

    def test_modes_says_at_once_what_cannot_be_written(self):
        for path, why in ((self.path('no/such/folder.json'), 'does not exist'),
                          ('/dev/null', 'got a device or pipe')):
            code, text = run('cable_modes', SWEEP_YAML, '--vehicle', SWEEP_URDF, '--json', path)
            self.assertEqual(code, 2, text)
            self.assertIn(why, text)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
