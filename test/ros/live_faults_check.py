#!/usr/bin/python3
"""Faults of transforms, joint states, clocks, subscribers and of the vehicle itself while a live node runs. Each has a
node of its own; they run at the same time, and the tests judge what each has published and printed."""
import math
import os
import signal
import socket
import subprocess
import sys
import threading
import time
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest
from live_node import CART, LEADS, TELEMETRY_RATE, LiveNode, pose
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

PERIOD = 0.02  # [s] of transforms
ERROR = 2  # level of a status
YEARS = 100000000  # [s]
RADIUS = 0.0025  # of the cables [m]

# The lead hangs between two jaws; the arm's closes.
PRESS = """<robot name="press">
  <link name="base_link"><collision><origin xyz="-0.03 0.1 0.87"/>
    <geometry><box size="0.04 0.3 0.1"/></geometry></collision></link>
  <link name="arm"><collision><origin xyz="0.05 0.1 0.87"/>
    <geometry><box size="0.04 0.3 0.1"/></geometry></collision></link>
  <joint name="slide" type="prismatic">
    <parent link="base_link"/> <child link="arm"/>
    <axis xyz="1 0 0"/> <limit lower="-1" upper="1" effort="1" velocity="100"/>
  </joint>
</robot>
"""
SECOND_PUBLISHER = """
import sys, time
sys.path.insert(0, %r)
import rospy
from live_node import pose
from tf2_msgs.msg import TFMessage
rospy.init_node('second', anonymous=True)
topic = rospy.Publisher(%r, TFMessage, queue_size=100)
while not rospy.is_shutdown():
    topic.publish(TFMessage([pose('odom', 'base_link', time.time(), 0.005)]))
    time.sleep(0.05)
"""


