#!/usr/bin/python3
"""A node that cannot keep up with the clock says so, leaves out markers, and no sample of telemetry."""
import threading
import unittest

import rospy
import rostest
from cosserat_cable.msg import ApexTelemetry
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from visualization_msgs.msg import MarkerArray

SECONDS = 3  # of the recording's 4 have to come
TELEMETRY_RATE = 200  # [Hz]
MARKER_RATE = 30  # [Hz]
TIMEOUT = 150


class Behind(unittest.TestCase):

    def setUp(self):
        self.changed = threading.Condition()
        self.stamps = []  # of telemetry [ns]
        self.markers = 0
        self.behind = None  # values of the node's status when it said so
        rospy.Subscriber('cables/cable/apex', ApexTelemetry, self.on_telemetry, queue_size=10000)
        rospy.Subscriber('cables/cable/markers', MarkerArray, self.on_markers, queue_size=1000)
        rospy.Subscriber('/diagnostics', DiagnosticArray, self.on_diagnostics)

    def on_telemetry(self, message):
        with self.changed:
            self.stamps.append(message.header.stamp.to_nsec())
            self.changed.notify()

    def on_markers(self, _):
        self.markers += 1

    def on_diagnostics(self, message):
        for status in message.status:
            if status.name == 'cosserat_cable: node' and 'behind' in status.message:
                self.assertEqual(status.level, DiagnosticStatus.WARN)
                self.behind = {pair.key: float(pair.value) for pair in status.values}

    def test_markers_are_left_out_and_telemetry_is_not(self):
        with self.changed:
            enough = self.changed.wait_for(
                lambda: self.stamps and self.stamps[-1] - self.stamps[0] > SECONDS * 1e9, TIMEOUT)
        self.assertTrue(enough, 'only %d samples came' % len(self.stamps))
        self.assertEqual({b - a for a, b in zip(self.stamps, self.stamps[1:])},
                         {10**9 // TELEMETRY_RATE})
        self.assertIsNotNone(self.behind, 'it never said that it is behind')
        self.assertGreater(self.behind['worst latency [s]'], 0.5)
        self.assertGreater(self.behind['real-time factor'], 0)
        self.assertLess(self.behind['real-time factor'], 2)
        self.assertLess(self.markers, 0.8 * SECONDS * MARKER_RATE)


if __name__ == '__main__':
    rospy.init_node('behind_check')
    rostest.rosrun('cosserat_cable', 'behind', Behind)
