#!/usr/bin/python3
"""bench: a quick run gives the keys that others read, and a page is made of a run's numbers."""

import json
import os
import tempfile
import unittest

from helpers import ROOT, contents, run

PROGRAMS = os.environ.get('COSSERAT_CABLE_TOOLS_DIR',
                          os.path.join(ROOT, 'build', 'devel', 'lib', 'cosserat_cable'))
KEYS = {'kernel': ('scalar_us_per_step_n40', 'lanes_us_per_step_n40', 'lanes_speedup_n40',
                   'peak_gflops', 'memory_bytes_per_cable_n40'),
        'replay': ('replay_real_time_factor', 'replay_all_threads_real_time_factor',
                   'replay_one_cable_real_time_factor'),
        'mujoco': ('mujoco_ratio',)}
NEEDS = {'kernel': 'rod_bench', 'replay': 'cable_replay', 'mujoco': 'mujoco_bench'}


def trial(code, outcome='done'):
    return {'code': code, 'elements': 16, 'dt': 1e-3, 'integrator': 'Euler', 'solver': 'PGS',
            'outcome': outcome, 'apex_error': 0.0123, 'sway_error': 0.02, 'seconds': 0.5}


def full_report():
    """What a full run leaves, with made-up numbers."""
    costs = {str(10 * 2**i): 200.0 + i for i in range(7)}
    case = {'eta_EI': 2e-6, 'rod': [trial('rod')],
            'mujoco': [trial('mujoco'), trial('mujoco', 'unstable')]}
    numbers = {
        'quick': False, 'parts': ['kernel', 'replay', 'mujoco'], 'scalar_us_per_step_n40': 9.5,
        'lanes_us_per_step_n40': 3.25, 'lanes_speedup_n40': 2.9, 'peak_gflops': 50.0,
        'memory_bytes_per_cable_n40': 70000, 'scalar_ns_per_node_step': costs,
        'lanes_ns_per_node_step': costs, 'cables_us_per_cable_step_n40': {'1': 9.0, '1024': 4.0},
        'replay_real_time_factor': 40.5, 'replay_all_threads_real_time_factor': 70.5,
        'replay_one_cable_real_time_factor': 100.5, 'mujoco_ratio': 123.4,
        'machine': {'cpu': 'a processor', 'cores': 2, 'vectors': 'avx2', 'system': 'Linux',
                    'compiler': 'GNU', 'flags': '-O3', 'lanes': 4},
        'mujoco': {'mujoco_version': '2.2.2', 'tolerance': 0.02,
                   'reference': {'elements': 160, 'dt': 2.5e-4}, 'full_damping': case,
                   'light_damping': dict(case, mujoco_within_tolerance=True,
                                         chosen=[trial('rod'), trial('mujoco')],
                                         race={'ratios': [120.0, 123.4, 130.0]})}}
    for how in ('scalar', 'lanes'):
        numbers.update({f'{how}_flops_per_step_n40': 1e5, f'{how}_gflops_n40': 10.0,
                        f'{how}_node_cost_spread_n20_to_n640': 0.05})
    return numbers


class Bench(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.report = os.path.join(self.folder, 'bench.json')
        self.page = os.path.join(self.folder, 'performance.md')

    def test_a_quick_run_gives_positive_numbers(self):
        parts = [part for part, program in NEEDS.items()
                 if os.path.exists(os.path.join(PROGRAMS, program))]
        if not parts:
            self.skipTest('no benchmarks were built')
        code, _, errors = run('bench', '--quick', '--json', self.report, '--programs', PROGRAMS,
                              *(word for part in parts for word in ('--part', part)))
        self.assertEqual(code, 0, errors)
        numbers = json.loads(contents(self.report))
        for key in (key for part in parts for key in KEYS[part]):
            self.assertGreater(numbers[key], 0, key)

    def write(self, numbers):
        with open(self.report, 'w', encoding='utf-8') as out:
            json.dump(numbers, out)
        return run('bench', '--report', self.report, '--output', self.page)

    def test_the_page_of_a_full_run(self):
        code, _, errors = self.write(full_report())
        self.assertEqual(code, 0, errors)
        text = contents(self.page).decode()
        self.assertIn('| one cable | 9.50 | 100.0 | 10.0 | 20 % | 5 % |', text)
        self.assertIn('**123 times as fast**: median of 3 races of one thread each, from 120 to '
                      '130', text)
        self.assertIn('| MuJoCo | 16 | 1 | Euler | PGS | 1.2 % | 2 % | 0.5 |', text)
        self.assertIn('| MuJoCo | 16 | 1 | Euler | PGS | unstable |  |  |', text)
        for name in ('cost_over_elements', 'cost_over_cables'):
            self.assertIn(b'<svg', contents(os.path.join(self.folder, 'figures', name + '.svg')))

    def test_says_where_mujoco_is_not_accurate_enough(self):
        numbers = full_report()
        numbers['mujoco']['light_damping']['mujoco_within_tolerance'] = False
        self.assertEqual(self.write(numbers)[0], 0)
        self.assertIn('No setting of MuJoCo that was tried is within 2 %',
                      contents(self.page).decode())

    def test_no_page_of_a_quick_run(self):
        code, _, errors = self.write(dict(full_report(), quick=True))
        self.assertEqual(code, 2)
        self.assertIn('a page needs all of it', errors)
        self.assertFalse(os.path.exists(self.page))

    def test_says_what_to_build(self):
        code, _, errors = run('bench', '--programs', self.folder)
        self.assertEqual(code, 2)
        for name in ('rod_bench', 'rod_steps', 'cable_replay', 'libmujoco-dev', 'benchmarks'):
            self.assertIn(name, errors)


if __name__ == '__main__':
    unittest.main()
