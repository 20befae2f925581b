"""What the commands that draw many comparisons share, ./dev accuracy and ./dev report: maps, options, time left, the end."""

import argparse
import pathlib
import sys
import time

import batch
import bright_map
import metrics

# Made up, with the contrast of the thesis' map.
SYNTHETIC = "synthetic"


class Problem(Exception):
    """One sentence for the user."""


class Parser(argparse.ArgumentParser):
    """Options of `./dev NAME`; what is wrong with them is a Problem."""

    def __init__(self, name):
        super().__init__(prog=f"./dev {name}", add_help=False, allow_abbrev=False)

    def error(self, message):
        raise Problem(f"{message}; {self.prog} --help lists the options")

    def add_common(self):
        """Maps, sizes, samples, where results go; --check only looks at the options."""
        self.add_argument("--quick", action="store_true")
        self.add_argument("--maps", type=path_list, default=[])
        self.add_argument("--size", type=whole_number(8, 2048))
        self.add_argument("--samples", type=whole_number(2, 1 << 20))
        self.add_argument("--timing-rounds", type=whole_number(1, 10000))
        self.add_argument("--json", type=pathlib.Path)
        self.add_argument("--out", type=pathlib.Path)
        self.add_argument("--check", action="store_true")


def path_list(text):
    return [pathlib.Path(name) for name in text.split(",") if name]


def whole_number(low, high):
    def convert(text):
        if not text.isdecimal() or not low <= int(text) <= high:
            raise argparse.ArgumentTypeError(f"must be a whole number from {low} to {high}, not {text}")
        return int(text)

    return convert


def own_maps(work):
    """{name: path} of the repository's maps and of the made-up one, which is kept below `work`."""
    return {
        "hall": batch.ROOT / "demo/environments/hall.exr",
        "sunset": batch.ROOT / "demo/environments/sunset.exr",
        "forest": batch.ROOT / "tests/data/forest.exr",
        SYNTHETIC: work / f"synthetic-{bright_map.version()}.exr",
    }


def check_files(options, maps):
    """Raises Problem where a file of --maps or the folder of --json is not there, or a name is taken."""
    for path in options.maps:
        if not path.is_file():
            raise Problem(f"{path}: there is no such map")
        if path.stem in maps or sum(other.stem == path.stem for other in options.maps) > 1:
            raise Problem(f"{path}: another map has the name {path.stem}")
    if options.json and not options.json.absolute().parent.is_dir():
        raise Problem(f"{options.json}: its folder does not exist")


def prepare_maps(options, maps, work):
    """Makes `work` and the made-up map where they are missing; ({name: path} of all maps, {name: key}), see batch.case_key."""
    work.mkdir(parents=True, exist_ok=True)
    if not maps[SYNTHETIC].exists():
        bright_map.write(maps[SYNTHETIC])
    paths = {**maps, **{path.stem: path.absolute() for path in options.maps}}
    sources = batch.source_key()
    return paths, {name: batch.case_key(sources, path) for name, path in paths.items()}


class Progress:
    """Says how far a run is; `weights` are what its cases usually take, in any unit."""

    def __init__(self, weights):
        self.count, self.done = len(weights), 0
        self.weight, self.done_weight = sum(weights), 0.0
        self.started = time.monotonic()

    def seconds(self):
        """Since the run began."""
        return time.monotonic() - self.started

    def step(self, weight, title, said):
        """One line on stderr: a case of this weight is done."""
        self.done += 1
        self.done_weight += weight
        seconds = self.seconds() * (self.weight / self.done_weight - 1.0)
        left = f"{seconds / 60:.0f} min left" if seconds >= 90 else f"{seconds:.0f} s left"
        print(f"[{self.done}/{self.count}] {title}: {said}; {left}", file=sys.stderr, flush=True)


def main(name, read_options, run):
    """The command: problems become one sentence and exit status 1, an interrupted run says how to go on."""
    try:
        options = read_options(sys.argv[1:])
        if not options.check:
            run(options)
    except (Problem, ValueError, OSError, metrics.MetricError) as problem:
        sys.exit(f"{name}: {str(problem).rstrip('.')}.")
    except KeyboardInterrupt:
        sys.exit(f"{name}: stopped; the same command goes on from here.")
