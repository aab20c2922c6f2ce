"""Speed and error of the integration beside scipy's DOP853 with events, in one run. Run it as a script.

Prints times, ratios and exponents; nothing is asserted.
"""

import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from numba import njit
from scipy.constants import g
from scipy.integrate import solve_ivp

from rocking.motion import integrate, integrate_batch
from rocking.motion import nonlinear_kernel as kernel
from rocking.motion.forcing import forcing_of
from rocking.motion.spectrum import rocking_spectrum
from rocking.motion.table import table_of
from rocking.records.accelerogram import Accelerogram
from rocking.structures import Arch, Block, Facade, load_structures
from rocking.structures.mechanism import EquivalentBlock, Mechanism

STEP = 0.005
STRUCTURES = Path(__file__).parents[2] / "workflow" / "structures.yaml"


def record(
    seconds: float, strength: float, seed: int = 1, step: float = STEP, period: float = 0.4
) -> Accelerogram:
    """Stationary noise of about this period, peak `strength` [m/s²], tapered over a second at its ends."""
    count = round(seconds / step)
    shape = np.hanning(max(round(period / step), 3))
    samples = np.convolve(np.random.default_rng(seed).normal(size=count + shape.size), shape, "same")[:count]
    times = np.arange(count) * step
    samples *= np.clip(times, 0, 1) * np.clip(times[-1] - times, 0, 1)
    return Accelerogram(samples * strength / np.abs(samples).max(), step)


def best(call: Callable[[], object], repeats: int = 15) -> float:
    """Shortest of several runs, s, after one that warms up."""
    call()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def scipy_peak(structure: Mechanism | EquivalentBlock, motion: Accelerogram, tolerance: float) -> float:
    """Largest φ/φ_cr by DOP853, restarted at every sample while it rocks, landings by its own event location."""
    acceleration = scipy_equation(structure)
    ground, step, lift = motion.acceleration, motion.time_step, structure.uplift_multiplier * g
    eta, critical = structure.restitution, structure.critical_rotation
    side, y, peak = 0, np.zeros(2), 0.0

    def landing(t, state):
        return state[0] if t > started else 1.0

    def crest(t, state):
        return state[1]

    landing.terminal, landing.direction, crest.direction = True, -1, -1
    for i in range(ground.size - 1):
        t, slope = 0.0, (ground[i + 1] - ground[i]) / step
        while t < step:
            if side == 0:
                if abs(ground[i + 1]) <= lift:
                    break
                t = max(t, min(step, (lift * np.sign(ground[i + 1]) - ground[i]) / slope)) if slope else t
                side, y = -int(np.sign(ground[i + 1])), np.zeros(2)
            started = t
            out = solve_ivp(
                lambda time, state, i=i, slope=slope, s=side: acceleration(s, state, ground[i] + slope * time),
                (t, step), y, "DOP853", events=(landing, crest), rtol=tolerance, atol=1e-3 * tolerance * critical,
            )  # fmt: skip
            t, y = out.t[-1], out.y[:, -1]
            peak = max([peak, *(state[0] for state in out.y_events[1])])
            if y[0] > 5 * critical:
                return np.inf
            if out.t_events[0].size:
                y, side = np.array([0.0, -eta * y[1]]), -side
                if y[1] < 1e-5 * critical:
                    side = 0
    return peak / critical


def scipy_equation(structure: Mechanism | EquivalentBlock) -> Callable:
    """(φ', φ'') with the functions of the structure bound as local names, as a careful user would write it."""
    if isinstance(structure, EquivalentBlock):
        square, critical = structure.frequency_parameter**2, structure.critical_rotation
        scale = structure.acceleration_scale / g
        return lambda s, y, a: (y[1], square * (y[0] - critical - s * scale * a))
    side = structure.positive
    inertia, slope, gravity, ground = side.inertia, side.inertia_slope, side.gravity, side.ground

    def equation(s, y, a):
        push = -s * ground(y[0]) * a - gravity(y[0]) * g - slope(y[0]) / 2 * y[1] ** 2
        return y[1], float(push / inertia(y[0]))

    return equation


def lively(structure: Mechanism | EquivalentBlock, seconds: float = 40) -> Accelerogram:
    """The strongest of some records under which the structure stands (ten seconds: a thousand times over)."""
    for strength in (3.0, 2.5, 2.2, 2.0, 1.8, 1.6, 1.5, 1.4, 1.3, 1.2, 1.1):
        motion = record(seconds, strength * g * structure.uplift_multiplier, period=0.3)
        rounds = Accelerogram(np.tile(motion.acceleration, 1000 if seconds == 10 else 1), STEP)
        if integrate(structure, rounds).outcome == "rocks":
            return motion
    raise RuntimeError("no record found under which the structure stands")


