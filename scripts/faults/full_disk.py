#!/usr/bin/env python3
"""Lets the disk fill at a random moment: a small tmpfs as output folder. Needs root.

    scripts/faults/full_disk.py [VERB ...] [-n 20]

The program must end with exit code 2 and one line of error, leave no part of a file, and go on to
an undisturbed run's files when there is room.
"""
import random
import subprocess
import sys

from verbs import Folder, arguments_of, difference, files_in, is_one_error_line, report


def size_of(folder):
    return sum((folder / name).stat().st_size for name in files_in(folder))


def fill(folder, verb, times):
    expected, _ = folder.undisturbed(verb)
    disk = folder.path / 'disk'
    disk.mkdir(exist_ok=True)
    failures = []
    full = 0
    for number in range(times):
        size = random.randrange(4096, size_of(expected) + 4096)
        subprocess.run(['mount', '-t', 'tmpfs', '-o', f'size={size}', 'none', disk], check=True)
        out = disk / 'out'
        try:
            done = folder.run(folder.call(verb, out))
            if done.returncode > 1:
                full += 1
                if done.returncode != 2 or not is_one_error_line(done.stderr):
                    failures.append(f'{number}, {size} B: {done.returncode}: {done.stderr[-300:]}')
                if any(name.endswith('.part') for name in files_in(disk)):
                    failures.append(f'{number}, {size} B: a part of a file is left')
            subprocess.run(['mount', '-o', 'remount,size=1G', disk], check=True)
            again = folder.run(folder.call(verb, out, resume=True))
            wrong = difference(verb, out, expected) if again.returncode < 2 else again.stderr
            if wrong:
                failures.append(f'{number}, {size} B: after the resumed run: {wrong}')
        finally:
            subprocess.run(['umount', disk], check=True)
    return report(verb, failures, f'{times} disks, of which {full} filled')


def main():
    arguments = arguments_of(__doc__, 20)
    folder = Folder()
    disk = folder.path / 'disk'
    disk.mkdir()
    probe = subprocess.run(['mount', '-t', 'tmpfs', 'none', disk], capture_output=True, check=False)
    if probe.returncode:
        print('skipped: mount is not allowed here')
        return 0
    subprocess.run(['umount', disk], check=True)
    wrong = sum(fill(folder, verb, arguments.n) for verb in arguments.verbs)
    folder.remove()
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
