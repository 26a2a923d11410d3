#!/usr/bin/python3
"""rviz on a virtual screen shows the cables of the ride: their colours are in the picture, and were not there
before the cables were."""
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest

import numpy

SOURCE = os.environ['COSSERAT_CABLE_SOURCE_DIR']
TOOLS = os.environ['COSSERAT_CABLE_TOOLS_DIR']
RIDE_BAG = os.path.join(SOURCE, 'test', 'data', 'ride.bag')
# The viridis map at 0, 1/8, ... 1; light and shade scale a colour but keep its direction.
VIRIDIS = numpy.array([(0.267, 0.005, 0.329), (0.279, 0.175, 0.483), (0.230, 0.322, 0.546),
                       (0.173, 0.449, 0.558), (0.128, 0.567, 0.551), (0.158, 0.684, 0.502),
                       (0.369, 0.789, 0.383), (0.678, 0.864, 0.190), (0.993, 0.906, 0.144)])
# Cosine of the angle to a colour of the map: neighbours on the map are about twice as far apart.
SAME_COLOR = 0.985
# A hose is some 10 pixels wide and 400 long in the picture, a sensor cable half of that: 5000 pixels. Half of
# them may be behind something or in the shade.
MIN_PIXELS = 2500
# The curvature varies along a cable: that many of the map's nine colours are to be seen, each on the length of
# a hose's own width at least.
MIN_COLORS = 4
MIN_PIXELS_PER_COLOR = 100
# Without cables, what is blended of the car's own colours.
MAX_PIXELS_WITHOUT = 250
# The car covers a good part of the picture: something else than background is on so much of it.
MIN_CAR_SHARE = 0.2
TIMEOUT = 45  # [s], until a picture is as expected


def free_port():
    with socket.socket() as probe:
        probe.bind(('localhost', 0))
        return probe.getsockname()[1]


class Picture:
    """What is on the screen below the tool bar, as colours in [0, 255]."""

    def __init__(self, path):
        size = subprocess.run(['identify', '-format', '%w %h', path], stdout=subprocess.PIPE,
                              check=True, universal_newlines=True).stdout.split()
        raw = subprocess.run(['convert', path, '-depth', '8', 'rgb:-'], stdout=subprocess.PIPE,
                             check=True).stdout
        image = numpy.frombuffer(raw, numpy.uint8).reshape(int(size[1]), int(size[0]), 3)
        self.pixels = image[70:-40, 30:-30].reshape(-1, 3).astype(float)

    def car_share(self):
        """Share of pixels that differ from the commonest colour."""
        codes = self.pixels @ [65536, 256, 1]
        values, counts = numpy.unique(codes, return_counts=True)
        return 1 - counts.max() / codes.size if values.size > 1 else 0

    def cable_pixels(self):
        """Number of pixels of each of the map's colours, whatever their brightness."""
        largest, least = self.pixels.max(axis=1), self.pixels.min(axis=1)
        # Neither black nor grey.
        colored = self.pixels[(largest > 40) & (least < 0.7 * largest)]
        if not colored.size:
            return numpy.zeros(len(VIRIDIS), int)
        directions = VIRIDIS / numpy.linalg.norm(VIRIDIS, axis=1, keepdims=True)
        cosines = (colored / numpy.linalg.norm(colored, axis=1, keepdims=True)) @ directions.T
        best = cosines.argmax(axis=1)[cosines.max(axis=1) > SAME_COLOR]
        return numpy.bincount(best, minlength=len(VIRIDIS))


