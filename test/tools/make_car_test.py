#!/usr/bin/python3
"""The generated car: what is committed is what the script writes, its meshes are closed and
outward."""

import filecmp
import os
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np

from helpers import ROOT, contents, run

URDF = os.path.join(ROOT, 'urdf')
CORNERS = ('fl', 'fr', 'rl', 'rr')
# Sines differ in their last bits between processors and single-precision vertices then by one step
# at 2 m.
VERTEX = 3e-7
FEWEST_TRIANGLES = 10000  # a corner's wheel well and arm
MOST_BYTES = 4e6


def read_stl(path):
    """(n, 3, 3) corners of a binary STL file."""
    data = contents(path)
    count = int.from_bytes(data[80:84], 'little')
    assert len(data) == 84 + 50 * count
    records = np.frombuffer(data[84:], dtype='u1').reshape(count, 50)
    floats = records[:, :48].copy().view('<f4').reshape(count, 4, 3)
    return floats[:, 1:]


class Car(unittest.TestCase):
    def setUp(self):
        self.robot = ElementTree.parse(os.path.join(URDF, 'car.urdf')).getroot()
        self.meshes = {name: read_stl(os.path.join(URDF, 'meshes', name))
                       for name in os.listdir(os.path.join(URDF, 'meshes'))}

    def test_committed_files_are_what_the_script_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            code, _, errors = run('make_car', '-o', folder)
            self.assertEqual(code, 0, errors)
            self.assertTrue(filecmp.cmp(os.path.join(folder, 'car.urdf'),
                                        os.path.join(URDF, 'car.urdf'), shallow=False))
            self.assertEqual(sorted(os.listdir(os.path.join(folder, 'meshes'))),
                             sorted(self.meshes))
            for name, kept in self.meshes.items():
                np.testing.assert_allclose(read_stl(os.path.join(folder, 'meshes', name)), kept,
                                           rtol=0, atol=VERTEX)

    def test_meshes_are_closed_and_outward(self):
        for name, corners in self.meshes.items():
            _, vertex = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
            edges = {}
            for a, b, c in vertex.reshape(-1, 3).tolist():
                for edge in ((a, b), (b, c), (c, a)):
                    self.assertNotIn(edge, edges, f'{name}: an edge is used twice in one direction')
                    edges[edge] = True
            self.assertTrue(all((b, a) in edges for a, b in edges), f'{name}: open edges')
            a, b, c = np.moveaxis(corners.astype(float), 1, 0)
            self.assertGreater(np.einsum('ij,ij->', a, np.cross(b, c)), 0, f'{name}: inside out')
            self.assertGreater(np.linalg.norm(np.cross(b - a, c - a), axis=1).min(), 2e-10,
                               f'{name}: a triangle without area')

    def test_corner_meshes_may_be_turned_for_the_other_side(self):
        for name in ('wheel_well', 'arm', 'strut', 'carrier'):
            bounds = [f(self.meshes[f'{name}.stl'][..., 0]) for f in (np.min, np.max)]
            self.assertAlmostEqual(bounds[0], -bounds[1], places=4, msg=name)

    def test_sizes(self):
        self.assertGreater(len(self.meshes['wheel_well.stl']) + len(self.meshes['arm.stl']),
                           FEWEST_TRIANGLES)
        self.assertLess(sum(os.path.getsize(os.path.join(URDF, 'meshes', n)) for n in self.meshes),
                        MOST_BYTES)

    def test_urdf_parses(self):
        if not shutil.which('check_urdf'):
            self.skipTest('check_urdf (liburdfdom-tools) is not installed')
        for name in ('car.urdf', 'sweep.urdf'):
            done = subprocess.run(['check_urdf', os.path.join(URDF, name)], capture_output=True,
                                  text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_every_mesh_is_there(self):
        for mesh in self.robot.iter('mesh'):
            name = mesh.get('filename')
            self.assertTrue(name.startswith('package://cosserat_cable/urdf/meshes/'))
            self.assertIn(os.path.basename(name), self.meshes)
            self.assertIsNone(mesh.get('scale'))

    def test_joints_of_the_readme(self):
        joints = {j.get('name'): j for j in self.robot.iter('joint')}
        kinds = {'travel': 'prismatic', 'wheel_spin': 'continuous', 'arm_joint': 'revolute',
                 'wheel_well_mount': 'fixed'}
        for corner in CORNERS:
            for joint, kind in kinds.items():
                self.assertEqual(joints[f'{corner}_{joint}'].get('type'), kind)
            mimic = joints[f'{corner}_arm_joint'].find('mimic')
            self.assertEqual((mimic.get('joint'), float(mimic.get('multiplier'))),
                             (f'{corner}_travel', 3.125))
            # The arm's outer end follows the carrier: up in bump on both sides.
            axis = float(joints[f'{corner}_arm_joint'].find('axis').get('xyz').split()[0])
            self.assertEqual(axis, 1 if corner[1] == 'l' else -1)
        self.assertEqual({n for n in joints if n.endswith('_steer')}, {'fl_steer', 'fr_steer'})
        with open(os.path.join(URDF, 'README.md'), encoding='utf-8') as readme:
            text = readme.read()
        for name in re.findall(r'XX_[a-z_]+', text):
            links = {link.get('name') for link in self.robot.iter('link')}
            self.assertIn(name.replace('XX', 'rl'), links | set(joints))


if __name__ == '__main__':
    unittest.main()
