"""What every Python tool here shares: problems listed all at once, files written whole or not at
all, exit codes."""

import contextlib
import difflib
import json
import os
import sys
import tempfile

OK, BAD_INPUT, FAILED, IO_ERROR = 0, 2, 3, 4


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


@contextlib.contextmanager
def whole_file(path):
    """Yields a temporary name beside `path`, which takes `path`'s place when the block ends
    well."""
    folder = os.path.dirname(os.path.abspath(path))
    handle, temporary = tempfile.mkstemp(prefix='.' + os.path.basename(path) + '.', suffix='.part',
                                         dir=folder)
    os.close(handle)
    try:
        yield temporary
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(temporary, 0o666 & ~mask)  # mkstemp makes it private
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


def run(main):
    """Runs a tool's main: a file that cannot be read or written whole is exit code 4."""
    try:
        sys.exit(main() or OK)
    except BrokenPipeError:
        # Nobody reads the rest of what it prints, as below `| head`: no reason to fail.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(OK)
    except OSError as error:
        print(f'{error.filename or "error"}: {error.strerror or error}', file=sys.stderr)
        sys.exit(IO_ERROR)
