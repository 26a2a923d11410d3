#!/usr/bin/python3
"""validation on a small report made here. (Another test holds the committed page to the rod.)"""

import os
import tempfile
import unittest
from xml.sax.saxutils import quoteattr

from helpers import ROOT, contents, run

ROWS = ['Statics|elastica, P L^2/EI = 1: w/L|Mattiasson 1981|0.30172|0.301730123|0.0001|80|0',
        'Numerics|change of the energy|objectivity|0|3.1e-13|1e-12|40|0',
        'Motion|tip x [m]|Lang 2011|-0.233|-0.232|0.01|40|0.0005']


class Validation(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.page = os.path.join(folder.name, 'validation.md')
        self.report = os.path.join(folder.name, 'rows.xml')
        os.mkdir(os.path.join(folder.name, 'figures'))
        for name in os.listdir(os.path.join(ROOT, 'docs', 'figures')):
            with open(os.path.join(folder.name, 'figures', name), 'w', encoding='utf-8'):
                pass
        self.folder = folder.name

    def measure(self, rows):
        with open(self.report, 'w', encoding='utf-8') as out:
            out.write('<testsuites><testcase><properties>')
            for i, row in enumerate(rows):
                out.write(f'<property name="validation_{i}" value={quoteattr(row)}/>')
            out.write('</properties></testcase></testsuites>')

    def tool(self, *arguments):
        return run('validation', '--report', self.report, '--output', self.page, *arguments)

    def write(self):
        self.measure(ROWS)
        code, _, errors = self.tool('--no-figures')
        self.assertEqual(code, 0, errors)

    def stale(self, rows):
        """What --check complains of."""
        self.measure(rows)
        before = contents(self.page)
        code, _, errors = self.tool('--check')
        self.assertEqual(contents(self.page), before)
        self.assertEqual(code, 1 if errors else 0)
        return errors

    def test_writes_one_line_a_row_in_its_section(self):
        self.write()
        text = contents(self.page).decode()
        self.assertIn('| elastica, P L^2/EI = 1: w/L | Mattiasson 1981 | 0.30172 | 0.30173 '
                      '| +0.0034 % | 0.033 % | 80 | - |', text)
        self.assertIn('| 0 | 3.1e-13 | +3.1e-13 | 1e-12 | 40 | - |', text)
        self.assertIn('| -0.233 | -0.232 | -0.43 % | 4.3 % | 40 | 0.5 |', text)
        self.assertLess(text.index('elastica'), text.index('tip x'))
        self.assertLess(text.index('tip x'), text.index('change of the energy'))

    def test_up_to_date(self):
        self.write()
        self.assertEqual(self.stale(ROWS), '')

    def test_rounding_is_not_stale(self):
        self.write()
        self.assertEqual(self.stale([ROWS[0].replace('0.301730123', '0.301730623'),
                                     ROWS[1].replace('3.1e-13', '-7e-13'), ROWS[2]]), '')

    def test_stale(self):
        self.write()
        self.assertIn('ours: the table says 0.30173, the tests 0.301735',
                      self.stale([ROWS[0].replace('0.301730123', '0.301735')] + ROWS[1:]))
        self.assertIn('allowed: the table says 0.033 %, the tests 0.066 %',
                      self.stale([ROWS[0].replace('0.0001', '0.0002')] + ROWS[1:]))
        self.assertIn('tip x [m]: no test measures it any more', self.stale(ROWS[:2]))
        self.assertIn('Statics: new: new, not in the table',
                      self.stale(ROWS + ['Statics|new|here|1|1|0.1|4|0']))
        self.assertIn('run scripts/validation', self.stale(ROWS[:2]))

    def test_a_missing_figure_or_an_edited_text_is_stale(self):
        self.write()
        with open(self.page, 'a', encoding='utf-8') as out:
            out.write('edited by hand\n')
        self.assertIn('the text around the rows', self.stale(ROWS))
        self.write()
        figure = os.path.join(self.folder, 'figures', 'elastica.svg')
        os.remove(figure)
        self.assertIn(figure + ': missing', self.stale(ROWS))

    def test_bad_rows_are_named(self):
        self.measure(ROWS + [ROWS[0], 'Static|new|here|1|1|0.1|4|0'])
        code, _, errors = self.tool('--no-figures')
        self.assertEqual(code, 2)
        self.assertIn("new: no section 'Static'; did you mean 'Statics'?", errors)
        self.assertIn('elastica, P L^2/EI = 1: w/L: two rows have this name', errors)
        self.measure([])
        self.assertEqual(self.tool('--no-figures')[0], 2)

    def test_programs_that_are_missing_or_fail(self):
        code, _, errors = run('validation', '--check', '--programs', self.folder)
        self.assertEqual(code, 2)
        self.assertIn('scripts/build --tests', errors)
        program = os.path.join(self.folder, 'rod_test')
        with open(program, 'w', encoding='utf-8') as out:
            out.write('#!/bin/sh\necho off by a mile\nexit 1\n')
        os.chmod(program, 0o755)
        code, _, errors = run('validation', '--check', '--programs', self.folder)
        self.assertEqual(code, 3)
        self.assertIn('off by a mile', errors)


if __name__ == '__main__':
    unittest.main()
