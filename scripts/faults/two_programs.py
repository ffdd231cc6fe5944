#!/usr/bin/env python3
"""Starts a second program on an output folder that a first one writes.

    scripts/faults/two_programs.py [VERB ...] [-n 20]

Of two that start at random moments one must do the whole work as if it were alone. The other must
be refused with exit code 2 and one line that names the first one's process, unless that has ended.
"""
import random
import shutil
import sys
import time

from verbs import Folder, arguments_of, difference, is_one_error_line, report


def start_two(folder, verb, times):
    expected, seconds = folder.undisturbed(verb)
    failures = []
    refused = 0
    for number in range(times):
        out = folder.path / 'shared'
        first = folder.start(folder.call(verb, out))
        time.sleep(random.choice([0, random.uniform(0, seconds)]))
        second = folder.start(folder.call(verb, out, resume=True))
        ended = [(process.communicate()[1], process) for process in (first, second)]
        for errors, process in ended:
            if process.returncode < 2:
                continue
            other = second if process is first else first
            refused += 1
            if process.returncode != 2 or not is_one_error_line(errors) or (
                    f'in use by process {other.pid} on host' not in errors):
                failures.append(f'{number}: {process.returncode}: {errors[-300:]}')
        if all(process.returncode > 1 for _, process in ended):
            failures.append(f'{number}: both were refused')
        elif (wrong := difference(verb, out, expected)):
            failures.append(f'{number}: {wrong}')
        shutil.rmtree(out)
    return report(verb, failures, f'{times} pairs, of which {refused} had one refused')


def main():
    arguments = arguments_of(__doc__, 20)
    folder = Folder()
    wrong = sum(start_two(folder, verb, arguments.n) for verb in arguments.verbs)
    folder.remove()
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
