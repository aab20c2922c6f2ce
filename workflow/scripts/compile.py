"""Compile the pulses and the closed form in one process and the integration in another, with a short record."""

from multiprocessing import Process
from pathlib import Path

import numpy as np

from rocking.assessment.assess import assess_structures, predict
from rocking.motion import Members, integrate, integrate_members
from rocking.pulses import extract_pulses
from rocking.records import Accelerogram
from rocking.structures import Block

RECORD = Accelerogram(5 * np.sin(np.arange(1000) * 0.06), 0.01)
BLOCK = Block(2.0, 0.2)


def pulses() -> None:
    """Nothing here integrates."""
    predict(BLOCK.mechanism(), extract_pulses(RECORD).ranked[:1])


def motion() -> None:
    """Nothing here asks for a pulse."""
    for structure in (BLOCK, BLOCK.mechanism().equivalent_block()):
        integrate(structure, RECORD)
    integrate_members(BLOCK, RECORD, Members([1.0]))


if __name__ == "__main__":
    beside = Process(target=pulses)
    beside.start()
    motion()
    beside.join()
    found = assess_structures(RECORD, {"block": BLOCK})  # what is left, and what failed above fails here
    Path(snakemake.log[0]).write_text(f"compiled; {len(found.cases)} case followed\n", encoding="utf-8")
