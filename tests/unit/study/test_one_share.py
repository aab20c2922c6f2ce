"""One share of a pinnacle whose stacks fall: in expected falls, strengthening, the page to sign and the summary."""

import csv
from pathlib import Path

import numpy as np
import pytest

import rocking
from rocking.assessment.decide import Verdict
from rocking.assessment.rows import ExpectedFallsRow, RecordRow, VerdictRow
from rocking.catalogue import load_catalogue
from rocking.earthquakes.sample import ClusterSample
from rocking.products.checks.work import write_checks
from rocking.strengthening import sizes, strengthen_scene
from rocking.study.job import Study
from rocking.study.plan import make_plan
from rocking.study.summary_tables import write_summary
from rocking.tables import read_table
from tests.made_pools import DESIGN
from tests.unit.study.made_jobs import outcomes_in, worked

STEP = 0.005
PERIODS = (0.45, 0.5, 0.55, 0.6, 0.65, 0.7)
PINNACLE = "- {name: pinnacle, type: spire, width_m: 0.6, height_m: 3.0, plan: square}\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """Three cycles of a sine at each of six stations, and a pinnacle on the ground."""
    made = tmp_path_factory.mktemp("pinnacle")
    with (made / "catalogue.csv").open("w", newline="") as stream:
        writer = csv.writer(stream)
        writer.writerow(["id", "file", "unit", "station"])
        for number, period in enumerate(PERIODS):
            times = np.arange(0, 3 * period, STEP)
            motion = np.append((3.9 + 0.1 * number) * np.sin(2 * np.pi * times / period), np.zeros(60))
            lines = [f"{STEP * place:.3f} {value:.9f}" for place, value in enumerate(motion)]
            (made / f"r{number}.txt").write_text("\n".join(lines) + "\n")
            writer.writerow([f"r{number}", f"r{number}.txt", "m/s2", f"s{number}"])
    (made / "structures.yaml").write_text(PINNACLE)
    return made


@pytest.mark.process
def test_four_tables_say_one_share_of_a_pinnacle_whose_stacks_fall(folder: Path, monkeypatch) -> None:
    monkeypatch.setattr(
        "rocking.assessment.evidence.asked.MOST_RUNS", 16
    )  # as many stacks tell as much of one share
    settings = {
        "catalogue": str(folder / "catalogue.csv"),
        "structures": str(folder / "structures.yaml"),
        "fidelity": "contact",
        "ensemble": {"reserve": 0},
        "reports": False,
        "processing": {"apply": "never"},
        "processing_variants": False,
        **DESIGN,
    }
    plan = make_plan(settings)
    study = Study(plan.scenes, plan.settings)
    catalogue = load_catalogue(folder / "catalogue.csv")
    worked(catalogue, study, folder / "results")
    outcomes = list(outcomes_in(folder / "results", catalogue))
    write_summary(outcomes, study, folder / "summary")
    verdicts = [row for outcome in outcomes for row in outcome.rows[VerdictRow]]

    # The summary: of each record the larger of two counts, that of the members and that of the stacks.
    assert len(verdicts) == len(PERIODS)
    of_members = np.array(
        [one_verdict.overturning_members / max(one_verdict.members, 1) for one_verdict in verdicts]
    )
    of_stacks = np.array(
        [
            other_verdict.stack_falls / other_verdict.stack_runs if other_verdict.stack_runs else 0.0
            for other_verdict in verdicts
        ]
    )
    shares = np.array([verdict.overturning_share for verdict in verdicts])
    assert shares == pytest.approx(np.maximum(of_members, of_stacks), abs=1e-12)
    decided = [
        this_verdict
        for this_verdict, stacks, members in zip(verdicts, of_stacks, of_members, strict=True)
        if stacks > members
    ]
    assert len(decided) >= 2, "else nothing is tested"
    assert any(this_verdict.verdict is Verdict.UNCERTAIN for this_verdict in decided), (
        "else no word is theirs"
    )

    # The expected falls of one structure under one record are its share.
    falls = read_table(ExpectedFallsRow, folder / "summary")
    assert [row.expected_falls for row in falls] == pytest.approx([*shares, shares.mean()])

    # The page to sign: the mean over the stations.
    pages = []
    monkeypatch.setattr(
        "rocking.products.checks.work.structures_data", lambda made, *_: pages.extend(made) or {}
    )
    monkeypatch.setattr("rocking.products.checks.work.write_document", lambda *_: None)
    records = read_table(RecordRow, folder / "summary")
    write_checks(study, folder, verdicts, records)
    assert pages[0].stations == len(PERIODS)
    assert pages[0].overturning_share == pytest.approx(shares.mean())

    # What would hold it, as it is given: the same mean. Two values are tried, which nothing lifts.
    monkeypatch.setattr("rocking.strengthening.GRID", 2)
    scene = study.scenes["pinnacle"]
    (side,) = (size for size in sizes(scene.structure) if size.name == "width")
    motions = [rocking.read(folder / f"{one_record.id}.txt", unit="m/s2")[0] for one_record in catalogue]
    names = tuple(record.id for record in catalogue)
    sample = ClusterSample(names, names)
    found = strengthen_scene(motions, scene, side, (1.5, 2.0), 0.1, sample, study.assessment)
    assert found.given.undecided == 0
    assert found.given.share == pytest.approx(shares.mean())