class Scenarios:
    """What is done to each node. Methods take it, and return when it can be judged."""

    def late(self, node):
        assert node.wait_for_text('waiting:')
        node.drive(2, period=PERIOD)

    def gaps(self, node):
        gaps = ((1, 1.03), (1.5, 1.6), (2, 2.5), (3, 8))
        node.drive(9.5, period=PERIOD, change=lambda t, messages: [] if any(
            begin < t < end for begin, end in gaps) else messages)

    def body_jump(self, node):
        def jump(t, messages):
            if t >= 1.5:
                messages[0].transform.translation.y += 1
            return messages
        node.drive(8.5, period=PERIOD, change=jump)

    def arm_jump(self, node):
        def jump(t, messages):
            if 1.5 <= t:
                messages[1].transform.translation.y += 1
            return messages
        node.drive(3, period=PERIOD, change=jump)

    def pulled_apart(self, node):
        def pull(t, messages):
            messages[1].transform.translation.y = max(0, t - 1)
            return messages
        node.drive(3, period=PERIOD, change=pull)

    def not_finite(self, node):
        def spoil(t, messages):
            i = round(t / PERIOD)
            rotation = messages[0].transform.rotation
            if i == 60:
                messages[0].transform.translation.y = math.nan
            elif i == 70:
                rotation.w = math.inf
            elif i == 80:
                rotation.w = 3
            elif i == 90:
                rotation.w = 0
            elif i > 100:
                # A length that is rounding's is none of these.
                rotation.w = 1 + 1e-6
            return messages
        node.drive(3, period=PERIOD, change=spoil)

    def two_publishers(self, node):
        text = SECOND_PUBLISHER % (os.path.dirname(os.path.abspath(__file__)), node.tf.resolved_name)
        second = subprocess.Popen([sys.executable, '-c', text])
        node.drive(5, period=PERIOD)
        second.terminate()
        second.wait()

    def static_instead(self, node):
        node.tf_static.publish(TFMessage([pose('base_link', 'arm', 0, 0)]))
        node.drive(1.5, period=PERIOD, change=lambda t, messages: messages[:1])
        # And then both, which contradict each other.
        def both(t, messages):
            messages[1].transform.translation.y = 0.01
            return messages
        node.drive(1, period=PERIOD, change=both)

    def missing_joint(self, node):
        def joints(t, messages):
            stamp = messages[0].header.stamp
            names = ['wheel'] if t < 1.5 or 3 <= t < 3.5 else ['wheel', 'slide']
            # As the body: 2 mm at 2 Hz.
            position = messages[0].transform.translation.y
            state = JointState(name=names, position=[position] * len(names))
            state.header.stamp = stamp
            node.joints.publish(state)
            return messages[:1]
        node.drive(5, period=PERIOD, change=joints)

    def clocks(self, node):
        begin = node.drive(1.5, period=PERIOD)
        node.drive(1.5, start=begin - 100, period=PERIOD)
        node.drive(1.5, start=begin + YEARS, period=PERIOD)

    def far_ahead(self, node):
        def ahead(t, messages):
            if round(t / PERIOD) in (2, 75):
                for message in messages:
                    message.header.stamp += rospy.Duration(YEARS)
            return messages
        node.drive(3, period=PERIOD, change=ahead)

    def frame_above(self, node):
        def above(t, messages):
            if t >= 1:
                late = pose('map', 'odom', messages[0].header.stamp.to_sec(), 5 if t < 2 else 6)
                messages.append(late)
            return messages
        node.drive(3, period=PERIOD, change=above)

    def loop(self, node):
        def loop(t, messages):
            if t < 0.3:
                messages[0].header.frame_id, messages[0].child_frame_id = 'base_link', 'odom'
            return messages
        node.drive(5, period=PERIOD, change=loop)

    def deaf(self, node):
        """A subscriber that connects, and never reads."""
        uri = rosgraph.Master('/deaf').lookupNode(node.name)
        topic = node.name.replace('cable_node', 'cables/lead/apex')
        _, _, (_, host, port) = xmlrpc.client.ServerProxy(uri).requestTopic(
            '/deaf', topic, [['TCPROS']])
        ear = socket.socket()
        ear.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        ear.connect((host, port))
        fields = [b'callerid=/deaf', b'topic=' + topic.encode(), b'md5sum=*',
                  b'type=cosserat_cable/ApexTelemetry']
        header = b''.join(len(field).to_bytes(4, 'little') + field for field in fields)
        ear.sendall(len(header).to_bytes(4, 'little') + header)
        node.drive(3, period=PERIOD)
        ear.close()

    def new_description(self, node):
        node.drive(1, period=PERIOD)
        rospy.set_param('/new_description/robot_description', '<robot name="other"/>')
        node.drive(2.5, period=PERIOD)

    def squeezed(self, node):
        """The jaws close to a fifth of the lead's diameter in a second, and open again."""
        def close(t, messages):
            messages[1].transform.translation.y = 0
            depth = max(0, min(t - 1, 3 - t, 1))
            messages[1].transform.translation.x = -0.039 * depth
            return messages
        node.drive(4, period=PERIOD, change=close)


# Parameters other than the usual ones.
ARGUMENTS = {
    'missing_joint': {'use_joint_states': True},
    'new_description': {'vehicle': None},
    'deaf': {'telemetry_rate': 1000},
    'squeezed': {'vehicle': PRESS, 'cables': LEADS.replace(
        'eta_EI: 1.0e-5', 'eta_EI: 1.0e-5\n    avoid: [base_link, arm]', 1).replace(
            'link: arm', 'link: base_link')},
}


