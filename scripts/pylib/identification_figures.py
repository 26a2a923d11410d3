"""The figures of a report of cable_identify. Each is a matplotlib figure, or None where the data for
it are not there."""

import math

import numpy as np

import page_figures
from matplotlib.ticker import LogFormatterSciNotation, LogLocator, NullLocator
from report_numbers import NORMAL_95

# The loss at the disc: D_E in the source paper's formulas.
END_DAMPING = 'extensions.clamp_damping.b.torsion'

plt = page_figures.pyplot('identification')

WIDTH = 10.5
# [in] About and between the axes of an experiment: room for the longest numbers and two lines of
# label. matplotlib's own layout takes as long as all of the drawing.
LEFT, RIGHT, TOP, BOTTOM, ACROSS, DOWN = 0.95, 0.1, 0.2, 0.45, 0.8, 0.42
MEASURED, FIT, OTHER, DIRECT = '0.55', page_figures.COLOURS[0], page_figures.COLOURS[1], \
    page_figures.COLOURS[2]
DEVIANCE_95 = 3.841459  # of a profile likelihood, one parameter
MANY = 300              # samples beyond which a line is drawn, not dots
MANY_DECADES = 300      # highest over lowest, from which on powers of ten are ticks enough
LONG = 28               # characters of a label


def _finish(figure):
    figure.tight_layout()
    plt.close(figure)  # kept by who asked for it, not by pyplot
    return figure


def _space(figure, rows, across):
    """Fixed margins of a grid of axes."""
    width, height = figure.get_size_inches()
    figure.subplots_adjust(left=LEFT / width, right=1 - RIGHT / width, bottom=BOTTOM / height,
                           top=1 - TOP / height,
                           wspace=across * ACROSS / (width - LEFT - RIGHT - (across - 1) * ACROSS),
                           hspace=rows * DOWN / (height - BOTTOM - TOP - (rows - 1) * DOWN))


def _shorten(text, length=LONG):
    return text if len(text) <= length else text[:length - 1] + '…'


def envelope(t, y, omega):
    """Times and sizes of the extrema of what swings in y about its mean, one per half period."""
    half = math.pi / omega
    periods = max(1, int((t[-1] - t[0]) / (2 * half)))
    last = t >= t[-1] - 2 * half * min(periods, 3)
    swing = np.abs(y - y[last].mean())
    cells = ((t - t[0]) / half).astype(int)
    peaks = [np.flatnonzero(cells == cell) for cell in range(cells[-1])]
    peaks = [cell[np.nanargmax(swing[cell])] for cell in peaks if len(cell) > 1]
    return t[peaks], swing[peaks]


def _draw_record(axes, x, measured, fit, channel, quasi_static):
    dots = quasi_static or len(x) < MANY
    axes.plot(x, measured, '.' if dots else '-', color=MEASURED, markersize=3, linewidth=1.6,
              label='measured')
    axes.plot(x, fit, color=FIT, linewidth=0.9, label='fit')
    axes.set_ylabel(f"{channel['column']}\n{channel.get('quantity', '')} [{channel.get('unit', '')}]")
    axes.legend(frameon=False, loc='upper left' if quasi_static else 'upper right', ncol=2)


def _draw_residual(axes, x, residual, channel, quasi_static):
    dots = quasi_static or len(x) < MANY
    axes.plot(x, residual, '.' if dots else '-', color=MEASURED, markersize=3, linewidth=0.7)
    axes.axhline(0, color='0.2', linewidth=0.6)
    sigma = channel.get('sigma')
    if sigma:
        axes.axhspan(-NORMAL_95 * sigma, NORMAL_95 * sigma, color=FIT, alpha=0.12, linewidth=0)
    axes.set_ylabel(f"residual [{channel.get('unit', '')}]")


def _set_sizes(axes, low, high):
    """Of a logarithmic axis, with ticks where a number stands: the many without one take as long as
    all else of a figure."""
    axes.set_ylim(low, high)
    subs = (1,) if high > MANY_DECADES * low else (1, 2, 5)
    axes.yaxis.set_major_locator(LogLocator(subs=subs))
    axes.yaxis.set_major_formatter(LogFormatterSciNotation(minor_thresholds=(math.inf, math.inf)))
    axes.yaxis.set_minor_locator(NullLocator())


