"""What a report of cable_identify says, item by item, from identification.json and the records."""

import identification_figures as figures
import report_cost
from report_numbers import NORMAL_95, number, percent, rounded, unit_of
from report_page import Bullets, Figure, Heading, Table, Text

# Residual over noise from which on a channel is said not to be explained.
MISFIT = 1.3
NOISE_FROM = {'set': 'given', 'record': 'the record', 'repeats': 'repeated steps',
              'residual': 'the residual: there is no other way'}


def intervals_of(data):
    """{parameter: (low, high)}, 95 %: as given, or from the standard deviation."""
    found = {}
    for name, estimate in data['parameters'].items():
        if estimate is None:
            continue
        given = (data.get('intervals') or {}).get(name)
        found[name] = tuple(given) if given else (estimate[0] - NORMAL_95 * estimate[1],
                                                  estimate[0] + NORMAL_95 * estimate[1])
    return found


def half_width(name, data, intervals):
    """Relative; None for a parameter that is 0."""
    value = data['parameters'][name][0]
    low, high = intervals[name]
    return (high - low) / 2 / abs(value) if value else None


def unexplained(channel):
    """Whether the residual is clearly more than noise; older answers leave that to a threshold."""
    explained = channel.get('explained')
    return (channel.get('misfit') or 0) > MISFIT if explained is None else not explained


def stop(text):
    """What ends the sentence, where it has no end."""
    return '' if text.endswith('?') else '.'


def misfits(data):
    return [f"{e['name']}/{c['column']}" for e in data.get('experiments', [])
            for c in e.get('channels', []) if unexplained(c)]


def verdict(data, intervals):
    """The answer in words."""
    known, unknown = [], [n for n, v in data['parameters'].items() if v is None]
    unknown += [n for n in data.get('undetermined') or {} if n not in unknown]
    for name, estimate in data['parameters'].items():
        if estimate is not None:
            share = half_width(name, data, intervals)
            known.append(f'{name} to ±{percent(share)}' if share is not None
                         else f'{name} as zero within ±{rounded(NORMAL_95 * estimate[1], 2)}')
    text = ('The data determine ' + ', '.join(known) + ' (95 %).' if known
            else 'The data determine no parameter.')
    if unknown:
        text += f" They do not determine {', '.join(unknown)}: see why below."
    off = misfits(data)
    channels = sum(len(e.get('channels', [])) for e in data.get('experiments', []))
    if off:
        text += (f' The fit does not explain {len(off)} of {channels} channels to their noise: '
                 'something is missing from the model there, and the intervals may be too narrow.')
    elif channels and all(c.get('noise_from') == 'residual' for e in data['experiments']
                          for c in e.get('channels', [])):
        text += ' No record tells its noise: whether the fit explains them cannot be said.'
    elif channels:
        text += f' The fit explains all {channels} channels to their noise.'
    return Text(text, 'verdict')


def parameter_table(data, intervals):
    undetermined = data.get('undetermined') or {}
    start = data.get('start') or {}
    kept = data.get('defaults_kept') or {}
    rows = []
    names = list(data['parameters']) + [n for n in undetermined if n not in data['parameters']]
    for name in names:
        estimate = data['parameters'].get(name)
        begun = number(start.get(name))
        if estimate is None:
            default = f"; default {number(kept[name])} kept" if name in kept else ''
            rows.append([name, unit_of(name, data), '-', '-', '-', begun,
                         'undetermined: ' + undetermined.get(name, 'no reason given') + default])
            continue
        value, sd = estimate
        low, high = intervals[name]
        share = half_width(name, data, intervals)
        differs = (data.get('scatter') or {}).get(name)
        how = 'fitted to all records' if not differs else (
            f"the mean of {differs['records']} records, which differ by "
            f"{number(differs['sd'])} (standard deviation)")
        if name in (data.get('untrusted') or {}):
            how = 'not to be trusted: ' + data['untrusted'][name]
        rows.append([name, unit_of(name, data), number(value, sd),
                     f'{number(low, sd)} to {number(high, sd)}',
                     '-' if share is None else '±' + percent(share), begun, how])
    return Table(['parameter', 'unit', 'value', '95 % interval', 'relative', 'start', 'how'], rows,
                 '')


def combinations(data):
    rows = [[c['text'], c.get('unit', ''), number(c['value'], c['sd']),
             f"{number(c['value'] - NORMAL_95 * c['sd'], c['sd'])} to "
             f"{number(c['value'] + NORMAL_95 * c['sd'], c['sd'])}"]
            for c in data.get('combinations') or []]
    if not rows:
        return []
    return [Table(['combination', 'unit', 'value', '95 % interval'], rows,
                  'Determined together where the single ones are not:')]


def rings_of(data, name):
    """{channel: direct evaluation} of an experiment."""
    direct = data.get('direct') or {}
    return {channel: ring for ring in direct.get('bending', []) + direct.get('torsion', [])
            if ring['experiment'] == name and 'refused' not in ring for channel in ring['channels']}


