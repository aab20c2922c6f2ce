"""The largest force of a tie while the wall strikes, over what statics asks of it at rest.

Drawn walls with ties that stretch and do not break are followed as stacks of the whole wall by contact dynamics, each
under one component of another site. A wall that falls says nothing of its ties, nor does one that hardly rocks. What
pages say of the impacts of a wall (`rocking.structures.linkage.IMPACTS`) is held against this.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from docs.research.held_walls import tied_wall
from docs.research.report import Target
from docs.research.scores import Score, median, scored
from docs.research.sites import (
    SiteRecord,
    Trial,
    draw_of,
    independent,
    lifting_factor,
    one_of_each,
    sample_of,
)
from docs.research.stacks import strong_part
from rocking.contacts.dynamics import StackResponse, follow_stack
from rocking.quantities import GRAVITY
from rocking.structures.stack import STEP, Held
from rocking.tables import column, row

PEAKS = (0.3, 1.0)
"""Range of peak acceleration to which records are scaled, log-uniform, g."""
ROCKED = 2e-3
"""Turn of a course beyond which a wall has rocked, rad: a few millimetres a storey."""
WALLS = 4
"""Under each component."""


@row("ties", "One row per tie of a wall that stands: its largest force beside that which statics asks for")
class TieRow(Trial):
    """One tie."""

    height_m: float = column("Height of the tie, m")
    needed_n_m: float = column("What holds the wall there at rest, as it starts, N/m")
    largest_n_m: float = column("Largest force of the tie, N/m")

    @property
    def ratio(self) -> float:
        """The one over the other."""
        return self.largest_n_m / self.needed_n_m


def tie_forces(target: Target) -> None:
    """Write the forces of ties, and the median and eight in ten of their ratios."""
    rows: list[TieRow] = []
    for component in one_of_each(independent(target.records)):
        for place in range(WALLS):
            rows += tie_rows(component, place)
        target.tell(f"{component.identifier}: {len(rows)} ties")
    rows_of_walls: dict[tuple[str, float], list[TieRow]] = {}
    for tie in rows:
        rows_of_walls.setdefault((tie.record, tie.scale_factor), []).append(tie)
    worst = [max(own, key=lambda tie: tie.ratio) for own in rows_of_walls.values()]
    ratios = [tie.ratio for tie in worst]
    measures = {
        "median": median(ratios),
        "10 % quantile": median(ratios, 0.1),
        "90 % quantile": median(ratios, 0.9),
    }
    sample = sample_of([tie.site for tie in worst], [tie.earthquake for tie in worst])
    of = scored("largest force of a tie over that of statics", "walls that stand", measures, sample)
    target.publish("What ties carry", f"{len(worst)} walls.", {Score: list(of), TieRow: rows})


def tie_rows(component: SiteRecord, place: int) -> Iterator[TieRow]:
    """Yield the ties of one wall that something asks of; none of a wall that falls or hardly rocks."""
    draw = draw_of(component.identifier, place)
    wall = tied_wall(draw)
    multiplier = wall.static_multiplier
    factor = lifting_factor(component.accelerogram, 1.0, PEAKS, draw)
    if factor * component.accelerogram.peak_acceleration <= multiplier * GRAVITY:
        return  # nothing lifts
    motion = strong_part(component.accelerogram.scaled(factor), multiplier)
    needed = {
        restraint.height: restraint.needed
        for restraint in wall.restraints
        if restraint.kind == "tie" and restraint.needed > 0
    }
    stack = wall.stack()
    # An impact lasts for less than a step of the record: the history has every step of contact dynamics.
    step = min(STEP, stack.longest_step)
    times = np.arange(0, motion.times[-1], step)
    fine = replace(motion, acceleration=np.interp(times, motion.times, motion.acceleration), time_step=step)
    response = follow_stack(stack, fine, step, history=True)
    if response.falls or response.largest_turns.max() < ROCKED:
        return
    for held in stack.held:
        at = min(needed, key=lambda height: abs(height - held.point[1]), default=None)
        if held.tie is None or at is None or abs(at - held.point[1]) > 1e-6:
            continue
        yield TieRow(
            **component.named,
            structure="wall with ties",
            scale_factor=factor,
            height_m=at,
            needed_n_m=needed[at],
            largest_n_m=largest_force(held, stack.courses[held.course].centre, response),
        )


def largest_force(held: Held, centre: tuple[float, float], response: StackResponse) -> float:
    """Return the largest force of a tie that stretches, by how far its point moves to the right of its rest."""
    assert held.tie is not None
    assert response.places is not None
    right, _, turn = response.places[:, held.course].T
    arm_x = held.point[0] - centre[0]
    arm_z = held.point[1] - centre[1]
    moved = right + arm_x * (np.cos(turn) - 1) + arm_z * np.sin(turn)
    return held.tie.pretension + held.tie.stiffness * max(float(moved.max()), 0.0)
