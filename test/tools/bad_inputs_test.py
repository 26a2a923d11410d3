#!/usr/bin/python3
"""Bad inputs of the Python tools: each is refused in words, never by a traceback, and no output is an
input."""

import json
import os
import shutil
import tempfile
import unittest

from helpers import ROOT, run

SWEEP_BAG = os.path.join(ROOT, 'test', 'data', 'sweep.bag')
CABLE = os.path.join(ROOT, 'config', 'cables', 'sweep.yaml')
GOOD = 't,fl,fr\n' + ''.join(f'{k * 0.01},{0.001 * (k % 20)},0\n' for k in range(300))
CSV = {
    'empty': b'', 'zeros': b'\0' * 1000, 'bytes': bytes(range(256)) * 20, 'header': b't,fl\n',
    'one_row': b't,fl\n0,1\n', 'nan': b't,fl\n0,nan\n1,nan\n2,nan\n',
    'back': b't,fl\n2,0\n1,0\n0,0\n', 'text': b't,fl\na,b\nc,d\n', 'ragged': b't,fl\n0,1\n1\n2,3,4\n',
    'quote': b't,"fl\n0,1\n', 'line': b't,fl\n' + b'1,' * 100000, 'far': b't,fl\n-1e300,0\n0,0\n1e300,0\n',
    'twice': b't,fl,fl\n0,1,1\n1,1,1\n2,1,1\n', 'clock': b'time,fl\n25:61:99,0\n26:00:00,0\n'}
# What a report's JSON may hold instead.
JSON = ['', '{', '[]', '3', '{}', '{"format": 1}', '{"format": 1, "cables": 3}',
        '{"format": 1, "cables": {"a": 3}}', '{"format": 1, "cables": {"a": {"modes": []}}}',
        '{"format": 1, "parameters": 3, "experiments": []}',
        '{"format": 1, "parameters": {"EI": [1]}, "experiments": {}}',
        '{"format": 1, "verdict": 3, "causes": {}}', '[' * 3000]
YAML = ['', '- a', 'a: [', 'cable: 3', '&a [*a]', '!!python/object/apply:os.system ["id"]',
        '[' * 5000]


