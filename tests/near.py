"""Print the test files that import what has changed since a commit: `python -m tests.near [COMMIT]` (default: HEAD).

Where few files of tests import a changed module, those that import what imports it are printed too, and so on. A file
of another kind, such as a template, counts as the modules of its folder and below that name it, or as all of them.
"""

import subprocess
import sys
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from tests.contracts.test_imports import HOMES, MODULES, PACKAGE, imported, names_in, owner

ROOT = PACKAGE.parent
FEW = 4
"""Files of tests below which those of what imports a module count as well."""
NAMES = {path: module for module, path in MODULES.items()}


def changed_since(commit: str) -> list[Path]:
    """The files that differ from a commit, new ones among them."""
    commands = ("diff", "--name-only", commit), ("ls-files", "--others", "--exclude-standard")
    texts = (subprocess.check_output(("git", *command), cwd=ROOT, text=True) for command in commands)
    return [ROOT / line for text in texts for line in text.splitlines()]


def modules_of(path: Path) -> set[str]:
    """The modules of the package that a changed file counts as."""
    if path in NAMES or path.suffix == ".py" or not path.is_relative_to(PACKAGE):
        return {NAMES[path]} if path in NAMES else set()
    within = {module: other for other, module in NAMES.items() if other.is_relative_to(path.parent)}
    naming = {module for module, other in within.items() if path.name in other.read_text(encoding="utf-8")}
    return naming or set(within)


@cache
def home(name: str) -> str:
    """The module in which an imported name is defined, also where a package hands it on."""
    name = HOMES.get(name, name)
    package, _, last = name.rpartition(".")
    handed_on = names_in(MODULES[package]) if package in MODULES and name not in MODULES else frozenset()
    behind = next((other for other in handed_on if other != name and other.endswith(f".{last}")), None)
    return home(behind) if behind else owner(name)


def near(changed: Iterable[Path]) -> set[Path]:
    """The test files that changed, and those that import what did."""
    tests = {path: set(map(home, names_in(path))) for path in (ROOT / "tests").rglob("test_*.py")}
    found = {path for path in changed if path in tests}
    for path in changed:
        wanted = modules_of(path)
        nearest: set[Path] = set()
        while len(nearest) < FEW:
            nearest = {test for test, names in tests.items() if names & wanted}
            more = wanted | {module for module in MODULES if imported(module) & wanted}
            if more == wanted:
                break
            wanted = more
        if wanted and not nearest:  # what a registry loads by its name
            part = path.relative_to(PACKAGE).parts[0]
            nearest = {
                test
                for test, names in tests.items()
                if any(name.startswith(f"rocking.{part}.") for name in names)
            }
        found |= nearest
    return found


if __name__ == "__main__":
    print(*sorted(path.relative_to(ROOT) for path in near(changed_since(*(sys.argv[1:] or ["HEAD"])))))