def _draw_decay(axes, x, measured, fit, ring, sigma):
    omega, delta = ring['omega'][0], ring['delta'][0]
    axes.set_yscale('log')  # once: each time makes its ticks anew
    for values, colour, marker, label in ((measured, MEASURED, 'o', 'measured'),
                                          (fit, FIT, '', 'fit')):
        times, sizes = envelope(x, values, omega)
        axes.plot(times, np.maximum(sizes, 1e-300), color=colour, marker=marker, markersize=3,
                  linewidth=0 if marker else 1, label=label)
        if values is measured and len(sizes):
            # Through the median of the larger half: a straight line of the direct decay rate.
            large = sizes >= np.median(sizes)
            start = np.exp(np.median(np.log(sizes[large]) + delta * (times[large] - x[0])))
            lowest, highest = sizes[sizes > 0].min(), sizes.max()
            axes.plot(x, start * np.exp(-delta * (x - x[0])), '--', color=OTHER, linewidth=0.9,
                      label=f'direct, {delta:.3g} 1/s')
            _set_sizes(axes, 0.4 * min(lowest, sigma or lowest), 2.5 * highest)
    if sigma:
        axes.axhline(NORMAL_95 * sigma, color='0.2', linestyle=':', linewidth=0.8,
                     label='noise, 95 %')
    axes.set_ylabel('extrema of the swing')
    axes.legend(frameon=False, loc='upper right', fontsize=7)


def experiment(entry, columns, rings):
    """Each channel's record with its fit, its residual and, for a ring-down, its decay.
    rings: {channel: its direct evaluation}."""
    channels = [c for c in entry.get('channels', []) if c['column'] in columns
                and c['column'] + '.fit' in columns]
    if not channels:
        return None
    quasi_static = 'step' in columns
    x = columns['step' if quasi_static else 't']
    decays = not quasi_static and any(c['column'] in rings for c in channels)
    across = 3 if decays else 2
    figure, grid = plt.subplots(len(channels), across, squeeze=False,
                                figsize=(WIDTH, 0.5 + 2.1 * len(channels)))
    _space(figure, len(channels), across)
    for row, channel in zip(grid, channels):
        measured, fit = columns[channel['column']], columns[channel['column'] + '.fit']
        _draw_record(row[0], x, measured, fit, channel, quasi_static)
        _draw_residual(row[1], x, measured - fit, channel, quasi_static)
        if decays and channel['column'] in rings:
            _draw_decay(row[2], x, measured, fit, rings[channel['column']], channel.get('sigma'))
        elif decays:
            row[2].set_axis_off()
    for axes in grid[-1]:
        axes.set_xlabel('step' if quasi_static else 't [s]')
    plt.close(figure)
    return figure


def _band(x, eta, d_e, correlation):
    """Half-width of the 95 % band of eta x + D_E; (value, sd) each."""
    variance = (x * eta[1]) ** 2 + d_e[1] ** 2 + 2 * x * correlation * eta[1] * d_e[1]
    return NORMAL_95 * np.sqrt(np.maximum(variance, 0))


def _correlation_of(data, first, second):
    table = data.get('correlation') or {}
    names = table.get('names', [])
    if first in names and second in names:
        return table['matrix'][names.index(first)][names.index(second)]
    return 0.0


