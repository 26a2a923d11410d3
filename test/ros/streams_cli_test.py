#!/usr/bin/python3
"""Standard streams and limits that hold no result: no tool ends by a signal or claims success."""
import os
import signal
import subprocess
import time
import unittest

from command_line import (CAR_URDF, CAR_YAML, RIDE_BAG, SOURCE, SWEEP_BAG, SWEEP_URDF, SWEEP_YAML,
                          TOOLS, CommandLine)

TEMPLATE_SET = os.path.join(SOURCE, 'config', 'sets', 'template')
SWEEP = ['--vehicle', SWEEP_URDF, '--cables', SWEEP_YAML, '--bag', SWEEP_BAG]
FILE_TROUBLE, INTERRUPTED = 4, 130


def tools(folder):
    """A command line of every tool that prints something."""
    def in_folder(name):
        return os.path.join(folder, name)
    programs = {
        'cable_check': SWEEP,
        'cable_replay': SWEEP + ['--duration', '0.1', '--output', in_folder('out.bag')],
        'cable_modes': [CAR_YAML, '--vehicle', CAR_URDF, '--count', '1'],
        'cable_simulate': [TEMPLATE_SET, '--plain', '--output', in_folder('simulated')],
        'cable_identify': ['--help'], 'cable_diagnose': ['--help'], 'cable_node': ['--help']}
    commands = [[os.path.join(TOOLS, name), *arguments] for name, arguments in programs.items()]
    scripts = os.path.join(SOURCE, 'scripts')
    for name in sorted(os.listdir(scripts)):
        path = os.path.join(scripts, name)
        if os.path.isdir(path):
            continue
        with open(path, encoding='utf-8') as script:
            if script.readline().endswith('python3\n'):
                commands.append([path, '--help'])
    return commands


class Streams(CommandLine):

    def says_it_is_lost(self, command, **streams):
        done = subprocess.run(command, stderr=subprocess.PIPE, universal_newlines=True, timeout=300,
                              **streams)
        self.assertEqual(done.returncode, FILE_TROUBLE, (command, done.stderr))
        self.assertIn('standard output could not be written', done.stderr, command)
        self.assertNotIn('Traceback', done.stderr, command)

    def test_a_full_standard_output_is_file_trouble(self):
        commands = tools(self.folder)
        self.assertGreater(len(commands), 20)
        for command in commands:
            with open('/dev/full', 'w') as full:
                self.says_it_is_lost(command, stdout=full)

    def test_a_reader_that_has_gone_is_file_trouble(self):
        for command in tools(self.folder):
            reading, writing = os.pipe()
            os.close(reading)
            with os.fdopen(writing, 'w') as pipe:
                # As a shell starts them: Python itself ignores the signal, and hands that on.
                self.says_it_is_lost(command, stdout=pipe, preexec_fn=lambda: signal.signal(
                    signal.SIGPIPE, signal.SIG_DFL))

    def test_no_file_takes_the_number_of_a_closed_standard_output(self):
        output = self.path('out.bag')
        self.says_it_is_lost([os.path.join(TOOLS, 'cable_replay'), *SWEEP, '--duration', '0.1',
                              '--output', output], preexec_fn=lambda: os.close(1))
        with open(output, 'rb') as bag:
            self.assertEqual(bag.read(13), b'#ROSBAG V2.0\n')

    def limited(self, size, *command):
        """Standard error of a run whose files may have so many bytes."""
        done = subprocess.run(['bash', '-c', 'ulimit -f $0; exec "$@"', str(size // 1024), *command],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              universal_newlines=True, timeout=300)
        self.assertEqual(done.returncode, FILE_TROUBLE, done.stderr)
        return done.stderr

    def test_a_bag_beyond_the_limit_of_files_is_kept_as_far_as_it_came(self):
        text = self.limited(100 * 1024, os.path.join(TOOLS, 'cable_replay'), '--vehicle', CAR_URDF,
                            '--cables', CAR_YAML, '--bag', RIDE_BAG, '--duration', '1',
                            '--output', self.path('out.bag'))
        self.assertIn('rosbag reindex', text)
        self.assertTrue(os.path.exists(self.path('out.bag.active')))
        self.assertFalse(os.path.exists(self.path('out.bag')))

    def test_a_file_beyond_the_limit_is_written_whole_or_not_at_all(self):
        json = self.path('check.json')
        with open(json, 'w') as old:
            old.write('old')
        text = self.limited(1024, os.path.join(TOOLS, 'cable_check'), '--vehicle', CAR_URDF,
                            '--cables', CAR_YAML, '--bag', RIDE_BAG, '--json', json)
        self.assertIn('check.json', text)
        with open(json) as old:
            self.assertEqual(old.read(), 'old')
        self.limited(1024, os.path.join(TOOLS, 'cable_simulate'), TEMPLATE_SET, '--plain',
                     '--output', self.path('simulated'))

    def test_an_empty_path_is_bad_input(self):
        for tool, arguments in (('cable_replay', [*SWEEP, '--output', '']),
                                ('cable_check', [*SWEEP, '--json', '']),
                                ('cable_check', [*SWEEP, '--clamps', '']),
                                ('cable_simulate', [TEMPLATE_SET, '--output', '']),
                                ('cable_identify', [TEMPLATE_SET, '--output', '']),
                                ('cable_diagnose', [TEMPLATE_SET, '--output', '']),
                                ('cable_modes', [CAR_YAML, '--vehicle', CAR_URDF, '--output', ''])):
            done = subprocess.run([os.path.join(TOOLS, tool), *arguments], timeout=300,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  universal_newlines=True)
            self.assertEqual(done.returncode, 2, (tool, done.stdout))
            self.assertIn('empty', done.stdout, tool)

    def test_signals_that_end_a_run_leave_a_readable_bag(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            output = self.path('out%d.bag' % number)
            # Small steps: the ride takes minutes.
            process = subprocess.Popen(
                [os.path.join(TOOLS, 'cable_replay'), '--vehicle', CAR_URDF, '--cables', CAR_YAML,
                 '--bag', RIDE_BAG, '--dt', '1e-5', '--output', output],
                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, universal_newlines=True)
            self.addCleanup(process.kill)
            deadline = time.monotonic() + 60
            while not os.path.exists(output + '.active') and time.monotonic() < deadline:
                time.sleep(0.05)
            process.send_signal(number)
            _, text = process.communicate(timeout=60)
            self.assertEqual(process.returncode, INTERRUPTED, (number, text))
            self.assertIn('interrupted', text)
            self.assertTrue(os.path.exists(output), number)


if __name__ == '__main__':
    unittest.main()