class BadInputs(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.good = self.written('good.csv', GOOD.encode())

    def path(self, name):
        return os.path.join(self.folder, name)

    def written(self, name, content):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), 'wb') as file:
            file.write(content)
        return self.path(name)

    def refused(self, script, *arguments, code=(2, 4)):
        got, out, errors = run(script, *arguments)
        self.assertIn(got, code, (script, arguments, out, errors))
        self.assertNotIn('Traceback', errors, (script, arguments))
        self.assertTrue(errors.strip(), (script, arguments))
        return errors

    def travel(self, csv, *options, output='out.bag', column='fl=fl'):
        return self.refused('travel_to_bag', csv, '-o', os.path.join(self.folder, output),
                            '--column', column, *options)

    def test_logs_that_are_none(self):
        for name, content in CSV.items():
            self.travel(self.written(name + '.csv', content))
        for path in ('/dev/null', '/nowhere', self.folder, ''):
            self.travel(path)

    def test_options_of_logs(self):
        for option in ('--scale=nan', '--scale=inf', '--offset=nan', '--cutoff=nan', '--cutoff=-1',
                       '--rate=nan', '--rate=-1', '--rate=1e300', '--max-gap=nan', '--max-gap=-1',
                       '--vehicle=/dev/null', '--vehicle=' + self.folder):
            self.travel(self.good, option)
        for column in ('', '=', 'fl=', '=fl', 'fl=fl:x', 'fl=fl:nan', 'fl=fl:1:2:3', 'xx=fl'):
            self.travel(self.good, column=column)

    def test_bags_that_are_none(self):
        with open(SWEEP_BAG, 'rb') as bag:
            content = bag.read()
        index = content.index(b'index_pos=') + len(b'index_pos=')
        bags = [self.written('cut%d.bag' % part, content[:len(content) * part // 100])
                for part in (0, 1, 50, 99)]
        bags.append(self.written('none.bag', content[:index] + b'\0' * 8 + content[index + 8:]))
        for path in bags + [self.folder, '/dev/null', '/nowhere', '', self.good]:
            self.refused('plot_apex', path, '-o', self.path('apex.png'))
            self.refused('bag_to_set', path, '-o', self.path('set'), '--experiment', 'e', '--start',
                         'unknown', '--cable', CABLE, '--clamp-a', '0,0,0,0,0,0,1', '--clamp-b',
                         'free', '--channel', 'x=/tf:body,quantity=position,axis=x,s=0.1')

    def test_cables_and_options_of_sets(self):
        sweep = ['bag_to_set', SWEEP_BAG, '-o', self.path('set'), '--experiment', 'e', '--start',
                 'unknown', '--clamp-a', '0,0,0,0,0,0,1', '--clamp-b', 'free', '--channel',
                 'x=/tf:body,quantity=position,axis=x,s=0.1']
        for k, text in enumerate(YAML):
            self.refused(*sweep, '--cable', self.written('cable%d.yaml' % k, text.encode()))
        for path in ('/dev/null', '/nowhere', self.folder):
            self.refused(*sweep, '--cable', path)
        for option in ('--gravity=nan,0,0', '--gravity=1', '--length=nan', '--from=nan', '--to=-1',
                       '--scale=inf', '--max-gap=-1', '--offset-a=1,2', '--free-b=xx',
                       '--experiment=../x', '--start=held:nan', '--clamp-a=0,0,0,0,0,0,0',
                       '--clamp-b=disc:nan:1', '--channel=x', '--vehicle=/dev/null',
                       '--cables=/dev/null', '-o/dev/null'):
            self.refused(*sweep, '--cable', CABLE, option)

    def test_answers_that_no_tool_wrote(self):
        for k, text in enumerate(JSON):
            for name, script in (('modes.json', 'plot_modes'),
                                 ('identification.json', 'identification_report'),
                                 ('verdict.json', 'diagnosis_report')):
                folder = os.path.dirname(self.written('answer%d/%s' % (k, name), text.encode()))
                errors = self.refused(script, folder)
                self.assertIn(name, errors, (script, text))

    # ---- What is read is never written.

    def test_no_output_is_an_input(self):
        os.symlink(self.good, self.path('soft'))
        os.link(self.good, self.path('hard'))
        for name in ('good.csv', 'soft', 'hard', '../' + os.path.basename(self.folder) + '/good.csv'):
            self.assertIn('would be lost', self.travel(self.good, output=name))
            self.assertIn('would be lost', self.travel(self.good, '--json', self.path(name)))
        self.assertIn('is what --output writes', self.travel(self.good, '--json', self.path('out.bag')))
        bag = self.path('ride.png')  # a bag may have any name
        shutil.copy(SWEEP_BAG, bag)
        self.assertIn('would be lost', self.refused('plot_apex', bag, '-o', bag))
        with open(self.good, encoding='utf-8') as log:
            self.assertEqual(log.read(), GOOD)
        with open(bag, 'rb') as kept, open(SWEEP_BAG, 'rb') as source:
            self.assertEqual(kept.read(), source.read())

    def test_no_output_is_a_device_a_pipe_or_a_folder(self):
        os.mkfifo(self.path('pipe'))
        for output in ('/dev/null', '/dev/full', self.path('pipe')):
            self.assertIn('device or pipe', self.travel(self.good, output=output))
            self.assertIn('device or pipe', self.travel(self.good, '--json', output))
        self.assertIn('folder', self.travel(self.good, output=self.folder))
        self.refused('travel_to_bag', self.good, '-o', '/nowhere/out.bag', '--column', 'fl=fl', code=(4,))
        self.assertIn('empty', self.travel(self.good, '--json', ''))
        self.assertTrue(os.path.exists('/dev/null') and not os.path.isfile('/dev/null'))

    def test_json_is_what_a_good_run_writes(self):
        code, _, errors = run('travel_to_bag', self.good, '-o', self.path('out.bag'), '--column',
                              'fl=fl', '--json', self.path('out.json'))
        self.assertEqual(code, 0, errors)
        with open(self.path('out.json'), encoding='utf-8') as numbers:
            self.assertTrue(json.load(numbers))


if __name__ == '__main__':
    unittest.main()
