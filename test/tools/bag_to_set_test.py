#!/usr/bin/python3
"""bag_to_set on a bag of known motions made here: what its topics said is what the set says."""

import csv
import math
import os
import tempfile
import unittest

import genpy
import numpy as np
import rosbag
import yaml
from geometry_msgs.msg import (PointStamped, PoseStamped, TransformStamped, WrenchStamped)
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64
from tf2_msgs.msg import TFMessage

from helpers import contents, run

# Stamps are doubles of about 1000 s in the tool, to the nanosecond in the bag.
STAMP = 1e-6
# Values pass as doubles through scales and rotations.
EXACT = 1e-12
# A sine of 1 Hz between samples 20 ms apart: (2 pi)^2 * 0.02^2 / 8 of its amplitude.
INTERPOLATED = 2e-3

EPOCH = 1000.0
CABLE = ('format: 1\n'
         'cable:\n'
         '  length: 0.25\n'
         '  diameter: 0.008\n'
         '  mass_per_length: 0.09\n'
         '  EI: 0.012\n'
         '  GJ: 9e-3\n'
         '  eta_EI: null\n'
         '  eta_GJ: critical\n'
         '  apex: {s: 0.1}\n')
QUARTER = math.sqrt(0.5)


def tip(t):
    return 0.01 * math.sin(2 * math.pi * t)


def shaker(t):
    return 0.05 * math.cos(2 * math.pi * t)


def turn(t):
    return 0.3 * t


def stamped(message, t):
    message.header.stamp = stamp(t)
    return message


