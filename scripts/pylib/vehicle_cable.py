"""A cable in its vehicle: its keys without its place there, and where a recording moves its clamps."""

import os
import shlex
import shutil
import subprocess
import sys
import tempfile

import numpy as np

import set_folder
import tool

HERE = os.path.dirname(os.path.realpath(__file__))


def load(path, name, problems):
    """The keys of a cable of a vehicle's file, its type's among them, without those of its place."""
    _, content = set_folder.load_yaml(path, problems)
    if problems:
        return {}
    cables = content.get('cables') if isinstance(content, dict) else None
    if not isinstance(cables, list):
        problems.add(path, "cables: missing, expected the list of a vehicle's cables")
        return {}
    names = [cable.get('name') for cable in cables]
    if name not in names:
        problems.add('--name', f"got '{name}'" + tool.nearest(name, names))
        return {}
    cable = dict(cables[names.index(name)])
    keys = {**(content.get('types') or {}).get(cable.pop('type', None), {}), **cable}
    return {key: value for key, value in keys.items() if key not in set_folder.OF_VEHICLES}


def checker():
    """The program that follows clamps: beside this script, where it was built, or in the path."""
    beside = [os.path.join(HERE, '..'), os.path.join(HERE, '..', '..', 'build', 'devel', 'lib',
                                                     'cosserat_cable')]
    beside.insert(0, os.environ.get('COSSERAT_CABLE_PROGRAMS_DIR', beside[0]))
    for folder in beside:
        program = os.path.join(folder, 'cable_check')
        if os.access(program, os.X_OK):
            return program
    return shutil.which('cable_check')


def follow(options, problems):
    """[(times, rows of poses) of clamp a, the same of b]."""
    program = checker()
    if program is None:
        problems.add('cable_check', 'not found: build it (scripts/build), or put it in the path')
        return []
    with tempfile.TemporaryDirectory() as folder:
        command = [program, '--vehicle', options.vehicle, '--cables', options.cables, '--bag',
                   options.bag, '--clamps', folder, *shlex.split(options.replay_options)]
        if options.use_record_times:
            command.append('--use-record-times')
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            for line in done.stderr.splitlines() or [f'exit code {done.returncode}']:
                problems.add('cable_check', line)
            return []
        for line in done.stdout.splitlines():
            if line.startswith(('warning:', 'inertial frame')):
                print(f'  {line}', file=sys.stderr if line.startswith('warning') else sys.stdout)
        motions = []
        for side in 'ab':
            rows = np.loadtxt(os.path.join(folder, f'{options.name}_{side}.csv'), delimiter=',',
                              skiprows=1, ndmin=2)
            motions.append((rows[:, 0], rows[:, 1:]))
        return motions
