"""Numbers by their paths in a cable's or a set's file (extensions.maxwell[0].tau), as the maps and
lists that the file has."""

import re


def nested(prefix, values):
    """The entry `prefix` of the file that these paths name: maps, and lists for names with [0]."""
    root = {}
    for path, value in values.items():
        if not path.startswith(prefix + '.'):
            continue
        keys = re.findall(r'[^.\[\]]+|\[\d+\]', path[len(prefix) + 1:])
        place = root
        for key in keys[:-1]:
            place = place.setdefault(key, {})
        place[keys[-1]] = value

    def lists(entry):
        if not isinstance(entry, dict):
            return entry
        if entry and all(key.startswith('[') for key in entry):
            return [lists(entry[key]) for key in sorted(entry)]
        return {key: lists(value) for key, value in entry.items()}
    return lists(root)
