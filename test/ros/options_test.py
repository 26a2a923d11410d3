#!/usr/bin/python3
"""Options that say what a recording does not: gravity, topics, times, and where the joints are."""
import json
import math
import os
import shutil
import subprocess
import tempfile
import unittest

import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

TOOLS = os.environ['COSSERAT_CABLE_TOOLS_DIR']

URDF = '''<robot name="rover">
  <link name="chassis"/><link name="rocker"/><link name="boom"/><link name="imu_link"/>
  <joint name="rocker_joint" type="revolute">
    <parent link="chassis"/><child link="rocker"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="2"/>
  </joint>
  <joint name="boom_joint" type="revolute">
    <parent link="chassis"/><child link="boom"/><axis xyz="0 1 0"/>
    <limit lower="{boom}" upper="1.2" effort="1" velocity="2"/>
  </joint>
  <joint name="imu_joint" type="fixed"><parent link="chassis"/><child link="imu_link"/></joint>
</robot>'''
# Between two points 0.4 m apart, its ends along x: hangs by its weight to one side of z.
LOOM = '''format: 1
cables:
  - {{name: loom, length: 0.6, diameter: 0.01, mass_per_length: 0.1, EI: 0.002, GJ: 0.002,
     eta_EI: 1.0e-4,
     a: {{link: chassis, pose: [-0.2, 0, 0, 0, 0.70710678, 0, 0.70710678]}},
     b: {{link: {b}, pose: [0.2, 0, 0, 0, 0.70710678, 0, 0.70710678]}}}}
'''
# Of the apex below the clamps at rest [m]: a chain of the same length hangs 0.200 m deep between
# the same points (sinh u / u = 1.5), and this loom is not much stiffer than one.
SAG, SAG_TOLERANCE = 0.20, 0.01


