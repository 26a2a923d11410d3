#!/usr/bin/python3
"""Bad input to cable_check and cable_replay: every problem at once, exit 2, and no file written."""
import json
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest

import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from command_line import (CAR_URDF, CAR_YAML, RIDE_BAG, SWEEP_BAG, SWEEP_URDF, SWEEP_YAML, TOOLS, run)
from made_recordings import MadeRecordings


def topics_of(path):
    with rosbag.Bag(path) as bag:
        return {topic: info.message_count
                for topic, info in bag.get_type_and_topic_info().topics.items()}


class Replays(MadeRecordings):

    @staticmethod
    def bytes_of(path):
        with open(path, 'rb') as file:
            return file.read()

    def replay(self, *more, bag=SWEEP_BAG, name='out.bag'):
        output = os.path.join(self.output_folder, name)
        code, text = run('cable_replay', '--vehicle', SWEEP_URDF, '--cables', SWEEP_YAML,
                         '--bag', bag, '--output', output, *more)
        return code, text, output

    # ---- What is accepted.

    def test_shipped_inputs_are_fine(self):
        for vehicle, cables, bag in ((SWEEP_URDF, SWEEP_YAML, SWEEP_BAG),
                                     (CAR_URDF, CAR_YAML, RIDE_BAG)):
            code, text = run('cable_check', '--vehicle', vehicle, '--cables', cables,
                             '--bag', bag)
            self.assertEqual(code, 0, text)
            self.assertIn('\nok\n', text)

    def test_replay_is_repeatable_and_complete(self):
        contents = []
        for name in ('one.bag', 'two.bag'):
            code, text, output = self.replay('--duration', '0.5', name=name)
            self.assertEqual(code, 0, text)
            contents.append(self.bytes_of(output))
        self.assertEqual(contents[0], contents[1])
        topics = topics_of(output)
        # 0.5 s with both ends: 200 Hz of telemetry, 30 Hz of markers, 500 Hz copied.
        self.assertEqual(topics['/cables/cable/apex'], 101)
        self.assertEqual(topics['/cables/cable/markers'], 16)
        self.assertEqual(topics['/tf'], 251)
        self.assertTrue(os.path.exists(os.path.join(self.output_folder, 'two.cables.yaml')))
        self.assertEqual([f for f in os.listdir(self.output_folder) if 'active' in f], [])

    def test_configuration_beside_the_result_reads_back(self):
        code, text, output = self.replay('--duration', '0.1')
        self.assertEqual(code, 0, text)
        code, text = run('cable_check', '--vehicle', SWEEP_URDF, '--cables',
                         output[:-len('.bag')] + '.cables.yaml')
        self.assertEqual(code, 0, text)

    # ---- Arguments.

    def test_unknown_option(self):
        self.assertEqual(run('cable_check', '--nonsense')[0], 2)

    def test_missing_option(self):
        self.assertEqual(run('cable_replay', '--vehicle', SWEEP_URDF)[0], 2)

    def test_time_step_out_of_range(self):
        code, text, _ = self.replay('--dt', '1')
        self.assertEqual(code, 2)
        self.assertIn('dt: got 1', text)
        self.assertEqual(os.listdir(self.output_folder), [])

    # ---- Cable files.

    def test_unknown_key(self):
        self.refused('lenght', "length", cables=self.cables(('length:', 'lenght:')))

    def test_unit_slip(self):
        self.refused('length', '200', cables=self.cables(('length: 0.200', 'length: 200')))

    def test_not_a_number(self):
        self.refused('diameter', cables=self.cables(('diameter: 0.008', 'diameter: .nan')))

    def test_zero_quaternion(self):
        self.refused('pose', cables=self.cables(
            ('[-0.05, 0, 0, 0, 0, 0, 1]', '[-0.05, 0, 0, 0, 0, 0, 0]')))

    def test_link_not_in_vehicle(self):
        self.refused("bdy", "body", cables=self.cables(('b: {link: body', 'b: {link: bdy')))

    def test_links_are_checked_beside_other_mistakes(self):
        self.refused('lenght', "bdy", cables=self.cables(('length:', 'lenght:'),
                                                         ('b: {link: body', 'b: {link: bdy')))

    def test_clamps_too_far_apart(self):
        self.refused('cables.yaml', cables=self.cables(('length: 0.200', 'length: 0.090')))

    def test_all_problems_at_once(self):
        self.refused('lenght', 'diameter', 'no such bag', 'no.urdf',
                     vehicle=self.path('no.urdf'), bag=self.path('no.bag'),
                     cables=self.cables(('length:', 'lenght:'),
                                        ('diameter: 0.008', 'diameter: -1')))

    def test_missing_cable_file(self):
        self.refused('no.yaml', cables=self.path('no.yaml'))

    # ---- Vehicles.

    def vehicle_with_mesh(self, mesh):
        with open(self.path('body.urdf'), 'w') as file:
            file.write('<robot name="v"><link name="world"/><link name="body"><collision><geometry>'
                       '<mesh filename="%s"/></geometry></collision></link>'
                       '<joint name="j" type="floating"><parent link="world"/>'
                       '<child link="body"/></joint></robot>' % mesh)
        return {'vehicle': self.path('body.urdf'),
                'cables': self.cables(('    length: 0.200',
                                       '    avoid: [body]\n    length: 0.200'))}

    def test_mesh_missing(self):
        self.refused('gone.stl', **self.vehicle_with_mesh('file://' + self.path('gone.stl')))

    def test_mesh_with_nan(self):
        with open(self.path('nan.obj'), 'w') as file:
            file.write('v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n')
        self.refused('nan.obj', **self.vehicle_with_mesh('file://' + self.path('nan.obj')))

    ROCKER = ('<robot name="rover">\n<link name="body"/>\n<link name="rocker">\n%s</link>\n'
              '<joint name="j" type="prismatic"><parent link="body"/><child link="rocker"/>\n'
              '<axis xyz="0 0 1"/><limit effort="1" velocity="1"/></joint></robot>\n')
    LOOM = ('format: 1\ncables:\n  - {name: loom, length: 0.6, diameter: 0.01, '
            'mass_per_length: 0.1, EI: 0.01, GJ: 0.01, eta_EI: 1.0e-4,\n'
            '     a: {link: body, pose: [-0.2, 0, 0.2, 0, 0.70710678, 0, 0.70710678]},\n'
            '     b: {link: body, pose: [0.2, 0, 0.2, 0, 0.70710678, 0, 0.70710678]},\n'
            '     %s}\n')

    def rocking(self, geometry, avoid):
        """Arguments of a replay: a loom over a link that comes up by 10 mm."""
        with open(self.path('rover.urdf'), 'w') as file:
            file.write(self.ROCKER % geometry)
        with open(self.path('loom.yaml'), 'w') as file:
            file.write(self.LOOM % avoid)
        if not os.path.exists(self.path('rock.bag')):
            with rosbag.Bag(self.path('rock.bag'), 'w') as bag:
                for i in range(101):
                    stamp = rospy.Time.from_sec(10 + 0.01 * i)
                    message = JointState(name=['j'], position=[-0.10 + 1e-6 * i * i])
                    message.header.stamp = stamp
                    bag.write('/joint_states', message, stamp)
        return {'vehicle': self.path('rover.urdf'), 'cables': self.path('loom.yaml'),
                'bag': self.path('rock.bag')}

    def replay_rocking(self, inputs):
        output = os.path.join(self.output_folder, 'out.bag')
        json_path = self.path('out.json')
        code, text = run('cable_replay', '--vehicle', inputs['vehicle'], '--cables',
                         inputs['cables'], '--bag', inputs['bag'], '--output', output, '--json',
                         json_path)
        self.assertEqual(code, 0, text)
        with open(json_path) as file:
            loom = json.load(file)['cables']['loom']
        with rosbag.Bag(output) as bag:
            bodies = {m.bodies for _, m, _ in bag.read_messages('/cables/loom/apex')}
        return text, loom, bodies

    BOX = '<%s><geometry><box size="0.2 2 0.2"/></geometry></%s>\n'

    def test_avoided_link_without_collision(self):
        visual = self.BOX % ('visual', 'visual')
        inputs = self.rocking(visual, 'avoid: [rocker]')
        self.refused("loom.yaml:6: cables[0].avoid[0]: got 'rocker', a link without <collision>",
                     'rover.urdf:3', '{link: rocker, use_visual: true}', **inputs)
        self.assertEqual(run('cable_modes', inputs['cables'], '--vehicle', inputs['vehicle'])[0], 2)
        self.refused("got 'rocker', a link without <collision>", 'take the link out of `avoid`',
                     **self.rocking('', 'avoid: [rocker]'))
        self.refused("got 'rocker', a link without <visual>", 'leave out use_visual',
                     **self.rocking(self.BOX % ('collision', 'collision'),
                                    'avoid: [rocker], use_visual: true'))

    def test_visual_geometry_instead_of_collision(self):
        touched = []
        for kind, avoid in (('collision', 'avoid: [rocker]'),
                            ('visual', 'avoid: [rocker], use_visual: true'),
                            ('visual', 'avoid: [{link: rocker, use_visual: true}]')):
            text, loom, bodies = self.replay_rocking(self.rocking(self.BOX % (kind, kind), avoid))
            self.assertEqual(bodies, {1})
            self.assertEqual(loom['bodies'], 1)
            touched.append(loom['clearance_min'])
        self.assertIsNotNone(touched[0])
        self.assertEqual(touched[1:], touched[:1] * 2)

    def test_placeholder_without_extent(self):
        geometry = '<collision><geometry><sphere radius="0"/></geometry></collision>\n'
        inputs = self.rocking(geometry, 'avoid: [rocker]')
        note = ("rover.urdf:4: link[rocker].collision.sphere.radius: got '0': a geometry with a "
                'size of zero touches nothing')
        code, text = run('cable_check', '--vehicle', inputs['vehicle'], '--cables',
                         inputs['cables'])
        self.assertEqual(code, 0, text)
        self.assertIn(note, text)
        self.assertIn('avoids nothing: no clearance is measured', text)
        text, loom, bodies = self.replay_rocking(inputs)
        self.assertIn(note, text)
        self.assertIn('no body', text)
        self.assertEqual(loom['bodies'], 0)
        self.assertEqual(bodies, {0})

    def test_depth_is_judged_against_the_radius(self):
        geometry = self.BOX % ('collision', 'collision')
        soft = 'avoid: [rocker], contact: {stiffness: 5}'
        text, loom, _ = self.replay_rocking(self.rocking(geometry, soft))
        self.assertGreater(loom['penetration_share_of_radius'], 0.05)
        self.assertIn("sinks", text)
        self.assertIn("into 'rocker'", text)
        needed = loom['contact_stiffness_needed']
        self.assertIn('contact: {stiffness: %.1e}' % needed, text)
        for contact in ('', ', contact: {stiffness: %g}' % needed):
            text, loom, _ = self.replay_rocking(self.rocking(geometry, 'avoid: [rocker]' + contact))
            self.assertLess(loom['penetration_share_of_radius'], 0.05)
            self.assertGreater(loom['penetration_max'], 0)
            self.assertIsNone(loom['contact_stiffness_needed'])
            self.assertNotIn('sinks', text)

    # ---- Where cables come to rest.

    def arch(self, change):
        """Check and replay of the arch on a cart that stands still: exit code and text of each."""
        bag = self.write_messages('still.bag', [
            ('/tf', 10 + i / 100, self.moved('odom', 'base_link', 10 + i / 100, 0))
            for i in range(101)])
        for name, text in (('v.urdf', self.CART), ('c.yaml', change(self.ARCH % 'base_link'))):
            with open(self.path(name), 'w') as target:
                target.write(text)
        return [run(tool, '--vehicle', self.path('v.urdf'), '--cables', self.path('c.yaml'),
                    '--bag', bag, *output)
                for tool, output in (('cable_check', []),
                                     ('cable_replay', ['--output', self.path('o.bag')]))]

    def test_an_obstacle_that_holds_the_clamps_inside_is_told(self):
        plane = '    extensions: {contact: {plane: {azimuth: 0, elevation: 1.5707963, offset: 0.05}}}\n'
        (code, text), (replay_code, replay_text) = self.arch(lambda text: text + plane)
        self.assertEqual((code, replay_code), (0, 0), text + replay_text)
        inside = ('the obstacle of extensions.contact holds the cable: clamp a is 52.5 mm inside, '
                  'clamp b is 52.5 mm inside')
        self.assertIn("warning: cable 'lead': " + inside, text)
        self.assertIn('ok, but for 1 warning', text)
        self.assertIn("cable 'lead': " + inside, replay_text)
        self.assertIn('warning: ' + inside, replay_text)
        # Also where no equilibrium is found against it.
        for azimuth, elevation in ((0, 0), (1.5707963, 0), (0, -1.5707963)):
            other = ('    extensions: {contact: {plane: {azimuth: %g, elevation: %g, offset: 0.3}, '
                     'stiffness: 1.0e7}}\n' % (azimuth, elevation))
            _, (_, replay_text) = self.arch(lambda text: text + other)
            self.assertIn('clamp a is 302 mm inside', replay_text)
            self.assertNotIn('too far apart', replay_text)

    def test_a_cable_that_would_balance_falls_and_says_so(self):
        def standing(text):
            for old, new in (('[0, 0, 1, 1, 0, 0, 0]', '[0, 0, 1, 0, 0, 0, 1]'),
                             ('[0, 0.2, 1, 0, 0, 0, 1]', '[0.2, 0, 1, 0, 1, 0, 0]'),
                             ('mass_per_length: 0.03', 'mass_per_length: 0.2'),
                             ('EI: 2.5e-3', 'EI: 1.0e-3')):
                self.assertIn(old, text)
                text = text.replace(old, new)
            return text
        _, (code, text) = self.arch(standing)
        self.assertEqual(code, 0, text)
        self.assertIn("cable 'lead': it would balance in an unstable equilibrium", text)
        self.assertIn('warning: it would balance', text)
        self.assertNotIn('energy balance', text)
        _, (code, text) = self.arch(lambda text: text)
        self.assertNotIn('equilibrium', text)

    # ---- Recordings.

    def test_missing_bag(self):
        self.refused('no such bag', bag=self.path('no.bag'))

    def test_no_bag_at_all(self):
        with open(self.path('text.bag'), 'w') as file:
            file.write('not a bag\n')
        self.refused('text.bag', bag=self.path('text.bag'))

    def test_unindexed_bag(self):
        bag = rosbag.Bag(self.path('plain.bag'), 'w')
        bag.write('/tf', TFMessage(), rospy.Time(1))
        bag.flush()
        shutil.copy(self.path('plain.bag'), self.path('unindexed.bag'))
        bag.close()
        self.refused('rosbag reindex', bag=self.path('unindexed.bag'))

    def test_truncated_bag(self):
        with open(self.path('cut.bag'), 'wb') as target:
            target.write(self.bytes_of(SWEEP_BAG)[:60000])
        self.refused('cut.bag', 'truncated', bag=self.path('cut.bag'))

    def test_damaged_bag(self):
        data = bytearray(self.bytes_of(SWEEP_BAG))
        middle = len(data) // 3
        data[middle:middle + 64] = b'\xff' * 64
        with open(self.path('damaged.bag'), 'wb') as target:
            target.write(data)
        code, text = run('cable_check', '--vehicle', SWEEP_URDF, '--cables', SWEEP_YAML, '--bag',
                         self.path('damaged.bag'))
        # Flipped bytes may hit a number, which no reader can tell from a good one; what counts is that it
        # ends in an orderly way.
        self.assertIn(code, (0, 2), text)

    def test_bag_without_motion(self):
        with rosbag.Bag(self.path('empty.bag'), 'w') as bag:
            bag.write('/chatter', String('hello'), rospy.Time(1))
        self.refused('/tf', '/joint_states', bag=self.path('empty.bag'))

    def test_bag_drives_other_links(self):
        with rosbag.Bag(self.path('other.bag'), 'w') as bag:
            for i in range(100):
                transform = TransformStamped()
                transform.header.stamp = rospy.Time.from_sec(1 + 0.01 * i)
                transform.header.frame_id = 'map'
                transform.child_frame_id = 'drone'
                transform.transform.rotation.w = 1
                bag.write('/tf', TFMessage([transform]), transform.header.stamp)
        self.refused("'body'", bag=self.path('other.bag'))

    def test_wrong_type_on_topic(self):
        with rosbag.Bag(self.path('typed.bag'), 'w') as bag:
            bag.write('/tf', String('hello'), rospy.Time(1))
        self.refused('std_msgs/String', bag=self.path('typed.bag'))

    def test_samples_that_cannot_be_used_are_named_where_they_are_missed(self):
        with rosbag.Bag(self.path('joints.bag'), 'w') as bag:
            for i in range(20):
                message = JointState(name=['fl_travel'], position=[0.0])  # no stamp; moves two links
                bag.write('/joint_states', message, rospy.Time(1000 + 0.01 * i))
        self.refused("'fl_travel'", 'sample without a stamp by /joint_states: 40',
                     vehicle=CAR_URDF, cables=CAR_YAML, bag=self.path('joints.bag'))

    # ---- Outputs.

    def test_output_is_input(self):
        shutil.copy(SWEEP_BAG, self.path('in.bag'))
        before = self.bytes_of(SWEEP_BAG)
        code, text = run('cable_replay', '--vehicle', SWEEP_URDF, '--cables', SWEEP_YAML,
                         '--bag', self.path('in.bag'), '--output', self.path('in.bag'))
        self.assertEqual(code, 2, text)
        self.assertEqual(self.bytes_of(self.path('in.bag')), before)

    def test_output_folder_missing(self):
        code, text = run('cable_replay', '--vehicle', SWEEP_URDF, '--cables', SWEEP_YAML,
                         '--bag', SWEEP_BAG, '--output', self.path('none/out.bag'))
        self.assertEqual(code, 2, text)
        self.assertIn('does not exist', text)

    def replay_until_some_is_written(self, output):
        """A replay of the ride that is at it, and of which chunks are in the file."""
        process = subprocess.Popen(
            [os.path.join(TOOLS, 'cable_replay'), '--vehicle', CAR_URDF, '--cables', CAR_YAML,
             '--bag', RIDE_BAG, '--output', output],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        active = output + '.active'
        while process.poll() is None and not (os.path.exists(active) and
                                              os.path.getsize(active) > 1000000):
            time.sleep(0.01)
        return process

    def test_interrupt_keeps_a_valid_bag(self):
        output = os.path.join(self.output_folder, 'out.bag')
        process = self.replay_until_some_is_written(output)
        process.send_signal(signal.SIGINT)
        text = process.communicate(timeout=60)[0]
        self.assertEqual(process.returncode, 130, text)
        self.assertIn('interrupted', text)
        self.assertGreater(topics_of(output)['/cables/brake_hose_fl/apex'], 10)

    def test_what_a_killed_replay_wrote_can_be_indexed(self):
        output = os.path.join(self.output_folder, 'out.bag')
        process = self.replay_until_some_is_written(output)
        process.kill()
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, -signal.SIGKILL)
        killed = self.path('killed.bag')
        os.rename(output + '.active', killed)
        subprocess.run(['rosbag', 'reindex', '-q', killed], check=True)
        self.assertGreater(topics_of(killed)['/cables/brake_hose_fl/apex'], 10)

    def test_full_disk_keeps_a_valid_bag(self):
        small = self.path('small')
        os.mkdir(small)
        if subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=8m', 'tmpfs', small],
                          stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest('needs the right to mount a small file system')
        self.addCleanup(subprocess.run, ['umount', small], check=True)
        output = os.path.join(small, 'out.bag')
        code, text = run('cable_replay', '--vehicle', CAR_URDF, '--cables', CAR_YAML,
                         '--bag', RIDE_BAG, '--output', output)
        self.assertEqual(code, 4, text)
        self.assertIn('No space left', text)
        self.assertGreater(topics_of(output)['/cables/brake_hose_fl/apex'], 10)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
