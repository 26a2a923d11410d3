#!/usr/bin/python3
"""apex_check on a bag: it passes only where a bound was given and held."""
import math
import os
import shutil
import socket
import subprocess
import tempfile
import time
import unittest
import xmlrpc.client

import rosbag
import rospy
from command_line import TOOLS
from cosserat_cable.msg import ApexTelemetry

NAN, INF = math.nan, math.inf


def free_port():
    with socket.socket() as probe:
        probe.bind(('localhost', 0))
        return probe.getsockname()[1]


class ApexCheck(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        port = free_port()
        cls.environment = dict(os.environ, ROS_MASTER_URI='http://localhost:%d' % port,
                               ROS_HOSTNAME='localhost', ROS_LOG_DIR=cls.folder)
        cls.core = subprocess.Popen(['rosmaster', '--core', '-p', str(port)], env=cls.environment,
                                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        cls.addClassCleanup(cls.core.wait)
        cls.addClassCleanup(cls.core.terminate)
        cls.master = xmlrpc.client.ServerProxy(cls.environment['ROS_MASTER_URI'])
        for _ in range(100):
            try:
                cls.master.getPid('/test')
                break
            except OSError:
                time.sleep(0.1)

    def record(self, **changed):
        """2 s of a cable that swings by 4 mm; `changed` is what one message says otherwise."""
        path = os.path.join(self.folder, 'apex.bag')
        with rosbag.Bag(path, 'w') as bag:
            for i in range(401):
                message = ApexTelemetry(position_y=0.002 * math.sin(0.3 * i), clearance=0.01,
                                        curvature_max=5, bodies=1)
                message.header.stamp = rospy.Time.from_sec(1000 + i / 200)
                if i == 200:
                    for field, value in changed.items():
                        setattr(message, field, value)
                bag.write('/cables/hose/apex', message, message.header.stamp)
        return path

    def check(self, bag, **bounds):
        for key in self.master.getParamNames('/test')[2]:
            if key.startswith('/apex_check/'):
                self.master.deleteParam('/test', key)
        for key, value in dict(bounds, bag=bag, cable='hose').items():
            self.master.setParam('/test', '/apex_check/' + key, value)
        done = subprocess.run([os.path.join(TOOLS, 'apex_check')], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True, timeout=60,
                              env=self.environment)
        return done.returncode, done.stdout

    def fails(self, words, bag, **bounds):
        code, text = self.check(bag, **bounds)
        self.assertEqual(code, 1, text)
        self.assertIn(words, text)

    def test_a_bound_that_holds_passes(self):
        bag = self.record()
        code, text = self.check(bag, peak_to_peak_max=0.0041, max_curvature=6.0)
        self.assertEqual(code, 0, text)
        self.fails('peak to peak', bag, peak_to_peak_max=0.0039)

    def test_nothing_that_is_judged_does_not_pass(self):
        bag = self.record()
        self.fails('no bound is given', bag)
        self.fails('no bound is given', bag, start=0.5)
        self.fails('did you mean', bag, max_curvatur=6.0)

    def test_bounds_that_are_not_finite_do_not_pass(self):
        bag = self.record()
        for bound in ('peak_to_peak_max', 'max_curvature', 'min_clearance', 'start', 'end'):
            self.fails(bound + ': got nan', bag, max_interval=1.0, **{bound: NAN})
        for bound in ('peak_to_peak_max', 'max_curvature', 'start'):
            self.fails(bound + ': got inf', bag, max_interval=1.0, **{bound: INF})
        self.fails('silence', bag, max_interval=1.0, silence=NAN)
        code, text = self.check(bag, max_interval=1.0, end=INF)
        self.assertEqual(code, 0, text)

    def test_telemetry_that_is_not_finite_does_not_pass(self):
        for field in ('position_y', 'velocity_x', 'curvature_max', 'clearance', 'contact_force'):
            bag = self.record(**{field: NAN})
            self.fails('1 of 401 messages', bag, peak_to_peak_max=1.0, max_curvature=100.0,
                       max_penetration=1.0, max_contact_force=1.0)

    def test_a_bag_that_is_cut_fails_in_words(self):
        with open(self.record(), 'rb') as whole:
            content = whole.read()
        cut = os.path.join(self.folder, 'cut.bag')
        for part in range(0, 100, 9):
            with open(cut, 'wb') as file:
                file.write(content[:len(content) * part // 100])
            self.fails('cut.bag', cut, max_curvature=6.0)


if __name__ == '__main__':
    unittest.main()
