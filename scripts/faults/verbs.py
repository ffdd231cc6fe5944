"""What the scripts of this folder share: small inputs, the verbs that write folders, the judge."""
import argparse
import hashlib
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get('EDGESCOUT', str(ROOT / 'build/release/host/cli/edgescout'))
VERBS = ['detect', 'register', 'scout', 'track', 'render', 'experiments', 'model', 'merge', 'eval']
NEEDS = {'register': ['detect'], 'track': ['detect'], 'eval': ['detect'],
         'merge': ['shard_1', 'shard_2']}  # runs whose files a verb reads
CANNOT_RESUME = {'render', 'track', 'model', 'merge', 'eval'}
LOCK_NO_FOLDER = {'model', 'eval'}  # they write one file
FEW = ['--viewpoints', '1', '--in-plane-steps', '6', '--distance-min', '0.25', '--distance-max',
       '0.27', '--scan-hits', '200', '--coarse-poses', '8', '--medium-poses', '3']
SMALL = ['--width', '160', '--height', '120', '--focal', '200']


class Folder:
    """A temporary folder with rendered images, an undisturbed run of each verb, and the calls."""

    def __init__(self, where=None):
        self.path = pathlib.Path(tempfile.mkdtemp(dir=where))
        self.path.chmod(0o755)
        self.environment = dict(os.environ, XDG_CACHE_HOME=str(self.path / 'cache'))
        self.scenes = self.path / 'scenes'
        self.model = ['--model', self.scenes / 'models/obj_000001.ply', '--unit', 'mm']
        self.must_end_well(self.call('render', self.scenes))

    def remove(self):
        shutil.rmtree(self.path)

    def call(self, verb, out, resume=False):
        """The arguments of the verb. One that cannot resume is run again from its beginning."""
        detect = [self.scenes, *self.model, *FEW, '--candidates', '2', '--min-probability',
                  '0.0001', '--device', 'cpu', '--out', out]
        work = {
            'render': ['--part', 'l_bracket', '--objects', '1', '--scenes', '2', '--views', '4',
                       '--seed', '1', *SMALL, '--out', out],
            'detect': detect,
            'shard_1': [*detect, '--shard', '1/2'],
            'shard_2': [*detect, '--shard', '2/2'],
            'register': [self.scenes, *self.model, '--poses', self.path / 'detect/results.csv',
                         '--device', 'cpu', '--out', out],
            'scout': ['cell', *self.model, *FEW, '--objects', '2', '--seed', '3', *SMALL,
                      '--view-count', '6', '--max-views', '3', '--candidates', '5', '--particles',
                      '20', '--device', 'cpu', '--out', out],
            'track': [self.scenes, *self.model, '--poses', self.path / 'detect/results.csv',
                      '--no-search', '--device', 'cpu', '--out', out],
            'experiments': ['detection', '--scenes', '3', '--image-scale', '0.25', '--candidates',
                            '5', '--no-times', '--seed', '1', '--out', out],
            'model': ['build', self.model[1], '--unit', 'mm', *FEW[:8], '--device', 'cpu', '--out',
                      out / 'part.templates'],
            'merge': [self.path / 'shard_1', self.path / 'shard_2', '--out', out],
            'eval': [self.path / 'detect/results.csv', self.scenes, *self.model, '--json',
                     out / 'figures.json'],
        }[verb]
        name = {'experiments': ['bench', 'experiments'], 'shard_1': ['detect'],
                'shard_2': ['detect']}.get(verb, [verb])
        if resume and verb not in CANNOT_RESUME:
            work = work + ['--resume']
        return [PROGRAM, *name, *map(str, work)]

    def run(self, call, **more):
        return subprocess.run(call, env=self.environment, capture_output=True, text=True,
                              check=False, **more)

    def start(self, call, **more):
        return subprocess.Popen(call, env=self.environment, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True, **more)

    def must_end_well(self, call):
        start = time.monotonic()
        done = self.run(call)
        if done.returncode > 1:
            sys.exit(f'{" ".join(call)}\nended with {done.returncode}: {done.stderr}')
        return time.monotonic() - start

    def undisturbed(self, verb):
        """Runs the verb into FOLDER/VERB, once. Returns the folder and the seconds."""
        for other in NEEDS.get(verb, []):
            self.undisturbed(other)
        out = self.path / verb
        if not out.exists():
            self.must_end_well(self.call(verb, out))  # the next one finds the templates
            shutil.rmtree(out)
            self.seconds = self.must_end_well(self.call(verb, out))
        return out, self.seconds


