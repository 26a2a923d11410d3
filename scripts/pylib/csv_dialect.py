"""How a logger laid out its text: what separates columns, which lines are header, where the names
and units stand. Works on the first lines; nothing here reads files."""

import csv
import re
import unicodedata
from collections import Counter
from dataclasses import dataclass, field

import clock_times
import csv_numbers
import units
from csv_text import NotUnderstood

DELIMITERS = {';': 'semicolon', '\t': 'tab', ',': 'comma', '|': 'bar', ' ': 'space'}
COMMENTS = ('#', '%', '//')
SECTION = re.compile(r'\[[^\]]*\]')
SEPARATOR_LINE = re.compile(r'"?sep=(.)"?\s*', re.IGNORECASE)  # Excel's own first line
LONGEST_CELL = 5  # line breaks; quoted names may have some
JUNK = '\0\x1a \t\r\n\f'  # what recorders leave behind the last row


@dataclass
class Dialect:
    """Lines count from 1. `units` are those of the row of units, '' where there is none."""
    delimiter: str
    names: list
    names_line: int  # 0 where no line has names
    data_line: int
    units: list = field(default_factory=list)
    units_line: int = 0
    decimal_evidence: dict = field(default_factory=dict)
    section_file: bool = False  # VBO: [header], [column names], [data]


def clean_name(text):
    """A name as it is compared: composed letters, single spaces, no quotes around it."""
    return ' '.join(unicodedata.normalize('NFC', text).replace('\ufeff', '').split()).strip('"')


def reader(lines, delimiter):
    """Yields (line number, cells) of each row."""
    if delimiter == ' ':
        for number, line in enumerate(lines, 1):
            yield number, line.split()
        return
    rows = csv.reader(lines, delimiter=delimiter, skipinitialspace=True)
    last = 0
    for row in rows:
        first, last = last + 1, rows.line_num
        if last > first + LONGEST_CELL:
            raise csv.Error(f'line {first} has a quote that nothing closes')
        yield first, row


def is_comment(row):
    first = row[0].lstrip() if row else ''
    return first.startswith(COMMENTS) and not csv_numbers.is_missing(first)


def is_blank(row):
    return not any(cell.strip(JUNK) for cell in row)


def without_trailing(row):
    """The cells up to the last that is not empty."""
    end = len(row)
    while end and not row[end - 1].strip():
        end -= 1
    return row[:end]


def is_data(cell):
    return csv_numbers.is_number(cell) or clock_times.is_clock(cell) or clock_times.is_date(cell)


