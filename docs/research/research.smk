"""What was measured once for this package: ensembles, a shake table, other codes. Run each by its name."""

from rocking.hashes import sha256_of
from rocking.study.settings import structure_hashes

RESEARCH = HOME / "docs" / "research"
REAL_RECORDS = [f"{HOME}/records/{name}.csv" for name in ("near_fault", "fema_p695")]
# Each target: what it says it does, the catalogues that it reads, and what it writes beside its scores and its report.
TARGETS_OF_RESEARCH = {
    "calibrate_ensemble": (
        "Draw thousands of members for each real record",
        REAL_RECORDS,
        ["ensemble_trials.csv"],
    ),
    "cover": ("Hold a fragility's median against truths that are known", REAL_RECORDS, []),
    "cover_rate": ("Hold the interval of an annual rate against truths that are known", REAL_RECORDS, []),
    "cover_earthquakes": (
        "Hold every interval against truths that are known, with few earthquakes of several stations",
        REAL_RECORDS,
        [],
    ),
    "pulse_shapes": ("Try half a sine, a cosine and several cycles beside one sine", REAL_RECORDS[1:], []),
    "worth": ("Hold the closed form under the best sine against the integration", REAL_RECORDS, []),
    "measure_scatter": ("Measure by how much the level that overturns scatters", REAL_RECORDS, []),
    "govern": ("Try the governing crack on stacks of courses", REAL_RECORDS, ["cracks.csv"]),
    "hold": (
        "Hold walls that something holds beside stacks of the whole wall",
        REAL_RECORDS,
        ["held_walls.csv"],
    ),
    "tie_forces": ("Hold the forces of ties in motion against those of statics", REAL_RECORDS, ["ties.csv"]),
    "between_ties": (
        "Hold walls with ties at a spacing beside walls of units in three dimensions",
        [*REAL_RECORDS, f"{HOME}/records/catalogue.csv"],
        ["between_ties.csv"],
    ),
    "anchors": (
        "Hold walls with light anchors beside stacks whose anchors slide out",
        [*REAL_RECORDS, f"{HOME}/records/catalogue.csv"],
        ["anchors.csv"],
    ),
    "diaphragms": (
        "Hold walls between floors beside the same walls below a diaphragm that drifts",
        REAL_RECORDS,
        ["diaphragms.csv"],
    ),
    "leaves": (
        "Hold walls of two leaves beside stacks of each leaf",
        REAL_RECORDS,
        ["leaves.csv"],
    ),
    "voussoirs": (
        "Hold arches and portals that stand beside other chains of stones, and beside LMGC90",
        [*REAL_RECORDS, f"{HOME}/records/catalogue.csv"],
        ["voussoirs.csv", "disagreements.csv", "lmgc90.csv"],
    ),
    "stand": (
        "Hold verdicts with and without contact dynamics against stacks",
        REAL_RECORDS,
        ["stacks.csv"],
    ),
    "screen": (
        "Hold the verdict over all cracks against the ensemble of each",
        REAL_RECORDS,
        ["screening.csv"],
    ),
    "stability": (
        "Hold the words of few members against the shares of thousands",
        [REAL_RECORDS[1], REAL_RECORDS[0], f"{HOME}/records/catalogue.csv"],
        ["stability.csv"],
    ),
    "floors": (
        "Hold the closed form against integration on supports that ring",
        REAL_RECORDS,
        ["floors.csv"],
    ),
    "fronts": (
        "Hold fronts that rock both ways beside fronts that floors throw back",
        REAL_RECORDS,
        ["fronts.csv"],
    ),
    "halves": (
        "Choose what holds on one half of the earthquakes, and state it on the other",
        REAL_RECORDS,
        [],
    ),
    "code_check": (
        "Hold the formulas of the Italian code beside records of the design level",
        REAL_RECORDS,
        ["walls.csv"],
    ),
    "code_sets": (
        "Hold what sets of records say beside sets of stations left out",
        REAL_RECORDS,
        ["sets.csv"],
    ),
    "validate": (
        "Predict the overturning of two specimens on a shake table",
        [f"{HOME}/records/shake_table.csv"],
        ["predictions.csv"],
    ),
    "compare": ("Run the same cases through every code", REAL_RECORDS[:1], ["codes.csv"]),
}

for TARGET, (TELLS, CATALOGUES, FILES) in TARGETS_OF_RESEARCH.items():

    rule:
        name:
            TARGET
        input:
            catalogues=CATALOGUES,
            source=sorted(map(str, RESEARCH.rglob("*.py"))),
        output:
            [
                f"{RESULTS}/{TARGET}/{file}"
                for file in ("scores.csv", "datapackage.json", "report.pdf", *FILES)
            ],
        log:
            f"{RESULTS}/summary/logs/{TARGET}.log",
        benchmark:
            f"{RESULTS}/summary/benchmarks/{TARGET}.tsv"
        params:
            structures_sha256=sha256_of(*structure_hashes(PLAN.scenes).items()),
            package_sha256=package_sha256(),
        message:
            TELLS
        run:
            research(rule, input.catalogues, output[0], log[0])
