"""Change one operator, comparison, number or branch of the code at a time; some test must notice.

    python tests/mutation/run.py --calls FOLDER [--mutants 160] [--seed 1] [--only motion/table.py] [--line 200 ...]

The first run into a FOLDER runs the quick tests and notes there which functions each of them calls. Each mutant is
tried in a copy of its own, by the tests that call what it changes, those of its wing first. How many a wing has is in
proportion to its lines; the compiled kernels count as a wing. How wide the lines of a figure are is not changed.
"""

import argparse
import ast
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).parents[2]
IGNORED = shutil.ignore_patterns(".git", ".venv", ".hypothesis", ".*_cache", "results", "benchmarks")
"""Not other files that begin with a dot: a test reads .snakemake-workflow-catalog.yml."""
MOST_SECONDS = 240.0
"""Of the tests of one mutant, in seconds of the code as it is; the others are left out, and it is said."""
KERNELS = ("linear_kernel", "nonlinear_kernel", "stack_kernel", "kernel", "scan")
LOOKS = {
    "alpha", "dpi", "fontsize", "hspace", "labelpad", "linewidth", "linewidths", "markeredgewidth", "markersize",
    "mutation_scale", "pad", "size", "wspace", "zorder",
}  # fmt: skip
OTHERS = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.Pow: ast.Mult, ast.Lt: ast.LtE,
    ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.And: ast.Or,
    ast.Or: ast.And,
}  # fmt: skip
"""What is written in the place of an operator."""

Calls = dict[str, tuple[float, list[list]]]
"""Of each test its seconds and the functions it calls, as [module, first line]."""
Change = tuple[ast.AST, str, object, int]
"""Node, attribute, its other value, and the first line of the function around it or 0."""


def changes(node: ast.AST, line: int = 0) -> Iterator[Change]:
    """Every change of what stands in `node`, itself in the function that begins at `line`, or in none."""
    match node:
        case ast.BinOp(op=operator) | ast.BoolOp(op=operator) if type(operator) in OTHERS:
            yield node, "op", OTHERS[type(operator)](), line
        case ast.Compare(ops=[operator, *more]) if type(operator) in OTHERS:
            yield node, "ops", [OTHERS[type(operator)](), *more], line
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            yield node, "value", 1.3 * number if isinstance(number, float) and number else number + 1, line
        case ast.UnaryOp(op=ast.Not() | ast.USub() as operator, operand=operand):
            yield node, "operand", ast.UnaryOp(operator, operand), line
        case ast.If(test=ast.Name(id="TYPE_CHECKING")):
            return
        case ast.If(test=test) | ast.IfExp(test=test):
            yield node, "test", ast.UnaryOp(ast.Not(), test), line
        case ast.keyword(arg=name) if name in LOOKS:
            return
        case ast.Dict(keys=keys) if any(isinstance(key, ast.Constant) and key.value in LOOKS for key in keys):
            return
    body = node.body if isinstance(node, ast.FunctionDef) else []
    for child in ast.iter_child_nodes(node):
        inside = child in body
        yield from changes(
            child, min(each.lineno for each in (node, *node.decorator_list)) if inside else line
        )


def wing(module: str) -> str:
    """The folder of a module such as motion/table.py."""
    return "kernels" if Path(module).stem in KERNELS else module.split("/")[0] if "/" in module else "base"


def drawn(texts: dict[str, str], count: int, seed: int, only: str, lines: list[int]) -> list[tuple[str, int]]:
    """Changes of the modules whose name holds `only`, on `lines` if there are any: module and place among its own."""
    possible: dict[str, list[tuple[str, int]]] = {}
    size: Counter[str] = Counter()
    for module in (each for each in texts if only in each):
        size[wing(module)] += texts[module].count("\n")
        for place, (node, *_) in enumerate(changes(ast.parse(texts[module]))):
            if not lines or node.lineno in lines:
                possible.setdefault(wing(module), []).append((module, place))
    choice = random.Random(seed)
    shares = {name: min(round(count * size[name] / size.total()), len(possible[name])) for name in possible}
    return [each for name, every in possible.items() for each in choice.sample(every, shares[name])]