def experiment_items(data, records):
    items = []
    for entry in data.get('experiments', []):
        name = entry['name']
        items.append(Heading(name, 3))
        facts = [entry.get('kind') or '', 'quasi-static steps' if entry.get('quasi_static') else '',
                 f"free length {entry['length']:g} m" if entry.get('length') else '']
        items.append(Text(', '.join(f for f in facts if f), ''))
        picture = name in records and figures.experiment(entry, records[name], rings_of(data, name))
        if picture:
            items.append(Figure(picture, 'Left: record and fit. Right of it: the residual, with 95 % '
                                'of the noise shaded. Where there is a third: extrema of the swing '
                                'on a logarithmic scale, a straight line where damping is linear.'))
        else:
            items.append(Text('No record with a fit was written for it.', 'warning'))
    return items


def noise_table(data):
    rows = []
    for entry in data.get('experiments', []):
        for channel in entry.get('channels', []):
            misfit = channel.get('misfit')
            offset = channel.get('offset')
            rows.append([entry['name'], channel['column'], channel.get('unit', ''),
                         number(channel.get('sigma')),
                         NOISE_FROM.get(channel.get('noise_from'), 'given'
                                        if channel.get('sigma_given') else 'estimated'),
                         number(channel.get('correlation_time')), number(channel.get('rms')),
                         '-' if misfit is None else f'{misfit:.2f}'
                         + (' NOT EXPLAINED' if unexplained(channel) else ''), number(offset)])
    if not rows:
        rows = [[*key.split('/', 1), '', number(sigma), '', '-', '-', '-', '-']
                for key, sigma in (data.get('noise') or {}).items() if '/' in key]
    return Table(['experiment', 'channel', 'unit', 'noise', 'from', 'correlation [s]',
                  'rms residual', 'residual/noise', 'offset'], rows, '')


def references_table(data):
    """What models without mechanics leave of channels that follow a clamp, by quantity."""
    kinds = {}
    for entry in data.get('experiments', []):
        for channel in entry.get('channels', []):
            references = channel.get('references') or {}
            if references.get('filter') is not None:
                kinds.setdefault((channel['quantity'], channel.get('unit', '')), []).append(
                    (channel['rms'], references['constant'], references['filter'],
                     references.get('filter_unseen')))

    def together(values):
        if None in values:
            return '-'
        return number((sum(v * v for v in values) / len(values)) ** 0.5)

    rows = [[f'{quantity} [{unit}]', *(together(column) for column in zip(*rows))]
            for (quantity, unit), rows in kinds.items()]
    if not rows:
        return []
    return [Heading('What the mechanics explain', 2),
            Table(['rms left by', 'the model', "each record's mean", "a filter of the clamps' motion",
                   'that filter, record left out'], rows,
                  'The filter weighs positions and directions of the clamps over their last 0.6 s: '
                  'it knows no mechanics, and has been fitted to the same records.')]


def direct_items(data, intervals):
    direct = data.get('direct') or {}
    rings = direct.get('bending', []) + direct.get('torsion', [])
    if not rings:
        return []
    items = [Heading('Direct evaluation, as in the paper', 2),
             Text('Frequency and decay rate of each ring-down, put into eqs. (11) to (13), without a '
                  'simulation. Known biases are named, not corrected; the full estimate has none of '
                  'them.', '')]
    rows = []
    for name, value in direct.get('values', {}).items():
        full = data['parameters'].get(name)
        rows.append([name, unit_of(name, data), number(value['value'], value['sd']),
                     ' to '.join(number(v, value['sd']) for v in value['interval']),
                     str(value['count']),
                     f"{number(value['scatter'])}" + (' (significant)' if value.get('scatters')
                                                      else ''),
                     number(full[0], full[1]) if full else '-',
                     f"{100 * (value['value'] / full[0] - 1):+.2g} %" if full and full[0] else '-'])
    if rows:
        items.append(Table(['parameter', 'unit', 'direct', '95 % interval', 'ring-downs', 'scatter',
                            'full estimate', 'direct - full'], rows, ''))
    beside = figures.direct_beside_full(data, intervals)
    if beside:
        items.append(Figure(beside, 'Direct evaluation beside the full estimate, 95 % intervals.'))
    combined = direct.get('combination')
    if combined:
        items.append(Text(f"{combined['text']} = {number(combined['value'], combined['sd'])} ± "
                          f"{rounded(combined['sd'], 2)} {combined['unit']} at L = "
                          f"{combined['length']:g} m: one length determines no more.", ''))
    lengths = figures.torsion_lengths(data)
    if lengths:
        items.append(Figure(lengths, 'Torsional damping over 1/L: the slope is eta_GJ, the intercept '
                            'the loss at the fixation D_E. Shaded: 95 % confidence.'))
    biases = [[ring['experiment'], bias['of'],
               ('order of ' if bias.get('order_only') else '')
               + (f"{rounded(100 * bias['relative'], 2)} %" if bias.get('order_only')
                  else f"{100 * bias['relative']:+.2g} %"), bias['text']]
              for ring in rings for bias in ring.get('biases', [])]
    if biases:
        items.append(Table(['experiment', 'of', 'too high by', 'known bias'], biases, ''))
    rows = [[ring['experiment'], ring.get('plane', 'torsion'), ', '.join(ring['channels']),
             f"{number(*ring['omega'])} ± {rounded(ring['omega'][1], 2)}",
             f"{number(*ring['delta'])} ± {rounded(ring['delta'][1], 2)}",
             f"{rounded(ring['delta'][0] / ring['undamped'])}"]
            for ring in rings if 'refused' not in ring]
    if rows:
        items.append(Table(['experiment', 'motion', 'channels', 'Omega [rad/s]', 'delta [1/s]',
                            'damping ratio'], rows, 'One standard deviation after ±.'))
    notes = [f"{ring['experiment']}: {ring['refused']}" for ring in rings if 'refused' in ring]
    notes += [f"{ring['experiment']}, {text}" for ring in rings for text in ring.get('messages', [])]
    notes += [f'{name}: {why}' for name, why in direct.get('undetermined', {}).items()]
    if notes:
        items.append(Bullets(notes + direct.get('messages', []), ''))
    critical = direct.get('critical')
    if critical:
        items.append(Text('Critical damping, eq. (10): ' + ', '.join(
            f'{name} {number(value)} {unit_of(name, data)}' for name, value in critical.items()), ''))
    return items


