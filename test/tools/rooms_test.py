#!/usr/bin/python3
"""A room of the code includes only the rooms below it, ROS stays in its room, files stay small."""

import os
import re
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PACKAGE = 'cosserat_cable'

# What each room may include, besides itself.
BELOW = {
    'math': set(),
    'input': {'math'},
    'console': {'input'},
    'rod': {'math'},
    'contact': {'math', 'input'},
    'cable': {'rod', 'contact', 'input', 'math'},
    'causes': {'cable', 'rod', 'contact', 'input', 'math'},
    'measurement': {'causes', 'cable', 'rod', 'contact', 'input', 'math'},
    'fit': {'measurement', 'causes', 'cable', 'rod', 'contact', 'input', 'math'},
    'identification': {'fit', 'console', 'measurement', 'causes', 'cable', 'rod', 'contact', 'input',
                       'math'},
    'diagnosis': {'identification', 'fit', 'console', 'measurement', 'causes', 'cable', 'rod',
                  'contact', 'input', 'math'},
    'vehicle': {'math', 'input', 'contact'},
}
# These may include every room, and ROS.
ROS_ROOMS = {'ros', 'apps'}

MAX_LINES = 600  # one idea a file: beyond this there are several

# `X_msgs/`, and the folders of the ROS libraries that have headers.
ROS_HEADER = re.compile(r'(\w+_msgs|ros|rosbag|roslib|rosgraph|rosconsole|roscpp|rospack|tf|tf2|'
                        r'tf2_ros|tf2_eigen|tf2_geometry_msgs|tf_conversions|eigen_conversions|'
                        r'message_filters|diagnostic_updater|dynamic_reconfigure|geometric_shapes|'
                        r'nodelet|pluginlib|class_loader|resource_retriever|xmlrpcpp|'
                        r'interactive_markers|rviz|std_srvs|topic_tools|kdl_parser|'
                        r'robot_state_publisher)/')
GENERATED = re.compile(PACKAGE + r'/[A-Z]\w*\.h$')  # headers of our own messages
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')
SOURCES = ('.h', '.hpp', '.cpp', '.cc', '.inl')


def sources(root):
    """(room or '', path) of every source below include/ and src/."""
    for top in (os.path.join(root, 'include', PACKAGE), os.path.join(root, 'src')):
        for folder, _, names in os.walk(top):
            inside = os.path.relpath(folder, top).split(os.sep)
            for name in sorted(names):
                if name.endswith(SOURCES):
                    yield ('' if inside == ['.'] else inside[0]), os.path.join(folder, name)


def included_room(root, path, quoted, target):
    """The room that a header belongs to, or None where it is none of ours."""
    own = re.match(PACKAGE + r'/(\w+)/', target)
    if own:
        return own.group(1)
    if quoted:  # a private header beside the source, or reached by ../
        found = os.path.normpath(os.path.join(os.path.dirname(path), target))
        beside = os.path.relpath(found, os.path.join(root, 'src')).split(os.sep)
        if os.path.exists(found) and beside[0] != '..' and len(beside) > 1:
            return beside[0]
    return None


def violations(root):
    """One line `file:line: what is wrong` for each."""
    found = []
    for room, path in sources(root):
        name = os.path.relpath(path, root)
        if room not in BELOW and room not in ROS_ROOMS:
            found.append(f"{name}:1: '{room}' is no known room")
            continue
        with open(path, encoding='utf-8') as source:
            lines = source.readlines()
        if len(lines) >= MAX_LINES:
            found.append(f'{name}:{len(lines)}: expected fewer than {MAX_LINES} lines')
        if room in ROS_ROOMS:
            continue
        for number, line in enumerate(lines, 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            target = match.group(2)
            other = included_room(root, path, match.group(1) == '"', target)
            if ROS_HEADER.match(target) or GENERATED.match(target):
                found.append(f"{name}:{number}: room '{room}' includes the ROS header {target}")
            elif other is not None and other != room and other not in BELOW[room]:
                found.append(f"{name}:{number}: room '{room}' includes room '{other}'")
    return found


class Rooms(unittest.TestCase):
    def test_this_package(self):
        rooms = {room for room, _ in sources(ROOT)}
        self.assertEqual(rooms, set(BELOW) | ROS_ROOMS, 'rooms without a source, or unknown ones')
        self.assertEqual(violations(ROOT), [])

    def test_rooms_stand_on_those_before_them(self):
        standing = set()
        for room, below in BELOW.items():
            self.assertLessEqual(below, standing, f"'{room}' would close a circle")
            standing.add(room)


class TheCheckItself(unittest.TestCase):
    """On small trees made here."""

    def found(self, files):
        with tempfile.TemporaryDirectory() as root:
            for name, text in files.items():
                path = os.path.join(root, name)
                os.makedirs(os.path.dirname(path), exist_ok=True)
                with open(path, 'w', encoding='utf-8') as out:
                    out.write(text)
            return violations(root)

    def test_accepts_what_is_allowed(self):
        self.assertEqual(self.found({
            'src/rod/a.h': '#include "cosserat_cable/math/pose.h"\n',
            'src/rod/a.cpp': '#include "a.h"\n#include <vector>\n#include <Eigen/Core>\n',
            'src/vehicle/urdf.cpp': '#include <urdf_model/model.h>\n#include <fcl/fcl.h>\n',
            'src/ros/node.cpp': '#include <ros/ros.h>\n#include "cosserat_cable/cable/a.h"\n',
            'src/apps/main.cpp': '#include <std_msgs/Header.h>\n',
            'src/rod/long.cpp': '\n' * (MAX_LINES - 1),
        }), [])

    def test_room_above(self):
        self.assertEqual(self.found({
            'include/cosserat_cable/math/pose.h': '\n#include "cosserat_cable/rod/rod.h"\n'}),
            ["include/cosserat_cable/math/pose.h:2: room 'math' includes room 'rod'"])
        self.assertEqual(self.found({
            'src/rod/rod.cpp': ' # include <cosserat_cable/contact/body.h>\n'}),
            ["src/rod/rod.cpp:1: room 'rod' includes room 'contact'"])

    def test_private_header_of_another_room(self):
        self.assertEqual(self.found({
            'src/cable/inside.h': '\n',
            'src/vehicle/a.cpp': '#include "../cable/inside.h"\n'}),
            ["src/vehicle/a.cpp:1: room 'vehicle' includes room 'cable'"])

    def test_ros_outside_its_room(self):
        for header in ('<ros/ros.h>', '<tf2_msgs/TFMessage.h>', '"tf2/buffer_core.h"',
                       '<rosbag/bag.h>', '<cosserat_cable/ApexTelemetry.h>'):
            with self.subTest(header):
                self.assertEqual(self.found({'src/cable/a.cpp': f'#include {header}\n'}),
                                 [f"src/cable/a.cpp:1: room 'cable' includes the ROS header "
                                  f"{header[1:-1]}"])
        self.assertEqual(self.found({'src/cable/a.cpp': '#include "cosserat_cable/ros/warnings.h"'}),
                         ["src/cable/a.cpp:1: room 'cable' includes room 'ros'"])

    def test_unknown_room_and_long_file(self):
        self.assertEqual(self.found({'src/cellar/a.cpp': ''}),
                         ["src/cellar/a.cpp:1: 'cellar' is no known room"])
        self.assertEqual(self.found({'src/ros/long.cpp': '\n' * MAX_LINES}),
                         [f'src/ros/long.cpp:{MAX_LINES}: expected fewer than {MAX_LINES} lines'])


if __name__ == '__main__':
    unittest.main()
