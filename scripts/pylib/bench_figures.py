"""The figures of docs/performance.md."""

import os
import sys

import tool

try:
    import matplotlib
except ImportError as missing:
    sys.exit(f'{missing}: install python3-matplotlib, and run with /usr/bin/python3')
matplotlib.use('Agg')
# The same bytes each time, and text that a browser sets.
matplotlib.rcParams.update({'svg.hashsalt': 'bench', 'svg.fonttype': 'none', 'font.size': 8,
                            'axes.spines.top': False, 'axes.spines.right': False})
import matplotlib.pyplot as plt  # noqa: E402

BLUE, ORANGE = '#0072B2', '#D55E00'  # Okabe and Ito's


def curve(axes, costs, **style):
    axes.plot([int(n) for n in costs], list(costs.values()), marker='o', markersize=4, **style)
    axes.set_xscale('log', base=2)
    axes.set_xticks([int(n) for n in costs])
    axes.xaxis.set_major_formatter(matplotlib.ticker.ScalarFormatter())
    axes.minorticks_off()


def over_elements(numbers):
    figure, axes = plt.subplots(figsize=(4.4, 3))
    curve(axes, numbers['scalar_ns_per_node_step'], color=BLUE, label='one cable')
    curve(axes, numbers['lanes_ns_per_node_step'], color=ORANGE,
          label=f"{numbers['machine']['lanes']} cables in lanes")
    axes.set(xlabel='elements', ylabel='time per node and step [ns]', ylim=(0, None))
    axes.legend(frameon=False)
    return figure


def over_cables(numbers):
    figure, axes = plt.subplots(figsize=(4.4, 3))
    curve(axes, numbers['cables_us_per_cable_step_n40'], color=ORANGE)
    axes.set(xlabel='cables', ylabel='time per cable and step [µs]', ylim=(0, None))
    return figure


def draw(numbers, target):
    """Pictures in the folder `target`."""
    os.makedirs(target, exist_ok=True)
    for name, figure in (('cost_over_elements', over_elements(numbers)),
                         ('cost_over_cables', over_cables(numbers))):
        figure.tight_layout()
        path = os.path.join(target, name + '.svg')
        with tool.whole_file(path) as temporary:
            figure.savefig(temporary, format='svg', metadata={'Date': None})
        plt.close(figure)
        print(path)
