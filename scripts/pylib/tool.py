"""What every Python tool here shares: problems listed all at once, files written whole or not at
all, exit codes."""

import contextlib
import difflib
import io
import json
import os
import signal
import sys
import tempfile
import traceback

OK, BAD_INPUT, FAILED, IO_ERROR, INTERRUPTED = 0, 2, 3, 4, 130


class Problems:
    """Collects what is wrong with an input, so that the user sees all of it in one run."""

    SHOWN = 50  # more lines than this hide the first ones

    def __init__(self):
        self.lines = []

    def add(self, where, message):
        self.lines.append(f'{where}: {message}')

    def __bool__(self):
        return bool(self.lines)

    def exit_if_any(self):
        """Prints them and exits with 2 where there is one."""
        if not self.lines:
            return
        for line in self.lines[:self.SHOWN]:
            print(line, file=sys.stderr)
        if len(self.lines) > self.SHOWN:
            print(f'... and {len(self.lines) - self.SHOWN} more', file=sys.stderr)
        print(f'{len(self.lines)} problem{"s"[:len(self.lines) != 1]} found', file=sys.stderr)
        sys.exit(BAD_INPUT)


def nearest(word, known):
    """'; did you mean X?' for the known word nearest to this one, or what there is."""
    known = list(known)
    close = difflib.get_close_matches(word.lower(), [k.lower() for k in known], 1, 0.5)
    if close:
        return f"; did you mean '{next(k for k in known if k.lower() == close[0])}'?"
    return '; there is ' + ', '.join(f"'{k}'" for k in known) if known else ''


def require_programs(parser, folder, names):
    """Ends with what is missing where a folder lacks programs that a long run would start."""
    missing = [name for name in names if not os.access(os.path.join(folder, name), os.X_OK)]
    if missing:
        parser.error('--programs: there is no %s in %s; built by: cmake --build build --target %s' % (
            ' nor '.join(missing), folder, ' '.join(missing)))


def check_outputs(problems, reads, writes):
    """Tells every output that is an input or another output, or no regular file; one that cannot be
    made is an OSError before anything is done. `writes`: [(option, path or None)]; a name that leads
    to an input counts as it."""
    def are_one(one, other):
        return (os.path.exists(one) and os.path.exists(other) and os.path.samefile(one, other)
                or os.path.realpath(one) == os.path.realpath(other))

    outputs = [(option, path) for option, path in writes if path is not None]
    for k, (option, path) in enumerate(outputs):
        if not path:
            problems.add(option, 'got an empty text, expected a path')
        elif os.path.isdir(path):
            problems.add(path, f'{option}: got a folder, expected a file')
        elif os.path.exists(path) and not os.path.isfile(path):
            problems.add(path, f'{option}: got a device or pipe, expected a file, which is put in '
                               'place whole')
        else:
            for other in reads:
                if other and are_one(path, other):
                    problems.add(path, f"{option}: '{other}' is read by this run and would be lost: "
                                       'write elsewhere')
            for name, other in outputs[:k]:
                if are_one(path, other):
                    problems.add(path, f'{option}: is what {name} writes, too')
            with whole_file(path, replace=False):
                pass


@contextlib.contextmanager
def whole_file(path, replace=True):
    """Yields a temporary name beside `path`, which takes `path`'s place when the block ends well,
    unless it is only to be seen whether it could."""
    folder = os.path.dirname(os.path.abspath(path))
    handle, temporary = tempfile.mkstemp(prefix='.' + os.path.basename(path) + '.', suffix='.part',
                                         dir=folder)
    os.close(handle)
    try:
        yield temporary
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(temporary, 0o666 & ~mask)  # mkstemp makes it private
        if replace:
            os.replace(temporary, path)
    except OSError as error:
        if error.filename:
            raise
        raise OSError(error.errno, error.strerror, path) from error  # a full disk names no file
    finally:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(temporary)


def write_text(path, text):
    with whole_file(path) as temporary, open(temporary, 'w', encoding='utf-8') as out:
        out.write(text)


def write_json(path, numbers):
    """Writes the summary's numbers where --json FILE asked for them."""
    if path:
        write_text(path, json.dumps(numbers, indent=2, sort_keys=True) + '\n')


TRACEBACK = 'COSSERAT_CABLE_TRACEBACK'
STDOUT = 'the standard output could not be written whole'


class _Stdout(io.FileIO):
    """The standard output, whose errors say that they are its own."""

    def write(self, data):
        try:
            return super().write(data)
        except OSError as error:
            error.filename = STDOUT
            raise


def _open_streams():
    sys.stderr = sys.stderr or open(os.devnull, 'w', encoding='utf-8')
    if sys.stdout is None:  # the caller has closed it: what is printed is lost, and that shows
        os.dup2(os.open('/dev/full', os.O_WRONLY), 1)
    sys.stdout = io.TextIOWrapper(io.BufferedWriter(_Stdout(1, 'w', closefd=False)),
                                  encoding=getattr(sys.stdout, 'encoding', 'utf-8'),
                                  errors=getattr(sys.stdout, 'errors', 'strict'),
                                  line_buffering=os.isatty(1))


def _interrupt(_signal, _frame):
    raise KeyboardInterrupt


def run(main):
    """Runs a tool's main: a file that cannot be read or written whole is exit code 4, and so is a
    standard output that is full or that nobody reads to its end. An interrupt ends it without a
    traceback."""
    signal.signal(signal.SIGTERM, _interrupt)
    _open_streams()
    try:
        try:
            code = main() or OK
        except SystemExit as end:  # of argparse, too, whose help goes to the standard output
            code = end.code or OK
        sys.stdout.flush()
    except KeyboardInterrupt:
        print('interrupted', file=sys.stderr)
        code = INTERRUPTED
    except MemoryError:
        print('the memory does not suffice', file=sys.stderr)
        code = FAILED
    except OSError as error:
        print(f'{error.filename or "error"}: {error.strerror or error}', file=sys.stderr)
        code = IO_ERROR
        if error.filename == STDOUT:
            # What is left in its buffer would fail once more at the end.
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    except Exception as error:  # pylint: disable=broad-except
        # Files that only look like what they should be: what is wrong with the usual ones is said
        # where they are read.
        if os.environ.get(TRACEBACK):
            raise
        where = traceback.extract_tb(error.__traceback__)[-1]
        print(f'an input is not what it should be: {type(error).__name__}: {error}, in {where.name}; '
              f'{TRACEBACK}=1 in the environment shows where', file=sys.stderr)
        code = BAD_INPUT
    sys.exit(code)
