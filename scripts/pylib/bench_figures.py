"""The figures of docs/performance.md."""

import page_figures
from matplotlib import ticker

plt = page_figures.pyplot('bench')
BLUE, ORANGE = page_figures.COLOURS[:2]


def curve(axes, costs, **style):
    counts = sorted(costs, key=int)  # a JSON file has them as text, in the order of text
    axes.plot([int(n) for n in counts], [costs[n] for n in counts], marker='o', markersize=4,
              **style)
    axes.set_xscale('log', base=2)
    axes.set_xticks([int(n) for n in counts])
    axes.xaxis.set_major_formatter(ticker.ScalarFormatter())
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
    page_figures.save(over_elements(numbers), target, 'cost_over_elements')
    page_figures.save(over_cables(numbers), target, 'cost_over_cables')
