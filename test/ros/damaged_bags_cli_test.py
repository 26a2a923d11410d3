#!/usr/bin/python3
"""Bags that are cut, damaged or lie about their sizes, and outputs that end early: bad input or file
trouble in words, within little memory, and what was written is readable."""
import os
import resource
import shutil
import signal
import struct
import subprocess
import time
import unittest

import rosbag
import rospy
from command_line import (CAR_URDF, CAR_YAML, RIDE_BAG, SWEEP_BAG, SWEEP_URDF, SWEEP_YAML, TOOLS,
                          CommandLine)
from geometry_msgs.msg import TransformStamped
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

# A run on the whole bag takes 20 MB, and as much address space as the libraries want.
MOST_MEMORY = 1 << 30
LIARS = 0xffffffff, 500 * 1024 * 1024


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))


def moved(t):
    edge = TransformStamped(child_frame_id='body')
    edge.header.frame_id = 'world'
    edge.header.stamp = t
    edge.transform.rotation.w = 1
    return TFMessage([edge])


class DamagedBags(CommandLine):

    def setUp(self):
        super().setUp()
        with open(SWEEP_BAG, 'rb') as bag:
            self.whole = bag.read()

    def check(self, content, size=None):
        """Exit code and text of a check of a bag with this content, as long as `size`."""
        path = self.path('in.bag')
        with open(path, 'wb') as bag:
            bag.write(content)
            bag.truncate(size or len(content))
        done = subprocess.run([os.path.join(TOOLS, 'cable_check'), '--vehicle', SWEEP_URDF,
                               '--cables', SWEEP_YAML, '--bag', path],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=30,
                              universal_newlines=True, preexec_fn=limit_memory)
        return done.returncode, done.stdout

    def refused(self, words, content, size=None):
        code, text = self.check(content, size)
        self.assertEqual(code, 2, text)
        self.assertIn(words, text)
        self.assertIn('in.bag', text)

    def with_field(self, name, value):
        """The whole bag, whose first field of this name is another number of as many bytes."""
        at = self.whole.index(name + b'=') + len(name) + 1
        return self.whole[:at] + value + self.whole[at + len(value):]

    def test_a_bag_that_is_cut_anywhere_is_named(self):
        for part in range(100):
            self.refused('rosbag reindex' if part else 'no bag',
                         self.whole[:len(self.whole) * part // 100])

    def test_a_bag_without_index_names_the_remedy(self):
        self.refused('rosbag reindex', self.with_field(b'index_pos', struct.pack('<Q', 0)))

    def test_sizes_that_the_bag_does_not_have_take_no_memory(self):
        for size in LIARS:
            for name in (b'size', b'conn_count', b'chunk_count'):
                self.refused('in.bag', self.with_field(name, struct.pack('<I', size)))
        for position in (13, len(self.whole), 1 << 62):
            self.refused('in.bag', self.with_field(b'index_pos', struct.pack('<Q', position)))

    def test_a_huge_sparse_bag_takes_no_memory(self):
        huge = 20 << 30
        code, text = self.check(self.whole, huge)  # its index says where everything is
        self.assertEqual(code, 0, text)
        self.refused('in.bag', self.with_field(b'index_pos', struct.pack('<Q', len(self.whole))),
                     huge)

    def test_messages_that_claim_more_than_they_have(self):
        for claimed in (2, 1 << 20, 0x3fffffff):
            payload = struct.pack('<I', claimed)
            with rosbag.Bag(self.path('claims.bag'), 'w') as bag:
                for n in range(10):
                    bag.write('/tf', ('tf2_msgs/TFMessage', payload, TFMessage._md5sum, ('0', '0'),
                                      TFMessage), rospy.Time(100 + n), raw=True)
            with open(self.path('claims.bag'), 'rb') as bag:
                self.refused('ends too early', bag.read())

    def test_times_that_are_none_are_named(self):
        with rosbag.Bag(self.path('times.bag'), 'w') as bag:
            for n in range(100):
                t = rospy.Time(100, n * 10000000)
                bag.write('/tf', moved(t), t)
        with open(self.path('times.bag'), 'rb') as bag:
            content = bag.read()
        at = content.index(b'index_pos=') + len(b'index_pos=')
        index, = struct.unpack_from('<Q', content, at)
        # The last entry of the chunk's index: seconds, nanoseconds, offset.
        for seconds, nanoseconds in ((0xffffffff, 0xffffffff), (101, 1000000000)):
            bad = bytearray(content)
            struct.pack_into('<II', bad, index - 12, seconds, nanoseconds)
            self.refused('a time in its index is none', bytes(bad))

    def test_the_last_times_that_there_are(self):
        with rosbag.Bag(self.path('late.bag'), 'w') as bag:
            for n in range(200):
                t = rospy.Time(4294967294 + n // 100, n % 100 * 10000000)
                bag.write('/tf', moved(t), t)
        done = subprocess.run([os.path.join(TOOLS, 'cable_replay'), '--vehicle', SWEEP_URDF,
                               '--cables', SWEEP_YAML, '--bag', self.path('late.bag'),
                               '--output', self.path('out.bag')], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_empty_and_foreign_bags(self):
        for name, messages in (('nothing moves the vehicle', []), ('std_msgs/String', [String('x')])):
            with rosbag.Bag(self.path('other.bag'), 'w') as bag:
                for message in messages:
                    bag.write('/tf', message, rospy.Time(1))
            with open(self.path('other.bag'), 'rb') as bag:
                self.refused(name, bag.read())

    # ---- Outputs that end early.

    def reindexed(self, path):
        """Messages of a bag after `rosbag reindex`."""
        bag = self.path('kept.bag')
        shutil.copy(path, bag)
        subprocess.run(['rosbag', 'reindex', bag], check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, timeout=60)
        with rosbag.Bag(bag) as kept:
            return sum(1 for _ in kept.read_messages(['/cables/brake_hose_fl/apex']))

    def start(self, output, *more):
        return subprocess.Popen([os.path.join(TOOLS, 'cable_replay'), '--vehicle', CAR_URDF,
                                 '--cables', CAR_YAML, '--bag', RIDE_BAG, '--output', output, *more],
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                universal_newlines=True)

    def test_a_killed_run_leaves_what_it_wrote(self):
        output = self.path('out.bag')
        process = self.start(output)
        self.addCleanup(process.stderr.close)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and process.poll() is None:
            if os.path.exists(output + '.active') and os.path.getsize(output + '.active') > 3e6:
                break
            time.sleep(0.02)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.assertFalse(os.path.exists(output))
        self.assertGreater(self.reindexed(output + '.active'), 100)

    @unittest.skipUnless(os.geteuid() == 0, 'mounts a small file system')
    def test_a_full_disk_leaves_what_it_wrote(self):
        disk = self.path('disk')
        os.mkdir(disk)
        # In a name space of its own, which goes with it: what is there at the end is copied out.
        script = ('mount -t tmpfs -o size=12m none "$0" || exit 77; "$@"; code=$?; '
                  'cp "$0"/* "$0.copy"/; exit $code')
        os.mkdir(disk + '.copy')
        done = subprocess.run(
            ['unshare', '-m', 'bash', '-c', script, disk, os.path.join(TOOLS, 'cable_replay'),
             '--vehicle', CAR_URDF, '--cables', CAR_YAML, '--bag', RIDE_BAG,
             '--output', disk + '/out.bag', '--json', disk + '/out.json'],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, universal_newlines=True, timeout=300)
        if done.returncode in (1, 77):
            self.skipTest('nothing can be mounted: ' + done.stderr)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn('No space left on device', done.stderr)
        kept = disk + '.copy/out.bag'
        if not os.path.exists(kept):
            self.assertIn('rosbag reindex', done.stderr)
            kept += '.active'
        self.assertGreater(self.reindexed(kept), 100)


if __name__ == '__main__':
    unittest.main()
