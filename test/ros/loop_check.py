#!/usr/bin/python3
"""With a recording that starts over again and again, the cable settles to rest and sways as before each time."""
import threading
import unittest

import rospy
import rostest
from cosserat_cable.msg import ApexTelemetry
from diagnostic_msgs.msg import DiagnosticArray

PASSES = 3
# Each pass has 2.5 s of the recording; at its end the last samples wait for later ones.
SECONDS = 2.4
RATE = 200  # [Hz] of telemetry
TIMEOUT = 40
# A settled cable is at the equilibrium's tolerance, and the first step has moved it by next to nothing [m].
REST_TOLERANCE = 1e-6
# The same input gives the same bits, and no pass but the first can have lost any [m].
REPEAT_TOLERANCE = 0
# The first pass may have lost samples before the subscriptions stood; forgotten after a second [m].
FIRST_PASS_TOLERANCE = 1e-6


class Loop(unittest.TestCase):

    def setUp(self):
        self.changed = threading.Condition()
        self.passes = []  # telemetry by stamp [ns]
        self.last_stamp = None
        self.resets = 0
        rospy.Subscriber('cables/cable/apex', ApexTelemetry, self.on_telemetry, queue_size=10000)
        rospy.Subscriber('/diagnostics', DiagnosticArray, self.on_diagnostics)

    def on_telemetry(self, message):
        with self.changed:
            stamp = message.header.stamp.to_nsec()
            if self.last_stamp is None or stamp <= self.last_stamp:
                self.passes.append({})
            self.passes[-1][stamp] = message
            self.last_stamp = stamp
            self.changed.notify()

    def on_diagnostics(self, message):
        for status in message.status:
            if status.name == 'cosserat_cable: input':
                for pair in status.values:
                    if pair.key == 'resets':
                        self.resets = int(pair.value)

    def distance(self, first, second, start):
        """Largest difference of two passes' positions, and how many stamps are in both."""
        begin = min(second)
        both = [s for s in first if s in second and s >= begin + start * 1e9]
        return max(max(abs(first[s].position_x - second[s].position_x),
                       abs(first[s].position_y - second[s].position_y),
                       abs(first[s].position_z - second[s].position_z)) for s in both), len(both)

    def test_each_pass_is_like_the_first(self):
        with self.changed:
            done = self.changed.wait_for(lambda: len(self.passes) > PASSES, TIMEOUT)
        self.assertTrue(done, 'only %d passes began' % len(self.passes))
        passes = self.passes[:PASSES]
        for messages in passes[1:]:
            self.assertGreaterEqual(len(messages), SECONDS * RATE)
            stamps = sorted(messages)
            self.assertEqual({b - a for a, b in zip(stamps, stamps[1:])}, {10**9 // RATE})
            start = messages[stamps[0]]
            self.assertLess(max(abs(start.displacement_x), abs(start.displacement_y),
                                abs(start.displacement_z)), REST_TOLERANCE)
            self.assertGreater(max(abs(m.displacement_x) for m in messages.values()), 1e-3)
        distance, both = self.distance(passes[1], passes[2], 0)
        self.assertGreaterEqual(both, SECONDS * RATE)
        self.assertLessEqual(distance, REPEAT_TOLERANCE)
        distance, both = self.distance(passes[0], passes[1], 1)
        self.assertGreaterEqual(both, (SECONDS - 1) * RATE)
        self.assertLess(distance, FIRST_PASS_TOLERANCE)
        # Diagnostics come once a second: those of the fourth pass are not there yet.
        self.assertGreaterEqual(self.resets, PASSES - 1)


if __name__ == '__main__':
    rospy.init_node('loop_check')
    rostest.rosrun('cosserat_cable', 'loop', Loop)
