#!/usr/bin/python3
"""Meshes that are no proper solids: each is named or accepted, and nothing ends by a signal."""
import math
import os
import resource
import struct
import subprocess
import unittest

from command_line import SWEEP_BAG, SWEEP_URDF, TOOLS, CommandLine

MEMORY, SECONDS = 4 << 30, 120
CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]  # seen from outside, anticlockwise


def stl(triangles):
    """A binary STL; the cable is 2 m away from what is within a cubic metre."""
    rows = [struct.pack('<12fH', 0, 0, 0, *a, *b, *c, 0) for a, b, c in triangles]
    return b'\0' * 80 + struct.pack('<I', len(triangles)) + b''.join(rows)


def tetrahedron(faces=tuple(FACES), size=1.0):
    return [[tuple(size * x for x in CORNERS[i]) for i in face] for face in faces]


def sphere(rings, sectors):
    """Its 2 * rings * sectors triangles, as the rows of a binary STL."""
    def point(i, k):
        polar, turn = math.pi * i / rings, 2 * math.pi * (k % sectors) / sectors
        return (math.sin(polar) * math.cos(turn), math.sin(polar) * math.sin(turn), math.cos(polar))
    rows = [[point(i, k) for k in range(sectors)] for i in range(rings + 1)]
    triangles = []
    for i in range(rings):
        for k in range(sectors):
            a, b = rows[i][k], rows[i][(k + 1) % sectors]
            c, d = rows[i + 1][k], rows[i + 1][(k + 1) % sectors]
            triangles += [(a, c, d), (a, d, b)]
    return triangles


class Meshes(CommandLine):

    def check(self, name, content, size=None):
        """Exit code and text of a check of the sweep with a cover 2 m above it."""
        path = self.path(name)
        if content is not None:
            with open(path, 'wb') as file:
                file.write(content if isinstance(content, bytes) else content.encode())
                if size:
                    file.truncate(size)
        with open(SWEEP_URDF) as file:
            text = file.read()
        cover = ('<link name="cover"><collision><origin xyz="0 0 2"/><geometry><mesh filename="%s"/>'
                 '</geometry></collision></link><joint name="cover_joint" type="fixed"><parent '
                 'link="body"/><child link="cover"/></joint></robot>' % name)
        with open(self.path('vehicle.urdf'), 'w') as file:
            file.write(text.replace('</robot>', cover))
        cables = self.cables(('length: 0.200', 'avoid: [cover]\n    length: 0.200'))
        done = subprocess.run(
            [os.path.join(TOOLS, 'cable_check'), '--vehicle', self.path('vehicle.urdf'),
             '--cables', cables, '--bag', SWEEP_BAG], stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, timeout=SECONDS, errors='replace', universal_newlines=True,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)))
        return done.returncode, done.stdout

    def accepted(self, content, triangles, name='cover.stl'):
        code, text = self.check(name, content)
        self.assertEqual(code, 0, text[:2000])
        self.assertIn('with %d triangles' % triangles, text)

    def refused(self, words, content, name='cover.stl', size=None):
        code, text = self.check(name, content, size)
        self.assertEqual(code, 2, (name, text[:2000]))
        self.assertIn(words, text)
        self.assertIn(name, text)

    def test_solids_with_flaws_are_accepted(self):
        self.accepted(stl(tetrahedron()), 4)
        self.accepted(stl(tetrahedron(FACES[:3])), 3)  # a hole
        self.accepted(stl(tetrahedron([face[::-1] for face in FACES])), 4)  # inside out
        self.accepted(stl(tetrahedron(FACES[:2] + [face[::-1] for face in FACES[2:]])), 4)
        # A point is left out; a sliver between three corners may be what closes a solid.
        sliver = [(0, 0, 0), (1, 0, 0), (0.5, 0, 0)]
        self.accepted(stl(tetrahedron() + [[(0, 0, 0)] * 3, sliver]), 5)
        # A nanometre is a point.
        self.accepted(stl(tetrahedron(size=1e-9) + tetrahedron()), 4)

    def test_a_million_triangles(self):
        rings, sectors = 500, 1000
        # At the poles a sector's second triangle has no area.
        self.accepted(stl(sphere(rings, sectors)), 2 * rings * sectors - 2 * sectors)

    def test_numbers_that_are_none_are_named(self):
        for bad in (math.nan, math.inf, -math.inf):
            triangles = tetrahedron()
            triangles[2][1] = (0.0, bad, 0.0)
            self.refused('not finite', stl(triangles))

    def test_meshes_without_an_area_are_named(self):
        self.refused('no triangle with an area', stl([[(0, 0, 0)] * 3] * 5))
        self.refused('no triangle with an area', stl([[(0, 0, 0), (1, 0, 0), (2, 0, 0)]]))

    def test_files_that_are_none_are_named(self):
        whole = stl(tetrahedron())
        for content in (b'', b'\0' * 100, whole[:100], whole[:-10], b'solid x\nfacet',
                        whole[:80] + struct.pack('<I', 0xffffffff) + whole[84:]):
            self.refused('mesh', content)
        for name in ('cover.obj', 'cover.dae', 'cover.xyz'):
            self.refused('mesh', bytes(range(256)) * 10, name)
        self.refused('mesh', 'v 0 0 0\nf 1 2 99999999\n', 'cover.obj')
        os.mkdir(self.path('folder.stl'))
        self.refused('mesh', None, 'folder.stl')
        os.mkfifo(self.path('fifo.stl'))
        self.refused('mesh', None, 'fifo.stl')
        self.refused('bytes', whole, 'sparse.stl', 20 << 30)

    def test_collada_is_not_expanded_fetched_or_followed_too_deep(self):
        dae = ('<?xml version="1.0"?>%s<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" '
               'version="1.4.1"><asset/><library_visual_scenes><visual_scene id="s">%s'
               '</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/>'
               '</scene></COLLADA>')
        lol = '<!DOCTYPE l [<!ENTITY lol "lol">%s]>' % ''.join(
            '<!ENTITY lol%d "%s">' % (i, '&lol%s;' % (i - 1 if i > 1 else '') * 10)
            for i in range(1, 10))
        with open(self.path('secret'), 'w') as file:
            file.write('a secret')
        external = '<!DOCTYPE r [<!ENTITY x SYSTEM "file://%s">]>' % self.path('secret')
        for head, scene in ((lol, '<node name="&lol9;"/>'), (external, '<node name="&x;"/>'),
                            ('', '<node>' * 100000 + '</node>' * 100000),
                            ('', '<node id="n"><instance_node url="#n"/></node>')):
            code, text = self.check('cover.dae', dae % (head, scene))
            self.assertEqual(code, 2, (head[:40], scene[:40], text[:500]))
            self.assertIn('cover.dae', text)
            self.assertNotIn('a secret', text)
            self.assertNotIn('lollol', text)


if __name__ == '__main__':
    unittest.main()
