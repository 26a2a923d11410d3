"""Runs the programs of bench/ and the replay, and gathers their numbers."""

import json
import os
import platform
import re
import statistics
import subprocess
import sys
import tempfile
import time

import flop_count
import tool

PROGRAMS = {'kernel': ('rod_bench', 'rod_steps'), 'replay': ('cable_replay',),
            'mujoco': ('mujoco_bench',)}
NEEDS = {'rod_bench': 'Google Benchmark (Debian: libbenchmark-dev)',
         'mujoco_bench': 'MuJoCo (Debian: libmujoco-dev)', 'cable_replay': 'scripts/build'}
SHIPPED_ELEMENTS = 40


class Progress:
    """What is going on and how long the rest takes, judged by how long tasks took on the machine
    that they were first tried on."""

    def __init__(self, expected):
        self.left = dict(expected)  # {task: seconds there}
        self.count, self.done, self.slower = len(expected), 0.0, 1.0
        self.terminal = sys.stderr.isatty()

    def run(self, task, work):
        seconds = sum(self.left.values()) * self.slower
        number = self.count - len(self.left) + 1
        left = f'{seconds / 60:.0f} min' if seconds > 90 else f'{seconds:.0f} s'
        line = f'bench: {number} of {self.count}: {task} (about {left} left)'
        print('\r\x1b[K' + line if self.terminal else line, end='' if self.terminal else '\n',
              file=sys.stderr, flush=True)
        begin = time.monotonic()
        result = work()
        expected = self.left.pop(task)
        self.done += expected
        # One short task says little of the machine.
        weight = expected / max(self.done, 1e-9)
        self.slower += weight * ((time.monotonic() - begin) / expected - self.slower)
        if self.terminal and not self.left:
            print('\r\x1b[K', end='', file=sys.stderr)
        return result


class Programs:
    """The built programs, in the folders given."""

    def __init__(self, folders):
        self.folders = folders

    def find(self, name):
        paths = [os.path.join(folder, name) for folder in self.folders]
        return next((path for path in paths if os.access(path, os.X_OK)), None)

    def check(self, parts, problems):
        for name in (name for part in parts for name in PROGRAMS[part]):
            if not self.find(name):
                need = f', which needs {NEEDS[name]}' if name in NEEDS else ''
                problems.add(name, f'not in {", ".join(self.folders)}; build it with `cmake -S . '
                             f'-B build && cmake --build build --target all benchmarks`{need}')

    def run(self, name, *arguments):
        """Standard output."""
        done = subprocess.run([self.find(name), *map(str, arguments)], capture_output=True,
                              text=True, check=False)
        if done.returncode:
            print(f'\n{done.stderr[-2000:]}{name}: failed with {done.returncode}', file=sys.stderr)
            sys.exit(tool.FAILED)
        return done.stdout


def machine(programs):
    with open('/proc/cpuinfo', encoding='utf-8') as source:
        cpu = re.search(r'^model name\s*: (.*)$', source.read(), re.M)
    found = {'cpu': cpu[1].strip() if cpu else platform.machine(), 'cores': os.cpu_count(),
             'system': f'{platform.system()} {platform.machine()}'}
    with open('/proc/cpuinfo', encoding='utf-8') as source:
        flags = source.read()
    found['vectors'] = next((name for name in ('avx512f', 'avx2', 'avx', 'sse2', 'asimd')
                             if re.search(rf'\b{name}\b', flags)), 'unknown')
    if programs.find('rod_steps'):
        found.update(json.loads(programs.run('rod_steps', 'build')))
    return found


def kernel_times(programs, quick):
    """{benchmark: {argument: counters}}: medians; repetitions take turns with one another, so that
    a machine that is slow for a while is slow for all."""
    text = programs.run('rod_bench', '--benchmark_format=json',
                        f'--benchmark_repetitions={3 if quick else 9}',
                        f'--benchmark_min_time={0.01 if quick else 0.25}',
                        '--benchmark_enable_random_interleaving=true',
                        '--benchmark_report_aggregates_only=true')
    found = {}
    for row in json.loads(text)['benchmarks']:
        if row.get('error_occurred'):
            print(f"\nrod_bench: {row['name']}: {row['error_message']}", file=sys.stderr)
            sys.exit(tool.FAILED)
        if row['aggregate_name'] == 'median':
            name, _, argument = row['run_name'].partition('/')
            found.setdefault(name, {})[int(argument or 0)] = row
    return found