class LiveFaults(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        # Each needs its clamps' links, and finds them on the parameter server.
        rospy.set_param('/new_description/robot_description', CART)
        names = [name for name in vars(Scenarios) if not name.startswith('_')]
        cls.nodes = {name: LiveNode(name, **ARGUMENTS.get(name, {})) for name in names}
        cls.ends = {}
        threads = [threading.Thread(target=cls.run_one, args=(name,)) for name in names]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    @classmethod
    def run_one(cls, name):
        node = cls.nodes[name]
        node.wait_until_listening()
        getattr(Scenarios(), name)(node)
        time.sleep(0.5)
        cls.ends[name] = node.stop(signal.SIGTERM)

    @classmethod
    def tearDownClass(cls):
        for node in cls.nodes.values():
            node.end()

    def judge(self, name, said=(), resets=0, code=0):
        """What holds for all: an orderly end, no value that is no number, and `lead` goes on."""
        self.assertIn(name, self.ends, 'it never ended')
        node = self.nodes[name]
        text = node.text()
        self.assertEqual(self.ends[name][0], code, text)
        self.assertLess(self.ends[name][1], 2)
        for words in said:
            self.assertIn(words, text)
        for messages in node.telemetry.values():
            for m in messages:
                self.assertTrue(math.isfinite(m.position_y + m.displacement_z + m.velocity_x +
                                              m.tension + m.curvature_max + m.amplitude), name)
        self.assertIn('published %d messages' % sum(map(len, node.telemetry.values())), text)
        if resets:
            self.assertIn('the cables settled anew %d times' % resets, text)
        else:
            self.assertNotIn('settled anew', text)
            self.goes_on(node, 'lead')
        return node

    def goes_on(self, node, cable, rate=TELEMETRY_RATE, seconds=1.0):
        """No sample of telemetry is missing."""
        stamps = node.stamps(cable)
        self.assertGreater(len(stamps), seconds * rate, node.text())
        for before, after in zip(stamps, stamps[1:]):
            self.assertAlmostEqual(after - before, 1 / rate, 6, node.name)

    def test_transforms_come_late(self):
        node = self.judge('late', ["waiting: joint 'slide' moves link 'arm', but neither /late/tf nor "
                                   '/late/joint_states drives it', 'running from'])
        self.assertTrue(node.said('node', 'waiting for transforms'))
        self.assertTrue(node.said('node', 'running'))

    def test_gaps_are_held_and_flagged(self):
        node = self.judge('gaps', ["cable 'lead' is held at", "cable 'lead' has resumed its motion at",
                                   'all cables held at', 'resumed at'])
        held = sum(m.held for m in node.telemetry['lead']) / TELEMETRY_RATE
        # Half a second and five; shorter gaps than a quarter of a second are no gaps.
        self.assertAlmostEqual(held, 5.5, delta=4 * PERIOD)
        self.assertTrue(node.said('node', 'no new motion'))
        self.assertTrue(node.said('input', 'gap'))
        self.assertGreater(node.stamps('lead')[-1] - node.stamps('lead')[0], 9)

    def test_a_body_that_jumps_is_told_and_cables_settle_anew(self):
        node = self.nodes['body_jump']
        self.assertEqual(self.ends['body_jump'][0], 3, node.text())
        self.assertIn('odom -> base_link (/body_jump/tf) jumps by 1 m', node.text())
        self.assertIn("cable 'lead' stopped at", node.text())
        # Nobody takes that for a run; and it is over five seconds later.
        self.assertIn((ERROR, "2 of 2 cables stopped; each one's status says why"),
                      [status[1:3] for status in node.statuses])
        for cable in ('lead', 'slack'):
            self.assertIn("cable '%s' settled anew at" % cable, node.text())
            stamps = node.stamps(cable)
            self.assertAlmostEqual(max(b - a for a, b in zip(stamps, stamps[1:])), 5, delta=0.3)
        self.assertEqual(node.status('node')[:2], (0, 'running'))
        for messages in node.telemetry.values():
            self.assertTrue(all(math.isfinite(m.position_y + m.tension) for m in messages))

    def test_an_arm_that_jumps_is_told(self):
        node = self.judge('arm_jump', ['base_link -> arm (/arm_jump/tf) jumps by 1 m',
                                       "cable 'slack' has its clamps up to"])
        self.assertTrue(node.said('input', 'jumps by 1 m'))
        self.goes_on(node, 'slack')

    def test_clamps_pulled_apart_are_told(self):
        node = self.judge('pulled_apart', ["cable 'slack' has its clamps up to", '% of its length'])
        self.assertTrue(node.said('input', "cable 'slack' has its clamps up to"))
        self.goes_on(node, 'slack')
        # Five times its length, and as taut.
        self.assertGreater(max(m.tension for m in node.telemetry['slack']), 1000)
        level, message, _ = node.status('lead')
        self.assertEqual((level, message), (0, 'swaying'))

    def test_poses_that_are_none_are_left_out(self):
        node = self.judge('not_finite', ['transform that is no rotation or not finite by '
                                         "/not_finite/tf: 4 (first: 'odom' -> 'base_link', its "
                                         'translation is not finite)'])
        self.goes_on(node, 'slack')
        self.assertFalse(any(m.held for m in node.telemetry['lead']))

    def test_two_publishers_are_named(self):
        node = self.judge('two_publishers', ['/live_faults', '/second_'])
        self.assertIn('publishers', node.text())

    def test_a_static_transform_instead_of_a_moving_one(self):
        node = self.judge('static_instead', ["frame 'arm' comes from two sources",
                                             '/static_instead/tf_static is kept'])
        self.goes_on(node, 'slack')

    def test_a_joint_that_is_missing(self):
        node = self.judge('missing_joint', ["joint 'slide' moves link 'arm', but neither",
                                            "joint not in the URDF: ", "'wheel'",
                                            "cable 'slack' is held at"])
        self.goes_on(node, 'slack')
        self.assertTrue(node.said('node', 'waiting for transforms'))
        # The lead hangs on the body alone.
        self.assertFalse(any(m.held for m in node.telemetry['lead']))

    def test_clocks_that_are_set_begin_anew(self):
        node = self.judge('clocks', ['time ran backwards', 'time jumped forward by 1e+08 s'], resets=2)
        stamps = node.stamps('lead')
        jumps = [b - a for a, b in zip(stamps, stamps[1:]) if abs(b - a - 1 / TELEMETRY_RATE) > 1e-6]
        self.assertEqual(len(jumps), 2)
        self.assertAlmostEqual(jumps[0], -100, delta=0.5)
        self.assertAlmostEqual(jumps[1], YEARS + 98.5, delta=0.5)
        self.assertGreater(len(stamps), 3 * TELEMETRY_RATE)

    def test_a_stamp_far_ahead_is_left_out(self):
        node = self.judge('far_ahead', ['sample with a bad stamp', 'by up to 1e+08 s'])
        self.goes_on(node, 'slack')

    def test_a_frame_above_that_comes_late_moves_nothing(self):
        node = self.judge('frame_above', ["inertial frame 'odom'",
                                          "began after the cables had settled in 'odom'"])
        self.goes_on(node, 'slack')

    def test_a_loop_of_a_moment_is_forgotten(self):
        node = self.judge('loop', ["'odom -> base_link' by /loop/tf closes a loop of frames",
                                   "'base_link' -> 'odom' is sent no more",
                                   "inertial frame 'odom'"], resets=1)
        self.assertGreater(len(node.stamps('lead')), 4 * TELEMETRY_RATE)

    def test_a_subscriber_that_does_not_read(self):
        node = self.nodes['deaf']
        self.assertEqual(self.ends['deaf'][0], 0, node.text())
        self.assertLess(self.ends['deaf'][1], 2)
        for cable in ('lead', 'slack'):
            self.goes_on(node, cable, rate=1000, seconds=2.5)

    def test_another_vehicle_on_the_parameter_server(self):
        node = self.judge('new_description', ['robot_description was replaced'])
        self.goes_on(node, 'slack')

    def test_a_cable_between_closing_bodies(self):
        node = self.judge('squeezed', ["cable 'lead' sinks by more than 5 % of its radius",
                                       'its contact forces are too small'])
        self.goes_on(node, 'slack', seconds=3)
        self.goes_on(node, 'lead', seconds=3)
        self.assertFalse(any(math.isnan(m.position_x + m.contact_force + m.clearance)
                             for m in node.telemetry['lead']))
        # The jaws are closer than the cable is thick; after they opened it may lie on one of them.
        clearances = [m.clearance for m in node.telemetry['lead']]
        self.assertLess(min(clearances), -0.5 * RADIUS)
        self.assertGreater(min(clearances[-TELEMETRY_RATE // 2:]), -0.05 * RADIUS)


if __name__ == '__main__':
    rospy.init_node('live_faults', disable_signals=True)
    rostest.rosrun('cosserat_cable', 'live_faults', LiveFaults)
