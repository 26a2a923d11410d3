#!/usr/bin/env python3
"""A cable that fails leaves a state from which it fails again, in the same words."""
import glob
import os
import re
import unittest

import rospy
from sensor_msgs.msg import JointState

from command_line import run
from made_recordings import MadeRecordings


class Failures(MadeRecordings):

    RIG = """<robot name="rig"><link name="base_link"/>
      <link name="wall"><collision><origin xyz="0.1 0.1 -0.2"/>
        <geometry><box size="1 1 0.1"/></geometry></collision></link>
      <joint name="to_wall" type="fixed"><parent link="base_link"/><child link="wall"/></joint>
      <link name="slider"/>
      <joint name="travel" type="prismatic"><parent link="base_link"/><child link="slider"/>
        <origin xyz="0.1 0 0"/><axis xyz="1 0 0"/>
        <limit lower="-0.1" upper="90" effort="100" velocity="1000"/></joint></robot>"""

    def replay(self, cables, positions):
        """Text of a replay in which the cable fails, and the path of its state."""
        messages = []
        for i, position in enumerate(positions):
            message = JointState(name=['travel'], position=[position])
            message.header.stamp = rospy.Time.from_sec(10 + i / 100)
            messages.append(('/joint_states', 10 + i / 100, message))
        for name, text in (('v.urdf', self.RIG), ('c.yaml', cables)):
            with open(self.path(name), 'w') as target:
                target.write(text)
        code, text = run('cable_replay', '--vehicle', self.path('v.urdf'), '--cables',
                         self.path('c.yaml'), '--bag', self.write_messages('in.bag', messages),
                         '--output', os.path.join(self.output_folder, 'out.bag'))
        self.assertEqual(code, 3, text)
        state, = glob.glob(os.path.join(self.output_folder, 'lead_*.failed.yaml'))
        self.assertIn('state in ' + state, text)
        return text, state

    def told(self, text):
        """What is said of the cable that stopped, without where its state is."""
        return re.search(r"cable 'lead' stopped at (.*)", text).group(1).split('; state in ')[0]

    def assert_fails_again(self, text, state, *more):
        code, again = run('cable_replay', '--resume-dump', state, *more)
        self.assertEqual(code, 3, again)
        self.assertEqual(self.told(again), self.told(text))
        self.assertIn('again, in the same words', again)

    # Torn away by 30 m within a sample.
    TORN = [0.0] * 40 + [30.0] * 10

    def test_a_step_fails_again(self):
        text, state = self.replay(self.ARCH % 'slider', self.TORN)
        self.assertIn("Newton's iteration does not converge", text)
        self.assert_fails_again(text, state)

    def test_a_step_beside_a_body_fails_again(self):
        cables = self.ARCH % 'slider' + '    avoid: [wall]\n'
        text, state = self.replay(cables, self.TORN)
        self.assert_fails_again(text, state)
        self.assert_fails_again(text, state, '--vehicle', self.path('v.urdf'))
        os.rename(self.path('v.urdf'), self.path('moved.urdf'))
        code, missing = run('cable_replay', '--resume-dump', state)
        self.assertEqual(code, 2, missing)
        self.assertIn('v.urdf', missing)
        self.assert_fails_again(text, state, '--vehicle', self.path('moved.urdf'))

    def test_one_with_memory_fails_again(self):
        cables = self.ARCH % 'slider' + """    extensions:
      maxwell: [{tau: 0.05, EI: 1.0e-3}]
      clamp_friction: {a: {stuck: 1.0, slip_moment: 1.0e-4, spring: 0.1}}
"""
        text, state = self.replay(cables, self.TORN)
        self.assert_fails_again(text, state)

    def test_other_states_are_told_apart(self):
        text, state = self.replay(self.ARCH % 'slider', self.TORN)
        with open(state) as source:
            content = source.read()
        damaged = self.path('damaged.failed.yaml')
        for old, new, code, words in (
                ('format: 2', 'format: 3', 2, 'expected 2'),
                ('message: ', 'message: "other" #', 0, 'here it fails otherwise'),
                ('elements: 40', 'elements: 41', 2, 'another model'),
                ('length: 0.4', 'length: -1', 2, 'length'),
                ('stamp_ns: ', 'stamp_ns: x', 2, 'stamp_ns'),
                ('state: |\n', 'state: |\n  00g\n', 2, 'hexadecimal')):
            self.assertIn(old, content)
            with open(damaged, 'w') as target:
                target.write(content.replace(old, new, 1))
            got, said = run('cable_replay', '--resume-dump', damaged)
            self.assertEqual(got, code, old + ': ' + said)
            self.assertIn(words, said)
        code, said = run('cable_replay', '--resume-dump', self.path('none.yaml'))
        self.assertEqual(code, 2, said)


if __name__ == '__main__':
    unittest.main()
