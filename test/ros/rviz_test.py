#!/usr/bin/python3
"""rviz on a virtual screen shows the cables of the ride: their colours are in the picture."""
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

SOURCE = os.environ['COSSERAT_CABLE_SOURCE_DIR']
RIDE_BAG = os.path.join(SOURCE, 'test', 'data', 'ride.bag')
# A port of its own, so that tests may run side by side.
MASTER = 'http://localhost:11397'
# The viridis map at 0, 1/8, ... 1; light and shade scale a colour but keep its direction.
VIRIDIS = [(0.267, 0.005, 0.329), (0.279, 0.175, 0.483), (0.230, 0.322, 0.546),
           (0.173, 0.449, 0.558), (0.128, 0.567, 0.551), (0.158, 0.684, 0.502),
           (0.369, 0.789, 0.383), (0.678, 0.864, 0.190), (0.993, 0.906, 0.144)]
# Two hoses of some 10 pixels width and 200 length are in view; a tenth of that is asked for.
MIN_PIXELS = 400
START_TIMEOUT = 90
TRIES = 20


def cable_pixels(picture):
    """Number of pixels whose colour is a shade of a colour of the map."""
    histogram = subprocess.run(['convert', picture, '-format', '%c', 'histogram:info:-'],
                               stdout=subprocess.PIPE, check=True,
                               universal_newlines=True).stdout
    count = 0
    for line in histogram.splitlines():
        match = re.match(r'\s*(\d+):\s*\(\s*(\d+),\s*(\d+),\s*(\d+)', line)
        if not match:
            continue
        pixels, *rgb = (int(group) for group in match.groups())
        if max(rgb) < 40 or min(rgb) > 0.7 * max(rgb):  # black, or grey as everything else
            continue
        norm = sum(c * c for c in rgb) ** 0.5
        for color in VIRIDIS:
            along = sum(a * b for a, b in zip(rgb, color)) / sum(c * c for c in color) ** 0.5
            if along > 0.985 * norm:
                count += pixels
                break
    return count


class Rviz(unittest.TestCase):

    def setUp(self):
        for tool in ('rviz', 'Xvfb', 'xvfb-run', 'convert', 'import'):
            if shutil.which(tool) is None and not os.path.exists('/usr/lib/rviz/' + tool):
                self.skipTest('needs ' + tool)
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def test_cables_are_in_the_picture(self):
        picture = os.environ.get('COSSERAT_CABLE_SCREENSHOT',
                                 os.path.join(self.folder, 'rviz.png'))
        environment = dict(os.environ, ROS_MASTER_URI=MASTER, ROS_HOSTNAME='localhost',
                           ROS_LOG_DIR=self.folder, LIBGL_ALWAYS_SOFTWARE='1')
        ready = os.path.join(self.folder, 'display')
        # xvfb-run chooses the display; the shell inside says which.
        launch = ('echo "$DISPLAY $XAUTHORITY" > %s; exec roslaunch -p %s cosserat_cable '
                  'replay.launch bag:=%s rviz:=true rate:=0.25 loop:=true' %
                  (ready, MASTER.rsplit(':', 1)[1], RIDE_BAG))
        with open(os.path.join(self.folder, 'log'), 'w') as log:
            process = subprocess.Popen(
                ['xvfb-run', '-a', '-s', '-screen 0 1280x720x24', 'sh', '-c', launch],
                env=environment, stdout=log, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            deadline = time.time() + START_TIMEOUT
            most = 0
            for _ in range(TRIES):
                time.sleep(3)
                if process.poll() is not None or time.time() > deadline:
                    break
                if not os.path.exists(ready):
                    continue
                with open(ready) as file:
                    display, authority = (file.read().split() + ['', ''])[:2]
                shot = subprocess.run(['import', '-window', 'root', picture],
                                      env=dict(environment, DISPLAY=display,
                                               XAUTHORITY=authority))
                if shot.returncode == 0:
                    most = max(most, cable_pixels(picture))
                if most >= MIN_PIXELS:
                    break
            with open(os.path.join(self.folder, 'log')) as log:
                text = log.read()
            self.assertGreaterEqual(most, MIN_PIXELS, text[-3000:])
        finally:
            os.killpg(process.pid, signal.SIGTERM)
            process.wait(30)


if __name__ == '__main__':
    unittest.main(verbosity=2)
