"""What the measurement set tells that the verdict does not: units, and what was driven."""

import csv
import os

import numpy as np

import set_folder
import tool

UNITS = {'position': 'm', 'velocity': 'm/s', 'acceleration': 'm/s^2', 'angle': 'rad',
         'rate': 'rad/s', 'force': 'N', 'moment': 'N m'}
DRIVES = (('x', 'm'), ('y', 'm'), ('z', 'm'), ('fx', 'N'), ('fy', 'N'), ('fz', 'N'))


class Described:
    """An experiment: units by column; free, whether nothing drives it (None: not known); and drive,
    (label, step or t, value) of what is moved or loaded most."""

    def __init__(self, units=None, free=None, drive=None):
        self.units, self.free, self.drive = units or {}, free, drive


def strongest(files):
    """The column that varies most, of a motion's file or a load's."""
    found = None
    for label, path in files:
        with open(path, encoding='utf-8', newline='') as source:
            header, *rows = csv.reader(source)
        values = dict(zip(header, np.array([[float(c) for c in row] for row in rows]).T))
        for column, unit in DRIVES:
            if column in values and (found is None or np.ptp(values[column]) > found[0]):
                found = (np.ptp(values[column]), (f'{label}: {column} [{unit}]',
                                                  values[header[0]], values[column]))
    return found[1] if found and found[0] > 0 else None


def described(folder):
    """{experiment: Described}; empty where the set is no longer there."""
    problems = tool.Problems()
    try:
        found = set_folder.SetFolder(folder, problems)
    except OSError:
        return {}
    if problems or not found.exists():
        return {}
    experiments = {}
    for entry in found.content['experiments']:
        try:
            experiments[entry['name']] = _described(entry, folder)
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            continue  # changed since: the report does without
    return experiments


def _described(entry, folder):
    units = {c['column']: UNITS.get(c['quantity'], '') for c in entry['channels']}
    files = [(f'clamp {end}', os.path.join(folder, entry[end]['motion'])) for end in ('a', 'b')
             if isinstance(entry.get(end), dict) and 'motion' in entry[end]]
    if isinstance(entry.get('load'), str):
        files.append(('load', os.path.join(folder, entry['load'])))
    return Described(units, not files, strongest(files))
