"""For tests of recordings: bags that are made message by message."""
import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

from command_line import CommandLine


class MadeRecordings(CommandLine):

    CART = """<robot name="cart"><link name="base_link"/></robot>"""
    ARCH = """format: 1
cables:
  - name: lead
    length: 0.40
    diameter: 0.005
    mass_per_length: 0.03
    EI: 2.5e-3
    GJ: 2.5e-3
    eta_EI: 1.0e-5
    a: {link: base_link, pose: [0, 0, 1, 1, 0, 0, 0]}
    b: {link: %s, pose: [0, 0.2, 1, 0, 0, 0, 1]}
"""

    @staticmethod
    def moved(parent, child, stamp, x):
        message = TransformStamped()
        message.header.stamp = rospy.Time.from_sec(stamp)
        message.header.frame_id, message.child_frame_id = parent, child
        message.transform.translation.x = x
        message.transform.rotation.w = 1
        return TFMessage([message])

    def write_messages(self, name, messages):
        """A bag of (topic, stamp [s], message)."""
        with rosbag.Bag(self.path(name), 'w') as bag:
            for topic, stamp, message in sorted(messages, key=lambda m: m[1]):
                bag.write(topic, message, rospy.Time.from_sec(stamp))
        return self.path(name)
