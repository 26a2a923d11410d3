"""A table that some other program exported: finds how it is laid out, says so in one line, and
reads the columns that are asked for."""

import csv
import io
import itertools
import operator

import csv_dialect
import csv_numbers
import csv_text
import units
from csv_text import NotUnderstood

DECIMALS = {'.': 'point', ',': 'comma'}
SHOWN = 50  # problems of one kind; the others are counted
FOOTER = 20  # lines of words below the last row, as loggers end their files, at most


class CsvTable:
    """A file's names and units, and its columns as cells; `open` finds the dialect."""

    def __init__(self, path, encoding=None, delimiter=None, decimal=None, skip=None, wanted=()):
        self.path, self.asked_decimal = path, decimal
        self.source = csv_text.open_bytes(path)
        try:
            self.codec, self.encoding = csv_text.find_encoding(self.source, encoding)
            self.errors = 'replace' if encoding else 'strict'
            self.dialect = csv_dialect.detect(self.sample(), delimiter, skip, wanted)
        except BaseException:
            self.source.close()
            raise
        self.names = self.dialect.names
        self.left_out = 0  # last lines that end in the middle
        self.footer = 0  # lines of words below the rows
        self.decimal = decimal

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.source.close()

    def sample(self):
        """The first lines, without one that the sample cuts."""
        self.source.seek(0)
        head = self.source.read(csv_text.SAMPLE)
        more = len(head) == csv_text.SAMPLE
        text = io.TextIOWrapper(io.BytesIO(head), encoding=self.codec, errors='ignore', newline='')
        lines = text.readlines()
        return (lines[:-1] if more and len(lines) > 1 else lines)[:2000]

    def find(self, name):
        """Places of the columns that a user's `name` means: by name, or #N for the N-th."""
        places = [i for i, n in enumerate(self.names) if n == csv_dialect.clean_name(name)]
        if not places and name[:1] == '#' and name[1:].isdigit():
            places = [i for i in [int(name[1:]) - 1] if 0 <= i < len(self.names)]
        return places

    def label(self, place):
        return self.names[place] or f'#{place + 1}'

    def unit(self, place):
        """The unit in the row of units, else in the name, '' where neither has one."""
        return self.row_unit(place) or units.in_name(self.names[place])

    def row_unit(self, place):
        return self.dialect.units[place] if place < len(self.dialect.units) else ''

    def read(self, places, problems):
        """(cells of each place, line numbers) of all rows; rows of another width are problems."""
        picked, lines, odd, last = [], [], [], 0
        self.source.seek(0)
        text = io.TextIOWrapper(self.source, encoding=self.codec, errors=self.errors, newline='')
        try:
            if self.dialect.data_line:
                picked, lines, odd, last = self.pick_rows(text, places)
        except (csv.Error, UnicodeError) as error:
            problems.add(self.path, f'not a CSV text: {error}')
        finally:
            text.detach()
        if lines:
            odd = self.without_footer(odd, lines[-1])
        self.report_odd([o[:2] for o in odd], last, len(picked), problems)
        return [list(c) for c in zip(*picked)] if picked else [[] for _ in places], lines

    def pick_rows(self, text, places):
        """(cells, line numbers, [(line, cells, whether words) of rows that have too few or too
        many], last line)."""
        start, delimiter = self.dialect.data_line, self.dialect.delimiter
        rest = itertools.islice(text, start - 1, None)
        if delimiter == ' ':
            return self.pick(enumerate(map(str.split, rest), start), places)
        rows = csv.reader(rest, delimiter=delimiter, skipinitialspace=True)
        found = self.pick(enumerate(rows, start), places)
        if rows.line_num + start - 1 <= found[-1]:
            return found
        text.seek(0)  # some rows have several lines: counted one by one
        rest = itertools.islice(text, start - 1, None)
        return self.pick(((start - 1 + number, row) for number, row in
                          csv_dialect.reader(rest, delimiter)), places)

    def pick(self, numbered, places):
        width, picked, lines, odd, number = len(self.names), [], [], [], 0
        pick = operator.itemgetter(*places) if len(places) > 1 else lambda row: (row[places[0]],)
        take, count = picked.append, lines.append
        for number, row in numbered:
            if len(row) == width and row[0][:1] not in '#%/':
                take(pick(row))
                count(number)
            elif not csv_dialect.is_comment(row) and any(row):
                # All columns, and empty ones behind the last delimiter.
                if len(row) >= width and csv_dialect.is_blank(row[width:]):
                    take(pick(row))
                    count(number)
                elif not csv_dialect.is_blank(row):
                    odd.append((number, len(csv_dialect.without_trailing(row))
                                if len(row) > width else len(row), begins_with_word(row)))
        return picked, lines, odd, number

    def without_footer(self, odd, last_good):
        """Counts the lines of words below the last row, and leaves them out."""
        below = [o for o in odd if o[0] > last_good]
        if not below or len(below) > FOOTER or not all(words for _, _, words in below):
            return odd
        self.footer = len(below)
        return odd[:-len(below)]

    def report_odd(self, odd, last, good, problems):
        if odd and odd[-1] == (last, odd[-1][1]) and odd[-1][1] < len(self.names) \
                and not self.ends_with_newline():
            self.left_out = 1
            odd = odd[:-1]
        width = len(self.names)
        if odd and not good:
            line, got = odd[0]
            remedy = ''
            if self.dialect.delimiter == ',' and got > width:
                remedy = ('; are the commas decimal ones as well? Export with semicolons or with '
                          'decimal points')
            problems.add(f'{self.path}:{line}', f'got {got} cells, expected {width}: the names on '
                                                f'line {self.dialect.names_line}{remedy}; '
                                                '--delimiter and --skip say otherwise')
            return
        for line, got in odd[:SHOWN]:
            problems.add(f'{self.path}:{line}', f'got {got} cells, expected {width}')
        if len(odd) > SHOWN:
            problems.add(f'{self.path}:{odd[SHOWN][0]}',
                         f'{len(odd) - SHOWN} more rows have another number of cells')

    def ends_with_newline(self):
        self.source.seek(-1, io.SEEK_END)
        tail = self.source.read(1)
        if self.codec.startswith('utf-16'):
            self.source.seek(-2, io.SEEK_END)
            tail = self.source.read(2).strip(b'\0')
        return tail in (b'\n', b'\r')

    def settle_decimal(self, columns):
        """Decides on the decimal mark from the first rows, and from all cells of `columns` where
        these do not tell; NotUnderstood where nothing does."""
        if self.decimal:
            return
        found = dict(self.dialect.decimal_evidence)
        if not {'comma', 'point'} & set(found):
            for cells in columns:
                for kind, cell in csv_numbers.evidence(cells).items():
                    found.setdefault(kind, cell)
        self.decimal, unclear = csv_numbers.decide_decimal(found)
        if unclear:
            raise NotUnderstood(0, unclear)

    def words(self):
        """What was detected, as words for one line."""
        d = self.dialect
        separated = csv_dialect.DELIMITERS.get(d.delimiter, repr(d.delimiter))
        words = [f'{separated} separated' if len(self.names) > 1 else 'one column']
        if self.decimal:
            words.append(f'decimal {DECIMALS[self.decimal]}')
        words.append(self.encoding)
        header = max(d.data_line - 1, 0)
        words.append(f'{header} header line{"s"[:header != 1]}')
        words.append(f'names on line {d.names_line}' if d.names_line
                     else 'no line of names (columns are #1, #2, ...)')
        if d.units_line:
            words.append(f'units on line {d.units_line}')
        return words


def begins_with_word(row):
    """Whether a row's first cell that is not empty begins with a letter."""
    return next((cell.strip()[0].isalpha() for cell in row if cell.strip()), False)


def numbers(cells, lines, name, decimal, path, problems):
    """The cells' numbers, NaN where missing; what is no number is a problem."""
    values, wrong = csv_numbers.to_numbers(cells, decimal)
    for i in wrong[:SHOWN]:
        text = cells[i].strip()
        if csv_dialect.clean_name(text) == name:
            message = 'the names again: a second recording begins here, cut the file'
        else:
            message = f"got '{text[:80]}', expected a number"
            if decimal == '.' and csv_numbers.to_numbers([text], ',')[1].size == 0:
                message += ' with a decimal point (or say --decimal ,)'
        problems.add(f'{path}:{lines[i]}', f'{name}: {message}')
    if len(wrong) > SHOWN:
        problems.add(f'{path}:{lines[wrong[SHOWN]]}',
                     f'{name}: {len(wrong) - SHOWN} more cells are no number')
    return values
