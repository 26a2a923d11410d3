"""The text of a file that some other program wrote: its encoding, and a plain word where it is no
text at all."""

import codecs
import shutil
import stat
import os
import tempfile

SAMPLE = 1 << 20  # bytes from which the encoding and the dialect are judged
LONGEST_LINE = 1 << 20  # bytes; a longer one is no row of a table
LARGEST_FILE = 1 << 30  # bytes; a day of eight channels at 1 kHz is half of it

MARKS = ((codecs.BOM_UTF8, 'utf-8-sig', 'UTF-8'), (codecs.BOM_UTF32_LE, 'utf-32', 'UTF-32'),
         (codecs.BOM_UTF32_BE, 'utf-32', 'UTF-32'), (codecs.BOM_UTF16_LE, 'utf-16', 'UTF-16'),
         (codecs.BOM_UTF16_BE, 'utf-16', 'UTF-16'))
BINARY = ((b'PK\x03\x04', 'a zip file or an Excel workbook'), (b'\x1f\x8b', 'a gzip file'),
          (b'\xd0\xcf\x11\xe0', 'an old Excel workbook'), (b'MDF ', 'an MDF file'),
          (b'MATLAB 5', 'a MAT file'), (b'\x89HDF', 'an HDF5 file'), (b'#ROSBAG', 'a bag'),
          (b'\x89PNG', 'a picture'), (b'%PDF', 'a PDF'), (b'BZh', 'a bzip2 file'))


class NotUnderstood(Exception):
    """What a file does not say clearly: its line (0: the file as a whole), and the remedy."""

    def __init__(self, line, message):
        super().__init__(message)
        self.line, self.message = line, message


def open_bytes(path):
    """The file, open where it can be read twice; a pipe is copied first."""
    source = open(path, 'rb')
    if stat.S_ISREG(os.fstat(source.fileno()).st_mode):
        size = os.fstat(source.fileno()).st_size
    else:
        copy = tempfile.TemporaryFile()
        with source:
            while copy.tell() <= LARGEST_FILE:
                block = source.read(SAMPLE)
                if not block:
                    break
                copy.write(block)
        source, size = copy, copy.tell()
        source.seek(0)
    if size > LARGEST_FILE:
        source.close()
        raise NotUnderstood(0, f'got more than {LARGEST_FILE >> 30} GiB; cut the file')
    if size == 0:
        source.close()
        raise NotUnderstood(1, 'the file is empty, expected a header line')
    return source


def marked(head):
    """(codec, name) that the first bytes tell, or None."""
    for mark, codec, name in MARKS:
        if head.startswith(mark):
            return codec, name
    # Of UTF-16 without a mark every other byte is 0 in a text of numbers.
    even, odd = head[0::2].count(0), head[1::2].count(0)
    if len(head) > 8 and max(even, odd) > 0.4 * len(head[1::2]) and min(even, odd) == 0:
        return ('utf-16-le' if odd else 'utf-16-be'), 'UTF-16 without a mark'
    return None


def refuse_binary(head):
    for magic, what in BINARY:
        if head.startswith(magic):
            raise NotUnderstood(0, f'got {what}, expected text: export it as CSV')
    rest = head.rstrip(b'\0')  # recorders that lose power leave zeros behind the text
    controls = sum(rest.count(bytes([code])) for code in range(32) if code not in
                   (9, 10, 11, 12, 13, 26, 27))
    if not rest or b'\0' in rest or controls > 0.01 * len(rest):
        raise NotUnderstood(0, 'got binary data, expected text: export it as CSV, or say '
                               'its --encoding')


def blocks(source):
    source.seek(0)
    while True:
        block = source.read(SAMPLE)
        if not block:
            return
        yield block


def refuse_long_lines(source):
    """A line without an end would be read into memory whole."""
    line, length = 1, 0
    for block in blocks(source):
        for_lines = block.replace(b'\r', b'\n')
        first = for_lines.find(b'\n')
        longest = length + (len(block) if first < 0 else first)
        if longest > LONGEST_LINE:
            raise NotUnderstood(line, f'the line has more than {LONGEST_LINE >> 20} MiB, '
                                      'expected rows of a table')
        line += block.count(b'\n')
        length = longest if first < 0 else len(block) - 1 - for_lines.rfind(b'\n')


def decodes(source, codec):
    """None where all of the file is text in this codec, otherwise (line, byte, whether what comes
    before has letters beyond ASCII)."""
    decoder = codecs.getincrementaldecoder(codec)()
    line, beyond = 1, False
    for block in blocks(source):
        try:
            decoder.decode(block)
        except UnicodeDecodeError as error:
            # The decoder may hold bytes of the block before: positions count from these.
            held = error.object[:error.start]
            return line + held.count(b'\n'), error.object[error.start], beyond or not held.isascii()
        line += block.count(b'\n')
        beyond = beyond or not block.isascii()
    try:
        decoder.decode(b'', final=True)
    except UnicodeDecodeError as error:
        return line, error.object[error.start], beyond
    return None


def find_encoding(source, asked):
    """(codec, name for people) of an open file; `asked` is what the user says, or None."""
    source.seek(0)
    head = source.read(SAMPLE)
    if asked:
        try:
            codec = codecs.lookup(asked)
            ''.encode(asked)  # refuses what turns bytes to bytes, as zlib
        except (LookupError, ValueError):
            raise NotUnderstood(0, f"--encoding: got '{asked}', expected one as utf-8, latin-1, "
                                   'cp1252 or utf-16') from None
        name = codec.name
        return ('utf-8-sig' if name == 'utf-8' else name), asked
    known = marked(head)
    if not known:
        refuse_binary(head)
    if not known or known[0] == 'utf-8-sig':
        refuse_long_lines(source)
    codec, name = known or ('utf-8', 'UTF-8')
    wrong = decodes(source, codec)
    if wrong is None:
        return codec, name
    line, byte, beyond = wrong
    if known or beyond:
        raise NotUnderstood(line, f'the text is {name} up to here, but not the byte 0x{byte:02x}; '
                                  'say its --encoding, as utf-8 or latin-1')
    if decodes(source, 'cp1252') is None:
        return 'cp1252', 'Latin-1 (Windows-1252)'
    return 'latin-1', 'Latin-1'
