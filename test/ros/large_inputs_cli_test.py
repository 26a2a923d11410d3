#!/usr/bin/python3
"""Inputs that are far larger than they should be, or have no end: each tool is done with them in
seconds, in words, within little memory."""
import math
import os
import resource
import subprocess
import unittest

import rosbag
import rospy
from command_line import SWEEP_BAG, SWEEP_URDF, SWEEP_YAML, TOOLS, CommandLine
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

# A check of the sweep takes 0.02 s and 20 MB; of the inputs here up to 3 s and 200 MB, where what
# grew with the square of their size took from ten seconds to minutes.
SECONDS, MEMORY = 30, 2 << 30
MANY = 20000


def transform(parent, child, x, time):
    edge = TransformStamped(child_frame_id=child)
    edge.header.frame_id = parent
    edge.header.stamp = time
    edge.transform.translation.x = x
    edge.transform.rotation.w = 1
    return edge


class LargeInputs(CommandLine):

    def run_tool(self, tool, *arguments):
        done = subprocess.run([os.path.join(TOOLS, tool), *arguments], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, timeout=SECONDS,
                              universal_newlines=True, preexec_fn=lambda: resource.setrlimit(
                                  resource.RLIMIT_AS, (MEMORY, MEMORY)))
        return done.returncode, done.stdout

    def check(self, vehicle=SWEEP_URDF, cables=SWEEP_YAML, bag=SWEEP_BAG, more=()):
        return self.run_tool('cable_check', '--vehicle', vehicle, '--cables', cables, '--bag', bag,
                             *more)

    def written(self, name, text):
        with open(self.path(name), 'w') as file:
            file.write(text)
        return self.path(name)

    def vehicle(self, elements, head=''):
        """The sweep's vehicle with these elements added."""
        with open(SWEEP_URDF) as file:
            text = file.read()
        text = text[text.index('<robot'):]
        end = text.rindex('</robot>')
        return self.written('vehicle.urdf', head + text[:end] + elements + text[end:])

    def bag(self, foreign):
        """The sweep's frame moves, and now and then `foreign` (parent, child) frames come."""
        with rosbag.Bag(self.path('in.bag'), 'w') as bag:
            for k in range(200):
                time = rospy.Time(100, k * 5000000)
                edges = [transform('world', 'body', 0.001 * math.sin(k / 20), time)]
                if k % 50 == 0:
                    edges += [transform(parent, child, 0.1, time) for parent, child in foreign]
                bag.write('/tf', TFMessage(edges), time)
        return self.path('in.bag')

    # ---- Time.

    def test_frames_that_belong_to_no_vehicle(self):
        for above in (lambda i: 'world', lambda i: 'f%d' % (i - 1) if i else 'world'):
            code, text = self.check(bag=self.bag([(above(i), 'f%d' % i) for i in range(MANY)]))
            self.assertEqual(code, 0, text)

    def test_a_loop_of_frames_is_still_told(self):
        code, text = self.check(bag=self.bag([('f1', 'f0'), ('f2', 'f1'), ('f0', 'f2'), ('g', 'g')]))
        self.assertEqual(code, 0, text)
        self.assertIn('f2', text)
        self.assertIn('above itself', text)

    def test_links_of_a_vehicle(self):
        joint = ('<link name="l%d"/><joint name="j%d" type="%s"><parent link="%s"/>'
                 '<child link="l%d"/><axis xyz="1 0 0"/>%s</joint>')
        for above in (lambda i: 'body', lambda i: 'l%d' % (i - 1) if i else 'body'):
            vehicle = self.vehicle(''.join(joint % (i, i, 'fixed', above(i), i, '')
                                           for i in range(MANY)))
            code, text = self.check(vehicle=vehicle)
            self.assertEqual(code, 0, text)
        for last in ('', '<mimic joint="j0"/>'):  # joints that follow each other, in a circle too
            vehicle = self.vehicle(''.join(
                joint % (i, i, 'continuous', 'body', i,
                         '<mimic joint="j%d"/>' % (i + 1) if i < MANY - 1 else last)
                for i in range(MANY)))
            code, text = self.check(vehicle=vehicle)
            self.assertEqual(code, 0, text)

    def test_names_that_are_all_unknown(self):
        vehicle = self.vehicle(''.join(
            '<link name="l%d"/><joint name="j%d" type="fixed"><parent link="body%d"/>'
            '<child link="k%d"/></joint>' % (i, i, i, i) for i in range(MANY)))
        code, text = self.check(vehicle=vehicle)
        self.assertEqual(code, 2)
        self.assertIn("there is no link 'body0'; did you mean 'body'?", text)

    def test_a_key_of_twenty_thousand_letters(self):
        with open(SWEEP_YAML) as file:
            text = file.read()
        key = 'k' * MANY
        code, text = self.check(cables=self.written('cables.yaml', '? %s\n: 1\n%s' % (key, text)))
        self.assertEqual(code, 2, text[:300])
        self.assertIn('unknown key', text)
        self.assertLess(len(text), 2000)
        code, text = self.check(cables=self.cables(('link: body', 'link: ' + key)))
        self.assertEqual(code, 2, text[:300])
        self.assertIn('expected a link of the vehicle', text)

    def test_twenty_thousand_unknown_keys(self):
        with open(SWEEP_YAML) as file:
            text = file.read()
        keys = ''.join('key%d: 1\n' % i for i in range(MANY))
        code, text = self.check(cables=self.written('cables.yaml', keys + text))
        self.assertEqual(code, 2)
        self.assertEqual(text.count('unknown key'), MANY)

    # ---- Memory.

    def test_files_that_have_no_end_or_are_no_text(self):
        fifo = self.path('fifo')
        os.mkfifo(fifo)
        holes = self.path('holes.yaml')
        with open(holes, 'w') as file:
            file.truncate(20 << 30)
        line = self.written('line.yaml', 'a' * (40 << 20))
        for path in ('/dev/zero', '/dev/full', '/dev/null', '/dev/urandom', '/dev/stdin', fifo, holes,
                     line, SWEEP_BAG, self.folder):
            sweep = ['--vehicle', SWEEP_URDF, '--cables', SWEEP_YAML]
            for tool, arguments in (
                    ('cable_check', ['--vehicle', path, '--cables', SWEEP_YAML]),
                    ('cable_check', ['--vehicle', SWEEP_URDF, '--cables', path]),
                    ('cable_check', sweep + ['--section', path]),
                    ('cable_simulate', [path, '--output', self.path('out')]),
                    ('cable_modes', [path, '--a', '0,0,0,0,0,0,1', '--b', '0,0,0.2,0,0,0,1'])):
                code, text = self.run_tool(tool, *arguments)
                self.assertEqual(code, 2, (tool, arguments, text[:300]))
                self.assertIn(os.path.basename(path), text[:2000], tool)
            if path != SWEEP_BAG:
                code, text = self.check(bag=path)
                self.assertEqual(code, 2, text[:300])

    def test_yaml_that_is_deep_or_refers_to_itself(self):
        laughs = 'a: &a [x, x, x, x, x, x, x, x, x]\n'
        for one, next_one in zip('abcdefghij', 'bcdefghijk'):
            laughs += '%s: &%s [%s]\n' % (next_one, next_one, ', '.join(['*' + one] * 9))
        for text in ('[' * 100000, '{a: ' * 100000, '- ' * 100000,
                     ''.join(' ' * i + 'a:\n' for i in range(3000)), laughs + 'cables: *k\n',
                     '&a [*a]\n', 'format: 1\ncables: &a\n  - *a\n  - <<: *a\n'):
            code, said = self.check(cables=self.written('deep.yaml', text))
            self.assertEqual(code, 2, said[:300])
            self.assertIn('deep.yaml', said)

    # ---- What XML can do.

    def test_entities_are_neither_expanded_nor_fetched(self):
        lol = '<?xml version="1.0"?>\n<!DOCTYPE lolz [<!ENTITY lol "lol">%s]>\n' % ''.join(
            '<!ENTITY lol%d "%s">' % (i, '&lol%s;' % (i - 1 if i > 1 else '') * 10)
            for i in range(1, 10))
        secret = self.written('secret', 'a secret')
        external = '<?xml version="1.0"?>\n<!DOCTYPE r [<!ENTITY x SYSTEM "file://%s">]>\n' % secret
        for head, entity in ((lol, '&lol9;'), (external, '&x;')):
            code, text = self.check(vehicle=self.vehicle('<link name="%s"/>' % entity, head))
            self.assertEqual(code, 2, text[:300])
            self.assertNotIn('lollol', text)
            self.assertNotIn('a secret', text)

    def test_xml_that_is_deep(self):
        code, text = self.check(vehicle=self.written(
            'deep.urdf', '<robot name="r">' + '<a>' * MANY + '</a>' * MANY + '</robot>'))
        self.assertEqual(code, 2, text[:300])
        self.assertIn('too deep', text)


if __name__ == '__main__':
    unittest.main()
