"""What the tools that make reports share: reading what a program wrote into a folder, and the
command line."""

import argparse
import csv
import importlib
import json
import os

import numpy as np

import report_page
import tool

FORMAT = 1


def read_columns(path, problems):
    """{column: array}; empty fields are nan."""
    with open(path, encoding='utf-8', newline='') as source:
        rows = list(csv.reader(source))
    try:
        header, *rows = rows
        values = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows])
        values = values.reshape(len(rows), len(header))
    except ValueError:
        problems.add(path, 'expected a header and rows of as many numbers')
        return {}
    if header[0] not in ('t', 'step'):
        problems.add(path, f"first column: got '{header[0]}', expected 't' or 'step'")
        return {}
    return dict(zip(header, values.T)) if len(rows) > 1 else {}


def read(folder, name, program, key, records, problems):
    """The answer of `program` in the file `name`, which has `key`, and its records by experiment.
    records(answer): [(experiment, file)]"""
    path = os.path.join(folder, name)
    with open(path, encoding='utf-8') as source:
        try:
            data = json.load(source)
        except (ValueError, RecursionError) as error:
            problems.add(path, f'no JSON: {error}')
            return {}, {}
    if not isinstance(data, dict) or key not in data:
        problems.add(path, f'not written by {program}')
        return {}, {}
    if data.get('format') != FORMAT:
        problems.add(path, f"format: got {data.get('format')}, expected {FORMAT}")
        return {}, {}
    return data, {experiment: read_columns(os.path.join(folder, file), problems)
                  for experiment, file in records(data) if file}


def main(description, name, program, key, records, title, content):
    """content: the module whose `content(answer, records)` makes the report's items."""
    parser = argparse.ArgumentParser(description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('folder', metavar='DIR', help=f'the --output of {program}')
    parser.add_argument('--pdf', action='store_true', help='write report.pdf as well')
    options = parser.parse_args()

    problems = tool.Problems()
    data, read_records = read(options.folder, name, program, key, records, problems)
    problems.exit_if_any()
    title = f"{title}: {data.get('set', '')}"
    # With matplotlib, which takes a second: not for a file that is refused.
    content_of = importlib.import_module(content).content
    try:
        items = content_of(data, read_records)
    except (ValueError, KeyError, IndexError, TypeError, AttributeError) as error:
        problems.add(os.path.join(options.folder, name),
                     f'not written by {program}: {type(error).__name__}: {error}')
        problems.exit_if_any()
    path = os.path.join(options.folder, 'report.html')
    report_page.write_html(path, title, items)
    print(path)
    if options.pdf:
        path = os.path.join(options.folder, 'report.pdf')
        report_page.write_pdf(path, title, items)
        print(path)
