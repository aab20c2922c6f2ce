"""What numba compiled, kept from one checkout to the next by the hash of the kernels.

numba itself keeps it in __pycache__ beside each kernel, by the content of that file alone: it does not see that a
function which the kernel takes from another file has changed.
"""

import contextlib
import fcntl
import hashlib
import os
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

PACKAGE = Path(__file__).parents[1] / "rocking"
KEPT = Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache").expanduser() / "rocking-kernels"
MOST_KEPT = 8
_COMPILES = re.compile(r"^from (numba|rocking\.motion\.runs) import", re.M)


def fetch() -> None:
    """Bring what was compiled of the same kernels into the package, or compile it, once for all workers."""
    newest = max(path.stat().st_mtime for path in sources())
    if any(path.stat().st_mtime < newest for path in _compiled(PACKAGE)):
        _remove(PACKAGE)
    with contextlib.suppress(OSError), _kept() as kept:  # a home may lack or be closed
        if len(_compiled(kept)) > len(_compiled(PACKAGE)):
            _remove(PACKAGE)
            copy(kept, PACKAGE)
    if not _compiled(PACKAGE):
        from rocking.assessment.compilation import compile_all  # which loads every kernel

        compile_all()


def keep() -> None:
    """Keep what was compiled, where it is more than was kept before."""
    with contextlib.suppress(OSError), _kept() as kept:
        if len(_compiled(PACKAGE)) > len(_compiled(kept)):
            _remove(kept)
            copy(PACKAGE, kept)


@contextlib.contextmanager
def _kept() -> Iterator[Path]:
    """The folder of these kernels, while no other run reads or writes it."""
    import numba

    digest = hashlib.sha256(numba.__version__.encode())
    for path in sources():
        digest.update(path.read_bytes())
    KEPT.mkdir(parents=True, exist_ok=True)
    with (KEPT / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield KEPT / digest.hexdigest()[:16]
        folders = sorted(filter(Path.is_dir, KEPT.iterdir()), key=lambda path: path.stat().st_mtime)
        for outdated in folders[:-MOST_KEPT]:
            shutil.rmtree(outdated)


def sources() -> list[Path]:
    return [
        path for path in sorted(PACKAGE.rglob("*.py")) if _COMPILES.search(path.read_text(encoding="utf-8"))
    ]


def _compiled(folder: Path) -> list[Path]:
    """What numba wrote below a folder, and the stamps of what is compiled."""
    return sorted(
        path for path in folder.rglob("__pycache__/*") if path.suffix in {".nbi", ".nbc", ".compiled"}
    )


def _remove(folder: Path) -> None:
    for path in _compiled(folder):
        path.unlink()


def copy(source: Path, target: Path) -> None:
    """Copy what was compiled of the same kernels."""
    for path in _compiled(source):
        to = Path(target, path.relative_to(source))
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, to)