def plan_items(data):
    planned = data.get('plan')
    if not planned:
        return []
    target = planned.get('target') or {}
    name = target.get('parameter', '')
    items = [Heading('Plan', 2)]
    recommended = planned.get('recommended') or {}
    asked = f"±{percent(target['accuracy'])} on {name}" if target.get('accuracy') else name
    if recommended:
        width = (recommended.get('predicted') or {}).get(name)
        items.append(Text(f"For {asked}: {recommended.get('text', '')}"
                          + (f', predicted ±{percent(width)}.' if width is not None else '.'),
                          'verdict'))
    else:
        items.append(Text(f'No rig of those tried reaches {asked}.', 'warning'))
    picture = figures.plan(data)
    if picture:
        items.append(Figure(picture, f'Predicted 95 % half-width of {name} over the repeats.'))
    others = sorted({key for c in planned.get('candidates', []) for key in c.get('predicted') or {}},
                    key=lambda key: (key != name, key))
    rows = [[c.get('text', ''), ', '.join(f'{v:g}' for v in c.get('lengths', [])),
             number(c.get('inertia')), str(c.get('repeats', '-'))]
            + ['±' + percent(c['predicted'][k]) if (c.get('predicted') or {}).get(k) is not None
               else '-' for k in others] for c in planned.get('candidates', [])]
    if rows:
        items.append(Table(['rig', 'lengths [m]', 'disc [kg m^2]', 'repeats'] + others, rows, ''))
    return items


def content(data, records):
    """All items. records: {experiment: {column: array}}"""
    intervals = intervals_of(data)
    items = [Heading('Identification: ' + data.get('set', ''), 1), verdict(data, intervals)]
    if data.get('slips'):
        items.append(Bullets([f"{slip['experiment']}: {slip['text']}{stop(slip['text'])} It would leave "
                              f"{rounded(slip['misfit_with'], 2)} times the noise instead of "
                              f"{rounded(slip['misfit'], 2)}." for slip in data['slips']], 'warning'))
    if data.get('warnings'):
        items.append(Bullets(data['warnings'], 'warning'))
    items += [Heading('Parameters', 2), parameter_table(data, intervals), *combinations(data)]
    picture = figures.profiles(data, intervals)
    if picture:
        items.append(Figure(picture, 'Profile likelihoods: how much worse the best fit becomes where '
                            'one parameter is held. Shaded: the 95 % interval. A profile that follows '
                            'its parabola has an interval that can be read from its standard '
                            'deviation.'))
    picture = figures.correlation(data)
    if picture:
        items.append(Figure(picture, 'Correlation of the estimates: near ±1, two parameters can be '
                            'exchanged for each other.'))
    if data.get('experiments'):
        items += [Heading('Experiments', 2), *experiment_items(data, records)]
    noise = noise_table(data)
    if noise.rows:
        items += [Heading('Noise', 2),
                  Text('A channel whose residual is clearly more than its noise is not explained by '
                       'the model. The noise comes from the record itself, not from the fit, where '
                       'there is a way.', ''), noise]
    items += references_table(data)
    items += direct_items(data, intervals) + plan_items(data)
    if data.get('messages'):
        items += [Heading('Messages', 2), Bullets(data['messages'], '')]
    return items + report_cost.items(data, 'Identified')
