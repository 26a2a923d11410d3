#!/usr/bin/python3
"""Launch files and URDFs as shipped: they parse, and all that they name is there.

The cable files are loaded by cable_file_test, which has the reader.
"""

import glob
import os
import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PACKAGE = 'cosserat_cable'
FOUND = re.compile(r'\$\(find ' + PACKAGE + r'\)/([^\s"\'$<]+)')
OTHERS_NODE = {'robot_state_publisher', 'rosbag', 'rviz'}  # packages whose nodes we start
LAUNCH_FILES = sorted(glob.glob(os.path.join(ROOT, 'launch', '*.launch'))
                      + glob.glob(os.path.join(ROOT, 'test', 'ros', '*.test')))
URDFS = sorted(glob.glob(os.path.join(ROOT, 'urdf', '*.urdf')))


def executables():
    """Names of our programs: one per src/apps/*.cpp, and the executable scripts of test/ros."""
    programs = {os.path.splitext(os.path.basename(path))[0]
                for path in glob.glob(os.path.join(ROOT, 'src', 'apps', '*.cpp'))}
    return programs | {os.path.basename(path)
                       for path in glob.glob(os.path.join(ROOT, 'test', 'ros', '*.py'))
                       if os.access(path, os.X_OK)}


def exec_depends():
    root = ElementTree.parse(os.path.join(ROOT, 'package.xml')).getroot()
    return {element.text for tag in ('depend', 'exec_depend') for element in root.findall(tag)}


def launch_problems(path):
    """What a launch file names that is not there."""
    root = ElementTree.parse(path).getroot()
    problems = []
    declared = {arg.get('name') for arg in root.iter('arg')}
    for element in root.iter():
        for text in (*element.attrib.values(), element.text or ''):
            for name in FOUND.findall(text):
                if not os.path.exists(os.path.join(ROOT, name)) and name not in executables():
                    problems.append(f'no file {name}')
            for name in re.findall(r'\$\(arg (\w+)\)', text):
                if name not in declared:
                    problems.append(f"no argument '{name}'")
    for node in (*root.iter('node'), *root.iter('test')):
        package, kind = node.get('pkg'), node.get('type')
        if package == PACKAGE and kind not in executables():
            problems.append(f'no executable {kind}')
        elif package != PACKAGE and package not in OTHERS_NODE & exec_depends():
            problems.append(f'package.xml has no exec_depend on {package}')
    for include in root.iter('include'):
        name = FOUND.match(include.get('file', ''))
        if name is None:
            continue
        theirs = ElementTree.parse(os.path.join(ROOT, name.group(1))).getroot().findall('arg')
        given = {arg.get('name') for arg in include.findall('arg')}
        problems += [f"{name.group(1)} has no argument '{extra}'"
                     for extra in sorted(given - {arg.get('name') for arg in theirs})]
        problems += [f"{name.group(1)} needs the argument '{arg.get('name')}'" for arg in theirs
                     if arg.get('default') is None and arg.get('value') is None
                     and arg.get('name') not in given]
    return problems


class LaunchFiles(unittest.TestCase):
    def test_name_what_exists(self):
        self.assertGreaterEqual(len(LAUNCH_FILES), 4)
        for path in LAUNCH_FILES:
            with self.subTest(os.path.relpath(path, ROOT)):
                self.assertEqual(launch_problems(path), [])


class Urdfs(unittest.TestCase):
    def test_meshes_exist(self):
        self.assertGreaterEqual(len(URDFS), 2)
        for path in URDFS:
            for mesh in ElementTree.parse(path).getroot().iter('mesh'):
                name = re.sub(r'^package://' + PACKAGE + '/', ROOT + '/', mesh.get('filename'))
                with self.subTest(os.path.relpath(path, ROOT), mesh=name):
                    self.assertTrue(os.path.isfile(os.path.join(os.path.dirname(path), name)))

    def test_urdfdom_reads_them(self):
        if shutil.which('check_urdf') is None:
            self.skipTest('check_urdf is not installed (liburdfdom-tools)')
        for path in URDFS:
            with self.subTest(os.path.relpath(path, ROOT)):
                done = subprocess.run(['check_urdf', path], capture_output=True, text=True,
                                      check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertIn('Successfully Parsed XML', done.stdout)
                self.assertNotIn('rror', done.stdout + done.stderr)


if __name__ == '__main__':
    unittest.main()
