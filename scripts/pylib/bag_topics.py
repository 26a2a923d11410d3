"""What the topics of a bag measured, as series over time: poses, and single numbers."""

import math
import sys

import numpy as np

import tool

try:
    import rosbag
except ImportError as error:
    sys.exit(f'{error}: install python3-rosbag and run with /usr/bin/python3')

TF_TYPES = ('tf2_msgs/TFMessage', 'tf/tfMessage')
AXES = 'xyz'


def vector(v):
    return [v.x, v.y, v.z]


def quaternion(q):
    return [q.x, q.y, q.z, q.w]


# Position and, where there is one, rotation of what the message is about.
POSES = {
    'geometry_msgs/PoseStamped': lambda m: vector(m.pose.position) + quaternion(m.pose.orientation),
    'geometry_msgs/Pose': lambda m: vector(m.position) + quaternion(m.orientation),
    'geometry_msgs/PoseWithCovarianceStamped':
        lambda m: vector(m.pose.pose.position) + quaternion(m.pose.pose.orientation),
    'nav_msgs/Odometry':
        lambda m: vector(m.pose.pose.position) + quaternion(m.pose.pose.orientation),
    'geometry_msgs/TransformStamped':
        lambda m: vector(m.transform.translation) + quaternion(m.transform.rotation),
    'geometry_msgs/PointStamped': lambda m: vector(m.point),
    'geometry_msgs/Point': vector,
}
# By type and quantity: the three components, one of which the channel takes.
VECTORS = {
    ('geometry_msgs/WrenchStamped', 'force'): lambda m: vector(m.wrench.force),
    ('geometry_msgs/WrenchStamped', 'moment'): lambda m: vector(m.wrench.torque),
    ('geometry_msgs/TwistStamped', 'velocity'): lambda m: vector(m.twist.linear),
    ('geometry_msgs/TwistStamped', 'rate'): lambda m: vector(m.twist.angular),
    ('geometry_msgs/AccelStamped', 'acceleration'): lambda m: vector(m.accel.linear),
    ('sensor_msgs/Imu', 'rate'): lambda m: vector(m.angular_velocity),
}
JOINT_FIELDS = {'angle': 'position', 'position': 'position', 'rate': 'velocity',
                'velocity': 'velocity', 'force': 'effort', 'moment': 'effort'}
NUMBERS = {f'std_msgs/{name}' for name in ('Float64', 'Float32', 'Int8', 'Int16', 'Int32', 'Int64',
                                           'UInt8', 'UInt16', 'UInt32', 'UInt64')}


def rotate(q, v):
    """`v` turned by the quaternions `q` (x, y, z, w)."""
    u, w = q[..., :3], q[..., 3:]
    t = 2 * np.cross(u, v)
    return v + w * t + np.cross(u, t)


def multiply(a, b):
    """Products of quaternions (x, y, z, w)."""
    u, v, s, t = a[..., :3], b[..., :3], a[..., 3:], b[..., 3:]
    return np.concatenate([s * v + t * u + np.cross(u, v),
                           s * t - np.sum(u * v, axis=-1, keepdims=True)], axis=-1)


class Source:
    """TOPIC, or tf:PARENT:CHILD."""

    def __init__(self, text):
        self.text = text
        self.frames = tuple(f.strip('/') for f in text[3:].split(':')) if text.startswith('tf:') \
            else None

    def well_formed(self):
        if self.frames is not None:
            return len(self.frames) == 2 and all(self.frames)
        return self.text.startswith('/')


