"""The figures of a report of cable_diagnose. Each is a matplotlib figure, or None where the records
cannot make it. What they draw are the Records of diagnosis_content."""

import numpy as np

import page_figures
import record_signals as signals

plt = page_figures.pyplot('diagnosis')

WIDTH = 10.5
# Plain and extended also differ in the shape of their marks or the width of their lines.
MEASURED, PLAIN, EXTENDED = '0.45', page_figures.COLOURS[1], page_figures.COLOURS[0]
BAND = 2.0          # noise levels: what is shaded
MANY = 300          # samples beyond which a line is drawn, not dots
CYCLES = 14         # of a fast oscillation, that can still be told apart in a picture
MOST_CHANNELS = 36  # in the picture of all channels
MOST_RECORDS = 6    # in the others
OFF = 3.0           # times the noise from which on the extension's own picture needs no other scale


def _finish(figure):
    figure.align_ylabels()
    figure.tight_layout()
    plt.close(figure)  # kept by who asked for it, not by pyplot
    return figure


def _with_legend(figure, axes):
    """One legend, above all panels."""
    handles, labels = axes.get_legend_handles_labels()
    order = sorted(range(len(labels)), key=lambda k: labels[k] != 'measured')
    handles, labels = [handles[k] for k in order], [labels[k] for k in order]
    # Tied to the figure by this transform it also stays in place where a PDF's page is cut.
    figure.legend(handles, labels, frameon=False, ncol=4, loc='upper left', fontsize=8,
                  bbox_to_anchor=(0, 1), bbox_transform=figure.transFigure, borderaxespad=0.2)
    figure.tight_layout(rect=(0, 0, 1, 1 - 0.25 / figure.get_size_inches()[1]))
    plt.close(figure)
    return figure


def _label(record, column):
    return f'{column} [{record.unit(column)}]'


def _models(record, column):
    """(label, colour, line width, mark, values) of what was simulated."""
    found = [('plain', PLAIN, 1.3, '^', record.plain(column))]
    if record.extended(column) is not None:
        found.append((record.extended_label, EXTENDED, 1.0, 's', record.extended(column)))
    return found


def _legend_above(axes, columns=3):
    axes.legend(frameon=False, loc='lower left', bbox_to_anchor=(0, 1), ncol=columns, fontsize=8,
                borderaxespad=0.2)


