#!/usr/bin/python3
"""The ROS master is killed and started again: what is connected goes on, the node says so, and is known to the new one."""
import os
import signal
import socket
import subprocess
import time
import unittest

import live_node
import rosgraph
import rospy
import rostest


def free_port():
    with socket.socket() as probe:
        probe.bind(('localhost', 0))
        return probe.getsockname()[1]


class MasterRestart(unittest.TestCase):

    def start_master(self):
        # With a run id as roscore gives it, and without its /rosout.
        master = subprocess.Popen(['rosmaster', '--core', '-p', str(self.port)],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(self.kill, master)
        end = time.time() + 10
        while time.time() < end:
            try:
                handle = rosgraph.Master('/test')
                handle.setParam('/run_id', 'run %d' % master.pid)
                return master
            except socket.error:
                time.sleep(0.05)
        self.fail('no master came up')

    @staticmethod
    def kill(process):
        process.kill()
        process.wait()

    def test_the_node_goes_on_and_is_registered_anew(self):
        self.port = free_port()
        os.environ['ROS_MASTER_URI'] = 'http://localhost:%d' % self.port
        # The node waits for the master, says so, and can be stopped meanwhile.
        early = subprocess.Popen([live_node.program()], stderr=subprocess.PIPE, universal_newlines=True)
        self.assertIn('waiting for the ROS master at http://localhost:%d' % self.port,
                      early.stderr.readline())
        begin = time.time()
        early.send_signal(signal.SIGINT)
        early.communicate(timeout=10)
        self.assertLess(time.time() - begin, 2)

        first = self.start_master()
        rospy.init_node('master_restart', disable_signals=True)
        node = live_node.LiveNode('survivor')
        self.addCleanup(node.end)
        node.wait_until_listening()
        begin = node.drive(1)
        self.kill(first)
        begin = node.drive(1.5, start=begin)
        self.assertTrue(node.wait_for_text('is gone: what is connected goes on'))
        self.start_master()
        node.drive(2.5, start=begin)
        self.assertTrue(node.wait_for_text("the ROS master was restarted: this node's topics"))
        publishers, subscribers, _ = rosgraph.Master('/test').getSystemState()
        known = {topic for topic, nodes in publishers if node.name in nodes}
        self.assertLessEqual({'/survivor/cables/lead/apex', '/survivor/cables/slack/apex',
                              '/survivor/cables/markers', '/diagnostics'}, known)
        known = {topic for topic, nodes in subscribers if node.name in nodes}
        self.assertLessEqual({'/survivor/tf', '/survivor/tf_static'}, known)
        code, took = node.stop(signal.SIGTERM)
        self.assertEqual(code, 0, node.text())
        self.assertLess(took, 3)
        stamps = node.stamps('lead')
        self.assertGreater(stamps[-1] - stamps[0], 4.8)
        for before, after in zip(stamps, stamps[1:]):
            self.assertAlmostEqual(after - before, 1 / live_node.TELEMETRY_RATE, 6)


if __name__ == '__main__':
    rostest.rosrun('cosserat_cable', 'master_restart', MasterRestart)
