"""What a report of cable_diagnose says, item by item, from verdict.json, the records with what was
simulated, and the measurement set."""

import math

import numpy as np

import diagnosis_figures as figures
import diagnosis_set
import record_signals as signals
import report_cost
from report_numbers import NORMAL_95, number, percent, rounded, unit_of
from report_page import Bullets, Figure, Folded, Heading, Table, Text

MOST_LATE = 5  # causes that are told by name where the time budget was spent
LEADS = {'none': 'No cause:', 'ambiguous': 'Ambiguous:', 'unexplained': 'Unexplained:'}


class Record:
    """An experiment's channels with a noise level: measured, plain, extended."""

    def __init__(self, entry, columns, described, extended_label):
        self.name = entry['experiment']
        self.data, self.described, self.extended_label = columns, described, extended_label
        self.quasi_static = 'step' in columns
        self.x = columns.get('step' if self.quasi_static else 't', np.zeros(0))
        self.x_label = 'step' if self.quasi_static else 't [s]'
        self.noise = {name: level for name, level in (entry.get('noise') or {}).items() if level}
        self.columns = [name for name in columns if name in self.noise
                        and name + '.plain' in columns]
        self.has_extended = any(name + '.extended' in columns for name in self.columns)

    def measured(self, column):
        return self.data[column]

    def plain(self, column):
        return self.data[column + '.plain']

    def extended(self, column):
        return self.data.get(column + '.extended')

    def unit(self, column):
        return self.described.units.get(column) or 'SI unit'

    def times_noise(self, column, extended=False):
        """rms of the residual; nan where there is none."""
        model = self.extended(column) if extended else self.plain(column)
        if model is None:
            return math.nan
        return math.sqrt(np.nanmean((self.measured(column) - model) ** 2)) / self.noise[column]

    def worst(self):
        return max(self.columns, key=self.times_noise)

    def main(self):
        """The channel that moves most."""
        return max(self.columns, key=lambda name: np.nanstd(self.measured(name)))

    def driven(self):
        """What was moved or loaded at each sample, and its label."""
        if self.described.drive:
            label, x, values = self.described.drive
            return np.interp(self.x, x, values), label
        return self.x, self.x_label


def joined(words, last='and'):
    return f' {last} '.join(filter(None, (', '.join(words[:-1]), *words[-1:])))


def extended_label(data):
    """What the simulation beside the plain one is called."""
    if data.get('extended'):
        return 'extended: ' + ' + '.join(data['extended'].get('causes') or data.get('causes') or [])
    best = next((c['cause'] for c in data.get('candidates', []) if c.get('fitted')), '')
    return f'best candidate: {best}'


def headline(data):
    causes = data.get('causes') or []
    lead = LEADS.get(data['verdict'])
    if data['verdict'] == 'named':
        lead = f"{'Causes' if len(causes) > 1 else 'Cause'}: {joined(causes)}."
    return Text(f"{lead or data['verdict'] + ':'} {data.get('sentence') or ''}".strip(), 'headline')


def best_times_noise(data):
    if data.get('extended'):
        return data['extended'].get('times_noise')
    if data['verdict'] == 'none':
        return None
    return next((times_noise(c) for c in data.get('candidates', []) if c.get('fitted')), None)


def times_noise(candidate):
    chi2, samples = candidate.get('cost') or (None, None)
    return math.sqrt(chi2 / samples) if samples and chi2 is not None else None


def floor_unit(records):
    """The noise floor is that of the first quantity of the set."""
    record = next((r for r in records if r.columns), None)
    unit = record.described.units.get(record.columns[0]) if record else None
    return f' [{unit}]' if unit else ' [SI unit]'


def facts(data, records):
    baseline, extended = data.get('baseline') or {}, data.get('extended') or {}
    floor = number(data.get('noise_floor'))
    best = best_times_noise(data)
    header = ['', 'plain model'] + [extended_label(data)] * (best is not None) + ['noise alone']
    rows = [['left in these records, times the noise', number(baseline.get('times_noise'))]
            + [number(best)] * (best is not None) + ['1'],
            ['rms error on records that no fit saw' + floor_unit(records),
             number(baseline.get('rms_test'))]
            + [number(extended.get('rms_test'))] * (best is not None) + [floor]]
    return [Table(header, rows, ''), gain(data)]


def gain(data):
    found = data.get('gain')
    if not found or found.get('value') is None:
        return Text('Gain: none is claimed' + (
            ': it was not measured.' if data.get('extended') else ': nothing was extended.'), '')
    text = (f"Gain: with the extension {percent(found['value'])} is gone of what the plain model gets "
            f"wrong, beyond the noise, in records that no fit saw (95 %: {percent(found['low'])} to "
            f"{percent(found['high'])}).")
    if found['low'] is None or found['low'] > 0:
        return Text(text, '')
    return Text(text + ' The interval includes zero: on such records the extension is not shown to '
                'predict better.', 'warning')


