#!/usr/bin/python3
"""Numbers on the command line that cannot be meant: each is bad input, and none is ignored."""
import os
import unittest

from command_line import CAR_URDF, CAR_YAML, SOURCE, SWEEP_BAG, SWEEP_URDF, SWEEP_YAML, CommandLine, run

TEMPLATE_SET = os.path.join(SOURCE, 'config', 'sets', 'template')
SWEEP = ['--vehicle', SWEEP_URDF, '--cables', SWEEP_YAML, '--bag', SWEEP_BAG]
# Not finite, no number, negative, beyond what a double or 64 bits of nanoseconds hold.
NEVER = ('nan', 'inf', '-inf', 'x', '1,5', '', '-1', '1e400', '1e300', '1e19', '9300000000')
NUMBERS = {
    'cable_check': ('start', 'duration', 'max-gap', 'smooth'),
    'cable_replay': ('start', 'duration', 'max-gap', 'smooth', 'dt', 'threads', 'telemetry-rate',
                     'marker-rate', 'amplitude-window'),
    'cable_modes': ('count', 'time', 'max-gap', 'smooth'),
    'cable_simulate': ('dt', 'elements'),
    'cable_identify': ('uncertain-clamp', 'uncertain-length', 'time-budget', 'plan-accuracy',
                       'plan-longest', 'plan-shortest'),
    'cable_diagnose': ('time-budget',)}


class Numbers(CommandLine):

    def arguments(self, tool):
        output = os.path.join(self.output_folder, 'out')
        return {'cable_check': SWEEP, 'cable_replay': SWEEP + ['--output', output + '.bag'],
                'cable_modes': [SWEEP_YAML, *SWEEP[:2], *SWEEP[4:], '--output', output],
                'cable_simulate': [TEMPLATE_SET, '--output', output],
                'cable_identify': [TEMPLATE_SET, '--output', output, '--plan'],
                'cable_diagnose': [TEMPLATE_SET, '--output', output]}[tool]

    def test_numbers_that_cannot_be_meant_are_bad_input(self):
        for tool, options in NUMBERS.items():
            for option in options:
                for number in NEVER:
                    code, text = run(tool, *self.arguments(tool), '--%s=%s' % (option, number))
                    self.assertEqual(code, 2, (tool, option, number, text))
                    self.assertIn(option.replace('-', '_'), text.replace('-', '_'),
                                  (tool, option, number))
                    self.assertEqual(os.listdir(self.output_folder), [], (tool, option, number))

    def test_a_start_behind_the_end_says_how_long_the_recording_is(self):
        # The sweep lasts as long as its bag says: `rosbag info` prints 7.0 s.
        for start in ('7.1', '1000', '1e9'):
            code, text = run('cable_check', *SWEEP, '--start', start)
            self.assertEqual(code, 2, text)
            self.assertIn('the recording lasts 7', text)
            self.assertIn('counts from its first message', text)
        code, text = run('cable_check', *SWEEP, '--start', '1000')
        self.assertNotIn('drives', text)  # nothing else is wrong with it

    def test_joints_that_are_no_numbers(self):
        for number in ('nan', 'inf', '1e400', '', 'x'):
            code, text = run('cable_modes', CAR_YAML, '--vehicle', CAR_URDF,
                             '--joints', 'fl_travel=' + number)
            self.assertEqual(code, 2, text)
            self.assertIn('fl_travel', text)


if __name__ == '__main__':
    unittest.main()
