#!/usr/bin/python3
"""causes: the committed page shows what docs/validation.md and src/causes have, and a page is made of
a run's numbers."""

import json
import os
import sys
import tempfile
import unittest

from helpers import ROOT, contents, run

sys.path.insert(0, os.path.join(ROOT, 'scripts', 'pylib'))
import causes_page  # noqa: E402
from generated_set import CAUSES  # noqa: E402

SOURCES = sorted(os.path.splitext(name)[0] for name in
                 os.listdir(os.path.join(ROOT, 'src', 'causes')) if name.endswith('.cpp'))


def row(cause, name, true, found, inside=True):
    return {'cause': cause, 'parameter': name, 'true': true, 'start': 0.5 * true, 'found': found,
            'sd': 0.01, 'interval': [0, 1], 'inside': inside, 'seconds': 1.0, 'gain': 0.98765}


def made_up():
    rows = [row(name, f'extensions.{name}.x', 2.0, 2.02) for name in CAUSES if name != 'contact']
    rows += [row('contact', 'extensions.contact.plane.elevation', 0.0, 0.01, False),
             row('contact', 'extensions.contact.stiffness', 100.0, None), row('contact', 'EI', 1, 1)]
    apart = {'apart': 3e-4, 'record': 'torsion', 'moves': 0.12, 'records': {}}
    return {'agreement': {name: apart for name in ('none', *CAUSES)}, 'agreement_snr': 80.0,
            'agreement_records': 5,
            'recovery': {'seed': 1, 'snr': 40.0, 'beside': 0.05, 'rows': rows,
                         'failed': {'clock': 'it is late'}},
            'cost': {'us_per_step': 12.34, 'elements': 40, 'rounds': 15, 'steps': 1000,
                     'ratios': {name: 1.234 for name in CAUSES}}}


class Causes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.page = os.path.join(folder.name, 'causes.md')
        self.report = os.path.join(folder.name, 'numbers.json')

    def write(self):
        with open(self.report, 'w', encoding='utf-8') as out:
            json.dump(made_up(), out)
        code, _, errors = run('causes', '--report', self.report, '--output', self.page)
        self.assertEqual(code, 0, errors)
        return contents(self.page).decode()

    def test_the_committed_page_is_up_to_date(self):
        code, _, errors = run('causes', '--check')
        self.assertEqual(code, 0, errors)

    def test_every_cause_has_its_law_its_closed_form_and_its_generator(self):
        self.assertEqual(list(causes_page.LAWS), SOURCES)
        self.assertEqual(sorted(CAUSES), SOURCES)
        validation = contents(os.path.join(ROOT, 'docs', 'validation.md')).decode()
        self.assertEqual(sorted(causes_page.closed_forms(validation)), SOURCES)

    def test_keys_are_those_of_the_templates(self):
        templates = ''.join(contents(os.path.join(ROOT, 'config', *path)).decode() for path in (
            ('cables', 'template.yaml'), ('sets', 'template', 'measurement.yaml')))
        for name, (_, _, keys) in causes_page.LAWS.items():
            for key in keys.replace(':', ',').replace(' or ', ', ').split(',')[1:]:
                self.assertIn(key.strip() + ':', templates, name)

    def test_a_page_of_numbers(self):
        text = self.write()
        self.assertIn('| 0.03 % | 12 % | 1 of 1, 1 % | 0.9877 | 1.23 |', text)
        self.assertIn('| 0 of 2, 1 undetermined | 0.9877 |', text)
        self.assertIn('| the fit failed | - |', text)
        self.assertIn('| `extensions.contact.plane.elevation` | 0 | 0 | 0.01 | 0.01 | **no** |',
                      text)
        self.assertIn('| `extensions.contact.stiffness` | 100 | 50 | undetermined | - | - |', text)
        self.assertEqual(run('causes', '--check', '--output', self.page)[0], 0)

    def test_says_what_to_build(self):
        code, _, errors = run('causes', '--programs', os.path.dirname(self.page))
        self.assertEqual(code, 2)
        for name in ('rig_generator', 'cable_simulate', 'cable_identify', 'cause_steps'):
            self.assertIn(name + ': not in', errors)
        self.assertIn('scripts/build --tests', errors)

    def test_stale(self):
        text = self.write()
        with open(self.page, 'w', encoding='utf-8') as out:
            out.write(text.replace('`air_drag`', '`air_drug`'))
        code, _, errors = run('causes', '--check', '--output', self.page)
        self.assertEqual(code, 1)
        self.assertIn('air_drag: not in the page', errors)
        self.assertIn('run scripts/causes', errors)


if __name__ == '__main__':
    unittest.main()
