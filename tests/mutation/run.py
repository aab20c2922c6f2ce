"""Change one operator, comparison, number or branch of the code at a time; the tests of that wing must notice.

    python tests/mutation/run.py [WING ...] [--mutants 30] [--seed 1] [--only MODULE.py]

Works on a clone of the last commit in a temporary folder and prints each change that no test noticed. Compiled modules
are tested interpreted, on small cases. A mutant whose tests take longer than LIMIT counts as noticed.
"""

import argparse
import ast
import os
import random
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
LIMIT = 600
"""s of the clock for the tests of one mutant; the slowest wing takes half a minute on a quiet machine."""
INTERPRETED = ("motion", "sine_pulse")
BESIDE = {
    "motion": ["tests/properties/test_motion.py"],
    "pulses": ["tests/properties/test_pulses.py"],
    "records": ["tests/contracts"],
    "sine_pulse": ["tests/published/test_sine_pulse.py"],
    "structures": ["tests/properties/test_registered_structures.py", "tests/published/test_structures.py"],
}
"""Tests of a wing besides its folder in tests/unit."""

OTHERS = {
    ast.Add: "-", ast.Sub: "+", ast.Mult: "/", ast.Div: "*", ast.Pow: "*", ast.Lt: "<=", ast.LtE: "<", ast.Gt: ">=",
    ast.GtE: ">", ast.Eq: "!=", ast.NotEq: "==", ast.And: "or", ast.Or: "and",
}  # fmt: skip
"""What is written in the place of an operator."""


def mutants(source: str) -> Iterator[tuple[int, int, str]]:
    """Every change of a module as (offset, length, other text), docstrings and annotations left alone."""
    encoded = source.encode()
    starts = [0]
    for line in encoded.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))

    def between(left: ast.expr, right: ast.expr, operator: ast.AST) -> Iterator[tuple[int, int, str]]:
        begin, end = (
            starts[left.end_lineno - 1] + left.end_col_offset,
            starts[right.lineno - 1] + right.col_offset,
        )
        gap = encoded[begin:end].decode()
        word = gap.strip(" ()\n\\")
        if type(operator) in OTHERS and word and "#" not in gap:
            yield begin + gap.index(word), len(word), OTHERS[type(operator)]

    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.BinOp):
            yield from between(node.left, node.right, node.op)
        elif isinstance(node, ast.BoolOp):
            yield from between(node.values[0], node.values[1], node.op)
        elif isinstance(node, ast.Compare):
            yield from between(node.left, node.comparators[0], node.ops[0])
        elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
            begin, end = (
                starts[node.lineno - 1] + node.col_offset,
                starts[node.end_lineno - 1] + node.end_col_offset,
            )
            yield begin, end - begin, repr(node.value + 1)
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not | ast.USub):
            yield starts[node.lineno - 1] + node.col_offset, 3 if isinstance(node.op, ast.Not) else 1, ""


def tests_of(tree: Path, wing: str, module: Path | None) -> list[Path]:
    """The files of tests of a wing; those that name the module first, since most mutants end at the first failure."""
    places = [tree / "tests/unit" / wing, *(tree / each for each in BESIDE.get(wing, []))]
    files = [file for place in places for file in (place.rglob("test_*.py") if place.is_dir() else [place])]
    name = module.stem if module else ""
    return sorted(files, key=lambda file: (name not in file.read_text(encoding="utf-8"), file))


def noticed(tree: Path, wing: str, module: Path | None = None) -> bool:
    """Whether a test of the wing fails on the tree as it stands."""
    surroundings = os.environ | {"PYTHONPATH": str(tree), "NUMBA_DISABLE_JIT": str(int(wing in INTERPRETED))}
    options = ("-qx", "-p", "no:cacheprovider", "-W", "ignore::RuntimeWarning")
    command = [sys.executable, "-m", "pytest", *options, *map(str, tests_of(tree, wing, module))]
    try:
        done = subprocess.run(
            command, cwd=tree, env=surroundings, capture_output=True, timeout=LIMIT, check=False
        )
    except subprocess.TimeoutExpired:
        return True
    return done.returncode != 0


def try_wing(tree: Path, wing: str, count: int, seed: int, only: str) -> None:
    """Draw mutants of one wing, of modules that match `only`; print those that survive and how many there were."""
    if noticed(tree, wing):
        raise SystemExit(f"{wing}: its tests fail on the code as it is")
    modules = sorted((tree / "rocking" / wing).rglob(only))
    possible = [(path, change) for path in modules for change in mutants(path.read_text(encoding="utf-8"))]
    drawn = random.Random(seed).sample(possible, min(count, len(possible)))
    survivors = 0
    for path, (at, length, other) in drawn:
        whole = path.read_bytes()
        path.write_bytes(whole[:at] + other.encode() + whole[at + length :])
        if not noticed(tree, wing, path):
            survivors += 1
            line = whole[:at].count(b"\n")
            changed = path.read_text(encoding="utf-8").splitlines()[line].strip()
            print(f"{path.relative_to(tree)}:{line + 1} survives as: {changed}", flush=True)
        path.write_bytes(whole)
    print(f"{wing}: {survivors} of {len(drawn)} survive, of {len(possible)} possible", flush=True)


def main() -> None:
    """Try each wing that is named."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument(
        "wings", nargs="*", default=sorted(path.name for path in (ROOT / "tests/unit").iterdir())
    )
    parser.add_argument("--mutants", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="*.py", help="modules, such as facade.py")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "tree"
        subprocess.run(["git", "clone", "--quiet", ROOT, tree], check=True)
        for wing in options.wings:
            try_wing(tree, wing, options.mutants, options.seed, options.only)


if __name__ == "__main__":
    main()
