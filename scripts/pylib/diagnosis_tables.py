"""Tables of how blind sets were diagnosed: who was taken for whom, rates with their intervals."""

from binomial import clopper_pearson

# name, suites, judgements that count; the rate is of all sets that were made.
RATES = (('right cause named', ('single', 'twins'), ('right',)),
         ('wrong cause named', ('single', 'twins', 'pairs'), ('wrong',)),
         ('effect taken for noise', ('single', 'pairs'), ('missed',)),
         ('null sets accused', ('null', 'absorbed'), ('wrong',)),
         ('outside the library refused', ('outside',), ('right',)),
         ('outside the library explained', ('outside',), ('wrong',)),
         ('look-alikes called so', ('twins-without',), ('right',)),
         ('look-alikes decided wrongly', ('twins-without',), ('wrong',)),
         ('two causes, both found', ('pairs',), ('right',)),
         ('unidentifiable called so', ('unidentifiable',), ('right',)),
         ('failed', None, ('failed',)))


def made(rows):
    return [row for row in rows if row['judgement'] != 'unmade']


def quantile(values, part):
    """Linear between the order statistics."""
    values = sorted(values)
    place = part * (len(values) - 1)
    low = int(place)
    high = min(low + 1, len(values) - 1)
    return values[low] + (place - low) * (values[high] - values[low])


def rates(rows):
    """{name: (count, total, low, high)}"""
    result = {}
    for name, suites, judgements in RATES:
        counted = [row for row in made(rows) if suites is None or row['suite'] in suites]
        if counted:
            count = sum(row['judgement'] in judgements for row in counted)
            result[name] = (count, len(counted)) + clopper_pearson(count, len(counted))
    return result


def confusion(rows):
    """Lines of a table: what was at work by what was said."""
    columns = sorted({row['said'] for row in made(rows)})
    lines = ['| at work | sets | ' + ' | '.join(columns) + ' |',
             '|---|---|' + '---|' * len(columns)]
    for label in sorted({row['label'] for row in made(rows)}):
        own = [row for row in made(rows) if row['label'] == label]
        counts = [sum(row['said'] == column for row in own) for column in columns]
        lines.append('| %s | %d | %s |' % (label, len(own), ' | '.join(
            str(count) if count else '' for count in counts)))
    return lines


def rate_table(rows):
    lines = ['| suite | dB | times noise | sets | right | cautious | partial | lucky | missed | wrong | failed |',
             '|---|---|---|---|---|---|---|---|---|---|---|']
    groups = sorted({(row['suite'], row['snr'], row['strength']) for row in made(rows)})
    for group in groups:
        own = [row for row in made(rows)
               if (row['suite'], row['snr'], row['strength']) == group]
        lines.append('| %s | %g | %g | %d | %s |' % (group + (len(own), ' | '.join(
            str(sum(row['judgement'] == word for row in own))
            for word in ('right', 'cautious', 'partial', 'lucky', 'missed', 'wrong', 'failed')))))
    lines += ['', '| rate | of | % | 95 % interval |', '|---|---|---|---|']
    for name, (count, total, low, high) in rates(rows).items():
        lines.append('| %s | %d/%d | %.1f | %.1f to %.1f |' % (
            name, count, total, 100 * count / total, 100 * low, 100 * high))
    return lines


def spread(name, values, form):
    if not values:
        return '| %s | 0 | | | | | |' % name
    return '| %s | %d | %s |' % (name, len(values), ' | '.join(
        form % quantile(values, part) for part in (0, 0.1, 0.5, 0.9, 1)))


def number_table(rows):
    lines = ['| | sets | least | 10 % | median | 90 % | most |', '|---|---|---|---|---|---|---|']
    right = [row for row in rows if row['judgement'] == 'right']
    for name, key in (('gain, by the verdict', 'gain'), ('gain, unseen record', 'unseen')):
        lines.append(spread(name, [row[key] for row in right if row.get(key) is not None], '%.3f'))
    lines.append(spread('seconds', [row['seconds'] for row in rows
                                    if row.get('seconds') is not None], '%.1f'))
    inside = [hit for row in right for path, hit in row['covered'].items()]
    if inside:
        low, high = clopper_pearson(sum(inside), len(inside))
        lines.append('\n%d of %d parameters of rightly extended cables are within their 95 %% '
                     'intervals: %.1f %% (%.1f to %.1f).' % (
                         sum(inside), len(inside), 100 * sum(inside) / len(inside), 100 * low,
                         100 * high))
    return lines
