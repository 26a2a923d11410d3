#!/usr/bin/python3
"""What a run reads is never written, by whatever name it is called, and outputs are files."""
import os
import shutil
import unittest

from command_line import SOURCE, SWEEP_BAG, SWEEP_URDF, SWEEP_YAML, CommandLine, run

TEMPLATE_SET = os.path.join(SOURCE, 'config', 'sets', 'template')
STL = '''solid t
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid t
'''


class Outputs(CommandLine):

    def setUp(self):
        super().setUp()
        for name, source in (('in.bag', SWEEP_BAG), ('cables.yaml', SWEEP_YAML)):
            shutil.copy(source, self.path(name))
        with open(SWEEP_URDF) as file:
            text = file.read()
        # No cable touches the mesh: it is named, and not loaded.
        mesh = ('<link name="cover"><visual><geometry><mesh filename="cover.stl"/></geometry>'
                '</visual></link><joint name="cover_joint" type="fixed"><parent link="body"/>'
                '<child link="cover"/></joint></robot>')
        with open(self.path('vehicle.urdf'), 'w') as file:
            file.write(text.replace('</robot>', mesh))
        with open(self.path('cover.stl'), 'w') as file:
            file.write(STL)
        shutil.copytree(TEMPLATE_SET, self.path('set'))
        self.sweep = ['--vehicle', self.path('vehicle.urdf'), '--cables', self.path('cables.yaml'),
                      '--bag', self.path('in.bag')]
        self.inputs = ['in.bag', 'cables.yaml', 'vehicle.urdf', 'cover.stl']

    def contents(self):
        found = {}
        for folder, _, files in os.walk(self.folder):
            for name in files:
                path = os.path.join(folder, name)
                if os.path.isfile(path):
                    with open(path, 'rb') as file:
                        found[os.path.relpath(path, self.folder)] = file.read()
        return found

    def commands(self, path):
        """Every option of every tool that writes a file, as this one."""
        other = self.path('other.bag')
        modes = ['cable_modes', self.path('cables.yaml'), *self.sweep[:2], '--count', '1']
        yield ['cable_replay', *self.sweep, '--duration', '0.1', '--output', path]
        yield ['cable_replay', *self.sweep, '--duration', '0.1', '--output', other, '--json', path]
        yield ['cable_check', *self.sweep, '--json', path]
        yield [*modes, '--json', path]

    def lost(self, commands, words):
        before = self.contents()
        for command in commands:
            code, text = run(*command)
            self.assertEqual(code, 2, (command, text))
            self.assertIn(words, text, command)
            self.assertEqual(self.contents(), before, command)

    def test_no_output_is_an_input_by_any_name(self):
        for name in self.inputs:
            os.symlink(self.path(name), self.path('soft_' + name))
            os.link(self.path(name), self.path('hard_' + name))
            for path in (self.path(name), self.path('soft_' + name), self.path('hard_' + name),
                         os.path.join(self.folder, 'output', '..', name)):
                commands = list(self.commands(path))
                if name == 'in.bag':
                    commands = [c for c in commands if c[0] != 'cable_modes']
                self.lost(commands, 'is read by this run and would be lost')

    def test_nor_by_the_name_under_which_it_is_written(self):
        active = self.path('ride.bag.active')
        shutil.copy(SWEEP_BAG, active)
        sweep = self.sweep[:4] + ['--bag', active]
        self.lost([['cable_replay', *sweep, '--output', self.path('ride.bag')],
                   ['cable_check', *sweep, '--json', self.path('ride.bag')]], 'would be lost')

    def test_nor_is_a_file_of_a_folder(self):
        for name in ('cable.csv', 'cable_a.csv'):  # of the shapes, of the clamps' motions
            shutil.copy(self.path('cover.stl'), self.path(name))
        with open(self.path('vehicle.urdf')) as file:
            text = file.read()
        for name, command in (
                ('cable.csv', ['cable_modes', self.path('cables.yaml'), *self.sweep[:2], '--count',
                               '1', '--output', self.folder]),
                ('cable_a.csv', ['cable_check', *self.sweep, '--clamps', self.folder])):
            with open(self.path('vehicle.urdf'), 'w') as file:
                file.write(text.replace('cover.stl', name))
            self.lost([command], 'would be lost')

    def test_nor_is_a_file_of_a_set(self):
        for tool in ('cable_simulate', 'cable_identify', 'cable_diagnose'):
            for name in ('measurement.yaml', 'shaken.csv', 'shaker.csv'):
                self.lost([[tool, self.path('set'), '--output', self.path('answer'), '--json',
                            self.path('set/' + name)]], 'would be lost')
            self.assertFalse(os.path.exists(self.path('answer')))
        self.lost([['cable_simulate', self.path('set'), '--output', self.path('set')]],
                  'would be lost')

    def test_outputs_are_files(self):
        os.mkfifo(self.path('pipe'))
        for path in ('/dev/null', '/dev/full', self.path('pipe')):
            self.lost(self.commands(path), 'got a device or pipe')
            for tool in ('cable_simulate', 'cable_identify', 'cable_diagnose'):
                self.lost([[tool, self.path('set'), '--output', self.path('answer'), '--json', path]],
                          'got a device or pipe')
        self.lost(self.commands(self.folder), 'got a folder')


if __name__ == '__main__':
    unittest.main()