def beside_scipy() -> None:
    """One response, its error against a run at 1e-13, and the same by scipy with its own error."""
    block, arch = (
        Block(3.0, 0.2, restitution=0.9).mechanism(),
        Arch(20.0, 2.4, np.pi, restitution=0.9).mechanism(),
    )
    print("40 s, 200 Hz record | this package | DOP853 with events | ratio of times")
    for name, structure in (("block", block), ("arch", arch), ("equivalent block", block.equivalent_block())):
        motion = lively(structure)
        truth = integrate(structure, motion, 1e-13).rotation_ratio
        found = integrate(structure, motion)
        ours = best(lambda structure=structure, motion=motion: integrate(structure, motion))
        error = abs(found.rotation_ratio / truth - 1)
        print(f"  {name}: {found.rotation_ratio:.6f}, {found.steps} steps, {found.impacts} impacts")
        print(f"    here {ours * 1e3:.3f} ms, error {error:.0e}")
        seconds = 4 if name == "arch" else 40
        short = lively(structure, seconds)
        # Two seconds of still ground, in which scipy's loop also reaches the last peak.
        short = Accelerogram(np.append(short.acceleration, np.zeros(round(2 / STEP))), STEP)
        reference = integrate(structure, short, 1e-13).rotation_ratio
        here = best(lambda structure=structure, short=short: integrate(structure, short))
        for tolerance in (1e-6, 1e-8):
            start = time.perf_counter()
            there = scipy_peak(structure, short, tolerance)
            taken = time.perf_counter() - start
            print(
                f"    DOP853 at {tolerance:g} over {seconds} s: {taken:.2f} s, error {abs(there / reference - 1):.0e}, "
                f"{taken / here:,.0f} times the {here * 1e3:.3f} ms here"
            )


def growth() -> None:
    """Exponent of cost against samples (the same ten seconds over and over) and against structures."""
    block = Block(3.0, 0.2, restitution=0.9).mechanism()
    repeats = np.array([1, 10, 100, 1000])
    counts = repeats * 2000
    for name, structure in (("mechanism", block), ("equivalent block", block.equivalent_block())):
        seconds = lively(structure, 10).acceleration
        motions = [Accelerogram(np.tile(seconds, n), STEP) for n in repeats]
        standing = all(integrate(structure, motion).outcome == "rocks" for motion in motions)
        taken = [best(lambda s=structure, m=motion: integrate(s, m), 5) for motion in motions]
        exponent = np.polyfit(np.log(counts), np.log(taken), 1)[0]
        print(
            f"cost ~ samples^{exponent:.3f} ({name}, {counts[0]} to {counts[-1]}, stands: {standing}), "
            f"{taken[0] / counts[0] * 1e9:.0f} to {taken[-1] / counts[-1] * 1e9:.0f} ns a sample"
        )
    motion = lively(block, 4)
    counts, taken = np.array([100, 1000, 10_000, 100_000]), []
    for count in counts:
        many = [block] * count
        taken.append(best(lambda many=many: integrate_batch(many, motion), 3 if count < 1e5 else 1))
    exponent = np.polyfit(np.log(counts), np.log(taken), 1)[0]
    print(f"cost ~ structures^{exponent:.3f}")


@njit(error_model="numpy", fastmath={"contract"})
def _bare(pieces, grid, ground, time_step, arc, speed, steps):
    """The arithmetic of `steps` steps and nothing else: table, short series, new state."""
    i = 0
    for _ in range(steps):
        i = i + 1 if i + 2 < ground.size else 0
        slope = (ground[i + 1] - ground[i]) / time_step
        j, centre, _ = kernel._place(grid, 0, arc)
        x = kernel._short_series(
            pieces, 0, j, arc - centre, speed, ground[i], slope, 9.80665, 0.0, None, None, 1
        )
        x = (x[0], x[1], x[2], x[3], x[4], x[5], 0.0, 0.0)
        new, pull = arc + kernel._displacement(x, time_step), kernel._speed(x, time_step)
        arc, speed = (
            arc + 1e-9 * (new - arc),
            speed + 1e-9 * (pull - speed),
        )  # keeps the chain, not the growth
    return arc + speed


def share_of_the_limit() -> None:
    """Time of the bare arithmetic over the time of the whole run: what events, control and peaks leave."""
    block = Block(3.0, 0.2, restitution=0.9).mechanism()
    table = table_of(block)
    for strength, period in ((1.3, 0.8), (1.3, 0.3), (1.1, 0.2)):
        motion = record(40, strength * g * block.uplift_multiplier, period=period)
        ground, response = forcing_of(motion).ground, integrate(block, motion)
        member, start = kernel.Member(1.0, 0.0, table.restitution), kernel.Start(0.0, 0.0, 0)
        room = kernel.memory(None), np.empty((2, 2)), np.empty((0, 3))
        arguments = table.kernel, ground, member, start, 3e-8, False, *room
        whole = best(lambda a=arguments: kernel.rock(*a), 40)
        alone = table.kernel.pieces, table.kernel.grid, ground.horizontal, STEP, 0.01, 0.01, response.steps
        bare = best(lambda a=alone: _bare(*a), 40)
        print(
            f"bare arithmetic / whole run: {bare / whole:.0%} "
            f"({response.steps} steps of {whole / response.steps * 1e9:.0f} ns, "
            f"{response.impacts} impacts, {response.outcome})"
        )


