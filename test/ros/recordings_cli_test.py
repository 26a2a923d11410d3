#!/usr/bin/python3
"""Recordings that contradict themselves, the vehicle or the request: cable_check and cable_replay name it."""
import json
import math
import os
import random
import sys
import unittest

import rosbag
import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from sensor_msgs.msg import JointState

from command_line import run
from made_recordings import MadeRecordings


class Recordings(MadeRecordings):

    RIG = """<robot name="rig"><link name="base_link"/><link name="slider"/>
      <joint name="travel" type="prismatic"><parent link="base_link"/><child link="slider"/>
        <origin xyz="0.1 0 0"/><axis xyz="1 0 0"/>
        <limit lower="-0.1" upper="0.1" effort="100" velocity="1"/></joint></robot>"""

    def judged(self, bag, *more, vehicle=MadeRecordings.CART, link='base_link'):
        """What cable_check and cable_replay write to JSON, after both ended well."""
        for name, text in (('v.urdf', vehicle), ('c.yaml', self.ARCH % link)):
            with open(self.path(name), 'w') as target:
                target.write(text)
        results = []
        for tool, output in (('cable_check', []),
                             ('cable_replay', ['--output', self.path('out.bag')])):
            code, text = run(tool, '--vehicle', self.path('v.urdf'), '--cables',
                             self.path('c.yaml'), '--bag', bag, '--json', self.path('o.json'),
                             *output, *more)
            self.assertEqual(code, 0, text)
            with open(self.path('o.json')) as source:
                results.append(json.load(source))
            # Each finding is printed too.
            for finding in results[-1]['findings']:
                self.assertIn(finding['what'], text)
        for kind in ('kind', 'subject', 'worst', 'size'):
            self.assertEqual(*[[f[kind] for f in result['findings']] for result in results])
        return results

    def test_late_stamps_are_told_and_smoothed(self):
        generator = random.Random(1)
        stamps = [100 + i / 100 + generator.uniform(0, 0.002) for i in range(501)]
        bag = self.write_messages('late.bag', [
            ('/tf', stamp, self.moved('odom', 'base_link', stamp, 0.1 * i))
            for i, stamp in enumerate(stamps)])
        _, rough = self.judged(bag)
        self.assertEqual([f['kind'] for f in rough['findings']], ['late_stamps'])
        self.assertEqual(rough['findings'][0]['subject'], 'odom -> base_link')
        self.assertGreater(rough['cables']['lead']['amplitude_max'], 0.02)
        _, smooth = self.judged(bag, '--smooth', '20')
        self.assertEqual(smooth['findings'], [])
        # It rolls on steadily: nothing sways. Stamps evened out over a second leave 2 %.
        self.assertLess(smooth['cables']['lead']['amplitude_max'], 0.002)

    def test_corrections_of_a_localisation_do_not_shake_cables(self):
        messages = []
        for i in range(251):
            stamp = 100 + i / 50
            messages.append(('/tf', stamp, self.moved('odom', 'base_link', stamp, 0.04 * i)))
            if i % 5 == 0:
                x = 7 if i < 125 else 7.1
                messages.append(('/tf', stamp, self.moved('map', 'odom', stamp, x)))
        bag = self.write_messages('map.bag', messages)
        check, replay = self.judged(bag)
        self.assertEqual(check['world_frame'], 'odom')
        self.assertEqual(replay['world_frame'], 'odom')
        self.assertLess(replay['cables']['lead']['amplitude_max'], 1e-5)
        finding, = replay['findings']
        self.assertEqual((finding['kind'], finding['subject']), ('jump', 'map -> odom'))
        self.assertAlmostEqual(finding['size'], 0.1)
        self.assertAlmostEqual(finding['worst'], 102.5)
        _, replay = self.judged(bag, '--world-frame', 'map')
        self.assertEqual(replay['world_frame'], 'map')
        self.assertGreater(replay['cables']['lead']['amplitude_max'], 0.05)
        self.assertIn('--world-frame odom', replay['findings'][0]['remedy'])
        _, replay = self.judged(bag, '--world-frame', 'odom')
        self.assertEqual(replay['findings'], [])

    def test_constant_transforms_sent_slowly_are_no_gaps(self):
        messages = []
        for i in range(201):
            stamp = 100 + i / 50
            messages.append(('/tf', stamp, self.moved('odom', 'base_link', stamp, 0.04 * i)))
            if i % 50 == 0:
                messages.append(('/tf', stamp, self.moved('world', 'odom', stamp, 5)))
        check, replay = self.judged(self.write_messages('slow.bag', messages))
        self.assertEqual((check['gaps'], replay['gaps']), (0, 0))
        with rosbag.Bag(self.path('out.bag')) as out:
            held = [m.held for _, m, _ in out.read_messages('/cables/lead/apex')]
        self.assertGreater(len(held), 700)
        self.assertFalse(any(held))

    def test_constant_transforms_hold_before_their_first_sample(self):
        messages = self.rolling(*[('/tf', 100.7 + i, self.moved('map', 'odom', 100.7 + i, 5))
                                  for i in range(4)])
        check, replay = self.judged(self.write_messages('slow.bag', messages))
        self.assertEqual((check['findings'], replay['findings']), ([], []))
        self.assertAlmostEqual(replay['simulated_time'], 3.99, 1)
        for result in (check, replay):
            self.assertTrue(any('map -> odom (/tf) never changes' in note
                                for note in result['notes']), result['notes'])

    def test_a_clock_that_was_set_back_is_told(self):
        messages = []
        for i in range(400):
            stamp = 100 + 0.01 * i - (0.3 if i > 200 else 0)
            record = 100 + 0.01 * i
            messages.append(('/tf', record, self.moved('odom', 'base_link', stamp, 0.05 * i)))
        for result in self.judged(self.write_messages('back.bag', messages)):
            finding, = result['findings']
            self.assertEqual((finding['kind'], finding['subject']),
                             ('clock_set_back', 'odom -> base_link'))
            self.assertAlmostEqual(finding['size'], 0.3)
            self.assertAlmostEqual(finding['worst'], 102)

    def test_a_snapshot_has_nothing_to_simulate(self):
        # No multiple of a time step.
        bag = self.write_messages('instant.bag',
                                  [('/tf', 100.0012, self.moved('odom', 'base_link', 100.0012, 1))])
        for name, text in (('v.urdf', self.CART), ('c.yaml', self.ARCH % 'base_link')):
            with open(self.path(name), 'w') as target:
                target.write(text)
        inputs = ['--vehicle', self.path('v.urdf'), '--cables', self.path('c.yaml'), '--bag', bag]
        # Where the clamps are can be checked, and is.
        code, text = run('cable_check', *inputs)
        self.assertEqual(code, 0, text)
        self.assertIn('warning: the recording has one instant only', text)
        self.assertIn('clamps 200.0 mm apart (50 % of its length)', text)
        code, text = run('cable_replay', *inputs, '--output', self.path('out.bag'))
        self.assertEqual(code, 2, text)
        self.assertIn('there is no motion to simulate', text)
        self.assertFalse(os.path.exists(self.path('out.bag')))

    def test_transforms_that_are_all_unusable_are_refused(self):
        messages = []
        for i in range(100):
            stamp = 100 + 0.01 * i
            message = self.moved('odom', 'base_link', stamp, i)
            message.transforms[0].transform.rotation.w = 0
            messages.append(('/tf', stamp, message))
            state = JointState(name=['travel'], position=[0.01 * math.sin(stamp)])
            state.header.stamp = rospy.Time.from_sec(stamp)
            messages.append(('/joint_states', stamp, state))
        for name, text in (('v.urdf', self.RIG), ('c.yaml', self.ARCH % 'slider')):
            with open(self.path(name), 'w') as target:
                target.write(text)
        self.refused('no transform of /tf can be used, of 100', "'odom' -> 'base_link'",
                     'its quaternion has the length 0', vehicle=self.path('v.urdf'),
                     cables=self.path('c.yaml'), bag=self.write_messages('bad.bag', messages))

    def joint_bag(self, positions):
        messages = []
        for i, position in enumerate(positions):
            message = JointState(name=['travel'], position=[position])
            message.header.stamp = rospy.Time.from_sec(10 + i / 100)
            messages.append(('/joint_states', 10 + i / 100, message))
        return self.write_messages('joints.bag', messages)

    def test_clamps_pulled_apart_later_are_told(self):
        # From 0.30 m to 0.41 m and back; the cable has 0.40 m.
        bag = self.joint_bag([0.0367 * (1 - math.cos(math.pi * i / 100)) for i in range(201)])
        vehicle = self.RIG.replace('xyz="0.1 0 0"', 'xyz="0.281 0 0"')
        check, replay = self.judged(bag, vehicle=vehicle, link='slider')
        for result in (check, replay):
            lead = result['cables']['lead']
            self.assertAlmostEqual(lead['clamps_max'], math.hypot(0.281 + 0.0734, 0.2), 6)
            self.assertAlmostEqual(lead['clamps_min'], math.hypot(0.281, 0.2), 6)
            self.assertAlmostEqual(lead['clamps_max_at'], 11)
            self.assertEqual([f['kind'] for f in result['findings']], ['clamps_too_far'])
        # Pulled straight between clamps that point across, it turns there within an element.
        self.assertIn('elements would do', replay['cables']['lead']['long_elements'])

    def test_elements_that_are_short_enough_are_not_told(self):
        _, replay = self.judged(self.joint_bag([0.01] * 101), vehicle=self.RIG, link='slider')
        self.assertIsNone(replay['cables']['lead']['long_elements'])

    def test_joint_beyond_its_limits_is_told(self):
        bag = self.joint_bag([0.15 * math.sin(math.pi * i / 100) for i in range(201)])
        for result in self.judged(bag, vehicle=self.RIG, link='slider'):
            finding, = result['findings']
            self.assertEqual((finding['kind'], finding['subject'], finding['topic']),
                             ('joint_limit', "joint 'travel'", '/joint_states'))
            self.assertAlmostEqual(finding['limit'], 0.1)

    def test_findings_are_in_the_diagnostics(self):
        bag = self.joint_bag([0.15 * math.sin(math.pi * i / 100) for i in range(301)])
        self.judged(bag, vehicle=self.RIG, link='slider')
        with rosbag.Bag(self.path('out.bag')) as out:
            status = [s for _, m, _ in out.read_messages('/diagnostics') for s in m.status
                      if s.name == 'cosserat_cable: input'][-1]
        self.assertEqual(status.level, DiagnosticStatus.WARN)
        self.assertIn("joint 'travel'", status.message)
        self.assertIn("joint_limit: joint 'travel'", [pair.key for pair in status.values])

    def rolling(self, *more, seconds=4, shift=0.0):
        """A cart that rolls on at 2 m/s, 100 times a second, and `more` messages."""
        return [*more, *[('/tf', 100 + i / 100,
                          self.moved('odom', 'base_link', 100 + i / 100 + shift, 0.02 * i))
                         for i in range(100 * seconds)]]

    def test_an_edge_that_was_sent_once_is_refused(self):
        bag = self.write_messages('once.bag', self.rolling(
            ('/tf', 100.5, self.moved('map', 'odom', 100.5, 5))))
        for name, text in (('v.urdf', self.CART), ('c.yaml', self.ARCH % 'base_link')):
            with open(self.path(name), 'w') as target:
                target.write(text)
        self.refused('nothing would be simulated', 'map -> odom (/tf) has one sample only',
                     '100.500 s (0.500 s after the start)', '/tf_static', '--world-frame odom',
                     vehicle=self.path('v.urdf'), cables=self.path('c.yaml'), bag=bag)

    def test_an_edge_that_ends_early_is_told(self):
        bag = self.write_messages('early.bag', self.rolling(
            *[('/tf', 100 + i, self.moved('map', 'odom', 100 + i, 5)) for i in range(3)]))
        for result in self.judged(bag):
            finding, = result['findings']
            self.assertEqual((finding['kind'], finding['subject'], finding['topic']),
                             ('limits_the_run', 'map -> odom', '/tf'))
            self.assertAlmostEqual(finding['size'], 1.99)
            self.assertAlmostEqual(finding['start'], 100)
        self.assertAlmostEqual(result['simulated_time'], 2, 2)

    def test_a_spike_of_one_sample_is_told(self):
        messages = self.rolling()
        messages[200][2].transforms[0].transform.translation.z = 0.01
        for result in self.judged(self.write_messages('spike.bag', messages)):
            finding, = result['findings']
            self.assertEqual((finding['kind'], finding['subject']),
                             ('outlier', 'odom -> base_link'))
            self.assertAlmostEqual(finding['size'], 0.01, 4)
            self.assertAlmostEqual(finding['worst'], 102)

    def test_samples_that_do_not_count_are_told_with_time_size_and_remedy(self):
        messages = self.rolling()
        messages[100][2].transforms[0].transform.translation.y = math.nan
        messages[150][2].transforms[0].transform.rotation.w = 3
        messages[200][2].transforms[0].header.stamp = rospy.Time()
        messages[250][2].transforms[0].header.stamp = rospy.Time(109)
        messages += self.rolling(('/tf', 103, self.moved('map', 'base_link', 103, 0)), seconds=0)
        bag = self.write_messages('bad.bag', messages)
        self.judged(bag)
        for tool, output in (('cable_check', []), ('cable_replay', ['--output', self.path('o.bag')])):
            code, text = run(tool, '--vehicle', self.path('v.urdf'), '--cables',
                             self.path('c.yaml'), '--bag', bag, *output)
            self.assertEqual(code, 0, text)
            for words in (
                    "transform that is no rotation or not finite by /tf: 2 (first: 'odom' -> "
                    "'base_link', its translation is not finite), at 101.000 s (1.000 s after the "
                    "start): it is left out",
                    "sample without a stamp by /tf: 1 (first: base_link), at 102.000 s (2.000 s "
                    "after the start): --use-record-times",
                    "sample with a bad stamp: 1 (first: frame 'base_link' by /tf, too late), at "
                    "109.000 s (9.000 s after the start), by up to 6.5 s: it is left out",
                    "frame 'base_link' has two parents: 1 (first: 'odom' by /tf is kept, 'map' by "
                    "/tf is ignored), at 103.000 s (3.000 s after the start): a frame has one parent"):
                self.assertIn(words, text, tool)

    def test_a_recording_that_is_ignored_as_a_whole_is_refused(self):
        # A plate that is fixed to the vehicle is said to carry it, and a frame to carry the plate.
        plated = self.CART.replace('</robot>', """<link name="plate"/>
            <joint name="bolts" type="fixed"><parent link="base_link"/><child link="plate"/></joint>
            </robot>""")
        for name, text in (('v.urdf', plated), ('c.yaml', self.ARCH % 'plate')):
            with open(self.path(name), 'w') as target:
                target.write(text)
        for parent, child, why in (
                ('plate', 'base_link', "'plate -> base_link' by /tf closes a loop of frames and is "
                 "ignored: record it the other way round"),
                ('odom', 'plate', "frame 'plate' has two parents, 'base_link' by the URDF is kept, "
                 "'odom' by /tf is ignored")):
            bag = self.write_messages('ignored.bag', [
                ('/tf', 100 + 0.01 * i, self.moved(parent, child, 100 + 0.01 * i, 0.02 * i))
                for i in range(300)])
            self.refused('nothing moves the vehicle: all 300 samples are ignored (the first: ' + why,
                         vehicle=self.path('v.urdf'), cables=self.path('c.yaml'), bag=bag)

    def test_recordings_in_a_loop_are_told(self):
        messages = self.rolling() + [(topic, stamp + 4, message)
                                     for topic, stamp, message in self.rolling()]
        bag = self.write_messages('loop.bag', messages)
        check, replay = self.judged(bag)
        self.assertEqual(replay['resets'], 1)
        code, text = run('cable_check', '--vehicle', self.path('v.urdf'), '--cables',
                         self.path('c.yaml'), '--bag', bag)
        self.assertIn("time ran backwards: 1 (first: frame 'base_link' from 103.989 s to 100.000 s), "
                      'at 103.989 s (3.990 s after the start), by up to 3.99 s: all starts anew '
                      'there', text)
        self.assertIn('ok, but for 1 warning', text)

    def test_a_stamp_far_ahead_is_left_out_and_a_jump_is_not_simulated_through(self):
        years = 10**8
        for name, far, kind, least in (('first', [0], 'time ran backwards', 3.9),
                                       ('second', [1], 'sample with a bad stamp', 3.98),
                                       ('middle', [200], 'sample with a bad stamp', 3.98),
                                       ('last', [399], 'sample with a bad stamp', 3.97),
                                       # What curves wait for at the jump is missing: ten periods.
                                       ('jump', range(200, 400), 'time jumped forward', 3.8),
                                       ('last two', [398, 399], 'time jumped forward', 3.8)):
            with self.subTest(name):
                messages = self.rolling()
                for i in far:
                    messages[i][2].transforms[0].header.stamp += rospy.Duration(years)
                _, replay = self.judged(self.write_messages('far.bag', messages))
                self.assertEqual(list(replay['warnings']), [kind])
                self.assertEqual(replay['warnings'][kind], 1)
                self.assertGreaterEqual(replay['simulated_time'], least)
                self.assertLess(replay['simulated_time'], 4)
                self.assertTrue(all(c['failure'] is None for c in replay['cables'].values()), replay)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
