"""For the tests of the Python tools: runs one, and reads what it wrote without its own code."""

import os
import subprocess
import sys

import numpy as np
import rosbag

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def run(script, *arguments):
    """Exit code, stdout, stderr of a tool."""
    done = subprocess.run([sys.executable, os.path.join(ROOT, 'scripts', script),
                           *map(str, arguments)],
                          capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def read_joints(path):
    """{joint: (times, positions)} of a bag's /joint_states."""
    joints = {}
    with rosbag.Bag(path) as bag:
        for _, message, recorded in bag.read_messages(topics=['/joint_states']):
            assert recorded == message.header.stamp
            for name, position in zip(message.name, message.position):
                joints.setdefault(name, []).append((message.header.stamp.to_sec(), position))
    return {name: tuple(np.array(rows).T) for name, rows in joints.items()}


def contents(path):
    with open(path, 'rb') as source:
        return source.read()
