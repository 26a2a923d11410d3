"""Bags that are the same bytes on each run: fixed stamps, fixed order, nothing of the machine in
them."""

import contextlib
import sys

import tool

try:
    import genpy
    import geometry_msgs.msg
    import rosbag
    import sensor_msgs.msg
    import tf2_msgs.msg
except ImportError as error:
    sys.exit(f'{error}: install python3-rosbag, python3-sensor-msgs, python3-geometry-msgs and '
             'python3-tf2-msgs, and run with /usr/bin/python3')

# A clock that starts at 0 cannot be told from one that was never set.
EPOCH = 1000.0


def stamp(seconds):
    """The time of a sample [s] after EPOCH, to the nanosecond."""
    nanoseconds = round((EPOCH + seconds) * 1e9)
    return genpy.Time(nanoseconds // 10**9, nanoseconds % 10**9)


@contextlib.contextmanager
def whole_bag(path, compression=rosbag.Compression.LZ4):
    """A bag open for writing that appears under its name once it is complete."""
    with tool.whole_file(path) as temporary:
        bag = rosbag.Bag(temporary, 'w', compression=compression)
        try:
            yield bag
        except BaseException:
            # After a failed write closing fails as well, and its error would hide the first one.
            with contextlib.suppress(Exception):
                bag.close()
            raise
        bag.close()


def write_transform(bag, seconds, parent, child, xyz, quaternion):
    """One /tf sample; xyz [m], quaternion (x, y, z, w), of the child in the parent."""
    pose = geometry_msgs.msg.TransformStamped()
    pose.header.stamp = stamp(seconds)
    pose.header.frame_id, pose.child_frame_id = parent, child
    pose.transform.translation = geometry_msgs.msg.Vector3(*xyz)
    pose.transform.rotation = geometry_msgs.msg.Quaternion(*quaternion)
    bag.write('/tf', tf2_msgs.msg.TFMessage([pose]), pose.header.stamp)


def write_joints(bag, seconds, names, positions):
    """One /joint_states sample; positions [m] or [rad]."""
    joints = sensor_msgs.msg.JointState()
    joints.header.stamp = stamp(seconds)
    joints.name, joints.position = list(names), [float(p) for p in positions]
    bag.write('/joint_states', joints, joints.header.stamp)