class BagTopics:
    """The messages of one bag, read as often as somebody asks."""

    def __init__(self, path, problems, use_record_times=False):
        """`use_record_times`: instead of the messages' stamps."""
        self.path, self.problems, self.bag, self.types = path, problems, None, {}
        self.use_record_times = use_record_times
        try:
            self.bag = rosbag.Bag(path)
        except rosbag.ROSBagUnindexedException:
            problems.add(path, 'it has no index (the recording was cut off): '
                               f'run `rosbag reindex {path}`')
            return
        except (rosbag.ROSBagException, ValueError) as error:
            problems.add(path, f'not a bag: {error}')
            return
        topics = self.bag.get_type_and_topic_info().topics
        self.types = {name: info.msg_type for name, info in topics.items()}
        self.notes = []

    def poses(self, source, where):
        """(times, rows of x, y, z and, where the messages have it, qx, qy, qz, qw)."""
        if source.frames is not None:
            return self._transforms(source, where)
        kind = self._type(source, where)
        if kind is None:
            return None
        if kind not in POSES:
            self.problems.add(where, f'{source.text} is a {kind}, expected poses: '
                              + ', '.join(sorted(POSES)) + ', or tf:PARENT:CHILD')
            return None
        return self._series(source.text, POSES[kind], where)

    def vectors(self, source, quantity, gravity, where):
        """(times, rows of x, y, z) of a quantity that has three components; None with a problem
        where the topic has no such thing."""
        if quantity == 'position':
            return self.poses(source, where)
        kind = self._type(source, where)
        if kind is None:
            return None
        if (kind, quantity) == ('sensor_msgs/Imu', 'acceleration'):
            return self._kinematic_acceleration(source, gravity, where)
        if (kind, quantity) not in VECTORS:
            known = sorted(k for k, q in VECTORS if q == quantity) \
                + ['sensor_msgs/Imu'] * (quantity == 'acceleration')
            self.problems.add(where, f'{source.text} is a {kind}, which has no {quantity}; '
                              'expected one of ' + ', '.join(
                                  known + ['sensor_msgs/JointState', 'std_msgs/Float64 and alike']))
            return None
        return self._series(source.text, VECTORS[kind, quantity], where)

    def joint(self, source, name, quantity, where):
        """(times, column) of a joint of a JointState."""
        field = JOINT_FIELDS.get(quantity)
        if field is None:
            self.problems.add(where, f'a joint has no {quantity}')
            return None
        seen = set()

        def value(message):
            seen.update(message.name)
            values = getattr(message, field)
            if name not in message.name or len(values) != len(message.name):
                return None
            return [values[message.name.index(name)]]
        found = self._series(source.text, value, where, empty_is_wrong=False)
        if found is None:
            return None
        if not len(found[0]):
            self.problems.add(where, f"{source.text}: no {field} of a joint '{name}'"
                              + tool.nearest(name, sorted(seen)))
            return None
        return found

    def number(self, source, where):
        """(times, column) of a topic of single numbers."""
        return self._series(source.text, lambda m: [float(m.data)], where)

    def is_joint_state(self, source):
        return self.types.get(source.text) == 'sensor_msgs/JointState'

    def is_number(self, source):
        return self.types.get(source.text) in NUMBERS

    def _type(self, source, where):
        kind = self.types.get(source.text)
        if kind is None:
            self.problems.add(where, f"no topic '{source.text}' in {self.path}"
                              + tool.nearest(source.text, sorted(self.types)))
        return kind

    def _kinematic_acceleration(self, source, gravity, where):
        """What an accelerometer feels, turned into the world and freed of gravity."""
        def value(message):
            if message.orientation_covariance[0] == -1:
                return None
            return vector(message.linear_acceleration) + quaternion(message.orientation)
        found = self._series(source.text, value, where, empty_is_wrong=False)
        if found is None:
            return None
        if not len(found[0]):
            self.problems.add(where, f'{source.text}: the messages have no orientation, and '
                              'without it gravity cannot be taken out of what the sensor felt')
            return None
        times, rows = found
        q = self._unit(rows[:, 3:], source.text, where)
        return times, rotate(q, rows[:, :3]) + np.asarray(gravity)

    def _transforms(self, source, where):
        parent, child = source.frames
        rows, seen = [], set()
        topics = [name for name, kind in self.types.items() if kind in TF_TYPES]
        for _, message, recorded in self.bag.read_messages(topics=topics):
            for transform in message.transforms:
                pair = (transform.header.frame_id.strip('/'), transform.child_frame_id.strip('/'))
                seen.add(pair)
                if pair == (parent, child):
                    rows.append((transform.header.stamp, recorded,
                                 POSES['geometry_msgs/TransformStamped'](transform)))
        if not rows:
            self.problems.add(where, f"no transform from '{parent}' to '{child}' in {self.path}"
                              + tool.nearest(f'tf:{parent}:{child}',
                                             [f'tf:{p}:{c}' for p, c in sorted(seen)]))
            return None
        return self._timed(rows, source.text, where)

    def _series(self, topic, value, where, empty_is_wrong=True):
        rows = []
        for _, message, recorded in self.bag.read_messages(topics=[topic]):
            row = value(message)
            if row is None:
                continue
            stamp = getattr(getattr(message, 'header', None), 'stamp', None)
            rows.append((stamp, recorded, row))
        if not rows and empty_is_wrong:
            self.problems.add(where, f'{topic}: no message')
            return None
        return self._timed(rows, topic, where)

    def _timed(self, rows, name, where):
        """Series of (stamp, time of recording, row). Stamps and times of recording do not mix: a
        delay of some milliseconds would come and go."""
        unstamped = sum(not stamp for stamp, _, _ in rows)
        if unstamped not in (0, len(rows)) and not self.use_record_times:
            self.problems.add(where, f'{name}: {unstamped} of {len(rows)} messages have no stamp: '
                              '--use-record-times takes the times at which all were recorded')
            return None
        by_record = self.use_record_times or unstamped
        if by_record:
            self.notes.append(f'{name}: messages ' + ('without a stamp ' if unstamped else '')
                              + 'have the time at which they were recorded, whose delay is not '
                                'known')
        return self._ordered([((recorded if by_record else stamp).to_sec(), row)
                              for stamp, recorded, row in rows], name, where)

    def _ordered(self, rows, name, where):
        """By time; the same sample sent twice counts once."""
        rows.sort(key=lambda row: row[0])
        kept, repeated = [], 0
        for time, row in rows:
            if not all(math.isfinite(x) for x in row):
                self.problems.add(where, f'{name}: a number is not finite at {time:.6f} s')
                return None
            if kept and kept[-1][0] == time:
                if kept[-1][1] != row:
                    self.problems.add(where, f'{name}: two different values have the stamp '
                                             f'{time:.6f} s')
                    return None
                repeated += 1
                continue
            kept.append((time, row))
        if repeated:
            self.notes.append(f'{name}: {repeated} messages repeat another one and were left out')
        return np.array([t for t, _ in kept]), np.array([row for _, row in kept])

    def _unit(self, q, name, where):
        norm = np.linalg.norm(q, axis=1)
        if np.any(np.abs(norm - 1) > 1e-3):
            self.problems.add(where, f'{name}: got a quaternion of length '
                              f'{norm[np.argmax(np.abs(norm - 1))]:.3g}, expected unit length')
            return np.tile([0.0, 0.0, 0.0, 1.0], (len(q), 1))
        return q / norm[:, None]

    def clamp_motion(self, source, scale, offset, where):
        """(times, rows of poses) of a clamp that sits at `offset` in the frame that was tracked."""
        found = self.poses(source, where)
        if found is None:
            return None
        times, rows = found
        if rows.shape[1] < 7:
            self.problems.add(where, f'{source.text} has positions only, expected poses')
            return None
        q = self._unit(rows[:, 3:], source.text, where)
        position = scale * rows[:, :3] + rotate(q, np.broadcast_to(offset[:3], (len(q), 3)))
        turned = multiply(q, np.broadcast_to(offset[3:], q.shape))
        # q and -q are one rotation: neighbours have the sign that makes them neighbours.
        flips = np.where(np.sum(turned[1:] * turned[:-1], axis=1) < 0, -1.0, 1.0)
        turned[1:] *= np.cumprod(flips)[:, None]
        return times, np.hstack([position, turned])
