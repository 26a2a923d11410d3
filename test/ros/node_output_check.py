#!/usr/bin/python3
"""The live node says on the console what it simulates, what is wrong with its input, what state it is in, and at the
end, also after SIGTERM and SIGINT, what came of it."""
import signal
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest
from live_node import LEADS, RATE, TELEMETRY_RATE, LiveNode

STOP_WITHIN = 2  # [s]


class NodeOutput(unittest.TestCase):

    def start(self, name, **arguments):
        node = LiveNode(name, **arguments)
        self.addCleanup(node.end)
        return node

    def test_a_run_is_told_from_start_to_end(self):
        node = self.start('told')
        # Nothing moves yet: it says what is missing.
        self.assertTrue(node.wait_for_text("joint 'slide' moves link 'arm'"))
        node.wait_until_listening()
        node.drive(1)
        # Transforms stop for longer than a second, and go on.
        self.assertTrue(node.wait_for_text('all cables held at'))
        node.drive(0.5)
        self.assertTrue(node.wait_for_text('resumed at'))
        code, took = node.stop(signal.SIGTERM)
        self.assertEqual(code, 0, node.text())
        self.assertLess(took, STOP_WITHIN)
        text = node.text('stdout')
        for words in ('cart.urdf', "root 'base_link'", "cable 'lead': 'base_link' to 'base_link'",
                      "cable 'slack': 'base_link' to 'arm'", 'step 1 ms', 'telemetry 50 Hz', '/tf',
                      'running from', "inertial frame 'odom'", 'amplitude', 'real-time factor'):
            self.assertIn(words, text)
        published = sum(len(messages) for messages in node.telemetry.values())
        self.assertIn('published %d messages of telemetry' % published, text)

    def test_an_interrupt_leaves_the_summary_too(self):
        node = self.start('interrupted')
        node.wait_until_listening()
        end = node.drive(0.5)
        # One link stops, the other goes on: no reason to call the node late.
        node.drive(1, start=end, change=lambda t, messages: messages[:1])
        code, took = node.stop(signal.SIGINT)
        self.assertEqual(code, 0, node.text())
        self.assertLess(took, STOP_WITHIN)
        self.assertIn('amplitude', node.text('stdout'))
        # The motion curve waits for later samples, and the end is not cut off for it.
        self.assertGreater(node.stamps('lead')[-1], end - 2 / RATE - 1 / TELEMETRY_RATE)

    def test_rosnode_kill_leaves_the_summary_too(self):
        node = self.start('killed')
        node.wait_until_listening()
        node.drive(0.5)
        uri = rosgraph.Master('/node_output').lookupNode(node.name)
        xmlrpc.client.ServerProxy(uri).shutdown('/node_output', 'a test')
        self.assertEqual(node.process.wait(3), 0, node.text())
        for reader in node.readers:
            reader.join(5)
        self.assertIn('amplitude', node.text('stdout'))

    def test_all_of_bad_input_is_on_stderr(self):
        node = self.start('bad', cables=LEADS.replace('EI: 2.5e-3', 'EI: -1', 1).replace(
            '    diameter', '    diametre', 1), dt=3, threads=-4, gravity='down', smooth='much')
        self.assertEqual(node.process.wait(10), 2)
        node.readers[1].join(5)
        for words in ("/bad/cable_node/gravity: got 'down'", '/bad/cable_node/smooth: expected a number',
                      'dt: got 3', 'threads: got -4', 'cables.yaml:7: cables[0].EI: got -1',
                      "cables.yaml:5: cables[0].diametre: got an unknown key, did you mean 'diameter'?"):
            self.assertIn(words, node.text('stderr'))

    def test_parameters_of_another_type_are_all_named(self):
        node = self.start('types', dt='fast', threads='[1, 2]', hold_joints='slide', cables=None,
                          amplitude_frame='sideways')
        self.assertEqual(node.process.wait(10), 2)
        node.readers[1].join(5)
        for words in ('/types/cable_node/dt: expected a number', '/types/cable_node/threads',
                      '/types/cable_node/hold_joints: expected a list',
                      "amplitude_frame: got 'sideways'", '/types/cable_node/cables: missing'):
            self.assertIn(words, node.text('stderr'))

    def test_absurd_numbers_are_refused(self):
        node = self.start('numbers', dt=-1e-3, max_gap=1e9, telemetry_rate=-5,
                          amplitude_window=-1, smooth=1e9, clearance_reach=0)
        self.assertEqual(node.process.wait(10), 2)
        node.readers[1].join(5)
        for words in ('dt: got -0.001', 'max_gap: got 1e+09', 'telemetry_rate: got -5',
                      'amplitude_window: got -1', 'smooth: got 1e+09', 'clearance_reach: got 0'):
            self.assertIn(words, node.text('stderr'))


if __name__ == '__main__':
    rospy.init_node('node_output_check')
    rostest.rosrun('cosserat_cable', 'node_output', NodeOutput)