def stamp(t):
    nanoseconds = round((EPOCH + t) * 1e9)
    return genpy.Time(nanoseconds // 10**9, nanoseconds % 10**9)


def write_bag(path):
    """Two seconds: the tip in mm at 100 Hz, the shaker and the other sensors at 50 Hz."""
    with rosbag.Bag(path, 'w') as bag:
        for i in range(201):
            t = 0.01 * i
            pose = stamped(PoseStamped(), t)
            pose.pose.position.x, pose.pose.position.z = 1000 * tip(t), 250
            pose.pose.orientation.w = 1
            bag.write('/tip/pose', pose, stamp(t + 0.003))
            half = PointStamped()
            half.header.stamp = stamp(t) if i % 2 else genpy.Time()
            bag.write('/half_stamped', half, stamp(t + 0.003))
            if i % 2:
                continue
            bag.write('/phi', Float64(turn(t)), stamp(t))
            # Sent twice, as tf often is.
            shake = stamped(TransformStamped(), t)
            shake.header.frame_id, shake.child_frame_id = 'world', 'shaker'
            shake.transform.translation.x = 1000 * shaker(t)
            shake.transform.rotation.z, shake.transform.rotation.w = QUARTER, QUARTER
            for _ in range(2):
                bag.write('/tf', TFMessage([shake]), stamp(t))
            # The sensor lies on its side: its y points up and feels gravity.
            imu = stamped(Imu(), t)
            imu.orientation.x, imu.orientation.w = QUARTER, QUARTER
            imu.linear_acceleration.x, imu.linear_acceleration.y = t, 9.81
            imu.angular_velocity.y = 0.3
            bag.write('/imu', imu, stamp(t))
            wrench = stamped(WrenchStamped(), t)
            wrench.wrench.force.z, wrench.wrench.torque.x = 1 + t, 2 + t
            bag.write('/wrench', wrench, stamp(t))
            joints = stamped(JointState(), t)
            joints.name, joints.position, joints.velocity = ['other', 'disc'], [9, turn(t)], [9, .3]
            bag.write('/joint_states', joints, stamp(t))
            point = stamped(PointStamped(), t)
            point.point.y = tip(t)
            if not 1.0 < t < 1.5:  # hidden meanwhile
                bag.write('/marker', point, stamp(t))


def read_csv(path):
    with open(path, newline='', encoding='utf-8') as source:
        header, *rows = csv.reader(source)
    return dict(zip(header, np.array(rows, float).T))


class BagToSet(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recording = tempfile.TemporaryDirectory()
        cls.bag = os.path.join(cls.recording.name, 'rig.bag')
        write_bag(cls.bag)

    @classmethod
    def tearDownClass(cls):
        cls.recording.cleanup()

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.cable = self.path('cable.yaml')
        self.set = self.path('set')
        with open(self.cable, 'w', encoding='utf-8') as out:
            out.write(CABLE)

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def convert(self, *arguments, name='one', cable=True, start='rest', a='0,0,0,0,0,0,1',
                b='free'):
        return run('bag_to_set', self.bag, '-o', self.set, '--experiment', name, '--start', start,
                   '--clamp-a', a, '--clamp-b', b, *(['--cable', self.cable] if cable else []),
                   *arguments)

    def converted(self, *arguments, **options):
        code, out, errors = self.convert(*arguments, **options)
        self.assertEqual(code, 0, errors)
        with open(self.path('set', 'measurement.yaml'), encoding='utf-8') as source:
            return yaml.safe_load(source), out

    def refused(self, *arguments, **options):
        before = sorted(os.listdir(self.set)) if os.path.exists(self.set) else None
        code, _, errors = self.convert(*arguments, **options)
        self.assertEqual(code, 2, errors)
        self.assertNotIn('Traceback', errors)
        after = sorted(os.listdir(self.set)) if os.path.exists(self.set) else None
        self.assertEqual(before, after)
        return errors

    TIP = ('--channel', 'tip_x=/tip/pose,quantity=position,axis=x,s=0.25,scale=0.001,sigma=5e-5')

    def test_positions_and_a_moving_clamp(self):
        # The clamp sits 20 mm along the marker's x axis and is turned half about it.
        content, out = self.converted(
            '--channel', 'tip_x=/tip/pose,quantity=position,axis=x,s=0.25,sigma=5e-5',
            '--channel', 'tip_z=/tip/pose,quantity=position,axis=z,s=0.25,add=-0.05',
            '--scale', '0.001', '--from', '0.5', '--to', '1.5', '--kind', 'shaken',
            '--offset-a', '0.02,0,0,1,0,0,0', a='tf:world:shaker', b='-0.1,0,0,0,0,0,1')
        record = read_csv(self.path('set', 'one.csv'))
        self.assertEqual(list(record), ['t', 'tip_x', 'tip_z'])
        np.testing.assert_allclose(record['t'], 0.01 * np.arange(101), atol=STAMP)
        np.testing.assert_allclose(record['tip_x'], [tip(0.5 + 0.01 * i) for i in range(101)],
                                   atol=EXACT)
        np.testing.assert_allclose(record['tip_z'], 0.2, atol=EXACT)
        motion = read_csv(self.path('set', 'one_a.csv'))
        self.assertLessEqual(motion['t'][0], STAMP)
        self.assertGreaterEqual(motion['t'][-1], 1 - STAMP)
        np.testing.assert_allclose(np.diff(motion['t']), 0.02, atol=STAMP)
        np.testing.assert_allclose(motion['x'], [shaker(0.5 + t) for t in motion['t']], atol=STAMP)
        np.testing.assert_allclose(motion['y'], 0.02, atol=EXACT)
        # About z by 90 degrees, then about the new x by 180: (z + w)(x) = w x + y.
        for name, value in zip(('qx', 'qy', 'qz', 'qw'), (QUARTER, QUARTER, 0, 0)):
            np.testing.assert_allclose(motion[name], value, atol=EXACT)
        experiment = content['experiments'][0]
        self.assertEqual(content['format'], 1)
        self.assertEqual(content['cable'], {'length': 0.25, 'diameter': 0.008,
                                            'mass_per_length': 0.09, 'EI': 0.012, 'GJ': 9e-3,
                                            'eta_EI': None, 'eta_GJ': 'critical'})
        self.assertEqual(experiment, {
            'name': 'one', 'kind': 'shaken', 'gravity': [0, 0, -9.81], 'a': {'motion': 'one_a.csv'},
            'b': {'pose': [-0.1, 0, 0, 0, 0, 0, 1]}, 'start': {'rest': True}, 'record': 'one.csv',
            'channels': [
                {'column': 'tip_x', 'quantity': 'position', 's': 0.25, 'axis': 'x', 'sigma': 5e-5},
                {'column': 'tip_z', 'quantity': 'position', 's': 0.25, 'axis': 'z'}]})
        self.assertIn('left out apex', out)
        self.assertIn('messages repeat another one', out)

    def test_other_messages(self):
        content, out = self.converted(
            '--channel', 'phi=/phi,quantity=angle,s=0.25,offset=unknown',
            '--channel', 'disc=/joint_states,quantity=angle,s=0.25,joint=disc,scale=-1',
            '--channel', 'disc_rate=/joint_states,quantity=rate,s=0.25,joint=disc',
            '--channel', 'gyro=/imu,quantity=rate,s=0.25,of=y',
            '--channel', 'ax=/imu,quantity=acceleration,s=0.25,axis=x',
            '--channel', 'az=/imu,quantity=acceleration,s=0.25,axis=z',
            '--channel', 'fz=/wrench,quantity=force,clamp=a,axis=z,frame=a',
            '--channel', 'mx=/wrench,quantity=moment,clamp=a,axis=x',
            b='disc:1.2e-4:0.15', start='twisted:1.2')
        record = read_csv(self.path('set', 'one.csv'))
        t = 0.02 * np.arange(101)
        np.testing.assert_allclose(record['t'], t, atol=STAMP)
        for name, value in (('phi', turn(t)), ('disc', -turn(t)), ('disc_rate', 0.3), ('gyro', 0.3),
                            ('ax', t), ('az', 0), ('fz', 1 + t), ('mx', 2 + t)):
            np.testing.assert_allclose(record[name], np.broadcast_to(value, t.shape), atol=1e-9,
                                       err_msg=name)
        experiment = content['experiments'][0]
        self.assertEqual(experiment['b'], {'disc': {'inertia': 1.2e-4, 'mass': 0.15}})
        self.assertEqual(experiment['start'], {'twisted': 1.2})
        self.assertEqual(experiment['channels'][0], {'column': 'phi', 'quantity': 'angle',
                                                     's': 0.25, 'offset': 'unknown'})
        self.assertEqual(experiment['channels'][6], {'column': 'fz', 'quantity': 'force',
                                                     'clamp': 'a', 'axis': 'z', 'frame': 'a'})
        self.assertIn('/phi: messages without a stamp', out)

    def test_slower_channels_are_interpolated_and_gaps_left_out(self):
        _, out = self.converted(*self.TIP, '--channel',
                                'marker=/marker,quantity=position,axis=y,s=0.1')
        record = read_csv(self.path('set', 'one.csv'))
        np.testing.assert_allclose(record['tip_x'], [tip(t) for t in record['t']], atol=STAMP)
        np.testing.assert_allclose(record['marker'], [tip(t) for t in record['t']],
                                   atol=0.01 * INTERPOLATED)
        hidden = (record['t'] > 1 + STAMP) & (record['t'] < 1.5 - STAMP)
        self.assertFalse(hidden.any())
        self.assertIn('at the times of /tip/pose', out)
        self.assertIn('averages their noise: marker', out)
        self.assertIn('49 rows left out', out)

    def test_adds_to_a_set_and_keeps_its_comments(self):
        self.converted(*self.TIP, start='held:0.25:0.01,0,0.249')
        path = self.path('set', 'measurement.yaml')
        with open(path, 'a', encoding='utf-8') as out:
            out.write('# the second day\n')
        first = contents(self.path('set', 'one.csv'))
        content, _ = self.converted(*self.TIP, '--length', '0.2', '--free-b', 'tz,rx', name='two',
                                    cable=False, b='0,0,0.2,0,0,0,1')
        self.assertIn(b'# the second day\n', contents(path))
        self.assertEqual([e['name'] for e in content['experiments']], ['one', 'two'])
        self.assertEqual(content['experiments'][0]['start'],
                         {'held': {'s': 0.25, 'position': [0.01, 0, 0.249]}})
        self.assertEqual(content['experiments'][1]['specimen'], {'length': 0.2})
        self.assertEqual(content['experiments'][1]['b']['free'], ['tz', 'rx'])
        self.assertEqual(contents(self.path('set', 'one.csv')), first)

    def test_overwrites_nothing_in_silence(self):
        self.converted(*self.TIP)
        self.assertRegex(self.refused(*self.TIP), "has 'one' already")
        with open(self.path('set', 'two.csv'), 'w', encoding='utf-8') as out:
            out.write('mine\n')
        self.assertRegex(self.refused(*self.TIP, name='two'), 'two.csv: there already')
        self.assertEqual(contents(self.path('set', 'two.csv')), b'mine\n')
        content, _ = self.converted(*self.TIP, '--replace', '--kind', 'again')
        self.assertEqual([e['kind'] for e in content['experiments']], ['again'])
        with open(self.cable, 'a', encoding='utf-8') as out:
            out.write('  EA: 3000.0\n')
        self.assertRegex(self.refused(*self.TIP, name='three'), 'differs from the cable of')

    def test_record_times_instead_of_stamps(self):
        _, out = self.converted(*self.TIP)
        self.assertIn('t = 0 at 1000.000000 s', out)
        _, out = self.converted(*self.TIP, '--use-record-times', name='two', cable=False)
        self.assertIn('t = 0 at 1000.003000 s', out)
        self.assertIn('/tip/pose: messages have the time at which they were recorded', out)

    def test_stamps_and_record_times_do_not_mix(self):
        half = ('--channel', 'x=/half_stamped,quantity=position,axis=x,s=0.25')
        self.assertIn('/half_stamped: 101 of 201 messages have no stamp: --use-record-times',
                      self.refused(*half))
        self.converted(*half, '--use-record-times')
        record = read_csv(self.path('set', 'one.csv'))
        np.testing.assert_allclose(record['t'], 0.01 * np.arange(201), atol=STAMP)

    def test_gravity_of_another_unit(self):
        self.assertIn('--gravity: got 981 m/s^2', self.refused(*self.TIP, '--gravity', '0,0,-981'))

    def test_mistakes(self):
        # What the options alone show, then what the bag shows: each is told in one run.
        for mistakes in (
                (('x', 'expected COLUMN=/TOPIC'),
                 ('x=/tip/pose,quantity=position,axis=x', 's: missing, expected it of a position'),
                 ('x=/tip/pose,quantity=positoin,axis=x,s=0', 'expected one of position'),
                 ('x=/tip/pose,quantity=position,axis=x,s=0,sgima=1', "did you mean 'sigma'"),
                 ('x=/tip/pose,quantity=position,axis=w,s=0', "axis: got 'w'"),
                 ('x=/phi,quantity=angle,axis=x,s=0', 'axis: got this of an angle'),
                 ('t=/phi,quantity=angle,s=0', "'t' must be the name of one column")),
                (('a=/tip/pos,quantity=position,axis=x,s=0', "did you mean '/tip/pose'"),
                 ('b=/tip/pose,quantity=force,axis=x,clamp=a', 'which has no force'),
                 ('c=/imu,quantity=rate,s=0', 'of: missing'),
                 ('d=/joint_states,quantity=angle,s=0', 'joint: missing'),
                 ('e=/joint_states,quantity=angle,s=0,joint=dsic', "did you mean 'disc'"),
                 ('f=tf:world:shaken,quantity=position,axis=x,s=0',
                  "did you mean 'tf:world:shaker'"),
                 ('g=/tip/pose,quantity=angle,s=0', 'which has no angle'))):
            errors = self.refused(*(word for channel, _ in mistakes
                                    for word in ('--channel', channel)))
            for channel, message in mistakes:
                with self.subTest(channel):
                    self.assertIn(message, errors)
        self.assertIn('--cable: missing', self.refused(*self.TIP, cable=False))
        self.assertIn('has positions only', self.refused(*self.TIP, a='/marker'))
        self.assertIn("--clamp-b: got 'fre'", self.refused(*self.TIP, b='fre'))
        self.assertIn("--start: got 'hold'", self.refused(*self.TIP, start='hold'))
        self.assertIn('got 0 samples', self.refused(*self.TIP, '--from', '7'))
        self.assertIn('quaternion of length 2', self.refused(*self.TIP, a='0,0,0,0,0,0,2'))


if __name__ == '__main__':
    unittest.main()