def files_in(folder):
    return {str(file.relative_to(folder)) for file in folder.rglob('*') if file.is_file()}


def finished_files(verb, folder):
    """Checksums of the files that must outlive whatever comes, by name."""
    patterns = {'detect': ['0*.json'], 'register': ['0*.json'],
                'render': ['*/gray/*.png', '*/scene_*.json', 'models/*'],
                'experiments': ['cells/*/*.csv']}.get(verb, [])
    return {str(file.relative_to(folder)): hashlib.sha256(file.read_bytes()).hexdigest()
            for pattern in patterns for file in folder.glob(pattern)
            if not file.name.startswith('.')}


def age_parts(folder):
    """A verb that locks no folder removes parts of files when they are older than 10 seconds."""
    for part in folder.rglob('.*.part'):
        os.utime(part, (time.time() - 11,) * 2)


def half_a_frame(folder):
    """Whether a killed `track` left something else than whole rows."""
    tracks = folder / 'tracks.csv'
    return tracks.exists() and not tracks.read_text().endswith('\n')


def scout_log(folder):
    """scout.json, view files and results without what a clock says."""
    def strip(value):
        if isinstance(value, list):
            return [strip(item) for item in value]
        if isinstance(value, dict):
            return {name: strip(item) for name, item in value.items()
                    if not name.endswith('_ms') and name != 'seconds'}
        return value
    logs = [strip(json.loads(file.read_text())) for file in sorted(folder.glob('*.json'))]
    rows = [row.rsplit(',', 1)[0] for row in (folder / 'results.csv').read_text().split('\n')]
    return logs, rows


def difference(verb, folder, expected):
    """What differs between the files of two runs that ended; None: nothing but times."""
    strays = files_in(folder) ^ files_in(expected)
    if strays:
        return f'files of one run alone: {sorted(strays)}'
    if verb in ('detect', 'register', 'merge'):
        done = subprocess.run([ROOT / 'scripts/compare_batches.py', folder, expected],
                              capture_output=True, text=True, check=False)
        return done.stdout if done.returncode else None
    if verb == 'scout':
        return None if scout_log(folder) == scout_log(expected) else 'scout.json or results differ'
    times = {'summary.json'} if verb == 'track' else set()
    for name in files_in(folder) - times:
        if (folder / name).read_bytes() != (expected / name).read_bytes():
            return f'{name} differs'
    return None


def is_one_error_line(text):
    """Progress, warnings, and then one line of the error."""
    errors = [line for line in text.splitlines() if line.startswith('edgescout: error: ')]
    return len(errors) == 1


def arguments_of(description, moments):
    parser = argparse.ArgumentParser(description=description.splitlines()[0])
    parser.add_argument('verbs', nargs='*', default=VERBS, help='default: all')
    parser.add_argument('-n', type=int, default=moments, help='how often, for each verb')
    parser.add_argument('--seed', type=int, default=1)
    arguments = parser.parse_args()
    for verb in arguments.verbs:
        if verb not in VERBS:
            parser.error(f'found {verb}, expected some of {", ".join(VERBS)}')
    random.seed(arguments.seed)
    return arguments


def report(verb, failures, text):
    """Prints a line of counts and returns the number of failures."""
    print(f'{verb}: {text}; {len(failures)} failures', flush=True)
    for failure in failures[:5]:
        print(f'  {failure}')
    return len(failures)
