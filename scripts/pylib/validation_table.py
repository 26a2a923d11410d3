"""The rows of docs/validation.md: as tests record them, and as the page shows them."""

import xml.etree.ElementTree

DIGITS = 6
HEADER = '| case | source | target | ours | error | allowed | N | dt |'


class Row:
    """One line of the table."""

    def __init__(self, section, case, source, target, ours, tolerance, elements, dt):
        self.section, self.case, self.source = section, case, source
        self.target, self.ours, self.tolerance = float(target), float(ours), float(tolerance)
        self.elements, self.dt = int(elements), float(dt)

    def line(self):
        error = self.ours - self.target
        if self.target:
            error = f'{100 * error / self.target:+.2g} %'
            allowed = f'{100 * self.tolerance / abs(self.target):.2g} %'
        else:
            error, allowed = f'{error:+.2g}', f'{self.tolerance:.2g}'
        return '| ' + ' | '.join((
            self.case, self.source, f'{self.target:.{DIGITS}g}', f'{self.ours:.{DIGITS}g}', error,
            allowed, str(self.elements) if self.elements else '-',
            f'{1e3 * self.dt:g}' if self.dt else '-')) + ' |'


def cells(line):
    return [cell.strip() for cell in line.strip('|').split(' | ')]


def read_report(path):
    """The rows that the tests recorded, in their order."""
    rows = []
    for found in xml.etree.ElementTree.parse(path).iter('property'):
        if found.get('name').startswith('validation_'):
            rows.append(Row(*found.get('value').split('|')))
    return rows


def is_row(line):
    return line.startswith('| ') and line != HEADER


def table(text):
    """{(section, case): cells} of a page."""
    found, section = {}, ''
    for line in text.splitlines():
        if line.startswith('## '):
            section = line[3:]
        elif is_row(line):
            found[section, cells(line)[0]] = cells(line)
    return found
