#!/usr/bin/env python3
"""Gives the program too little memory: a random limit of its address space (ulimit -v).

    scripts/faults/memory.py [VERB ...] [-n 20]

It must not crash: exit code 2 or 4 and one line of error, or done, perhaps with images that failed
for want of memory. A resumed run with enough memory must end with an undisturbed run's files.
"""
import random
import resource
import shutil
import sys

from verbs import PROGRAM, Folder, arguments_of, difference, is_one_error_line, report

MIB = 1 << 20


def peak_mib(folder, call):
    """The least limit in MiB, to 16, with which the call ends well."""
    low, high = 32, 8192
    while high - low > 16:
        middle = (low + high) // 2
        out = folder.path / 'probe'
        done = run_with(folder, call(out), middle)
        shutil.rmtree(out, ignore_errors=True)
        low, high = (low, middle) if done.returncode == 0 else (middle, high)
    return high


def run_with(folder, call, mib):
    return folder.run(call, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS,
                                                                  (mib * MIB, mib * MIB)))


def starve(folder, verb, times):
    expected, _ = folder.undisturbed(verb)
    starts = peak_mib(folder, lambda out: [PROGRAM, '--version'])  # below, libraries abort
    enough = max(starts + 1, peak_mib(folder, lambda out: folder.call(verb, out)))
    failures = []
    codes = {}
    for number in range(times):
        out = folder.path / 'starved'
        mib = random.randrange(starts, enough)
        done = run_with(folder, folder.call(verb, out), mib)
        codes[done.returncode] = codes.get(done.returncode, 0) + 1
        if done.returncode not in (0, 1) and (
                done.returncode not in (2, 4) or not is_one_error_line(done.stderr)):
            failures.append(f'{number}, {mib} MiB: {done.returncode}: {done.stderr[-300:]}')
        again = folder.run(folder.call(verb, out, resume=out.exists()))
        wrong = difference(verb, out, expected) if again.returncode < 2 else again.stderr
        if wrong:
            failures.append(f'{number}, {mib} MiB: after the resumed run: {wrong}')
        shutil.rmtree(out, ignore_errors=True)
    found = ', '.join(f'{count} of code {code}' for code, count in sorted(codes.items()))
    return report(verb, failures, f'{times} limits of {starts} to {enough} MiB: {found}')


def main():
    arguments = arguments_of(__doc__, 20)
    folder = Folder()
    wrong = sum(starve(folder, verb, arguments.n) for verb in arguments.verbs)
    folder.remove()
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
