#!/usr/bin/env python3
"""Takes the right to write from the output folder at a random moment.

    scripts/faults/read_only.py [VERB ...] [-n 20]

Run by root, the program runs as `nobody`: root may write anywhere. It must end with exit code 2 and
one line of error, or have been done; when the right is back, a resumed run must end with an
undisturbed run's files.
"""
import os
import random
import shutil
import sys
import time

from verbs import (LOCK_NO_FOLDER, Folder, age_parts, arguments_of, difference,
                   is_one_error_line, report)

NOBODY = 65534


def as_nobody(call):
    if os.getuid():
        return call
    return ['setpriv', f'--reuid={NOBODY}', f'--regid={NOBODY}', '--clear-groups', *call]


def folders_in(folder):
    return [folder, *(entry for entry in folder.rglob('*') if entry.is_dir())]


def give(path):
    if not os.getuid():
        for folder, _, files in os.walk(path):
            for entry in [folder, *(os.path.join(folder, file) for file in files)]:
                os.chown(entry, NOBODY, NOBODY)


def forbid(folder, verb, times):
    expected, seconds = folder.undisturbed(verb)
    give(folder.path / 'cache')
    failures = []
    refused = 0
    for number in range(times):
        out = folder.path / 'forbidden'
        out.mkdir()
        give(out)
        process = folder.start(as_nobody(folder.call(verb, out)))
        time.sleep(random.uniform(0, seconds))
        for entry in folders_in(out):
            entry.chmod(0o555)
        errors = process.communicate()[1]
        if process.returncode > 1 or process.returncode < 0:
            refused += 1
            if process.returncode != 2 or not is_one_error_line(errors):
                failures.append(f'{number}: {process.returncode}: {errors[-300:]}')
        for entry in folders_in(out):
            entry.chmod(0o755)
        if verb in LOCK_NO_FOLDER:
            age_parts(out)
        again = folder.run(as_nobody(folder.call(verb, out, resume=True)))
        wrong = difference(verb, out, expected) if again.returncode < 2 else again.stderr
        if wrong:
            failures.append(f'{number}: after the resumed run: {wrong}')
        shutil.rmtree(out)
    return report(verb, failures, f'{times} runs, of which {refused} were refused to write')


def main():
    arguments = arguments_of(__doc__, 20)
    folder = Folder()
    wrong = sum(forbid(folder, verb, arguments.n) for verb in arguments.verbs)
    folder.remove()
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