def kernel_numbers(programs, quick):
    found = kernel_times(programs, quick)
    one, lanes, many = found['OneRod'], found['RodsInLanes'], found['ManyRods']
    node = {'scalar': {n: 1e9 * row['node_step'] for n, row in one.items()},
            'lanes': {n: 1e9 * row['node_step'] for n, row in lanes.items()}}

    def spread(costs):
        from20 = [cost for n, cost in costs.items() if n >= 20]
        return max(from20) / min(from20) - 1
    return {
        'scalar_us_per_step_n40': 1e6 * one[SHIPPED_ELEMENTS]['cable_step'],
        'lanes_us_per_step_n40': 1e6 * lanes[SHIPPED_ELEMENTS]['cable_step'],
        'lanes_speedup_n40':
            one[SHIPPED_ELEMENTS]['cable_step'] / lanes[SHIPPED_ELEMENTS]['cable_step'],
        'scalar_ns_per_node_step': node['scalar'], 'lanes_ns_per_node_step': node['lanes'],
        'scalar_node_cost_spread_n20_to_n640': spread(node['scalar']),
        'lanes_node_cost_spread_n20_to_n640': spread(node['lanes']),
        'cables_us_per_cable_step_n40': {n: 1e6 * row['cable_step'] for n, row in many.items()},
        'peak_gflops': 1e-9 * found['FmaPeak'][0]['flops']}


def memory(programs):
    text = programs.run('rod_steps', 'memory', 1024, SHIPPED_ELEMENTS)
    return json.loads(text)['bytes_per_cable']


def flops(programs, lanes):
    """Operations per cable-step at 40 elements: one rod, and in lanes."""
    each = flop_count.disassembled(programs.find('rod_steps'))

    def of(how, cables):
        return flop_count.total(each, programs.run('rod_steps', how, SHIPPED_ELEMENTS, 1)) / cables
    return {'scalar_flops_per_step_n40': of('one', 1),
            'lanes_flops_per_step_n40': of('lanes', lanes)}


def alone(cables, folder):
    """A file with the first of the cables alone."""
    import yaml  # with ROS's Python tools
    with open(cables, encoding='utf-8') as source:
        content = yaml.safe_load(source)
    content['cables'] = content['cables'][:1]
    path = os.path.join(folder, 'alone.yaml')
    tool.write_text(path, yaml.safe_dump(content))
    return path


def replays(programs, root, quick):
    """Real-time factors of the ride, medians; one thread, all of them and one cable alone take
    turns."""
    factors = {}
    with tempfile.TemporaryDirectory() as folder:
        car = os.path.join(root, 'config', 'cables', 'car.yaml')
        summary = os.path.join(folder, 'summary.json')
        kinds = {'replay_real_time_factor': (car, 1),
                 'replay_all_threads_real_time_factor': (car, 0),
                 'replay_one_cable_real_time_factor': (alone(car, folder), 1)}
        for _ in range(1 if quick else 5):
            for name, (cables, threads) in kinds.items():
                programs.run('cable_replay', '--vehicle', os.path.join(root, 'urdf', 'car.urdf'),
                             '--cables', cables,
                             '--bag', os.path.join(root, 'test', 'data', 'ride.bag'),
                             '--output', os.path.join(folder, 'cables.bag'), '--json', summary,
                             '--threads', threads, *(('--duration', 2) if quick else ()))
                with open(summary, encoding='utf-8') as source:
                    factors.setdefault(name, []).append(json.load(source)['real_time_factor'])
    return {name: statistics.median(values) for name, values in factors.items()}


def mujoco(programs, quick):
    found = json.loads(programs.run('mujoco_bench', *(('--quick',) if quick else ())))
    return {'mujoco': found, 'mujoco_ratio': found['light_damping']['race']['ratio']}


def measure(programs, parts, root, quick):
    """All numbers of the parts asked for."""
    expected = {}
    if 'kernel' in parts:
        expected.update({'time step': 4 if quick else 90, 'memory': 1})
        if not quick:
            expected['floating-point operations'] = 10
    if 'replay' in parts:
        expected['replay'] = 3 if quick else 15
    if 'mujoco' in parts:
        expected['MuJoCo'] = 7 if quick else 900
    progress = Progress(expected)
    numbers = {'machine': machine(programs), 'quick': quick}
    if 'kernel' in parts:
        numbers.update(progress.run('time step', lambda: kernel_numbers(programs, quick)))
        numbers['memory_bytes_per_cable_n40'] = progress.run('memory', lambda: memory(programs))
        if not quick:
            numbers.update(progress.run('floating-point operations', lambda: flops(
                programs, numbers['machine']['lanes'])))
            for how in ('scalar', 'lanes'):  # operations per microsecond
                numbers[f'{how}_gflops_n40'] = (1e-3 * numbers[f'{how}_flops_per_step_n40']
                                                / numbers[f'{how}_us_per_step_n40'])
    if 'replay' in parts:
        numbers.update(progress.run('replay', lambda: replays(programs, root, quick)))
    if 'mujoco' in parts:
        numbers.update(progress.run('MuJoCo', lambda: mujoco(programs, quick)))
    return numbers
