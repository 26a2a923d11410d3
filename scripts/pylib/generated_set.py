"""Sets of rig_generator (test/generator) with one cause at work: a seen set, a record in unseen/,
the truth of both."""

import json
import os
import re
import subprocess

from nested_paths import nested

CAUSES = ('maxwell', 'structural_damping', 'section_friction', 'nonlinear_stiffness', 'anisotropy',
          'rest_curvature', 'bend_twist_coupling', 'clamp_compliance', 'clamp_damping',
          'clamp_friction', 'clamp_play', 'air_drag', 'external_damping', 'added_mass', 'contact',
          'drift', 'clock', 'sensor', 'base_motion')
PLAIN = ('EI', 'GJ', 'eta_EI', 'eta_GJ')
# Numbers that the truth has as zero where that part of the cause is not there.
ABSENT = ('clamp_', 'peg', 'low_pass', 'bracket')


class Failed(RuntimeError):
    """A program ended with an error."""


def run(arguments):
    done = subprocess.run(arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          universal_newlines=True, check=False)
    if done.returncode != 0:
        raise Failed('%s: exit %d: %s' % (' '.join(arguments[:3]), done.returncode,
                                          done.stdout.strip()[-400:]))


def load(*path):
    with open(os.path.join(*path), encoding='utf-8') as file:
        return json.load(file)


def present(effects):
    """The effect's numbers without those that truth.json has as absent."""
    there = {path: value for path, value in effects.items()
             if value != 0 or not any(word in path for word in ABSENT)}
    if not there.get('faults.base_motion.a.bracket.frequency'):
        there = {path: value for path, value in there.items() if 'bracket' not in path}
    return there


class GeneratedSet:
    """In `folder`; `cause` None: of the plain cable."""

    def __init__(self, programs, folder, cause, seed, snr):
        self.programs, self.folder, self.snr = programs, folder, snr
        effect = ['--effect', cause] if cause else []
        run([os.path.join(programs, 'rig_generator'), 'effects', *effect, '--seed', str(seed),
             '--snr', str(snr), '--output', folder])
        truth = load(folder, 'truth.json')
        self.parameters = truth['parameters']
        self.effects = present(truth['effect_parameters'])
        self.sigma = {'': truth['sigma'], 'unseen': load(folder, 'unseen', 'truth.json')['sigma']}
        self.text = {}
        for part in self.sigma:
            with open(self.path(part, 'measurement.yaml'), encoding='utf-8') as file:
                self.text[part] = file.read()

    def path(self, part, *names):
        return os.path.join(self.folder, part, *names)

    def write(self, part, uncertain=None, values=None, cable=None):
        """The set of `part` with these numbers of causes, by their paths, and of its cable."""
        values, text = values or {}, self.text[part]
        for name, value in (cable or {}).items():
            text = re.sub(r'(?m)^  %s: .*$' % name, '  %s: %.17g' % (name, value), text)
        extensions, faults = nested('extensions', values), nested('faults', values)
        lines = 'uncertain: ' + json.dumps(uncertain) if uncertain else ''
        if extensions:
            lines += '\n  ' * bool(lines) + 'extensions: ' + json.dumps(extensions)
        if lines:
            text = re.sub(r'uncertain: \[.*\]', lambda _: lines, text)
        if faults:
            text += '\nfaults: %s\n' % json.dumps(faults)
        with open(self.path(part, 'measurement.yaml'), 'w', encoding='utf-8') as file:
            file.write(text)

    def rms(self, part, cable=None):
        """{record: {channel: rms of simulated less recorded}}, with the set's own cable or with
        that of a file."""
        numbers = self.path('', 'predicted.json')
        run([os.path.join(self.programs, 'cable_simulate'), self.path(part),
             *(['--cable', cable] if cable else []), '--output', self.path('', 'predicted'),
             '--rms', '--json', numbers])
        return {name: of['rms'] for name, of in load(numbers)['experiments'].items()}
