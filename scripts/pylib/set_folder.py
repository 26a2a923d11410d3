"""Measurement sets on disk: one more experiment in measurement.yaml, and its CSV files."""

import os
import sys

import tool

try:
    import yaml
except ImportError as error:
    sys.exit(f'{error}: install python3-yaml and run with /usr/bin/python3')

# Keys of a cable file that say nothing in a measurement set.
OF_VEHICLES = ('name', 'reference', 'a', 'b', 'apex', 'avoid', 'contact')


def load_yaml(path, problems):
    if not os.path.isfile(path):
        problems.add(path, 'got no file, expected a YAML file')
        return '', None
    with open(path, encoding='utf-8') as source:
        text = source.read()
    try:
        return text, with_numbers(yaml.safe_load(text))
    except RecursionError:
        problems.add(path, 'malformed YAML: too deep, or a list that is in itself')
        return text, None
    except yaml.YAMLError as error:
        mark = getattr(error, 'problem_mark', None)
        problems.add(f'{path}:{mark.line + 1}' if mark else path, f'malformed YAML: {error.problem}'
                     if mark else 'malformed YAML')
        return text, None


def with_numbers(value):
    """PyYAML takes `1e-4`, without a point, for a text; in these files it is a number."""
    if isinstance(value, dict):
        return {key: with_numbers(item) for key, item in value.items()}
    if isinstance(value, list):
        return [with_numbers(item) for item in value]
    if isinstance(value, str) and value[:1] in '+-.0123456789':
        try:
            return float(value)
        except ValueError:
            return value
    return value


def load_cable(path, problems):
    """(the keys of a file's `cable`, those left out)."""
    _, content = load_yaml(path, problems)
    if problems:
        return {}, []
    if not isinstance(content, dict) or not isinstance(content.get('cable'), dict):
        problems.add(path, "cable: missing, expected the keys of one cable (a file with `cables` "
                           'is a vehicle\'s)')
        return {}, []
    cable = content['cable']
    return ({key: value for key, value in cable.items() if key not in OF_VEHICLES},
            [key for key in cable if key in OF_VEHICLES])


class Flow(dict):
    """A map on one line."""


yaml.SafeDumper.add_representer(
    Flow, lambda dumper, data: dumper.represent_mapping('tag:yaml.org,2002:map', data.items(),
                                                        flow_style=True))
yaml.SafeDumper.add_representer(
    list, lambda dumper, data: dumper.represent_sequence(
        'tag:yaml.org,2002:seq', data,
        flow_style=not any(isinstance(item, (dict, list)) for item in data)))


class NoAliases(yaml.SafeDumper):
    def ignore_aliases(self, data):
        return True


def dump(value):
    return yaml.dump(value, Dumper=NoAliases, sort_keys=False, width=1000, allow_unicode=True)


class SetFolder:
    def __init__(self, path, problems):
        self.path, self.file = path, os.path.join(path, 'measurement.yaml')
        self.text, self.content = None, None
        if not os.path.exists(self.file):
            return
        self.text, self.content = load_yaml(self.file, problems)
        if not problems and not (isinstance(self.content, dict)
                                 and isinstance(self.content.get('experiments'), list)):
            problems.add(self.file, 'not a measurement set: it has no list of `experiments`')

    def exists(self):
        return self.content is not None

    def names(self):
        return [e.get('name') for e in self.content['experiments']] if self.content else []

    def with_experiment(self, cable, experiment):
        """(text of measurement.yaml, whether the rest of it stays as it was written)."""
        if not self.exists():
            return dump({'format': 1, 'cable': cable, 'experiments': [experiment]}), True
        others = [e for e in self.content['experiments'] if e.get('name') != experiment['name']]
        content = {**self.content, 'experiments': others + [experiment]}
        # Added at the end, comments and style of the others stay; where that is not possible, or
        # an experiment is replaced, all is written anew.
        for indent in ('', '  '):
            added = ''.join(indent + line for line in dump([experiment]).splitlines(True))
            text = self.text.rstrip('\n') + '\n' + added
            try:
                if with_numbers(yaml.safe_load(text)) == content:
                    return text, True
            except yaml.YAMLError:
                continue
        return dump(content), False


def csv_text(columns, rows):
    """Numbers that read back to the same bits."""
    lines = [','.join(columns)]
    lines += [','.join(repr(float(x)) for x in row) for row in rows]
    return '\n'.join(lines) + '\n'


def write(folder, files):
    """Writes {name: text}, measurement.yaml last: before it, the new files belong to nothing."""
    os.makedirs(folder, exist_ok=True)
    for name in sorted(files, key=lambda name: name == 'measurement.yaml'):
        tool.write_text(os.path.join(folder, name), files[name])
