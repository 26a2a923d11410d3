"""For tests of the live node: starts one of its own beside others, moves its vehicle by transforms, and keeps all
that it publishes and prints. Clock: the machine's, or the stamps that a test makes up."""
import os
import signal
import subprocess
import tempfile
import threading
import time

import roslib.packages
import rospy
from cosserat_cable.msg import ApexTelemetry
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

# `lead` hangs on the body alone, `slack` between the body and an arm that slides along y.
CART = """<robot name="cart">
  <link name="base_link"/>
  <link name="arm"/>
  <joint name="slide" type="prismatic">
    <parent link="base_link"/> <child link="arm"/>
    <axis xyz="0 1 0"/> <limit lower="-1" upper="1" effort="1" velocity="100"/>
  </joint>
</robot>
"""
LEADS = """format: 1
cables:
  - name: lead
    length: 0.40
    diameter: 0.005
    mass_per_length: 0.03
    EI: 2.5e-3
    GJ: 2.5e-3
    eta_EI: 1.0e-5
    a: {link: base_link, pose: [0, 0, 1, 1, 0, 0, 0]}
    b: {link: base_link, pose: [0, 0.2, 1, 0, 0, 0, 1]}
  - name: slack
    length: 0.40
    diameter: 0.005
    mass_per_length: 0.03
    EI: 2.5e-3
    GJ: 2.5e-3
    eta_EI: 1.0e-5
    a: {link: base_link, pose: [0.5, 0, 1, 1, 0, 0, 0]}
    b: {link: arm, pose: [0.5, 0.2, 1, 0, 0, 0, 1]}
"""
RATE = 100  # [Hz] of transforms
TELEMETRY_RATE = 50  # [Hz]


def pose(parent, child, stamp, y, quaternion=(0, 0, 0, 1)):
    message = TransformStamped()
    message.header.stamp = rospy.Time.from_sec(stamp)
    message.header.frame_id, message.child_frame_id = parent, child
    message.transform.translation.y = y
    rotation = message.transform.rotation
    rotation.x, rotation.y, rotation.z, rotation.w = quaternion
    return message


def program():
    """The node, also in a build folder within the package, which rosrun overlooks."""
    return roslib.packages.find_node('cosserat_cable', 'cable_node')[0]


class LiveNode:
    """A cable_node in a namespace of its own."""

    def __init__(self, name, cables=LEADS, vehicle=CART, environment=None, **parameters):
        self.name = '/%s/cable_node' % name
        self.folder = tempfile.mkdtemp()
        values = {'telemetry_rate': TELEMETRY_RATE, 'tf': '/%s/tf' % name,
                  'joint_states': '/%s/joint_states' % name, 'threads': 1,
                  'dump_directory': self.folder}
        if cables:
            values['cables'] = self.write('cables.yaml', cables)
        if vehicle:
            values['vehicle'] = self.write('cart.urdf', vehicle)
        values.update(parameters)
        self.changed = threading.Condition()
        self.telemetry = {}  # by cable
        self.statuses = []  # (name, level, message, values)
        self.lines = {'stdout': [], 'stderr': []}
        self.tf = rospy.Publisher('/%s/tf' % name, TFMessage, queue_size=10000)
        self.tf_static = rospy.Publisher('/%s/tf_static' % name, TFMessage, queue_size=10,
                                         latch=True)
        self.joints = rospy.Publisher('/%s/joint_states' % name, JointState, queue_size=10000)
        for cable in ('lead', 'slack'):
            rospy.Subscriber('/%s/cables/%s/apex' % (name, cable), ApexTelemetry,
                             self.on_telemetry, callback_args=cable, queue_size=10000)
        rospy.Subscriber('/diagnostics', DiagnosticArray, self.on_diagnostics)
        self.process = subprocess.Popen(
            [program(), '__ns:=/' + name] + ['_%s:=%s' % pair for pair in sorted(values.items())],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True,
            env=dict(os.environ, **(environment or {})))
        self.readers = [threading.Thread(target=self.read, args=(stream,), daemon=True)
                        for stream in ('stdout', 'stderr')]
        for reader in self.readers:
            reader.start()

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, 'w') as target:
            target.write(text)
        return path

    def read(self, stream):
        for line in getattr(self.process, stream):
            with self.changed:
                self.lines[stream].append(line)
                self.changed.notify_all()

    def on_telemetry(self, message, cable):
        with self.changed:
            self.telemetry.setdefault(cable, []).append(message)
            self.changed.notify_all()

    def on_diagnostics(self, message):
        if message._connection_header['callerid'] != self.name:
            return
        with self.changed:
            for status in message.status:
                self.statuses.append((status.name.replace('cosserat_cable: ', ''), status.level,
                                      status.message, {v.key: v.value for v in status.values}))
            self.changed.notify_all()

    def text(self, stream=None):
        with self.changed:
            return ''.join(self.lines['stdout'] + self.lines['stderr'] if stream is None
                           else self.lines[stream])

    def wait(self, condition, timeout=10):
        with self.changed:
            return self.changed.wait_for(condition, timeout)

    def wait_for_text(self, words, timeout=10):
        return self.wait(lambda: words in ''.join(self.lines['stdout'] + self.lines['stderr']),
                         timeout)

    def wait_until_listening(self, timeout=10):
        """Until the node reads what is sent, and all that it sends is read."""
        self.wait_for_text('wait for the transforms', timeout)
        end = time.time() + timeout
        while self.tf.get_num_connections() == 0 and time.time() < end:
            time.sleep(0.01)
        # It has no way to say that this end has connected to it.
        time.sleep(0.3)

    def said(self, status, words):
        """Whether a status of this name ever had these words in its message or values."""
        with self.changed:
            return any(name == status and (words in message or words in ' '.join(
                '%s %s' % pair for pair in values.items()))
                       for name, _, message, values in self.statuses)

    def status(self, name):
        """The last one of this name: level, message, values."""
        with self.changed:
            return [s for s in self.statuses if s[0] == name][-1][1:]

    def stamps(self, cable):
        with self.changed:
            return [m.header.stamp.to_sec() for m in self.telemetry.get(cable, [])]

    def drive(self, seconds, start=None, change=None, period=1 / RATE, speed=1, clock=None):
        """Shakes the body by 2 mm at 2 Hz for so long, `speed` times as fast as the clock on the wall. Stamps
        count from `start`, the time where there is none. `change(t, messages)` returns what is sent instead.
        `clock` publishes the time. Returns the stamp at which it may go on."""
        begin = time.time()
        first = begin if start is None else start
        for i in range(int(round(seconds / period))):
            t = i * period
            phase = (t * 2) % 1
            shake = 0.002 * (4 * abs(phase - 0.5) - 1)
            messages = [pose('odom', 'base_link', first + t, shake),
                        pose('base_link', 'arm', first + t, 0)]
            if change:
                messages = change(t, messages)
            if clock:
                clock.publish(Clock(rospy.Time.from_sec(first + t)))
            if messages:
                self.tf.publish(TFMessage(messages))
            time.sleep(max(0, begin + (t + period) / speed - time.time()))
        return first + seconds

    def stop(self, number=signal.SIGINT):
        """Exit code, and how long it took."""
        begin = time.time()
        self.process.send_signal(number)
        try:
            code = self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            code = None
        took = time.time() - begin
        for reader in self.readers:
            reader.join(5)
        return code, took

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        for topic in (self.tf, self.tf_static, self.joints):
            topic.unregister()
        for name in os.listdir(self.folder):
            os.remove(os.path.join(self.folder, name))
        os.rmdir(self.folder)
