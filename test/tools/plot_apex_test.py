#!/usr/bin/python3
"""plot_apex on small telemetry bags made here."""

import json
import math
import os
import tempfile
import unittest

import genpy
import genpy.dynamic
import rosbag

from helpers import ROOT, contents, run

HEADER = '\n'.join(['', '=' * 80, 'MSG: std_msgs/Header', 'uint32 seq', 'time stamp',
                    'string frame_id', ''])


def telemetry_type():
    """The message class from msg/ApexTelemetry.msg, whether the package was built or not."""
    with open(os.path.join(ROOT, 'msg', 'ApexTelemetry.msg'), encoding='utf-8') as source:
        return genpy.dynamic.generate_dynamic('cosserat_cable/ApexTelemetry',
                                              source.read()
                                              + HEADER)['cosserat_cable/ApexTelemetry']


class PlotApex(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.Telemetry = telemetry_type()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.at = lambda name: os.path.join(folder.name, name)

    def write_bag(self, name):
        with rosbag.Bag(self.at(name), 'w') as bag:
            for i in range(200):
                for cable, touches in (('hose_fl', False), ('cable_fl', True)):
                    message = self.Telemetry()
                    message.header.stamp = genpy.Time.from_sec(1000 + i / 100)
                    message.displacement_z = 0.004 * math.sin(0.2 * i)
                    message.amplitude = 0.008
                    message.clearance = (-0.0005 if i == 50 else 0.01) if touches else math.inf
                    message.contact_force = 1.5 if touches and i == 50 else 0.0
                    message.held = 100 <= i < 120
                    bag.write(f'/cables/{cable}/apex', message, message.header.stamp)
        return self.at(name)

    def test_draws_and_sums_up(self):
        bag = self.write_bag('out.bag')
        code, out, errors = run('plot_apex', bag, '--json', self.at('sum.json'))
        self.assertEqual(code, 0, errors)
        self.assertEqual(contents(self.at('out.png'))[:8], b'\x89PNG\r\n\x1a\n')
        with open(self.at('sum.json'), encoding='utf-8') as source:
            numbers = json.load(source)
        self.assertEqual(list(numbers), ['cable_fl', 'hose_fl'])
        self.assertIsNone(numbers['hose_fl']['clearance_min_m'])
        self.assertEqual((numbers['cable_fl']['clearance_min_m'],
                          numbers['cable_fl']['contact_force_max_n']), (-0.0005, 1.5))
        self.assertEqual(numbers['cable_fl']['gaps'], 1)
        self.assertIn('hose_fl: amplitude up to 8.0 mm, nothing within reach, 1 gap', out)

    def test_one_cable_as_svg(self):
        code, out, errors = run('plot_apex', self.write_bag('out.bag'), '--cable', 'hose_fl', '-o',
                                self.at('hose.svg'))
        self.assertEqual(code, 0, errors)
        self.assertIn(b'<svg', contents(self.at('hose.svg')))
        self.assertNotIn('cable_fl', out)

    def test_bad_input_is_named_and_leaves_nothing_behind(self):
        bag = self.write_bag('out.bag')
        code, _, errors = run('plot_apex', bag, '--cable', 'hose_fr', '-o', self.at('a.jpg'))
        self.assertEqual(code, 2)
        self.assertIn("no cable 'hose_fr'; did you mean 'hose_fl'?", errors)
        self.assertIn('expected a name that ends in .png', errors)
        code, _, errors = run('plot_apex', os.path.join(ROOT, 'test', 'data', 'sweep.bag'), '-o',
                              self.at('a.png'))
        self.assertEqual(code, 2)
        self.assertIn('no topic of type cosserat_cable/ApexTelemetry; there is /tf', errors)
        with open(self.at('no.bag'), 'w', encoding='utf-8') as out:
            out.write('x,y\n')
        self.assertEqual(run('plot_apex', self.at('no.bag'))[0], 2)
        self.assertEqual(run('plot_apex', self.at('missing.bag'))[0], 4)
        self.assertEqual(sorted(os.listdir(self.at(''))), ['no.bag', 'out.bag'])

    def test_unindexed_bag_names_the_cure(self):
        whole = contents(self.write_bag('out.bag'))
        with open(self.at('cut.bag'), 'wb') as out:
            out.write(whole[:len(whole) // 2])
        code, _, errors = run('plot_apex', self.at('cut.bag'))
        self.assertEqual(code, 2, errors)
        self.assertNotIn('Traceback', errors)


if __name__ == '__main__':
    unittest.main()
