"""One blind set: made by the generator, diagnosed, and the verdict held against the truth."""

import json
import math
import os
import re
import shutil
import subprocess
import time

import yaml

from report_numbers import NORMAL_95

PLAIN = ('EI', 'GJ', 'eta_EI', 'eta_GJ')


def load(*path):
    with open(os.path.join(*path)) as file:
        return json.load(file)


def store(content, *path):
    """Whole or not at all: what is there counts as done."""
    name = os.path.join(*path)
    with open(name + '.part', 'w') as file:
        json.dump(content, file, indent=1)
    os.replace(name + '.part', name)


def run(arguments, limit):
    """Seconds that it took; RuntimeError where it fails or takes longer than `limit`."""
    begin = time.monotonic()
    try:
        done = subprocess.run(arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        raise RuntimeError('took longer than %g s' % limit)
    if done.returncode != 0:
        raise RuntimeError('exit %d: %s' % (done.returncode, done.stdout.strip()[-300:]))
    return time.monotonic() - begin


class Case:
    """What the generator is asked for, and the folder where everything about it is kept."""

    def __init__(self, suite, seed, snr, strength, effect=''):
        self.suite, self.seed, self.snr, self.strength = suite, seed, snr, strength
        self.effect = effect

    def name(self):
        words = [self.suite, self.effect, 'seed%d' % self.seed, 'snr%g' % self.snr]
        if self.suite not in ('null', 'unidentifiable'):
            words.append('x%g' % self.strength)
        return '_'.join(word for word in words if word)

    def generator(self, programs, folder):
        arguments = [os.path.join(programs, 'rig_generator'), 'blind', '--suite', self.suite,
                     '--seed', str(self.seed), '--snr', str(self.snr), '--strength',
                     str(self.strength), '--output', folder]
        return arguments + (['--effect', self.effect] if self.effect else [])


def unseen_errors(simulate, folder, limit, values=None, cable=None, faults=None):
    """Sum over channels of the mean squares, in sigma^2, of what a cable predicts of the record
    that the diagnosis did not have; and the number of channels."""
    place = os.path.join(folder, 'predict')
    shutil.rmtree(place, ignore_errors=True)
    shutil.copytree(os.path.join(folder, 'unseen'), place)
    name = os.path.join(place, 'measurement.yaml')
    with open(name) as file:
        text = file.read()
    for key in PLAIN:
        value = (values or {}).get(key)
        if value is not None:
            text = re.sub(r'(?m)^  %s: .*$' % key, '  %s: %r' % (key, value[0]), text)
        elif key.startswith('eta'):
            text = re.sub(r'(?m)^  %s: null$' % key, '  %s: 0.0' % key, text)
    with open(name, 'w') as file:
        file.write(text + ('\nfaults: %s\n' % json.dumps(faults) if faults else ''))
    numbers = os.path.join(folder, 'predicted.json')
    run([simulate, place, '--output', os.path.join(folder, 'predicted'), '--rms', '--json', numbers]
        + (['--cable', cable] if cable else []), limit)
    rms = load(numbers)['experiments']['unseen']['rms']
    sigma = load(folder, 'truth.json')['unseen_sigma']['unseen']
    return sum((rms[c] / sigma[c]) ** 2 for c in sigma), len(sigma)


def unseen_gain(programs, folder, verdict, limit):
    """(MSE_baseline - MSE_extended)/(MSE_baseline - noise) on the unseen record; None where it
    cannot be told, or where recalibration leaves no more than noise there."""
    simulate = os.path.join(programs, 'cable_simulate')
    extended = verdict.get('extended') or {}
    if verdict['verdict'] != 'named' or not extended.get('cable'):
        return None
    # From the set that was written with them: it has the numbers that no record tells, too.
    faults = {}
    if extended.get('measurement'):
        with open(os.path.join(folder, 'verdict', extended['measurement'])) as file:
            faults = yaml.safe_load(file).get('faults', {})
    cable = os.path.join(folder, 'verdict', extended['cable'])
    plain, channels = unseen_errors(simulate, folder, limit, values=verdict['baseline']['parameters'])
    better, _ = unseen_errors(simulate, folder, limit, cable=cable, faults=faults)
    if plain < 1.1 * channels:
        return None
    return (plain - better) / (plain - channels)


def apart(path, found, true):
    """Angles come round again; the axes of a section after half a turn."""
    turn = (2 * math.pi if path.endswith(('.azimuth', '.elevation')) else
            math.pi if path.endswith('.anisotropy.roll') else 0)
    return abs(math.remainder(found - true, turn) if turn else found - true)


def as_one_section(values):
    """A section whose first axis is the softer one is that with the other first, a quarter turned."""
    values = dict(values)
    difference, roll = 'extensions.anisotropy.difference', 'extensions.anisotropy.roll'
    if values.get(difference) and values[difference][0] < 0:
        values[difference] = [-values[difference][0], values[difference][1]]
        if values.get(roll):
            values[roll] = [values[roll][0] + math.pi / 2, values[roll][1]]
    return values


def covered(truth, verdict):
    """{path: whether the interval holds the truth} of the extended cable's parameters."""
    known = dict(truth['parameters'], **truth['effect_parameters'])
    known = {path: value[0] for path, value in
             as_one_section({path: [value, 0] for path, value in known.items()}).items()}
    found = as_one_section((verdict.get('extended') or {}).get('parameters') or {})
    return {path: apart(path, value[0], known[path]) <= NORMAL_95 * value[1]
            for path, value in found.items() if value is not None and known.get(path)}


def judgement(truth, verdict):
    """In a word: right; cautious (a true answer that says less than could be known); partial (some
    of several causes); lucky (a true answer that the data do not carry); missed (an effect taken for noise); wrong (something that is not so)."""
    expected = truth['expected']
    said, causes = verdict['verdict'], set(verdict.get('causes') or [])
    true = set(expected['causes'])
    for name in expected['undetermined']:
        if (verdict['baseline']['parameters'] or {}).get(name) is not None:
            return 'wrong'
    if said == 'named':
        if expected['verdict'] == 'named':
            if causes - true - set(expected['also']):
                return 'wrong'
            return 'right' if true <= causes else 'partial'
        if not causes or not causes <= set(truth['effects']):
            return 'wrong'
        # Of several that look alike: right where the data do tell them apart after all.
        return 'right' if 'named' in expected['tolerated'] else 'lucky'
    if said == 'ambiguous':
        if expected['verdict'] == 'ambiguous':
            return 'right' if causes & set(truth['effects']) else 'wrong'
        if expected['verdict'] == 'named':
            return 'cautious' if causes & true else 'wrong'
        return 'cautious' if 'none' in causes or 'ambiguous' in expected['tolerated'] else 'wrong'
    if said == expected['verdict']:
        return 'right'
    if said in expected['tolerated']:
        return 'cautious'
    if said == 'unexplained':
        return 'wrong' if expected['verdict'] == 'none' else 'cautious'
    return 'missed'


def answered(case, programs, output, limit):
    """A row for the tables; what is there from before is kept."""
    folder = os.path.join(output, case.name())
    os.makedirs(folder, exist_ok=True)
    row = {'suite': case.suite, 'seed': case.seed, 'snr': case.snr, 'strength': case.strength,
           'name': case.name()}
    kept = os.path.join(folder, 'row.json')
    if os.path.exists(kept):
        return load(kept)
    try:
        if not os.path.exists(os.path.join(folder, 'truth.json')):
            run(case.generator(programs, folder), max(limit, 120))
        truth = load(folder, 'truth.json')
    except RuntimeError as error:
        return dict(row, label=case.effect or '?', judgement='unmade', error=str(error))
    row.update(label=truth['label'], reached=truth['strength']['reached'],
               expected=truth['expected']['verdict'])
    place = os.path.join(folder, 'verdict')
    try:
        if os.path.exists(os.path.join(place, 'verdict.json')):
            verdict = load(place, 'verdict.json')
            row['seconds'] = verdict.get('seconds')
        else:
            row['seconds'] = run([os.path.join(programs, 'cable_diagnose'),
                                  os.path.join(folder, 'set'), '--output', place, '--no-report'],
                                 limit)
            verdict = load(place, 'verdict.json')
    except (RuntimeError, OSError, ValueError) as error:
        return dict(row, judgement='failed', said='failed', error=str(error))
    causes = sorted(verdict.get('causes') or [])
    said = verdict['verdict']
    row.update(said='+'.join(causes) if said == 'named' else said, causes=causes,
               judgement=judgement(truth, verdict), covered=covered(truth, verdict),
               gain=(verdict.get('gain') or {}).get('value'), unseen=None)
    if row['judgement'] in ('right', 'partial'):
        try:
            row['unseen'] = unseen_gain(programs, folder, verdict, limit)
        except (RuntimeError, OSError, KeyError) as error:
            row['error'] = 'unseen record: %s' % error
    store(row, kept)
    return row
