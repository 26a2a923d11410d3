"""For the tests of the tools that make reports: reads a report, and checks that it stands alone."""

import base64
import html.parser
import re
import xml.etree.ElementTree

EMPTY = {'meta', 'img', 'br'}  # html elements without an end tag


class Page(html.parser.HTMLParser):
    """Checks that elements close in order; keeps texts, pictures and what points elsewhere."""

    def __init__(self, text):
        super().__init__()
        self.open, self.text, self.pictures, self.links = [], '', [], []
        self.feed(text)
        assert not self.open, self.open

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ('src', 'href', 'srcset', 'action', 'data'):
                if value.startswith('data:image/svg+xml;base64,'):
                    self.pictures.append(base64.b64decode(value.split(',', 1)[1]))
                else:
                    self.links.append(value)
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in EMPTY:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open and self.open.pop() == tag, tag

    def handle_data(self, data):
        self.text += data + ' '


def read_alone(test, page):
    """The Page of a report's text, which must need nothing else."""
    test.assertNotRegex(re.sub(r'base64,[A-Za-z0-9+/=]*', '', page), r'https?:|//|@import|url\(')
    read = Page(page)
    test.assertEqual(read.links, [])
    for picture in read.pictures:
        drawn = xml.etree.ElementTree.fromstring(picture)
        test.assertTrue(drawn.tag.endswith('svg'))
        for element in drawn.iter():
            for name, target in element.attrib.items():
                if name.endswith('href'):
                    test.assertTrue(target.startswith(('#', 'data:')), target)
    return read