def reaching(texts: dict[str, str], module: str, node: ast.AST, line: int, calls: Calls) -> dict[str, float]:
    """The tests that call what is changed and their seconds, those of its wing first.

    Outside of functions, in kernels, and where no test calls the function in its own process: the tests that call
    anything of its module or of the modules which hold the name of what is changed.
    """
    chosen = {test for test, (_, functions) in calls.items() if line and [module, line] in functions}
    if not chosen:
        around = next(each for each in ast.parse(texts[module]).body if node.lineno <= (each.end_lineno or 0))
        names = {
            each.id for each in ast.walk(around) if isinstance(each, ast.Name) and type(each.ctx) is ast.Store
        }
        names = {around.name} if hasattr(around, "name") else names
        names |= {Path(module).stem} if wing(module) == "kernels" else set()
        callers = {each for each in texts if each == module or any(name in texts[each] for name in names)}
        chosen = {test for test, (_, functions) in calls.items() if callers & {name for name, _ in functions}}
    files: Counter[str] = Counter()
    for test in chosen:
        files[test.split("::")[0]] += calls[test][0]

    def place(test: str) -> tuple:
        file = test.split("::")[0]
        return f"/{module.split('/')[0]}/" not in file, files[file], file, calls[test][0]

    return {test: calls[test][0] for test in sorted(chosen, key=place)}


def fate(tree: Path, texts: dict[str, str], module: str, place: int, calls: Calls) -> str:
    """What became of a mutant, in a line."""
    mutant = ast.parse(texts[module])
    node, attribute, other, line = list(changes(mutant))[place]
    before = ast.unparse(node).split("\n")[0]
    setattr(node, attribute, other)
    after = ast.unparse(node).split("\n")[0]
    tests = reaching(texts, module, node, line, calls)
    seconds, chosen = 0.0, {}
    for test, duration in tests.items():
        if seconds + duration < MOST_SECONDS:
            seconds += duration
            chosen[test] = duration
    with tempfile.TemporaryDirectory() as folder:
        own = Path(shutil.copytree(tree, Path(folder) / "tree"))
        (own / "rocking" / module).write_text(ast.unparse(mutant), encoding="utf-8")
        if "njit" in texts[module]:
            for index in own.glob("rocking/*/__pycache__/*.nbi"):  # what others compiled of it would be used
                index.unlink()
        outcome = "killed" if chosen and pytest(own, chosen) else "SURVIVES"
    of = f"{len(chosen)} of {len(tests)} tests"
    return f"{outcome:8} {wing(module)} rocking/{module}:{node.lineno} `{before}` as `{after}`, {of}"


def pytest(tree: Path, tests: dict[str, float] | None = None, calls: Path | None = None) -> str:
    """Run tests on a tree, or all that are quick and note what they call; return what failed, if something did."""
    surroundings = os.environ | {
        "PYTHONPATH": f"{tree}:{tree}/tests/mutation",
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    options = ["-p", "calls", "-q", "-x", "--tb=no"]
    if calls:
        calls.mkdir()
        surroundings |= {"MUTATION_CALLS": str(calls)}
        surroundings.pop("PYTHONDONTWRITEBYTECODE")
        options += ["-n", "logical", "--dist", "loadfile", "--ignore", "tests/contracts/test_recipes.py"]
    else:
        (tree / "chosen.json").write_text(json.dumps(tests), encoding="utf-8")
        surroundings |= {"MUTATION_TESTS": str(tree / "chosen.json")}
        options += dict.fromkeys(test.split("::")[0] for test in tests or {})
    command = [sys.executable, "-m", "pytest", *options]
    done = subprocess.run(command, cwd=tree, env=surroundings, capture_output=True, text=True, check=False)
    return done.stdout + done.stderr if done.returncode else ""


def main() -> None:
    """Draw mutants and print what became of each, and how many survive in each wing."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--calls", type=Path, required=True)
    parser.add_argument("--mutants", type=int, default=160)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="part of the names of modules, such as facade.py")
    parser.add_argument("--line", type=int, nargs="*", default=[])
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(options.jobs) as pool:
        tree = Path(folder) / "tree"
        shutil.copytree(ROOT, tree, ignore=IGNORED)
        if not options.calls.exists() and (failure := pytest(tree, calls=options.calls.absolute())):
            raise SystemExit(f"The tests fail on the code as it is:\n{failure}")
        calls = {
            k: v for file in options.calls.glob("*.json") for k, v in json.loads(file.read_text()).items()
        }
        package = tree / "rocking"
        texts = {str(path.relative_to(package)): path.read_text() for path in sorted(package.rglob("*.py"))}
        mutants = drawn(texts, options.mutants, options.seed, options.only, options.line)
        outcomes: Counter[tuple[str, str]] = Counter()
        for line in pool.map(lambda mutant: fate(tree, texts, *mutant, calls), mutants):
            print(line, flush=True)
            outcomes[line.split()[1], line.split()[0]] += 1
    for (name, outcome), count in sorted(outcomes.items()):
        print(f"{name:12} {outcome:8} {count:4}")


if __name__ == "__main__":
    main()