def batches() -> None:
    """Responses a second and core of the shipped structures, and what the call costs beside its kernel."""
    structures = [each.mechanism() for each in load_structures(STRUCTURES).values()]
    motion = record(20, 3.0, step=0.01, period=0.5)
    for count in (1, 8, 64):
        factors = np.geomspace(0.6, 1.6, count)
        tables, ground, once = (
            [table_of(each) for each in structures],
            forcing_of(motion).ground,
            np.zeros(count),
        )

        def kernels(factors=factors, tables=tables, ground=ground, once=once, count=count):
            for table in tables:
                kernel.rock_members(
                    table.kernel, ground, factors, once, np.tile(table.restitution, (count, 1)), 3e-8,
                    np.zeros(count, np.int64), np.zeros((count, 2)), np.zeros(count, np.int64),
                )  # fmt: skip

        def whole(factors=factors):
            integrate_batch(structures, motion, factors, workers=1)

        def one_by_one(factors=factors):
            for structure in structures:
                for factor in factors:
                    integrate(structure, motion.scaled(factor))

        bare, taken, singly = cpu(kernels), cpu(whole), cpu(one_by_one)
        print(
            f"{len(structures)} structures x {count} factors, 20 s at 100 Hz: "
            f"{len(structures) * count / taken:,.0f} responses a second and core, {taken / bare - 1:.0%} beside the "
            f"kernel, {singly / taken:.1f} times as fast as one by one"
        )


def ties() -> None:
    """A façade with two ties that yield, under a record that lets it rattle throughout, beside the one without."""
    free = Facade((3.2, 2.8), (0.6, 0.5), 20e3, (10e3, 5e3), 0.05, restitution=0.85)
    tied = replace(
        free, tie_heights=(3.1, 5.8), tie_stiffness=3e5, tie_strength=6e3, tie_plastic_elongation=50.0
    )
    motion = record(40, 1.5 * g * tied.mechanism().uplift_multiplier, seed=3)
    for name, facade in (("without ties", free), ("with two that yield", tied)):
        found, taken = integrate(facade, motion), cpu(lambda facade=facade: integrate(facade, motion))
        print(
            f"façade {name}, 40 s at 200 Hz: {taken * 1e3:.2f} ms, {found.impacts} impacts, {found.steps} steps"
        )


def cpu(call: Callable[[], object], repeats: int = 15) -> float:
    """Least CPU time of several runs, s, after one that warms up."""
    call()
    times = []
    for _ in range(repeats):
        start = time.process_time()
        call()
        times.append(time.process_time() - start)
    return min(times)


def many() -> None:
    """10 000 nonlinear responses of a 40 s record, and the record spectrum, on all cores."""
    structures = [
        Block(size, slenderness, restitution=0.9).mechanism()
        for size in np.geomspace(1, 10, 25)
        for slenderness in np.linspace(0.15, 0.3, 20)
    ]
    motions = [record(40, 3.0, seed) for seed in range(20)]
    start = time.perf_counter()
    for structure in structures:
        table_of(structure)
    print(
        f"table of a block: {(time.perf_counter() - start) / len(structures) * 1e3:.1f} ms, once per structure"
    )
    start = time.perf_counter()
    ratios = np.hstack([integrate_batch(structures, motion) for motion in motions])
    taken = time.perf_counter() - start
    moved = np.mean(ratios > 0)
    print(f"10 000 nonlinear responses of a 40 s record: {taken:.2f} s ({moved:.0%} of them lifted)")

    motion = record(40, 4.0)
    frequencies, multipliers = np.linspace(0.5, 5, 100), np.linspace(0.05, 0.45, 100)
    taken = best(lambda: rocking_spectrum(motion, frequencies, multipliers, 0.9), 3)
    short = record(4, 4.0)
    start = time.perf_counter()
    for p, multiplier in ((1.0, 0.15), (3.0, 0.25)):
        scipy_peak(EquivalentBlock(p, multiplier, 1.0, 0.9), short, 1e-7)
    theirs = (time.perf_counter() - start) / 2 * 10 * 10_000
    print(
        f"100 x 100 record spectrum of {motion.acceleration.size} samples: {taken:.2f} s; "
        f"scipy, from two cells of a tenth of it: {theirs / 3600:.1f} h, ratio {theirs / taken:,.0f}"
    )


if __name__ == "__main__":
    beside_scipy()
    share_of_the_limit()
    batches()
    ties()
    growth()
    many()