def torsion_lengths(data):
    """2 J delta over 1/L, the lines eta_GJ/L + D_E with their bands, and the intercept."""
    direct = data.get('direct') or {}
    rings = [r for r in direct.get('torsion', []) if 'refused' not in r]
    values = direct.get('values', {})
    if 'eta_GJ' not in values or END_DAMPING not in values:
        return None
    figure, axes = plt.subplots(figsize=(0.68 * WIDTH, 3.8))
    inverse = np.array([1 / r['length'] for r in rings])
    inertia = np.array([r['inertia'] for r in rings])
    delta = np.array([r['delta'] for r in rings])
    axes.errorbar(inverse, 2 * inertia * delta[:, 0], yerr=NORMAL_95 * 2 * inertia * delta[:, 1],
                  fmt='o', color='0.25', markersize=4, linewidth=1, capsize=2, zorder=3,
                  label='ring-downs, 95 %')
    x = np.linspace(0, 1.1 * inverse.max(), 100)
    lines = [('direct', DIRECT, [values['eta_GJ']['value'], values['eta_GJ']['sd']],
              [values[END_DAMPING]['value'], values[END_DAMPING]['sd']],
              direct.get('eta_GJ_D_E_correlation', 0.0))]
    full = data.get('parameters', {})
    if full.get('eta_GJ') and full.get(END_DAMPING):
        lines.append(('full estimate', FIT, full['eta_GJ'], full[END_DAMPING],
                      _correlation_of(data, 'eta_GJ', END_DAMPING)))
    for name, colour, eta, d_e, correlation in lines:
        middle, half = eta[0] * x + d_e[0], _band(x, eta, d_e, correlation)
        axes.plot(x, middle, color=colour, linewidth=1.2, label=f'{name}: eta_GJ/L + D_E')
        axes.fill_between(x, middle - half, middle + half, color=colour, alpha=0.15, linewidth=0)
        axes.plot([0], [d_e[0]], 's', color=colour, markersize=5, clip_on=False,
                  label=f'D_E = {d_e[0]:.3g} ± {NORMAL_95 * d_e[1]:.2g} N m s')
    axes.axhline(0, color='0.2', linewidth=0.6)
    axes.set_xlim(0, x[-1])
    axes.set_xlabel('1/L [1/m]')
    axes.set_ylabel('2 J delta [N m s]')
    if len(set(inertia)) == 1:
        right = axes.secondary_yaxis('right', functions=(lambda v: v / (2 * inertia[0]),
                                                         lambda v: v * 2 * inertia[0]))
        right.set_ylabel('delta [1/s]')
    axes.legend(frameon=False, fontsize=7)
    return _finish(figure)