def next_step(data):
    told = data.get('next_experiment')
    if told:
        return Text(f'What would change the verdict: {told}', 'verdict')
    open_rivals = [c for c in data.get('candidates', []) if c.get('fitted') and not c.get('rejected')
                   and c.get('causes') != data.get('causes')]
    if data['verdict'] == 'named' and not open_rivals:
        text = ('no experiment was proposed. These records exclude every rival that was fitted: see '
                'the table of candidates for how clearly.')
    elif data['verdict'] == 'none':
        text = ('no experiment was proposed. An effect that these records hide would need larger '
                'motion, another excitation or less noise.')
    else:
        text = 'no experiment was proposed.'
    return Text('What would change the verdict: ' + text, '')


def proof_items(records):
    drawable = [r for r in records if r.columns]
    if not drawable:
        return [Text('No record with a noise level was written: there is no picture.', 'warning')]
    record = max(drawable, key=lambda r: r.times_noise(r.worst()))
    column = record.worst()
    after = record.times_noise(column, extended=True)
    text = (f'{record.name} / {column}: where the plain model is off most, by '
            f'{rounded(record.times_noise(column))} times the noise')
    if record.has_extended:
        text += f'; {record.extended_label} leaves {rounded(after)} times'
    return [Figure(figures.proof(record, column), text + '. Above: the record and the simulations. '
                   'Below: what they leave of it, in units of the noise; grey is where 95 % of '
                   'the noise lies.')]


def decay_of(record, column, values, frequency=None):
    found = signals.swings(record.x, values, record.noise[column], frequency)
    return found if found and signals.decays(found) else None


def free_decays(records):
    """[(record, column, swings, [(label, Decay)], [(label, ratios, noise)])] of those that die away
    by themselves."""
    found = []
    for record in records:
        if record.quasi_static or not record.columns or record.described.free is False:
            continue
        column = record.main()
        measured = decay_of(record, column, record.measured(column))
        if not measured:
            continue
        decays, harmonics = [], []
        for label, values in (('measured', record.measured(column)), ('plain', record.plain(column)),
                              (record.extended_label, record.extended(column))):
            if values is None:
                continue
            swings = measured if label == 'measured' else decay_of(record, column, values,
                                                                   measured.frequency)
            if not swings:
                continue
            decays.append((label, signals.decay_of(swings)))
            ratios = signals.harmonics(record.x, values, swings, record.noise[column])
            if ratios:
                harmonics.append((label, *ratios))
        found.append((record, column, decays, harmonics))
    return found


def shown(found, left_out, what):
    """The first of them; what is cut off is told."""
    if len(found) > figures.MOST_RECORDS:
        left_out.append(f'{what}: {len(found) - figures.MOST_RECORDS} of {len(found)} records with a '
                        'smaller misfit are not drawn')
    return found[:figures.MOST_RECORDS]


def wrong_items(records):
    """What is wrong after recalibration."""
    items, left_out = [], []

    def add(title, picture, caption, otherwise):
        if picture:
            items.extend([Heading(title, 3), Figure(picture, caption)])
        else:
            left_out.append(f'{title}: {otherwise}')

    picture, missing = figures.all_channels(records)
    add('Where', picture, 'rms of the residual by experiment and channel, in times the noise: 1 is '
        'noise alone.', 'no channel has a noise level')
    if missing:
        left_out.append(f'Where: {missing} channels with a smaller misfit are not drawn')
    ranked = sorted((r for r in records if r.columns), key=lambda r: -r.times_noise(r.worst()))
    dynamic = [r for r in ranked if not r.quasi_static]
    add('At which frequency', figures.spectra([(r, r.worst()) for r in shown(
        dynamic, left_out, 'At which frequency')]),
        'Spectrum of the residual of the channel with the largest misfit of each record. Noise that '
        'is correlated lies above 1 at low frequency and below it at high.',
        'there is no record over time that is long enough')
    found = shown(free_decays(ranked), left_out, 'At which amplitude')
    add('At which amplitude', figures.decays([(r, c, decays) for r, c, decays, _ in found]),
        'Free decays, from the successive extrema of the channel that moves most (its slowest strong '
        'oscillation): decay rate, frequency and energy lost per cycle over the half swing. A linear '
        'model has level lines, unless several motions mix in the channel. Bars: twice the standard '
        'deviation that noise gives.',
        'no record is a free decay of at least four cycles above the noise')
    add('Harmonics', figures.harmonics([(r, c, ratios) for r, c, _, ratios in found if ratios]),
        'Share of the 2nd and 3rd harmonics in the largest swings of the free decays; the bar is twice '
        'the standard deviation that noise gives.',
        'no record is a free decay that is sampled finely enough')
    quasi_static = [r for r in ranked if r.quasi_static]
    add('Loops', figures.loops([(r, r.worst()) for r in shown(quasi_static, left_out, 'Loops')]),
        'Quasi-static records: the channel with the largest misfit over what was driven, less the '
        'parabola through the measured points, which would hide the loop (over the step, where the '
        'measurement set is no longer there).', 'no record is quasi-static')
    return items + ([Text('Left out:', ''), Bullets(left_out, '')] if left_out else [])