class Options(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.write_vehicle()

    def path(self, name):
        return os.path.join(self.folder, name)

    def write_vehicle(self, b='rocker', boom=-1.2):
        with open(self.path('rover.urdf'), 'w') as file:
            file.write(URDF.format(boom=boom))
        with open(self.path('loom.yaml'), 'w') as file:
            file.write(LOOM.format(b=b))

    def record(self, name='in.bag', joints='/joint_states', tf='/tf', frame='odom', prefix='',
               stamped=True, angle=lambda t: 0.0, imu=None, imu_frame='imu_link', count=101, start=10.0,
               turn=(0.0, 0.0, 0.0, 1.0)):
        """A bag of 1 s: what is None is not in it."""
        with rosbag.Bag(self.path(name), 'w') as bag:
            for i in range(count):
                time = rospy.Time.from_sec(start + i / 100.0)
                stamp = time if stamped is True or (stamped == 'partly' and i % 2) else rospy.Time()
                if joints:
                    message = JointState(name=['rocker_joint'], position=[angle(i / 100.0)])
                    message.header.stamp = stamp
                    bag.write(joints, message, time)
                if tf:
                    edge = TransformStamped(child_frame_id=prefix + 'chassis')
                    edge.header.stamp = stamp
                    edge.header.frame_id = prefix + frame
                    rotation = edge.transform.rotation
                    rotation.x, rotation.y, rotation.z, rotation.w = turn
                    bag.write(tf, TFMessage([edge]), time)
                if imu:
                    message = Imu()
                    message.header.stamp = time
                    message.header.frame_id = prefix + imu_frame
                    a = message.linear_acceleration
                    a.x, a.y, a.z = imu
                    bag.write('/imu/data', message, time)
        return self.path(name)

    def run_tool(self, tool, *arguments):
        done = subprocess.run([os.path.join(TOOLS, tool), *arguments], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True, timeout=300)
        return done.returncode, done.stdout

    def inputs(self, bag):
        return ['--vehicle', self.path('rover.urdf'), '--cables', self.path('loom.yaml'),
                '--bag', bag]

    def check(self, bag, *options):
        return self.run_tool('cable_check', *self.inputs(bag), *options)

    def replay(self, bag, *options):
        return self.run_tool('cable_replay', *self.inputs(bag), '--output', self.path('out.bag'),
                             '--json', self.path('out.json'), *options)

    def apex(self):
        """The first message of the output's telemetry."""
        with rosbag.Bag(self.path('out.bag')) as bag:
            return next(message for _, message, _ in bag.read_messages('/cables/loom/apex'))

    def json(self, name='out.json'):
        with open(self.path(name)) as file:
            return json.load(file)

    def modes(self, *options):
        return self.run_tool('cable_modes', self.path('loom.yaml'), '--vehicle',
                             self.path('rover.urdf'), '--json', self.path('modes.json'), *options)

    # ---- Gravity.

    def test_gravity_is_taken_and_named(self):
        bag = self.record(frame='odom_ned')
        for options, sign, axis in (([], -1, '-z'), (['--gravity', '0,0,9.81'], 1, '+z')):
            code, text = self.replay(bag, *options)
            self.assertEqual(code, 0, text)
            self.assertIn('gravity 9.81 m/s^2 along %s of odom_ned' % axis, text)
            self.assertAlmostEqual(self.apex().position_z, sign * SAG, delta=SAG_TOLERANCE)
            self.assertEqual(self.json()['gravity'], [0, 0, sign * 9.81])
            with open(self.path('out.cables.yaml')) as file:
                self.assertIn('along %s of odom_ned' % axis, file.readline())
            code, text = self.check(bag, *options)
            self.assertIn('gravity 9.81 m/s^2 along %s of odom_ned' % axis, text)
            # A suggestion where it is not followed, and nothing where it is.
            self.assertEqual('--gravity 0,0,9.81 would fit' in text, sign < 0, text)

    def test_no_gravity_is_said(self):
        code, text = self.replay(self.record(), '--gravity', '0,0,0')
        self.assertEqual(code, 0, text)
        self.assertIn('no gravity', text)

    def test_gravity_that_cannot_be_is_refused_with_all_else(self):
        bag = self.record()
        for value, said in (('0,0,nan', "got '0,0,nan'"), ('9.81', 'got 1 number'),
                            ('0,0,-981', 'got 981 m/s^2'), ('0,0,9.81e3', 'got 9810 m/s^2'),
                            ('', "got ''")):
            for run in (self.check, self.replay, lambda _, *more: self.modes(*more)):
                code, text = run(bag, '--gravity', value)
                self.assertEqual(code, 2, text)
                self.assertIn('gravity: ' + said, text)
        code, text = self.check(self.path('no.bag'), '--gravity', '1,2')
        self.assertIn('gravity: got 2 numbers', text)
        self.assertIn('no such bag', text)

    def test_an_imu_of_an_unknown_frame_is_told(self):
        _, text = self.check(self.record(imu=(0, 0, 9.81), imu_frame='box'))
        self.assertIn("gravity cannot be held against /imu/data: its frame 'box'", text)

    def test_an_imu_suggests_gravity(self):
        code, text = self.check(self.record(imu=(0.3, 0.1, -9.8)))
        self.assertEqual(code, 0, text)
        self.assertIn('the mean of /imu/data', text)
        self.assertIn('--gravity 0,0,9.81 would fit', text)
        self.assertIn('gravity 9.81 m/s^2 along -z of odom\n', text)  # as it was
        for quiet in ((0.3, 0.1, 9.8), (0.1, 0.0, 0.0)):
            code, text = self.check(self.record(imu=quiet))
            self.assertNotIn('/imu/data', text)

    # ---- Names.

    def test_a_vehicle_upside_down_is_asked_about(self):
        bag = self.record(turn=(1.0, 0.0, 0.0, 0.0))
        for code, text in (self.check(bag), self.replay(bag)):
            self.assertEqual(code, 0, text)
            self.assertIn('the vehicle hangs upside down in all of the recording', text)
            self.assertIn("does the z axis of 'odom' point down? --gravity 0,0,9.81", text)
            self.assertIn('gravity 9.81 m/s^2 along -z of odom', text)
        code, text = self.check(bag, '--gravity', '0,0,9.81')
        self.assertNotIn('upside down', text)

    def test_limits_that_say_nothing_are_warned_of(self):
        with open(self.path('rover.urdf')) as file:
            text = file.read()
        with open(self.path('rover.urdf'), 'w') as file:
            file.write(text.replace('lower="-1" upper="1"', 'lower="1" upper="-1"'))
        bag = self.record()
        code, text = self.check(bag)
        self.assertEqual(code, 0, text)
        self.assertIn('warning: %s:5: joint[rocker_joint].limit: got lower 1 and upper -1'
                      % self.path('rover.urdf'), text)
        self.assertIn('ok, but for 1 warning', text)
        code, text = self.replay(bag)
        self.assertIn('joint[rocker_joint].limit: got lower 1 and upper -1', text)

    def test_topics_in_a_namespace_are_offered_and_read(self):
        bag = self.record(joints='/rover1/joint_states', tf=None)
        code, text = self.check(bag)
        self.assertEqual(code, 2, text)
        self.assertIn('there is /rover1/joint_states (sensor_msgs/JointState, 101 messages): '
                      '--joint-states /rover1/joint_states', text)
        for run in (self.check, self.replay):
            code, text = run(bag, '--joint-states', '/rover1/joint_states')
            self.assertEqual(code, 0, text)
        with rosbag.Bag(self.path('out.bag')) as out:
            self.assertEqual(out.get_message_count('/rover1/joint_states'), 101)

    def test_a_similar_topic_is_offered_beside_one_that_drives_too_little(self):
        code, text = self.check(self.record(joints='/rover1/joint_states'))
        self.assertEqual(code, 2, text)
        self.assertIn('drives it', text)
        self.assertIn('--joint-states /rover1/joint_states', text)

    def test_transforms_in_a_namespace(self):
        bag = self.record(tf='/rover1/tf')
        code, text = self.check(bag)
        self.assertEqual(code, 0, text)
        self.assertIn('note: there is /rover1/tf', text)
        code, text = self.check(bag, '--tf', '/rover1/tf')
        self.assertEqual(code, 0, text)
        self.assertIn("inertial frame 'odom'", text)
        self.assertIn('by /rover1/tf:', text)

    def test_topics_that_are_not_there(self):
        code, text = self.check(self.record(), '--joint-states', '/joint_sates', '--tf', '/r/tf')
        self.assertEqual(code, 2, text)
        self.assertIn("joint-states: got '/joint_sates', expected a topic of the recording: did "
                      "you mean '/joint_states'?", text)
        self.assertIn("tf: got '/r/tf'", text)

    def test_a_wrong_type_is_named_beside_the_topic_that_fits(self):
        bag = self.record(joints='/rover1/joint_states')
        with rosbag.Bag(bag, 'a') as more:
            more.write('/joint_states', String('hello'), rospy.Time(10))
        code, text = self.check(bag)
        self.assertEqual(code, 2, text)
        self.assertIn('std_msgs/String', text)
        self.assertIn('--joint-states /rover1/joint_states', text)

    def test_prefixed_frames_are_named_and_read(self):
        bag = self.record(prefix='rover1/')
        code, text = self.check(bag)
        self.assertIn("frames such as 'rover1/chassis' are the URDF's 'chassis' with a prefix: "
                      '--tf-prefix rover1', text)
        code, text = self.replay(bag, '--tf-prefix', 'rover1')
        self.assertEqual(code, 0, text)
        self.assertIn("inertial frame 'odom'", text)
        # Viewers know the frame by the name that was recorded.
        self.assertEqual(self.apex().header.frame_id, 'rover1/chassis')

    def test_names_that_nearly_fit_are_named(self):
        bag = self.path('in.bag')
        with rosbag.Bag(bag, 'w') as out:
            for i in range(101):
                message = JointState(name=['Rocker_Joint'], position=[0.0])
                message.header.stamp = rospy.Time.from_sec(10 + i / 100.0)
                out.write('/joint_states', message, message.header.stamp)
        code, text = self.check(bag)
        self.assertEqual(code, 2, text)
        self.assertIn("joint not in the URDF: 101 (first: 'Rocker_Joint')", text)
        self.assertIn("is it the URDF's 'rocker_joint'?", text)

    def test_a_second_parent_is_named_and_counted(self):
        bag = self.record()
        with rosbag.Bag(bag, 'a') as more:
            edge = TransformStamped(child_frame_id='chassis')
            edge.header.stamp = rospy.Time(10.5)
            edge.header.frame_id = 'map'
            edge.transform.rotation.w = 1.0
            more.write('/tf', TFMessage([edge]), rospy.Time(10.5))
        code, text = self.check(bag)
        self.assertEqual(code, 0, text)
        self.assertIn("frame 'chassis' has two parents: 1 (first: 'odom' by /tf is kept, 'map' by "
                      '/tf is ignored)', text)
        self.assertIn('ok, but for 1 warning', text)

    # ---- Stamps.

    def test_stamps_of_two_clocks_are_told(self):
        bag = self.record(tf=None)
        with rosbag.Bag(bag, 'a') as more:
            for i in range(101):
                edge = TransformStamped(child_frame_id='chassis')
                edge.header.stamp = rospy.Time.from_sec(1.7e9 + i / 100.0)
                edge.header.frame_id = 'odom'
                edge.transform.translation.x = 0.01 * i
                edge.transform.rotation.w = 1.0
                more.write('/tf', TFMessage([edge]), rospy.Time.from_sec(10 + i / 100.0))
        code, text = self.check(bag)
        self.assertEqual(code, 2, text)
        self.assertIn('stamps of two clocks', text)
        self.assertIn('odom -> chassis by /tf is recorded from 1700000000.000 s', text)
        code, text = self.check(bag, '--use-record-times')
        self.assertEqual(code, 0, text)

    def test_record_times_are_offered_and_used(self):
        bag = self.record(stamped=False, tf=None)
        code, text = self.check(bag)
        self.assertEqual(code, 2, text)
        self.assertNotIn('neither', text)
        self.assertLess(text.index('have no stamp: --use-record-times'),
                        text.index('sample without a stamp by /joint_states: 101'))
        code, text = self.replay(bag, '--use-record-times')
        self.assertEqual(code, 0, text)
        self.assertIn('times are those of recording', text)
        self.assertAlmostEqual(self.apex().header.stamp.to_sec(), 10.0, delta=0.01)
        self.assertTrue(self.json()['use_record_times'])
        # The output needs the option no more.
        code, text = self.check(self.path('out.bag'))
        self.assertEqual(code, 0, text)

    def test_a_body_without_stamps_does_not_silently_stand_still(self):
        bag = self.record(stamped=False)
        code, text = self.check(bag)
        self.assertEqual(code, 2, text)
        self.assertIn("frame 'chassis' is moved in 'odom', but all 101 samples of it by /tf have no "
                      'stamp', text)
        code, text = self.check(bag, '--use-record-times')
        self.assertEqual(code, 0, text)
        self.assertIn("inertial frame 'odom'", text)

    def test_partly_stamped_recordings(self):
        bag = self.record(stamped='partly')
        code, text = self.check(bag)
        self.assertEqual(code, 0, text)
        self.assertIn('51 samples by /joint_states have no stamp and are left out', text)
        code, text = self.check(bag, '--use-record-times')
        self.assertNotIn('no stamp', text)

    # ---- Modes where the vehicle is.

    def frequency(self):
        return self.json('modes.json')['cables']['loom']['modes'][0]['frequency']

    def test_joints_place_the_clamps(self):
        self.record(angle=lambda t: -0.3 * t)
        code, text = self.modes()
        self.assertEqual(code, 0, text)
        at_zero = self.frequency()
        code, text = self.modes('--joints', 'rocker_joint=-0.3')
        self.assertEqual(code, 0, text)
        by_joints = self.frequency()
        self.assertIn('rocker_joint -0.3', text)
        self.assertEqual(self.json('modes.json')['joints']['rocker_joint'], -0.3)
        self.assertGreater(abs(by_joints / at_zero - 1), 1e-3)
        # The same place in a recording, at its end.
        code, text = self.modes('--bag', self.path('in.bag'), '--time', '1')
        self.assertEqual(code, 0, text)
        self.assertIn('gravity 9.81 m/s^2 along -z of odom', text)
        self.assertAlmostEqual(self.json('modes.json')['joints']['rocker_joint'], -0.3, delta=1e-9)
        # Only rounding differs.
        self.assertAlmostEqual(self.frequency() / by_joints, 1, delta=1e-6)

    def test_times_outside_the_recording(self):
        bag = self.record()
        for time in ('-0.1', '1.5', '500'):
            code, text = self.modes('--bag', bag, '--time', time)
            self.assertEqual(code, 2, text)
            self.assertIn('expected 0 to 1 s after the recording', text)
            self.assertIn('stamps 10.000 s to 11.000 s', text)

    def test_modes_options_that_contradict_each_other(self):
        bag = self.record()
        for options, said in ((['--bag', bag], 'time: missing'), (['--time', '1'], 'give --bag'),
                              (['--bag', bag, '--time', '1', '--joints', 'rocker_joint=0'],
                               'joints: the recording'),
                              (['--tf', '/rover1/tf'], 'tf: is for a recording')):
            code, text = self.modes(*options)
            self.assertEqual(code, 2, text)
            self.assertIn(said, text)

    def test_limits_that_exclude_zero_are_respected(self):
        self.write_vehicle(b='boom', boom=0.3)
        code, text = self.modes()
        self.assertEqual(code, 0, text)
        self.assertIn("joint 'boom_joint' stands at 0.3 rad", text)
        self.assertEqual(self.json('modes.json')['joints']['boom_joint'], 0.3)
        code, text = self.modes('--joints', 'boom_joint=0', '--joints', 'rocker_jiont=30')
        self.assertEqual(code, 2, text)
        self.assertIn('expected its limits, 0.3 to 1.2 rad', text)
        self.assertIn("did you mean 'rocker_joint'?", text)

    def test_gravity_of_modes(self):
        frequencies = []
        for gravity in ('0,0,-9.81', '0,0,9.81', '0,0,-19.62'):
            code, text = self.modes('--gravity', gravity)
            self.assertEqual(code, 0, text)
            frequencies.append(self.frequency())
        # Mirrored, nothing changes; a heavier loom is a stiffer pendulum: sqrt(2) for a chain.
        self.assertAlmostEqual(frequencies[1] / frequencies[0], 1, delta=1e-6)
        self.assertAlmostEqual(frequencies[2] / frequencies[0], math.sqrt(2), delta=0.1)


if __name__ == '__main__':
    unittest.main(verbosity=2)
