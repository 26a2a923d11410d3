"""How the figures of docs/ look, and how they are written."""

import os
import sys

import tool

try:
    import matplotlib
except ImportError as missing:
    sys.exit(f'{missing}: install python3-matplotlib, and run with /usr/bin/python3')
matplotlib.use('Agg')

# Okabe and Ito's colours, told apart by colour-blind readers as well.
COLOURS = ('#0072B2', '#D55E00', '#009E73', '#CC79A7', '#E69F00', '#56B4E9', '#999999', '#000000')


def pyplot(page):
    """matplotlib.pyplot for a page's figures: the same bytes each time, and text that a browser sets."""
    matplotlib.rcParams.update({'svg.hashsalt': page, 'svg.fonttype': 'none', 'font.size': 8,
                                'axes.spines.top': False, 'axes.spines.right': False})
    import matplotlib.pyplot as plt
    return plt


def save(figure, folder, name):
    """As folder/name.svg."""
    os.makedirs(folder, exist_ok=True)
    figure.tight_layout()
    path = os.path.join(folder, name + '.svg')
    with tool.whole_file(path) as temporary:
        figure.savefig(temporary, format='svg', metadata={'Date': None})
    print(path)
