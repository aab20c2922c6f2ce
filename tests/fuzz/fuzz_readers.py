"""Coverage-guided fuzzing of one reader: anything but accelerograms or RecordError is a finding.

    python tests/fuzz/fuzz_readers.py "PEER AT2" -max_total_time=600 [CORPUS_FOLDER]

With ROCKING_RECORDS set, files of that folder which the reader recognises seed the corpus, cut to their first 6 kB with
the declared counts left as they are; a mutator that edits numbers keeps most inputs close to the format.
"""

import contextlib
import os
import random
import re
import sys
import tempfile
from pathlib import Path

import atheris

with atheris.instrument_imports(include=["rocking.records"]):
    from rocking.errors import RecordError
    from rocking.records.formats import FORMATS, Options
    from rocking.records.read import read_content

_SEED_BYTES = 6000
_NUMBER = re.compile(rb"[-+]?\d[\d.]*")
_OPTIONS = (Options(), Options(unit="g"), Options(unit="g", time_step=0.01))


def reads_or_refuses(form, content: bytes) -> None:
    """Read `content` with one reader, and through the front door."""
    for options in _OPTIONS:
        for reader in (form, None):
            with contextlib.suppress(RecordError):
                read_content(content, "fuzzed", options, reader=reader)


def mutate(data: bytes, largest: int, seed: int) -> bytes:
    """Edit one number half of the time, else leave the work to libFuzzer."""
    dice = random.Random(seed)
    numbers = list(_NUMBER.finditer(data))
    if dice.random() < 0.5 or not numbers:
        return atheris.Mutate(data, largest)
    found = dice.choice(numbers[:40] if dice.random() < 0.7 else numbers)
    new = dice.choice((b"0", b"1", b"2", b"7", b"-1", b"1e9", b"nan", b"", b"1_0", b"99999999999"))
    return (data[: found.start()] + new + data[found.end() :])[:largest]


def seeds(form, folder: str | None) -> Path:
    """Return a new folder with the heads of the real files that `form` recognises."""
    corpus = Path(tempfile.mkdtemp(prefix="rocking-fuzz-"))
    for i, path in enumerate(sorted(Path(folder).rglob("*")) if folder else ()):
        if path.is_file() and form.recognise(content := path.read_bytes()):
            (corpus / f"seed{i}").write_bytes(content[:_SEED_BYTES])
    return corpus


def main() -> None:
    """Fuzz the reader named first on the command line."""
    names = {form.name: form for form in FORMATS}
    if len(sys.argv) < 2 or sys.argv[1] not in names:
        raise SystemExit(f"name a reader: {', '.join(names)}")
    form = names[sys.argv.pop(1)]
    arguments = [
        *sys.argv,
        str(seeds(form, os.environ.get("ROCKING_RECORDS"))),
        "-timeout=2",
        "-rss_limit_mb=2048",
    ]
    atheris.Setup(arguments, lambda data: reads_or_refuses(form, data), custom_mutator=mutate)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
