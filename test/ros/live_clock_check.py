#!/usr/bin/python3
"""A live node under simulated time: slow, paused and fast as `rosbag play -r` makes it; and one that is stopped before
it has caught up."""
import signal
import time
import unittest

import rospy
import rostest
from live_node import LEADS, LiveNode
from rosgraph_msgs.msg import Clock

START = 1000  # [s]
RATE = 200  # [Hz] of telemetry
FAST = 10
SECONDS = 20  # of simulated time, at the fast rate


class LiveClock(unittest.TestCase):

    def setUp(self):
        self.clock = rospy.Publisher('/clock', Clock, queue_size=1000)

    def start(self, name, **arguments):
        node = LiveNode(name, telemetry_rate=RATE, **arguments)
        self.addCleanup(node.end)
        node.wait_until_listening()
        return node

    def test_slow_paused_and_fast(self):
        node = self.start('rates')
        now = node.drive(0.5, start=START, clock=self.clock)
        with node.changed:
            del node.statuses[:]
        # At a tenth, simulated diagnostics come once in ten seconds; the state comes once in one.
        now = node.drive(0.3, start=now, clock=self.clock, speed=0.1)
        states = {message for name, _, message, _ in node.statuses if name == 'node'}
        self.assertEqual(states, {'running'})
        # A pause is told, and that it ended.
        self.assertTrue(node.wait_for_text('all cables held at', 3))
        self.assertTrue(node.wait(lambda: any('no new motion' in s[2] for s in node.statuses), 3))
        now = node.drive(SECONDS, start=now, clock=self.clock, speed=FAST)
        self.assertTrue(node.wait_for_text('resumed at', 3))
        # A busy machine is behind for a while: what is interrupted by then is not simulated.
        node.wait(lambda: all(stamps and stamps[-1] - stamps[0] > now - START - 0.02
                              for stamps in map(node.stamps, ('lead', 'slack'))), 5)
        code, took = node.stop(signal.SIGINT)
        self.assertEqual(code, 0, node.text())
        self.assertLess(took, 2)
        # From the first sample to the last none is lost, though they came ten times as fast.
        for cable in ('lead', 'slack'):
            stamps = node.stamps(cable)
            self.assertEqual({round((b - a) * RATE, 3) for a, b in zip(stamps, stamps[1:])}, {1})
            self.assertAlmostEqual(stamps[-1] - stamps[0], now - START, delta=0.02)

    def test_what_was_not_simulated_is_told(self):
        # A hundred times the steps, of cables with five times the elements.
        node = self.start('late', dt=1e-5,
                          cables=LEADS.replace('    GJ', '    elements: 200\n    GJ'))
        now = node.drive(3, start=START, clock=self.clock, speed=2)
        code, took = node.stop(signal.SIGINT)
        self.assertLess(took, 2)
        self.assertEqual(code, 130, node.text())
        last = max(node.stamps('lead'), default=START)
        self.assertLess(last, now - 0.5)
        self.assertIn('s before the end of the motion', node.text('stderr'))
        # What was simulated is there.
        self.assertIn('amplitude', node.text('stdout'))


if __name__ == '__main__':
    rospy.init_node('live_clock', disable_signals=True)
    rostest.rosrun('cosserat_cable', 'live_clock', LiveClock)
