"""A report as a list of items, written as one html file that needs no network, and as a PDF.

An item is Heading, Text, Bullets, Table, Figure or Folded; both files have the same in the same
order. Figures are drawings in the html, and images on the PDF's pages."""

import base64
import collections
import html
import io
import textwrap

import page_figures
import tool

Heading = collections.namedtuple('Heading', 'text level')
Text = collections.namedtuple('Text', 'text kind')  # kind: '', 'headline', 'verdict' or 'warning'
Bullets = collections.namedtuple('Bullets', 'lines kind')
Table = collections.namedtuple('Table', 'header rows caption')
Figure = collections.namedtuple('Figure', 'figure caption')
Folded = collections.namedtuple('Folded', 'summary items')  # shown on a click, in the html

STYLE = """
body { font: 15px/1.5 sans-serif; color: #222; max-width: 72em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; } h2 { margin-top: 2em; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; margin: 0.8em 0; font-size: 0.9em; }
th, td { border-bottom: 1px solid #ddd; padding: 0.25em 0.8em 0.25em 0; text-align: left;
  vertical-align: top; }
th { border-bottom: 2px solid #888; }
td.number { font-variant-numeric: tabular-nums; white-space: nowrap; }
img { max-width: 100%; height: auto; }
figure { margin: 1em 0; } figcaption, caption { color: #555; font-size: 0.9em; text-align: left; }
.verdict { font-size: 1.1em; background: #eef4fa; padding: 0.7em 1em; border-left: 4px solid #0072B2; }
.headline { font-size: 1.45em; line-height: 1.35; background: #eef4fa; padding: 0.7em 1em;
  border-left: 6px solid #0072B2; }
summary { cursor: pointer; color: #0072B2; }
.warning { background: #fdf3e7; padding: 0.4em 1em; border-left: 4px solid #D55E00; }
ul.warning { padding-left: 2em; }
@media print { figure, table { break-inside: avoid; } }
"""

PAGE = (8.27, 11.69)  # A4 [in]
MARGIN = 0.07         # of the page
LINE = 0.0145         # height of a line, of the page
CHARACTERS = 98       # in a line of a page
CAPTION = 4 * LINE    # what a figure's caption takes, about
TALLEST = 0.6         # figure, of the page
DPI = 200             # of a figure
CELL = 34             # most characters of a table's cell before it is wrapped, in the PDF


def is_number(cell):
    return bool(cell) and cell.lstrip('+-')[:1].isdigit()


def html_table(table):
    head = ''.join(f'<th>{html.escape(cell)}</th>' for cell in table.header)
    rows = ''.join('<tr>' + ''.join(
        f'<td{" class=number" * is_number(cell)}>{html.escape(cell)}</td>' for cell in row)
        + '</tr>\n' for row in table.rows)
    caption = f'<caption>{html.escape(table.caption)}</caption>' if table.caption else ''
    return f'<table>{caption}<thead><tr>{head}</tr></thead>\n<tbody>{rows}</tbody></table>\n'


def html_figure(item):
    picture = io.BytesIO()
    item.figure.savefig(picture, format='svg', metadata={'Date': None})
    # As a picture of its own: names inside one do not meet those of another.
    data = base64.b64encode(picture.getvalue()).decode('ascii')
    caption = html.escape(item.caption)
    return (f'<figure><img alt="{caption}" src="data:image/svg+xml;base64,{data}"/>'
            f'<figcaption>{caption}</figcaption></figure>\n')


def html_item(item):
    if isinstance(item, Heading):
        return f'<h{item.level}>{html.escape(item.text)}</h{item.level}>\n'
    if isinstance(item, Text):
        kind = f' class="{item.kind}"' if item.kind else ''
        return f'<p{kind}>{html.escape(item.text)}</p>\n'
    if isinstance(item, Bullets):
        kind = f' class="{item.kind}"' if item.kind else ''
        lines = ''.join(f'<li>{html.escape(line)}</li>' for line in item.lines)
        return f'<ul{kind}>{lines}</ul>\n'
    if isinstance(item, Folded):
        return (f'<details><summary>{html.escape(item.summary)}</summary>\n'
                + ''.join(map(html_item, item.items)) + '</details>\n')
    return html_table(item) if isinstance(item, Table) else html_figure(item)


def write_html(path, title, items):
    tool.write_text(path, '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"/>\n'
                    f'<title>{html.escape(title)}</title>\n<style>{STYLE}</style></head>\n<body>\n'
                    + ''.join(map(html_item, items)) + '</body></html>\n')