def bounded_gain(value):
    """The linearised gain of a model that predicts worse is a number without meaning."""
    if value is None:
        return '-'
    return 'worse than plain' if value < 0 else percent(value)


def why_not(candidate, data):
    if candidate.get('rejected'):
        return candidate['rejected']
    if data['verdict'] == 'named' and candidate.get('causes') == data.get('causes'):
        return 'the verdict'
    return {'ambiguous': 'cannot be excluded', 'unexplained': 'the best there is; not enough'
            }.get(data['verdict'], '-')


def candidate_items(data):
    fitted = [c for c in data.get('candidates', []) if c.get('fitted')]
    others = sorted((c for c in data.get('candidates', []) if not c.get('fitted')),
                    key=lambda c: -(c.get('promise') or 0))
    items = [Heading('Candidates', 2)]
    if fitted:
        rows = []
        for c in fitted:
            worse = c.get('worse') or (None, None)
            best = not worse[0] and not worse[1]
            rows.append([c['cause'], '-' if c.get('share') is None else percent(c['share']),
                         number(times_noise(c)), bounded_gain(c.get('gain')),
                         'best' if best else f'{rounded(worse[0])} ± {rounded(worse[1], 2)}',
                         why_not(c, data)])
        items.append(Table(['cause', 'share explained', 'times noise left', 'gain, held out *',
                            'worse than the best **', 'why not'], rows, ''))
        items.append(Text('* On records left out one at a time, linearised; it names nothing by '
                          'itself. ** Difference of the cost in noise variances ± its standard error, '
                          'by paired blocks of the records.', ''))
    else:
        items.append(Text('No cause was fitted.', ''))
    if others:
        rows = [[c['cause'], '-' if c.get('promise') is None else percent(c['promise']),
                 c.get('rejected') or '-'] for c in others]
        items.append(Folded(f'{len(others)} causes that were not fitted', [
            Table(['cause', 'promise (share explained, to first order)', 'why not'], rows, '')]))
    return items


def parameter_items(data):
    plain = data.get('baseline') or {}
    extended = data.get('extended') or {}
    names = list(plain.get('parameters') or {})
    names += [n for n in extended.get('parameters') or {} if n not in names]
    if not names:
        return []

    def told(model, name):
        value = (model.get('parameters') or {}).get(name)
        if value:
            return f'{number(*value)} ± {rounded(NORMAL_95 * value[1], 2)}'
        reason = (model.get('undetermined') or {}).get(name)
        return f'undetermined: {reason}' if reason else '-'

    both = [plain] + [extended] * bool(extended)
    rows = [[name, unit_of(name, data)] + [told(model, name) for model in both] for name in names]
    files = [extended[key] for key in ('cable', 'measurement') if extended.get(key)]
    return [Heading('Parameters', 2),
            Table(['parameter', 'unit', 'plain'] + ['extended'] * bool(extended), rows, ''),
            Text('Half of the 95 % interval after ±. Units are SI.' + (
                f" To simulate with: {joined(files)}." if files else ''), '')]


def warning_items(data):
    warnings = data.get('warnings')
    return [Heading('Warnings', 2), Bullets(warnings, 'warning')] if warnings else []


def late_items(data):
    """What the time budget left untried."""
    late = sorted((c for c in data.get('candidates', []) if not c.get('fitted')
                   and 'time budget' in (c.get('rejected') or '')),
                  key=lambda c: -(c.get('promise') or 0))
    if not late:
        return []
    names = [f"{c['cause']} ({percent(c.get('promise') or 0)})" for c in late[:MOST_LATE]]
    if len(late) > MOST_LATE:
        names.append(f'{len(late) - MOST_LATE} others')
    return [Text('The time budget was spent before these causes were fitted, and they may be at work: '
                 f'{joined(names)}. In brackets: what they explain of the misfit to first order.',
                 'warning')]


def content(data, columns):
    """All items. columns: {experiment: {column: array}}"""
    described = diagnosis_set.described(data.get('set') or '')
    label = extended_label(data)
    records = [Record(entry, columns.get(entry['experiment'], {}),
                      described.get(entry['experiment'], diagnosis_set.Described()), label)
               for entry in data.get('records', [])]
    items = [Heading('Diagnosis: ' + data.get('set', ''), 1), headline(data)]
    if data.get('interrupted'):
        items.append(Text('The work was interrupted: what follows is what had been found by then, and '
                          'causes that were not tried may still be at work.', 'warning'))
    if data.get('noise_known') is False:
        items.append(Text('The noise of a channel is not known: all that is told in times the noise '
                          'rests on a guess there.', 'warning'))
    items += late_items(data)
    return (items + facts(data, records) + [next_step(data)] + proof_items(records)
            + [Heading('What the plain model gets wrong, recalibrated', 2), *wrong_items(records)]
            + candidate_items(data) + parameter_items(data) + report_cost.items(data, 'Diagnosed')
            + warning_items(data))