class Rviz(unittest.TestCase):

    def setUp(self):
        for tool in ('rviz', 'Xvfb', 'xvfb-run', 'convert', 'import'):
            if shutil.which(tool) is None and not os.path.exists('/usr/lib/rviz/' + tool):
                self.skipTest('needs ' + tool)
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.port = free_port()
        self.environment = dict(os.environ, ROS_MASTER_URI='http://localhost:%d' % self.port,
                                ROS_HOSTNAME='localhost', ROS_LOG_DIR=self.folder,
                                LIBGL_ALWAYS_SOFTWARE='1', QT_X11_NO_MITSHM='1')

    def start_rviz(self):
        """The recording runs and rviz looks at it, but nobody simulates cables."""
        ready = os.path.join(self.folder, 'ready')
        # xvfb-run chooses the display; the shell inside says which, and becomes roslaunch.
        launch = ('echo "$$ $DISPLAY $XAUTHORITY" > %s; exec roslaunch -p %d cosserat_cable '
                  'replay.launch bag:=%s rviz:=true simulate:=false rate:=0.2' %
                  (ready, self.port, RIDE_BAG))
        with open(os.path.join(self.folder, 'log'), 'w') as log:
            screen = subprocess.Popen(
                ['xvfb-run', '-a', '-s', '-screen 0 1280x720x24', 'sh', '-c', launch],
                env=self.environment, stdout=log, stderr=subprocess.STDOUT, start_new_session=True)
        self.addCleanup(self.stop, screen)
        deadline = time.time() + TIMEOUT
        words = []
        while len(words) < 2 and time.time() < deadline and screen.poll() is None:
            time.sleep(0.1)
            if os.path.exists(ready):
                with open(ready) as file:
                    words = file.read().split()
        self.assertGreaterEqual(len(words), 2, self.log())
        # roslaunch ends its nodes, then xvfb-run the screen.
        self.addCleanup(self.terminate, int(words[0]))
        self.environment['DISPLAY'] = words[1]
        if len(words) > 2:
            self.environment['XAUTHORITY'] = words[2]

    @staticmethod
    def terminate(pid):
        try:
            os.kill(pid, signal.SIGTERM)
        except ProcessLookupError:
            pass

    @staticmethod
    def stop(process):
        try:
            process.wait(20)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()

    def start_cables(self):
        with open(os.path.join(self.folder, 'log'), 'a') as log:
            node = subprocess.Popen(
                [os.path.join(TOOLS, 'cable_node'),
                 '_vehicle:=' + os.path.join(SOURCE, 'urdf', 'car.urdf'),
                 '_cables:=' + os.path.join(SOURCE, 'config', 'cables', 'car.yaml')],
                env=self.environment, stdout=log, stderr=subprocess.STDOUT, cwd=self.folder)
        self.addCleanup(self.stop, node)
        self.addCleanup(node.terminate)

    def log(self):
        with open(os.path.join(self.folder, 'log')) as log:
            return log.read()[-3000:]

    def shoot_until(self, path, good):
        """The first picture that is good, or the last within the time."""
        deadline = time.time() + TIMEOUT
        while True:
            time.sleep(1)
            done = subprocess.run(['import', '-window', 'root', path], env=self.environment,
                                  stderr=subprocess.DEVNULL)
            picture = Picture(path) if done.returncode == 0 else None
            if (picture and good(picture)) or time.time() > deadline:
                self.assertIsNotNone(picture, self.log())
                return picture

    def test_cables_are_in_the_picture(self):
        path = os.environ.get('COSSERAT_CABLE_SCREENSHOT', os.path.join(self.folder, 'rviz.png'))
        self.start_rviz()
        without = self.shoot_until(path, lambda p: p.car_share() > MIN_CAR_SHARE)
        self.assertGreater(without.car_share(), MIN_CAR_SHARE, self.log())
        self.assertLess(without.cable_pixels().sum(), MAX_PIXELS_WITHOUT, without.cable_pixels())

        def shows_cables(picture):
            pixels = picture.cable_pixels()
            return (pixels.sum() >= MIN_PIXELS and
                    (pixels >= MIN_PIXELS_PER_COLOR).sum() >= MIN_COLORS)

        self.start_cables()
        picture = self.shoot_until(path, shows_cables)
        print('pixels of the colours without cables:', without.cable_pixels(),
              'with cables:', picture.cable_pixels())
        self.assertTrue(shows_cables(picture), '%s\n%s' % (picture.cable_pixels(), self.log()))


if __name__ == '__main__':
    unittest.main(verbosity=2)
