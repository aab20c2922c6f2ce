"""What the rule of a product hands its job, another process: all that the job knows."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Task:
    """The task of one job.

    product: "record/a", "summary", .... config: of the study. made_from: the params of the rule, what the product was
    planned to be made from. folder: in which the files lie that the rule declares, as the study names them; on another
    machine they are copies. log: from the folder of the study. products: those over all records that a summary
    shows. by_name: see `rocking.study.plan.Plan`. cores: that its kernels may use.
    """

    product: str
    config: Mapping[str, Any]
    made_from: Sequence[str]
    folder: str = ""
    log: str = "log"
    products: Sequence[str] = ()
    by_name: bool = False
    cores: int = 1


def folder_of(copy: str, named: str) -> str:
    """Return the folder in which `copy` is the file that the study calls `named`: "" where it is no copy."""
    own, name = Path(copy).parts, Path(named).parts
    if own[len(own) - len(name) :] != name:
        raise ValueError(f"{copy} is no copy of {named}")
    return str(Path(*own[: len(own) - len(name)])) if own != name else ""
