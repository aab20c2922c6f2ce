"""Compile the search for pulses, the closed form and the integration once, saying how long it takes."""

import sys
from pathlib import Path

from rocking.assessment.compilation import compile_all

said: list[str] = []


def say(line: str) -> None:
    """On the terminal, which sees it while it happens, and in the log."""
    print(line, file=sys.stderr, flush=True)
    said.append(line)


compile_all(say)
Path(snakemake.log[0]).write_text("\n".join([*said, "compiled"]) + "\n", encoding="utf-8")