class Layout:
    """The first lines read with one delimiter, and how much of a table they look like."""

    def __init__(self, lines, delimiter):
        self.delimiter, self.rows, self.error = delimiter, [], ''
        try:
            for row in reader(lines, delimiter):
                self.rows.append(row)
        except csv.Error as error:
            self.error = str(error)  # an unpaired quote: judged by what came before
        table = [row for _, row in self.rows if not is_blank(row) and not is_comment(row)]
        good = [row for row in table if self.data_share(row) >= 0.5]
        widths = Counter(len(row) for row in good)
        # The wider of two that are as frequent: rows with a trailing delimiter and without.
        self.width = max(widths, key=lambda w: (widths[w], w)) if widths else 0
        self.body = [row for row in good if len(row) == self.width]
        cells = [c for row in self.body for c in row if not csv_numbers.is_missing(c)]
        self.foreign = sum(not is_data(c) for c in cells) / max(len(cells), 1)
        half = self.body[len(self.body) // 2:]
        self.numeric = [k for k in range(self.width)
                        if sum(is_data(r[k]) or csv_numbers.is_missing(r[k]) for r in half)
                        >= 0.8 * len(half)]

    @staticmethod
    def data_share(row):
        filled = [c for c in row if not csv_numbers.is_missing(c)]
        return sum(map(is_data, filled)) / len(filled) if filled else 0

    def is_body(self, row):
        """Whether the row is one of values: data in every numeric column that has something."""
        if is_blank(row) or is_comment(row) or abs(len(row) - self.width) > 1:
            return False
        cells = [row[k] for k in self.numeric if k < len(row)]
        filled = [c for c in cells if not csv_numbers.is_missing(c)]
        return bool(filled) and all(map(is_data, filled))

    def has_data(self, row):
        return any(is_data(row[k]) for k in self.numeric if k < len(row))


def choose_layout(lines, delimiter):
    """The layout that fits the lines, or NotUnderstood."""
    if delimiter:
        layout = Layout(lines, delimiter)
        if not layout.body and layout.error:
            raise NotUnderstood(0, f'not a CSV text: {layout.error}')
        if not layout.body:
            raise NotUnderstood(0, f'no rows of numbers between {DELIMITERS[delimiter]}s: '
                                   '--delimiter is another, or --skip is missing')
        return layout
    layouts = [Layout(lines, d) for d in DELIMITERS]
    quotes = next((x.error for x in layouts if x.error and names_width(x) > 1), None)
    if quotes:
        raise NotUnderstood(0, f'not a CSV text: {quotes}')
    several = [x for x in layouts if x.width >= 2 or (x.width and max(map(len, x.body)) >= 2)]
    most = max((len(x.body) for x in several), default=0)
    several = [x for x in several if len(x.body) >= 0.9 * most]
    single = next(x for x in layouts if x.delimiter == '|')  # a bar is in no number
    if not several:
        if not single.body:
            raise NotUnderstood(0, 'no rows of numbers found, expected a line of names and rows '
                                   'of numbers below; say --delimiter or --skip')
        return single
    best = min(x.foreign for x in several)
    several = [x for x in several if x.foreign <= best + 1e-9]
    tabs = [x for x in several if x.delimiter == '\t']
    if tabs:
        several = [x for x in several if x.delimiter != ' ']
    if len(several) == 1 and several[0].delimiter == ',':
        return comma_or_one_column(several[0], single)
    if len(several) > 1:
        fitting = [x for x in several if names_width(x) == x.width]
        if len(fitting) != 1:
            raise NotUnderstood(0, 'columns could be separated by '
                                + ' or '.join(DELIMITERS[x.delimiter] + 's' for x in several)
                                + ': say --delimiter')
        return fitting[0]
    return several[0]


def comma_or_one_column(commas, single):
    """1,5 below one name is a decimal comma; below two names two columns."""
    if len(single.body) < 0.9 * len(commas.body) or commas.width != 2:
        return commas
    width = names_width(commas)
    if width == 1:
        return single
    if width == 0:
        raise NotUnderstood(0, f"got '{','.join(commas.body[0])}' and no names: say --delimiter , "
                               'where these are two columns, --delimiter ; where it is one number')
    return commas


def names_width(layout):
    """Cells of the last line before the data, 0 where there is none."""
    width = 0
    for _, row in layout.rows:
        if layout.is_body(row):
            break
        if not is_blank(row) and not is_section(row):
            width = len(without_trailing(row))
    return width


def is_section(row):
    return SECTION.fullmatch(' '.join(without_trailing(row))) is not None


def header_cells(row):
    """A header row's names; the mark of a comment before them is none."""
    cells = list(row)
    if is_comment(cells):
        cells[0] = cells[0].lstrip().lstrip('#%/')
        if not cells[0].strip():
            cells = cells[1:]
    return [clean_name(c) for c in without_trailing(cells)]


def find_names(head, layout, wanted):
    """Index in `head` (rows before the data) of the row of names, None where there is none."""
    matches = [len(set(wanted) & set(header_cells(row))) for _, row in head]
    if any(matches):
        return max(range(len(head)), key=lambda i: (matches[i], i))
    candidates = [i for i, (_, row) in enumerate(head)
                  if not is_blank(row) and not is_section(row) and not layout.is_body(row)]
    lower = [n.lower() for n in wanted]
    for i in reversed(candidates):
        cells = header_cells(head[i][1])
        if units.is_unit_row(cells) and i != candidates[0] and not (
                set(lower) & {c.lower() for c in cells}) and any(
                abs(len(head[j][1]) - len(head[i][1])) <= 1 for j in candidates if j < i):
            continue
        if len(cells) >= max(layout.width - 1, 1):
            return i
    # Fewer names than columns: named as such when the rows are read.
    return candidates[-1] if candidates and len(head[candidates[-1]][1]) > 1 else None


def detect(lines, delimiter=None, skip=None, wanted=()):
    """The dialect of these lines. `wanted` are names of which some stand in the line of names;
    `skip` is the number of lines above it, None to find it."""
    wanted = [clean_name(w) for w in wanted]
    told = SEPARATOR_LINE.fullmatch(lines[0].strip('\r\n')) if lines else None
    if told and not delimiter and told.group(1) in DELIMITERS:
        delimiter = told.group(1)
    lines = ['\n' if i < (skip or 0) or (i == 0 and told) else line
             for i, line in enumerate(lines)]
    if not any(line.strip(JUNK) for line in lines):
        raise NotUnderstood(1, 'the file has no text' + (f' below line {skip}' if skip else ''))
    layout = choose_layout(lines, delimiter)
    first = next((i for i, (_, row) in enumerate(layout.rows) if layout.is_body(row)),
                 len(layout.rows))
    if numbered_columns(layout, first):
        first += 1
    head = layout.rows[:first]
    if skip is not None:
        place = next((i for i, (_, row) in enumerate(layout.rows) if not is_blank(row)), 0)
    else:
        place = find_names(head, layout, wanted)
    return describe(layout, place, first)


def numbered_columns(layout, first):
    """Whether row `first` only counts the columns: 1, 2, 3 and a blank line below the units."""
    if first == 0 or first + 2 >= len(layout.rows):
        return False
    row, below = layout.rows[first][1], layout.rows[first + 1][1]
    return is_blank(below) and [c.strip() for c in row] == [str(k + 1) for k in range(len(row))]


def describe(layout, place, first):
    """The dialect where row `place` has the names and row `first` the first clean values."""
    names, names_line, start = [], 0, first
    unit_row, units_line = [], 0
    if place is not None:
        names_line, row = layout.rows[place]
        names, start = header_cells(row), place + 1
        while start < len(layout.rows):
            line, row = layout.rows[start]
            if layout.has_data(row) and not is_comment(row) \
                    and not numbered_columns(layout, start):
                break
            if not units_line and units.is_unit_row(row):
                unit_row, units_line = [units.clean(c) for c in row], line
            start += 1
    else:
        names = [''] * layout.width
    sections = {' '.join(without_trailing(row)).lower()
                for _, row in layout.rows[:start] if is_section(row)}
    body = [row for _, row in layout.rows[start:] if layout.is_body(row)]
    return Dialect(delimiter=layout.delimiter, names=names, names_line=names_line,
                   data_line=layout.rows[start][0] if start < len(layout.rows) else 0,
                   units=unit_row, units_line=units_line,
                   decimal_evidence=csv_numbers.evidence(c for row in body for c in row),
                   section_file='[column names]' in sections)