def profiles(data, intervals):
    """Deviance over each parameter, with the 95 % interval."""
    found = {name: p for name, p in (data.get('profiles') or {}).items() if len(p['value']) > 2}
    if not found:
        return None
    across = min(3, len(found))
    rows = -(-len(found) // across)
    figure, grid = plt.subplots(rows, across, squeeze=False,
                                figsize=(max(across, 1.6) * WIDTH / 3, 0.4 + 2.3 * rows))
    for axes in grid.flat[len(found):]:
        axes.set_axis_off()
    for axes, (name, profile) in zip(grid.flat, found.items()):
        value = np.array(profile['value'], dtype=float)
        rise = np.array(profile['deviance'], dtype=float)
        rise = rise - np.nanmin(rise)
        axes.plot(value, rise, '.-', color=FIT, markersize=4, linewidth=1.1, label='profile')
        axes.axhline(DEVIANCE_95, color='0.2', linestyle=':', linewidth=0.8, label='95 %')
        estimate = (data.get('parameters') or {}).get(name)
        if estimate and estimate[1] > 0:
            x = np.linspace(value.min(), value.max(), 100)
            axes.plot(x, ((x - estimate[0]) / estimate[1]) ** 2, '--', color=OTHER, linewidth=0.8,
                      label='parabola')
        if name in intervals:
            axes.axvspan(*intervals[name], color=FIT, alpha=0.12, linewidth=0)
        axes.set_ylim(0, max(1.2 * DEVIANCE_95, min(np.nanmax(rise), 4 * DEVIANCE_95)))
        unit = (data.get('units') or {}).get(name, '')
        axes.set_xlabel(f'{name} [{unit}]' if unit else name)
        axes.ticklabel_format(axis='x', style='sci', scilimits=(-2, 3), useOffset=False)
        axes.locator_params(axis='x', nbins=5)
    for axes in grid[:, 0]:
        axes.set_ylabel('rise of the deviance')
    grid[0, 0].legend(frameon=False, fontsize=7, loc='upper center')
    return _finish(figure)


def correlation(data):
    table = data.get('correlation') or {}
    names = table.get('names', [])
    if len(names) < 2:
        return None
    size = 1.6 + 0.5 * len(names)
    figure, axes = plt.subplots(figsize=(size + 1, size))
    matrix = np.array(table['matrix'], dtype=float)
    image = axes.imshow(matrix, vmin=-1, vmax=1, cmap='RdBu_r')
    for i, row in enumerate(matrix):
        for j, value in enumerate(row):
            axes.text(j, i, f'{value:.2f}', ha='center', va='center', fontsize=7,
                      color='white' if abs(value) > 0.7 else 'black')
    axes.set_xticks(range(len(names)), names, rotation=45, ha='right')
    axes.set_yticks(range(len(names)), names)
    axes.spines[:].set_visible(False)
    figure.colorbar(image, shrink=0.8)
    return _finish(figure)


def direct_beside_full(data, intervals):
    """The direct evaluation's values over those of the full estimate, with 95 % intervals."""
    values = (data.get('direct') or {}).get('values', {})
    full = data.get('parameters') or {}
    names = [n for n in values if full.get(n) and full[n][0]]
    if not names:
        return None
    figure, axes = plt.subplots(figsize=(0.68 * WIDTH, 0.9 + 0.55 * len(names)))
    for row, name in enumerate(names):
        unit = full[name][0]
        low, high = intervals[name]
        for offset, value, ends, colour, label in (
                (-0.13, full[name][0], (low, high), FIT, 'full estimate'),
                (0.13, values[name]['value'], values[name]['interval'], DIRECT, 'direct')):
            ends = sorted(100 * (e / unit - 1) for e in ends)
            axes.plot(ends, [row + offset] * 2, color=colour, linewidth=2)
            axes.plot([100 * (value / unit - 1)], [row + offset], 'o', color=colour, markersize=5,
                      label=label if row == 0 else None)
    axes.axvline(0, color='0.2', linewidth=0.6)
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.set_xlabel('difference from the full estimate [%]')
    axes.legend(frameon=False, fontsize=7, loc='upper left', bbox_to_anchor=(1, 1))
    return _finish(figure)


def plan(data):
    """Predicted half-width of the parameter that is planned for, over repeats, a line per rig."""
    planned = data.get('plan') or {}
    target = planned.get('target') or {}
    name = target.get('parameter')
    rigs = {}
    for candidate in planned.get('candidates', []):
        width = (candidate.get('predicted') or {}).get(name)
        if width is not None and candidate.get('repeats'):
            lengths = ', '.join(f'{length:g}' for length in candidate.get('lengths', []))
            label = f'L = {lengths} m' if lengths else candidate.get('text', '')
            if candidate.get('inertia'):
                label += f", J = {candidate['inertia']:.3g} kg m²"
            rigs.setdefault(label, []).append((candidate['repeats'], 100 * width))
    if not rigs:
        return None
    figure, axes = plt.subplots(figsize=(0.8 * WIDTH, 3.4))
    for number, (label, points) in enumerate(rigs.items()):
        axes.loglog(*np.array(sorted(points)).T, marker='o', markersize=4, linewidth=1.1,
                    color=page_figures.COLOURS[number % len(page_figures.COLOURS)],
                    linestyle='-' if number < len(page_figures.COLOURS) else '--',
                    label=_shorten(label, 60))
    if target.get('accuracy'):
        axes.axhline(100 * target['accuracy'], color='0.2', linestyle=':', linewidth=1,
                     label=f"asked for: ±{100 * target['accuracy']:g} %")
    repeats = sorted({n for points in rigs.values() for n, _ in points})
    axes.set_xticks(repeats, [str(n) for n in repeats])
    axes.minorticks_off()
    low, high = axes.get_ylim()
    ticks = [m * 10.0 ** e for e in range(-2, 5) for m in (1, 2, 5) if low <= m * 10.0 ** e <= high]
    axes.set_yticks(ticks, [f'{tick:g}' for tick in ticks])
    axes.set_xlabel('repeats of each length')
    axes.set_ylabel(f'predicted 95 % half-width of {name} [%]')
    axes.grid(color='0.92')
    axes.legend(frameon=False, fontsize=7, loc='upper left', bbox_to_anchor=(1, 1))
    return _finish(figure)
