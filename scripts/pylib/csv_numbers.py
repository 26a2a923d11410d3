"""Cells of a CSV as numbers: decimal comma or point, separated thousands, missing values."""

import math
import re

import numpy as np

MISSING = {'', 'nan', '-nan', '+nan', 'na', 'n/a', '#n/a', '#na', '#nv', '#value!', '#div/0!',
           'null', 'none', '-', '--', '---', '?', '*', 'nan(ind)', '-nan(ind)', '1.#qnan',
           '-1.#ind', '1.#ind', '-1.#qnan', '1.#nan', 'invalid', 'undefined'}
SPACES = ' \u00a0\u2009\u202f\u2007'
GROUPS = SPACES + "'\u2019"  # what separates thousands beside the other of point and comma
MINUS = {0x2212: '-', 0x2013: '-'}

PLAIN = re.compile(r'[+-]?(?:\d+(?P<a>[.,])?\d*|(?P<b>[.,])\d+)(?:[eE][+-]?\d+)?')
GROUPED = re.compile(rf"[+-]?\d{{1,3}}(?:(?P<group>[.,{GROUPS}])\d{{3}})(?:(?P=group)\d{{3}})*"
                     r'(?:(?P<mark>[.,])\d*)?(?:[eE][+-]?\d+)?')
ONE_GROUP = re.compile(r'[+-]?[1-9]\d{0,2}[.,]\d{3}')  # 1,234: thousands or thousandths


def is_missing(cell):
    return cell.strip().lower() in MISSING


def grouped(cell):
    """The match of a number with separated thousands, None where it is none."""
    match = GROUPED.fullmatch(cell)
    if match is None or match.group('group') == match.group('mark'):
        return None
    # 0,500 and 1 000: no number of thousands begins with 0.
    return None if re.match(r'[+-]?0', cell) else match


def is_number(cell):
    """Whether a cell is a number in any of the dialects."""
    text = cell.strip().translate(MINUS)
    return PLAIN.fullmatch(text) is not None or grouped(text) is not None


def evidence(cells):
    """What the cells tell about the decimal mark, as {kind: a cell that tells it}: 'comma' and
    'point' are sure of it, 'comma?' and 'point?' may separate thousands instead."""
    found = {}
    for cell in cells:
        if '.' not in cell and ',' not in cell:
            continue
        text = cell.strip().translate(MINUS)
        plain, many = PLAIN.fullmatch(text), grouped(text)
        if plain is None and many is None:
            continue
        if plain is None:
            mark = many.group('mark') or {'.': ',', ',': '.'}.get(many.group('group'))
            kind = {',': 'comma', '.': 'point'}.get(mark)
        else:
            mark = plain.group('a') or plain.group('b')
            kind = {',': 'comma', '.': 'point'}.get(mark)
            if kind and ONE_GROUP.fullmatch(text):
                kind += '?'
        if kind:
            found.setdefault(kind, text)
            if 'comma' in found and 'point' in found:
                break
    return found


def decide_decimal(found):
    """('.' or ',', '') from evidence(), or (None, what is not clear)."""
    if 'comma' in found and 'point' in found:
        return None, (f"got '{found['comma']}' and '{found['point']}': say --decimal , or "
                      '--decimal .')
    if 'comma' in found:
        return ',', ''
    if 'point' in found or 'comma?' not in found:
        return '.', ''
    text = found['comma?']
    return None, (f"got '{text}': say --decimal , where this is {text.replace(',', '.')}, "
                  f"--decimal . where it is {text.replace(',', '')}")


def plain_float(cell, decimal):
    """The cell's number, NaN where it is missing, None where it is neither."""
    text = cell.strip().translate(MINUS)
    other = ',' if decimal == '.' else '.'
    match = PLAIN.fullmatch(text)
    if match is not None and (match.group('a') or match.group('b') or decimal) == decimal:
        return float(text.replace(',', '.'))
    many = grouped(text)
    if many is not None and many.group('group') != decimal:
        whole = text.replace(many.group('group'), '')
        return float(whole.replace(decimal, '.')) if other not in whole else None
    return math.nan if is_missing(text) else None


def to_numbers(cells, decimal):
    """(values, NaN where missing or wrong; indices of cells that are no number)."""
    values = fast_numbers(cells, decimal)
    if values is not None:
        return values, np.flatnonzero(np.isinf(values))
    values, wrong = np.full(len(cells), np.nan), []
    quick = re.compile(r'[+-]?\d+\.?\d*').fullmatch if decimal == '.' else re.compile(
        r'[+-]?\d+').fullmatch
    for i, cell in enumerate(cells):
        if not cell:
            continue
        value = float(cell) if quick(cell) else plain_float(cell, decimal)
        if value is None or math.isinf(value):
            wrong.append(i)
        else:
            values[i] = value
    return values, np.array(wrong, dtype=int)


def fast_numbers(cells, decimal):
    """As Python reads them, None where one is not of that form."""
    joined = '\n'.join(cells)
    if '_' in joined or not joined.isascii():
        return None
    if decimal == ',':
        if '.' in joined:
            return None
        joined = joined.replace(',', '.')
    parts = joined.split('\n')
    if len(parts) != len(cells):
        return None
    try:
        return np.array(list(map(float, parts)))
    except ValueError:
        return None
