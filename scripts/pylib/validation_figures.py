"""The figures of docs/validation.md, from the CSV files of the program validation_figures."""

import csv
import os

import numpy as np

import page_figures
from page_figures import COLOURS

plt = page_figures.pyplot('validation')
PUBLISHED = dict(marker='o', linestyle='none', markerfacecolor='none', color='black', markersize=6,
                 label='published')

ELASTICA = {1: (0.30172, 0.05643), 2: (0.49346, 0.16064), 5: (0.71379, 0.38763),
            10: (0.81061, 0.55500)}  # P L^2/EI: w/L, u/L
BEND = (15.685, 47.150, 53.475)
PENDULUM = ((0.798, -0.425), (-0.233, -0.920), (-0.863, -0.502))


def read(path):
    with open(path, encoding='utf-8', newline='') as source:
        header, *rows = csv.reader(source)
    return dict(zip(header, np.array(rows, dtype=float).T))


def groups(columns, key):
    """(value, the rows that have it) for each value of a column."""
    for value in dict.fromkeys(columns[key]):
        chosen = columns[key] == value
        yield value, {name: column[chosen] for name, column in columns.items()}


def elastica(columns):
    figure, axes = plt.subplots(figsize=(4, 3.2))
    for colour, (load, shape) in zip(COLOURS, groups(columns, 'load')):
        axes.plot(shape['z'], shape['x'], color=colour, label=f'P L$^2$/EI = {load:g}')
    axes.plot([1 - u for _, u in ELASTICA.values()], [w for w, _ in ELASTICA.values()], **PUBLISHED)
    axes.set(xlabel='along the clamp / L', ylabel='deflection / L', aspect='equal')
    axes.legend(frameon=False)
    return figure


def bend(columns):
    figure, panels = plt.subplots(1, 2, figsize=(6, 3))
    for axes, across in zip(panels, ('x', 'z')):
        for colour, (load, shape) in zip(COLOURS, groups(columns, 'load')):
            axes.plot(shape['y'], shape[across], color=colour, label=f'tip load {load:g}')
        axes.plot(BEND[1], BEND['xyz'.index(across)], **PUBLISHED)
        axes.set(xlabel='y', ylabel=across, aspect='equal')
    panels[1].legend(frameon=False)
    return figure


def pendulum(columns):
    figure, axes = plt.subplots(figsize=(4.4, 3))
    for colour, (t, shape) in zip(COLOURS, groups(columns, 't')):
        axes.plot(shape['x'], shape['z'], color=colour, label=f'{t:.1f} s')
    axes.plot(*zip(*PENDULUM), **PUBLISHED)
    axes.set(xlabel='x [m]', ylabel='z [m]', aspect='equal')
    axes.legend(frameon=False, loc='center left', bbox_to_anchor=(1, 0.5))
    return figure


def sweep(columns, cable):
    figure, axes = plt.subplots(figsize=(5, 3))
    chosen = dict(groups(columns, 'cable'))[cable]
    for colour, (factor, curve) in zip(COLOURS, groups(chosen, 'factor')):
        # A point in three: the file stays small.
        axes.plot(curve['t'][::3], curve['amplitude'][::3], color=colour,
                  label=f'$\\eta_{{EI}}$ × {factor:g}')
    axes.set(xlim=(0, 7), ylim=(0, None), xlabel='time [s]',
             ylabel='amplitude of the apex, in space [mm]')
    top = axes.secondary_xaxis('top', functions=(lambda t: 10 + 4 * t, lambda f: (f - 10) / 4))
    top.set_xlabel('excitation [Hz]')
    axes.legend(frameon=False)
    return figure


def draw(source, target):
    """Pictures in the folder `target` from the tables in `source`."""
    tables = {name: read(os.path.join(source, name + '.csv'))
              for name in ('elastica', 'bend', 'pendulum', 'sweep')}
    for name, figure in (('elastica', elastica(tables['elastica'])),
                         ('bend', bend(tables['bend'])),
                         ('pendulum', pendulum(tables['pendulum'])),
                         ('sweep_in_plane', sweep(tables['sweep'], 2)),
                         ('sweep_out_of_plane', sweep(tables['sweep'], 4))):
        page_figures.save(figure, target, name)
        plt.close(figure)
