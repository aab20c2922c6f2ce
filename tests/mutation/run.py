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
    "sine_pulse": [
        "tests/published/test_sine_pulse.py",
        "tests/properties/test_prediction_against_integration.py",
    ],
    "structures": ["tests/properties/test_registered_structures.py", "tests/published/test_structures.py"],
}
"""Tests of a wing besides its folder in tests/unit."""

OTHERS = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.Pow: ast.Mult, ast.Lt: ast.LtE,
    ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.And: ast.Or,
    ast.Or: ast.And,
}  # fmt: skip
"""What is written in the place of an operator."""


def mutants(tree: ast.Module) -> Iterator[tuple[ast.expr, str, object]]:
    """Every change of a module as (node, attribute, other value)."""
    for node in ast.walk(tree):
        match node:
            case ast.BinOp(op=operator) | ast.BoolOp(op=operator) if type(operator) in OTHERS:
                yield node, "op", OTHERS[type(operator)]()
            case ast.Compare(ops=[operator, *more]) if type(operator) in OTHERS:
                yield node, "ops", [OTHERS[type(operator)](), *more]
            case ast.Constant(value=number) if type(number) in (int, float):
                yield node, "value", number + 1
            case ast.UnaryOp(op=ast.Not() | ast.USub() as operator, operand=operand):
                yield node, "operand", ast.UnaryOp(operator, operand)


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
    texts = {path: path.read_text(encoding="utf-8") for path in sorted((tree / "rocking" / wing).rglob(only))}
    trees = {path: ast.parse(text) for path, text in texts.items()}
    possible = [(path, change) for path, module in trees.items() for change in mutants(module)]
    drawn = random.Random(seed).sample(possible, min(count, len(possible)))
    survivors = 0
    for path, (node, attribute, other) in drawn:
        before = getattr(node, attribute)
        setattr(node, attribute, other)
        path.write_text(ast.unparse(trees[path]), encoding="utf-8")
        if not noticed(tree, wing, path):
            survivors += 1
            print(f"{path.relative_to(tree)}:{node.lineno} survives with: {ast.unparse(node)}", flush=True)
        setattr(node, attribute, before)
        path.write_text(texts[path], encoding="utf-8")
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
