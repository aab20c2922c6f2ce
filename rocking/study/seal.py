"""The seal of finished results: beside the files of a job stand the size and hash of each, and what they came from.

A result counts as finished while its seal holds. A file that was cut, emptied or edited, or one that an earlier
version made, is made again by the next run.
"""

import json
from collections.abc import Iterable, Iterator
from pathlib import Path

from rocking.errors import RockingError
from rocking.study.folder import REMEMBERED
from rocking.study.hashes import ContentHashes
from rocking.study.plan import Plan
from rocking.study.results import part
from rocking.tables import read_whole, write_whole

SEAL = "seal.json"
"""The name of a seal."""
TRADE_SEAL = "trade_seal.json"
"""The name of the seal of the trade, which stands in the folder of the summary."""
_UNSEALED = ("timings.csv",)
"""The tables of a run about itself; they differ from run to run."""
_LARGEST = 100_000_000
"""Bytes of a seal that are read; a record with its report takes about two thousand."""
_HASHES = REMEMBERED / "rocking_results.json"
"""Beside what snakemake remembers of a study; it may be removed at any time."""


def write_seal(path: Path, made_from: str, files: Iterable[Path], results: Path) -> None:
    """Seal `files`, of which those that do not stand are left out, at `path`; names are seen from the `results`."""
    hashes = ContentHashes()
    sealed = {
        file.relative_to(results).as_posix(): [file.stat().st_size, hashes.of(file)]
        for file in sorted(set(files))
        if file.is_file() and file.name not in (SEAL, TRADE_SEAL, *_UNSEALED)
    }
    content = {"made_from": made_from, "files": sealed}
    write_whole(path, (json.dumps(content, indent=1) + "\n").encode())


def beside(outputs: Iterable[str]) -> list[Path]:
    """Return the `outputs` of a job with the tables that stand beside the report of each of its records."""
    files = [Path(output) for output in outputs]
    tables = (table for file in files if file.name == "report.pdf" for table in file.parent.glob("*.csv"))
    return [*files, *tables]


def remove_broken_seals(plan: Plan) -> Iterator[str]:
    """Remove each seal that does not hold, so that what it stood for is made again; yield a sentence for each."""
    results = Path(plan.settings.results)
    seals = {part(results, job) / SEAL: plan.made_from(job) for job in plan.jobs}
    seals[results / "summary" / SEAL] = plan.summary_made_from
    hashes = ContentHashes(_HASHES)
    fragility, trade = results / "fragility" / SEAL, results / "summary" / TRADE_SEAL
    seals |= {fragility: plan.fragility_made_from, trade: plan.trade_made_from}
    by_hand = {}
    if not plan.settings.fragility.in_every_run:
        by_hand[fragility] = "snakemake fragility makes it again"
    if not plan.settings.trade.in_summary:
        by_hand[trade] = "snakemake trade makes it again"
    for path, made_from in seals.items():
        if path.exists() and (why := _why_broken(path, made_from, results, hashes)):
            path.unlink()
            yield f"{why}; {by_hand.get(path, 'it is made again')}."
    hashes.save()


def sealed_origin(path: Path) -> str:
    """Return the hash of what the files of a seal were made from; "" where the seal cannot be read."""
    try:
        return str(json.loads(read_whole(path, _LARGEST, RockingError))["made_from"])
    except (RockingError, ValueError, KeyError, TypeError, RecursionError):
        return ""


def _why_broken(path: Path, made_from: str, results: Path, hashes: ContentHashes) -> str:
    """Return a sentence on what is not as it was sealed, or of another origin; "" where the seal holds."""
    try:
        content = json.loads(read_whole(path, _LARGEST, RockingError))
        sealed = dict(content["files"])
        for name, (size, sha256) in sealed.items():
            file = results / name
            if not file.is_file() or file.stat().st_size != size or hashes.of(file) != sha256:
                return f"{file} is not as it was written"
        # What snakemake remembers tells it another origin; a dry run then leaves the seal as it is.
        if content["made_from"] == made_from or any((REMEMBERED / "metadata").glob("*")):
            return ""
        return f"{path.parent} was made from something else"
    except (RockingError, OSError, ValueError, KeyError, TypeError, RecursionError):
        return f"{path} cannot be read"
