"""What a program's work took, stage by stage, from its answer."""

from report_numbers import rounded
from report_page import Heading, Table, Text


def items(data, done):
    """done: what was done in this time, in a word."""
    rows = [[s.get('stage', ''), rounded(s.get('seconds') or 0), f"{s.get('simulations') or 0:,}",
             f"{s.get('steps') or 0:,}"] for s in data.get('stages') or []]
    found = []
    if rows:
        found.append(Table(['stage', 'time [s]', 'simulations', 'time steps'], rows, ''))
    if data.get('seconds') is not None:
        found.append(Text(f"{done} in {rounded(data['seconds'])} s.", ''))
    return [Heading('Cost', 2), *found] if found else []
