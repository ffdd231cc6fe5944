#!/usr/bin/env python3
"""Kills verbs with SIGKILL at random moments and lets them go on.

    scripts/faults/kill.py [VERB ...] [-n 200]

After each kill nothing that was finished may be lost or changed. A run that comes to its end must
have the files of an undisturbed run, with equal contents but for times, and no other file.
"""
import random
import shutil
import subprocess
import sys

from verbs import (LOCK_NO_FOLDER, Folder, age_parts, arguments_of, difference, files_in,
                   finished_files, half_a_frame, report)


def kill_often(folder, verb, moments):
    expected, seconds = folder.undisturbed(verb)
    out = folder.path / 'killed'
    kills = ends = strays = 0
    failures = []
    before = {}
    while kills < moments or out.exists():
        last = kills >= moments
        process = folder.start(folder.call(verb, out, resume=out.exists()))
        try:
            errors = process.communicate(timeout=None if last else random.uniform(0, seconds))[1]
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            kills += 1
            after = finished_files(verb, out) if out.exists() else {}
            lost = [name for name in before if after.get(name) != before[name]]
            if lost:
                failures.append(f'lost after kill {kills}: {lost}')
            if half_a_frame(out):
                failures.append(f'half a frame after kill {kills}')
            before = after
            if verb in LOCK_NO_FOLDER:
                age_parts(out)
            strays += out.exists() and any(name.endswith('.part') for name in files_in(out))
            continue
        ends += 1
        wrong = difference(verb, out, expected) if process.returncode < 2 else errors
        if wrong:
            failures.append(f'end {ends}: {wrong}')
        shutil.rmtree(out)
        before = {}
    return report(verb, failures, f'{kills} kills, of which {strays} left a part of a file; '
                                  f'{ends} runs ended')


def main():
    arguments = arguments_of(__doc__, 200)
    folder = Folder()
    wrong = sum(kill_often(folder, verb, arguments.n) for verb in arguments.verbs)
    folder.remove()
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