class Pages:
    """Text and figures set one below the other onto pages of a PDF."""

    def __init__(self, pdf, plt):
        self.pdf, self.plt = pdf, plt
        self.page, self.y = None, 0
        self.drawn = None, None  # a figure, and what picture() makes of it

    def flush(self):
        if self.page is not None:
            self.pdf.savefig(self.page)
            self.plt.close(self.page)
        self.page = None

    def reserve(self, height):
        """A new page where this one has less left, of its height."""
        if self.page is None or self.y - height < MARGIN:
            self.flush()
            self.page, self.y = self.plt.figure(figsize=PAGE), 1 - MARGIN

    def line(self, text, **style):
        self.reserve(0)
        self.page.text(MARGIN, self.y, text, va='top', parse_math=False, **style)
        self.y -= LINE * style.get('fontsize', 9) / 9

    def paragraph(self, text, first='', **style):
        characters = int(CHARACTERS * 9 / style.get('fontsize', 9))
        for number, line in enumerate(textwrap.wrap(first + text, characters) or ['']):
            self.line(('  ' if number and first else '') + line, **style)
        self.y -= LINE / 2

    def table(self, table):
        if table.caption:
            self.paragraph(table.caption, color='0.35')
        wrapped = [[textwrap.wrap(cell, CELL) or [''] for cell in row]
                   for row in [table.header] + table.rows]
        widths = [max(len(line) for row in wrapped for line in row[k])
                  for k in range(len(table.header))]
        # Set as small as the widest row asks for.
        size = min(7.5, 7.5 * 108 / (sum(widths) + 2 * len(widths)))
        for number, row in enumerate(wrapped):
            for k in range(max(map(len, row))):
                cells = [cell[k] if k < len(cell) else '' for cell in row]
                self.line('  '.join(c.ljust(w) for c, w in zip(cells, widths)), fontsize=size,
                          family='monospace', weight='normal' if number else 'bold')
        self.y -= LINE

    def figure(self, item):
        image, height = self.picture(item.figure)
        self.reserve(height + CAPTION)
        # Margins are parts of the height for lines, and of the width for what stands in a line.
        axes = self.page.add_axes((MARGIN, self.y - height, 1 - 2 * MARGIN, height), anchor='NW')
        axes.imshow(image, interpolation='none')
        axes.set_axis_off()
        self.y -= height + LINE / 2
        self.paragraph(item.caption, color='0.35')

    def picture(self, figure):
        """A figure as an image, and its height on a page as wide as the text; once for each, though
        the heading above asks as well."""
        if self.drawn[0] is not figure:
            file = io.BytesIO()
            figure.savefig(file, format='png', dpi=DPI, bbox_inches='tight')
            file.seek(0)
            image = self.plt.imread(file)
            height = (1 - 2 * MARGIN) * PAGE[0] / PAGE[1] * image.shape[0] / image.shape[1]
            self.drawn = figure, (image, min(height, TALLEST))
        return self.drawn[1]

    def add(self, item, after=None):
        """`after`: what a heading is above, and is not to be parted from."""
        if isinstance(item, Heading):
            self.y -= LINE
            beside = self.picture(after.figure)[1] + CAPTION if isinstance(after, Figure) else 0
            self.reserve(3 * LINE + max(beside, 4 * LINE))
            self.paragraph(item.text, fontsize=18 - 3 * item.level, weight='bold')
        elif isinstance(item, Text):
            self.paragraph(item.text, fontsize=13 if item.kind == 'headline' else 9)
        elif isinstance(item, Folded):
            self.paragraph(item.summary, fontsize=9, weight='bold')
            for each in item.items:
                self.add(each)
        elif isinstance(item, Bullets):
            for line in item.lines:
                self.paragraph(line, first='- ', fontsize=9)
        elif isinstance(item, Table):
            self.table(item)
        else:
            self.figure(item)


def write_pdf(path, title, items):
    from matplotlib.backends.backend_pdf import PdfPages
    plt = page_figures.pyplot('report')
    with tool.whole_file(path) as temporary, PdfPages(
            temporary, metadata={'Title': title, 'CreationDate': None}) as pdf:
        pages = Pages(pdf, plt)
        for number, item in enumerate(items):
            pages.add(item, next((each for each in items[number + 1:]
                                  if not isinstance(each, Heading)), None))
        pages.flush()