def _window(record, column):
    """(begin, end) of a piece around the largest misfit in which single swings can be seen; all of
    the record where there are few."""
    x = record.x
    whole = (x[0], x[-1])
    if record.quasi_static:
        return whole
    sampled = signals.even(x, record.measured(column))
    frequency = sampled and signals.main_frequency(*sampled[1:])
    if not frequency or (x[-1] - x[0]) * frequency < 1.5 * CYCLES:
        return whole
    span = CYCLES / frequency
    wrong = np.nan_to_num(record.measured(column) - record.plain(column)) ** 2
    middle = x[int(np.argmax(np.convolve(wrong, np.ones(max(1, len(x) // 40)), 'same')))]
    begin = min(max(middle - span / 2, x[0]), x[-1] - span)
    return begin, begin + span


def _residuals(axes, record, column, models, limit=None):
    dots = record.quasi_static or len(record.x) < MANY
    axes.axhspan(-BAND, BAND, color='0.86', linewidth=0, zorder=0, label=f'noise, ±{BAND:g} σ')
    axes.axhline(0, color='0.3', linewidth=0.6, zorder=1)
    for label, colour, width, mark, values in models:
        left = (record.measured(column) - values) / record.noise[column]
        axes.plot(record.x, left, mark + '-' if dots else '-', color=colour, markersize=3,
                  linewidth=0.6 * width, label=f'measured - {label}')
    if limit:
        axes.set_ylim(-limit, limit)
    axes.set_ylabel('residual\n[times the noise]')


def proof(record, column):
    """Measured, plain and extended, and what each leaves."""
    models = _models(record, column)
    own = record.times_noise(column, extended=True)
    magnify = (len(models) > 1 and record.times_noise(column) > 2 * OFF and own < OFF)
    figure, rows = plt.subplots(3 if magnify else 2, 1, figsize=(WIDTH, 7.2 if magnify else 5.6),
                                gridspec_kw={'height_ratios': [1.5, 1] + [0.8] * magnify})
    begin, end = _window(record, column)
    shown = (record.x >= begin) & (record.x <= end)
    dots = record.quasi_static or shown.sum() < MANY
    rows[0].plot(record.x[shown], record.measured(column)[shown], 'o' if dots else '-',
                 color=MEASURED, markersize=3.5, linewidth=2.6, label='measured')
    for label, colour, width, mark, values in models:
        rows[0].plot(record.x[shown], values[shown], '-' if label != 'plain' else '--',
                     color=colour, linewidth=width, label=label)
    rows[0].set_ylabel(_label(record, column))
    rows[0].set_xlim(begin, end)
    _legend_above(rows[0])
    _residuals(rows[1], record, column, models)
    _legend_above(rows[1])
    if magnify:
        left = (record.measured(column) - models[1][-1]) / record.noise[column]
        _residuals(rows[2], record, column, models[1:], 1.15 * np.nanmax(np.abs(left)))
        rows[2].set_title(f'measured - {models[1][0]}, magnified', loc='left', fontsize=8)
    for axes in rows[1:]:
        axes.set_xlim(record.x[0], record.x[-1])
    rows[-1].set_xlabel(record.x_label)
    if (begin, end) != (record.x[0], record.x[-1]):
        rows[1].axvspan(begin, end, color=page_figures.COLOURS[4], alpha=0.22, linewidth=0, zorder=0,
                        label='shown above')
        _legend_above(rows[1], 4)
        rows[0].set_xlabel(record.x_label + ', where the plain model is off most')
    return _finish(figure)


def all_channels(records):
    """(figure, how many channels it leaves out): residual over noise, plain and extended."""
    rows = [(record, column) for record in records for column in record.columns]
    if not rows:
        return None, 0
    if len(rows) > MOST_CHANNELS:
        worst = sorted(rows, key=lambda row: -row[0].times_noise(row[1]))[:MOST_CHANNELS]
        rows, left_out = [row for row in rows if row in worst], len(rows) - MOST_CHANNELS
    else:
        left_out = 0
    figure, axes = plt.subplots(figsize=(WIDTH, 1.1 + 0.24 * len(rows)))
    plain = [record.times_noise(column) for record, column in rows]
    extended = [record.times_noise(column, extended=True) for record, column in rows]
    both = any(record.has_extended for record, _ in rows)
    y = np.arange(len(rows))
    axes.barh(y - 0.2 * both, np.array(plain) - 1, left=1, height=0.4 if both else 0.6, color=PLAIN,
              label='plain')
    if both:
        axes.barh(y + 0.2, np.array(extended) - 1, left=1, height=0.3, color=EXTENDED)
        axes.plot(extended, y + 0.2, 's', color=EXTENDED, markersize=5,
                  label=next(r.extended_label for r, _ in rows if r.has_extended))
    axes.axvline(1, color='0.2', linewidth=1, label='noise alone')
    axes.set_xscale('log')
    low, high = axes.get_xlim()
    low, high = min(low, 0.7), max(high, 3)
    axes.set_xlim(low, high)
    ticks = [m * 10.0 ** e for e in range(-2, 7) for m in (1, 2, 5) if low <= m * 10.0 ** e <= high]
    if len(ticks) > 12:
        ticks = [tick for tick in ticks if f'{tick:e}'.startswith('1')]
    axes.set_xticks(ticks, [f'{tick:g}' for tick in ticks])
    axes.minorticks_off()
    axes.grid(axis='x', color='0.92')
    axes.set_axisbelow(True)
    axes.set_yticks(range(len(rows)), [f'{record.name} / {column}' for record, column in rows])
    axes.set_ylim(len(rows) - 0.4, -0.9)
    for k in range(1, len(rows)):
        if rows[k][0] is not rows[k - 1][0]:
            axes.axhline(k - 0.5, color='0.8', linewidth=0.6)
    axes.set_xlabel('rms of the residual [times the noise]')
    _legend_above(axes)
    return _finish(figure), left_out


def _grid(count, height=2.5, across=3):
    across = min(across, count)
    rows = -(-count // across)
    figure, grid = plt.subplots(rows, across, squeeze=False,
                                figsize=(max(across, 1.8) * WIDTH / 3, 0.5 + height * rows))
    for axes in grid.flat[count:]:
        axes.set_axis_off()
    return figure, list(grid.flat[:count])


def spectra(chosen):
    """Of the residuals of (record, column), over the spectrum of white noise."""
    drawn = []
    for record, column in chosen:
        lines = [(label, colour, width, signals.spectrum(
            record.x, record.measured(column) - values, record.noise[column]))
            for label, colour, width, _, values in _models(record, column)]
        if not record.quasi_static and all(line[-1] for line in lines):
            drawn.append((record, column, lines))
    if not drawn:
        return None
    figure, grid = _grid(len(drawn))
    for axes, (record, column, lines) in zip(grid, drawn):
        for label, colour, width, (frequency, power) in lines:
            axes.loglog(frequency, power, '--' if label == 'plain' else '-', color=colour,
                        linewidth=width, label=label)
        axes.axhline(1, color='0.2', linewidth=1, linestyle=':', label='white noise')
        low, high = axes.get_ylim()
        axes.set_ylim(min(low, 0.1), max(high, 10))
        axes.set_title(f'{record.name} / {column}', fontsize=8)
        axes.set_xlabel('frequency [Hz]')
    grid[0].set_ylabel('power of the residual\n[times that of white noise]')
    return _with_legend(figure, grid[0])


def _decay_axes(axes, title, least):
    """least: of the mean, the smallest range that is shown; below it all is as good as equal."""
    low, high = axes.get_ylim()
    short = least * abs(low + high) / 2 - (high - low)
    if short > 0:
        axes.set_ylim(low - short / 2, high + short / 2)
    low, high = axes.get_xlim()
    if low > 0 and high > 6 * low:
        axes.set_xscale('log')
        ticks = [m * 10.0 ** e for e in range(-9, 4) for m in (1, 2, 5)
                 if low <= m * 10.0 ** e <= high]
        if len(ticks) > 6:
            ticks = [tick for tick in ticks if f'{tick:e}'.startswith('1')]
        axes.set_xticks(ticks, [f'{tick:g}' for tick in ticks])
        axes.minorticks_off()
    else:
        axes.locator_params(axis='x', nbins=5)
    axes.set_ylabel(title)
    axes.ticklabel_format(axis='y', useOffset=False)
    axes.grid(color='0.94')


def decays(found):
    """found: [(record, column, [(label, Decay)])], measured first."""
    if not found:
        return None
    figure, grid = plt.subplots(len(found), 3, squeeze=False,
                                figsize=(WIDTH, 0.7 + 2.2 * len(found)))
    styles = {'measured': dict(color=MEASURED, marker='o', linestyle='', markersize=5),
              'plain': dict(color=PLAIN, marker='^', linestyle='--', markersize=3.5)}
    extended = dict(color=EXTENDED, marker='s', linestyle='-', markersize=3)
    for row, (record, column, lines) in zip(grid, found):
        for label, decay in lines:
            style = dict(styles.get(label, extended), linewidth=1, label=label)
            loss = 1 - signals.loss_of(decay)
            for axes, values, sd in zip(
                    row, (decay.rate, decay.frequency, 100 * (1 - loss)),
                    (decay.rate_sd, decay.frequency_sd,
                     200 * loss * decay.rate_sd / decay.frequency)):
                if label == 'measured':
                    axes.errorbar(decay.amplitude, values, yerr=BAND * sd, capsize=2, **style)
                else:
                    axes.plot(decay.amplitude, values, **style)
        for axes, title, least in zip(row, ('decay rate [1/s]', 'frequency [Hz]',
                                            'energy lost per cycle [%]'), (0.2, 0.02, 0.2)):
            _decay_axes(axes, title, least)
            axes.set_xlabel(f'half swing of {_label(record, column)}')
        row[0].set_title(f'{record.name} / {column}', fontsize=8, loc='left')
    return _with_legend(figure, grid[0, 0])


def harmonics(found):
    """found: [(record, column, [(label, [2nd, 3rd], noise)])], measured first."""
    if not found:
        return None
    figure, grid = plt.subplots(1, 2, figsize=(WIDTH, 1.2 + 0.5 * len(found)), sharey=True)
    colours = {'measured': (MEASURED, 'o'), 'plain': (PLAIN, '^')}
    for h, axes in enumerate(grid):
        for k, (_, _, lines) in enumerate(found):
            for n, (label, ratios, noise) in enumerate(lines):
                colour, mark = colours.get(label, (EXTENDED, 's'))
                y = k + 0.24 * (n - (len(lines) - 1) / 2)
                axes.errorbar([100 * ratios[h]], [y], xerr=[100 * BAND * noise] if n == 0 else None,
                              fmt=mark, color=colour, markersize=5, capsize=2, linewidth=1,
                              label=label if k == 0 else None)
        axes.set_xlabel(f'{("2nd", "3rd")[h]} harmonic [% of the first]')
        axes.set_xlim(left=0)
        axes.grid(axis='x', color='0.92')
    grid[0].set_yticks(range(len(found)), [f'{record.name} / {column}'
                                           for record, column, _ in found])
    grid[0].set_ylim(len(found) - 0.5, -0.5)
    return _with_legend(figure, grid[0])


def loops(chosen):
    """Of quasi-static (record, column), over what was driven: without the parabola that
    hides the loop; or over the step."""
    if not chosen:
        return None
    figure, grid = _grid(len(chosen), 3.0)
    for axes, (record, column) in zip(grid, chosen):
        x, label = record.driven()
        measured = record.measured(column)
        line, what = 0, ''
        if record.described.drive:
            known = np.isfinite(measured)
            line = np.polyval(np.polyfit(x[known], measured[known], 2), x)
            what = '\nless its parabola'
        axes.plot(x, measured - line, 'o', color=MEASURED, markersize=3.5, label='measured')
        for name, colour, width, _, values in _models(record, column):
            axes.plot(x, values - line, '--' if name == 'plain' else '-', color=colour,
                      linewidth=width, label=name)
        axes.set_xlabel(label)
        axes.set_ylabel(_label(record, column) + what)
        axes.set_title(record.name, fontsize=8)
        axes.locator_params(nbins=5)
    return _with_legend(figure, grid[0])
