"""Edits of a small study, each with what it makes again: a table written by hand, against which plans are held."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import yaml

from rocking.study.outputs import STEPS, outputs_of
from rocking.study.plan import make_plan
from rocking.study.products import PRODUCTS
from tests.synthetic import SyntheticRecord, at2_text

STRUCTURES = [
    {"name": "block", "type": "block", "breadth_m": 0.5, "height_m": 3.0},
    {"name": "wall", "type": "wall", "height_m": 3.2, "hinge_height_m": 1.6, "thickness_m": 0.25},
]
SETTINGS = {
    "design_spectrum": {"points": "design.csv"},
    "checks": {"pool": "pool/catalogue.csv"},
    "fragility": {"hazard": "hazard.csv", "in_every_run": True},
    "trade": {"in_summary": True},
}
ALL = "S C F T M"
NUMBERS = f"a b {ALL}"
"""What depends on every number: both records, summary, checks, fragility, trade and map."""
PULSES, PREDICTED, INTEGRATED = (f"a.{step} b.{step} {ALL}" for step in ("pulses", "predict", "integrate"))
"""The same, where both records are taken up from a later step on."""
REPORTED = "a.report b.report S C T M"
JOBS = {
    "summary: all records": "S",
    **{f"{product.name}: {product.does}": product.name[0].upper() for product in PRODUCTS},
}
"""By the message of its rule the letter of a job over all records."""


def _waves(seed: int) -> bytes:
    return at2_text(
        SyntheticRecord(
            name="made", seed=seed, pulse_amplitude=1.0, pulse_period=0.3, noise_peak=0.5, duration=2.0
        )
    ).encode()


def write_settings(**changed: object) -> None:
    settings: dict[str, object] = {**SETTINGS}
    for name, value in changed.items():
        section = settings.get(name)
        both = isinstance(section, dict) and isinstance(value, dict)
        settings[name] = {**section, **value} if both else value
    Path("config.yaml").write_text(yaml.safe_dump(settings))


def write_catalogue(folder: str, *names: str, **cells: str) -> None:
    columns = ["id", "file", "unit", *cells]
    lines = [",".join(columns), *(",".join([name, f"{name}.AT2", "g", *cells.values()]) for name in names)]
    Path(folder, "catalogue.csv").write_text("\n".join([*lines, ""]))


def write_study() -> None:
    for folder, names in (("records", "ab"), ("pool", "p")):
        Path(folder).mkdir()
        for name in names:
            Path(folder, f"{name}.AT2").write_bytes(_waves(ord(name)))
        write_catalogue(folder, *names)
    Path("structures.yaml").write_text(yaml.safe_dump(STRUCTURES))
    Path("design.csv").write_text("period_s,acceleration_g\n0,0.2\n0.1,0.5\n0.5,0.5\n4,0.06\n")
    Path("hazard.csv").write_text("intensity,annual_rate\n0.1,0.01\n1,0.0001\n")
    write_settings()


def write_outputs() -> None:
    """Write some file in the place of each output of a run; what it is made from snakemake is told by --touch."""
    plan = make_plan(yaml.safe_load(Path("config.yaml").read_text()))
    rules = [(step, record) for record in plan.records for step in STEPS] + [
        (rule, "") for rule in (*plan.products, "summary")
    ]
    for rule, record in rules:
        for path in outputs_of(rule, plan.settings, record).values():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"{rule}\n")


def _setting(**changed: object) -> Callable[[], None]:
    return lambda: write_settings(**changed)


def _section(name: str, **changed: object) -> Callable[[], None]:
    return lambda: write_settings(**{name: changed})


def _structures(*listed: dict[str, object]) -> Callable[[], None]:
    return lambda: Path("structures.yaml").write_text(yaml.safe_dump(list(listed))) and None


def _content(file: str, old: str, new: str) -> Callable[[], None]:
    def edit() -> None:
        path = Path(file)
        before = path.read_text()
        assert old in before
        path.write_text(before.replace(old, new, 1))

    return edit


def _bytes(file: str, content: bytes) -> Callable[[], None]:
    return lambda: Path(file).write_bytes(content) and None


def _move_catalogue() -> None:
    shutil.copytree("records", "moved")
    write_settings(catalogue="moved/catalogue.csv")


def _move_structures() -> None:
    shutil.copy("structures.yaml", "list.yaml")
    write_settings(structures="list.yaml")


def _structures_as_csv() -> None:
    keys = list({key: None for structure in STRUCTURES for key in structure})
    lines = [keys, *([str(structure.get(key, "")) for key in keys] for structure in STRUCTURES)]
    Path("list.csv").write_text("\n".join(map(",".join, lines)))
    write_settings(structures="list.csv")


def _station_xml() -> None:
    """Of both records, which name it."""
    Path("records/station.xml").write_text("<a/>")
    write_catalogue("records", "a", "b", inventory="station.xml")


def _removed(path: str) -> Callable[[], None]:
    return lambda: Path("results", path).unlink()


def _add_record() -> None:
    shutil.copy("pool/p.AT2", "records")
    write_catalogue("records", "a", "b", "p")


def _odd_name() -> None:
    """Of a file, which snakemake would take for one with variables."""
    Path("records/b.AT2").rename("records/b {x}<y>.AT2")
    catalogue = Path("records/catalogue.csv")
    catalogue.write_text(catalogue.read_text().replace("b,b.AT2", "b,b {x}<y>.AT2"))


Edit = tuple[str, Callable[[], object], str] | tuple[str, Callable[[], object], str, Callable[[], object]]
"""Its name, the edit, what it makes again, and what the study is before, where that is not as usual."""

BLOCK, WALL = STRUCTURES
EDITS: list[Edit] = [
    ("nothing", lambda: None, ""),
    # What is told of the study stands in the report of a record, in the summary and on the pages to sign.
    ("study", _setting(study="A town"), REPORTED),
    ("client", _setting(client="A town"), REPORTED),
    ("project_number", _setting(project_number="12"), REPORTED),
    ("author", _setting(author="Somebody"), REPORTED),
    ("date", _setting(date="1 May"), REPORTED),
    ("display_units", _setting(display_units="g and cm"), REPORTED),
    ("figures", _setting(figures="svg"), f"a.report b.report {ALL}"),
    ("language", _setting(language="it"), "S C"),
    # Where files lie changes nothing; what lies there does.
    ("mirror", _setting(mirror="elsewhere"), ""),
    ("catalogue elsewhere", _move_catalogue, NUMBERS),
    ("structures elsewhere", _move_structures, ""),
    ("structures as CSV", _structures_as_csv, ""),
    ("cell of the structures as CSV", _content("list.csv", "3.2", "3.3"), PREDICTED, _structures_as_csv),
    ("unnamed_events", _setting(unnamed_events="each"), INTEGRATED),
    # What else is written, and when.
    ("reports", _setting(reports=False), "a.integrate b.integrate S C T"),
    ("histories", _setting(histories=True), "a.integrate b.integrate S C T M"),
    ("fragility.in_every_run", _section("fragility", in_every_run=False), "S"),
    ("trade.in_summary", _section("trade", in_summary=False), "S"),
    # Numbers.
    ("tolerance", _setting(tolerance=1e-7), INTEGRATED),
    ("acceleration_scale", _setting(acceleration_scale="uplift"), PREDICTED),
    ("fidelity", _setting(fidelity="quick"), INTEGRATED),
    ("friction_coefficient", _setting(friction_coefficient=0.5), PREDICTED),
    ("scale_to", _setting(scale_to="pga 0.3 g"), NUMBERS),
    ("vertical", _setting(vertical=True), NUMBERS),
    ("candidates", _setting(candidates=3), INTEGRATED),
    ("processing_variants", _setting(processing_variants=False), INTEGRATED),
    ("processing.apply", _section("processing", apply="always"), NUMBERS),
    ("processing.pre_event_s", _section("processing", pre_event_s=0.5), NUMBERS),
    ("processing.baseline", _section("processing", baseline="none"), NUMBERS),
    ("processing.taper", _section("processing", taper=0.05), NUMBERS),
    ("processing.high_pass_Hz", _section("processing", high_pass_hz=0.2), NUMBERS),
    ("processing.low_pass_Hz", _section("processing", low_pass_hz=25), NUMBERS),
    ("processing.order", _section("processing", order=2), NUMBERS),
    ("processing.time_step_s", _section("processing", time_step_s=0.005), NUMBERS),
    ("pulse.lowest_frequency_Hz", _section("pulse", lowest_frequency_hz=0.2), PULSES),
    ("pulse.highest_frequency_Hz", _section("pulse", highest_frequency_hz=4), PULSES),
    ("pulse.candidates", _section("pulse", candidates=5), PULSES),
    ("pulse.alternatives", _section("pulse", alternatives=3), PULSES),
    ("pulse.pursuit", _section("pulse", pursuit=2), PULSES),
    ("pulse.choice", _section("pulse", choice="demand"), PULSES),
    ("ensemble.members", _section("ensemble", members=16), INTEGRATED),
    ("ensemble.amplitude_range", _section("ensemble", amplitude_range=0.1), INTEGRATED),
    ("ensemble.restitution_range", _section("ensemble", restitution_range=0.1), INTEGRATED),
    ("ensemble.polarity", _section("ensemble", polarity=False), INTEGRATED),
    ("ensemble.processing", _section("ensemble", processing=False), INTEGRATED),
    ("ensemble.risk", _section("ensemble", risk=0.1), INTEGRATED),
    ("ensemble.reserve", _section("ensemble", reserve=2.0), INTEGRATED),
    # The design level is drawn in reports; what only the checks use is theirs.
    ("design level", _section("design_spectrum", points=None, ag_g=0.2, f0=2.5, tc_star_s=0.4), REPORTED),
    ("design_spectrum.damping", _section("design_spectrum", damping=0.1), REPORTED),
    ("checks.limit_state", _section("checks", limit_state="SLC"), "S C"),
    ("checks.confidence_factor", _section("checks", confidence_factor=1.2), "S C"),
    ("checks.behaviour_factor", _section("checks", behaviour_factor=1.5), "S C"),
    ("checks.least_others", _section("checks", least_others=0.4), "S C"),
    ("checks.stations", _section("checks", stations=10), "S C"),
    ("checks.least_factor", _section("checks", least_factor=0.3), "S C"),
    ("checks.largest_factor", _section("checks", largest_factor=3.0), "S C"),
    ("checks.shortest_period_s", _section("checks", shortest_period_s=0.2), "S C"),
    ("checks.longest_period_s", _section("checks", longest_period_s=1.5), "S C"),
    ("checks.seed", _section("checks", seed=1), "S C"),
    ("checks.pool", _section("checks", pool=None), "S C"),
    ("content of design.csv", _content("design.csv", "0.06", "0.05"), REPORTED),
    ("content of a record of the pool", _bytes("pool/p.AT2", _waves(9)), "S C"),
    ("catalogue of the pool", lambda: write_catalogue("pool", "p", scale_factor="2"), "S C"),
    ("record of the pool away", lambda: Path("pool/p.AT2").unlink(), "S C"),
    # The checks, the fragility and the trade stand in the summary.
    ("fragility.intensity_measure", _section("fragility", intensity_measure="pga"), "S F"),
    ("fragility.members", _section("fragility", members=False), "S F"),
    ("fragility.largest_factor", _section("fragility", largest_factor=5.0), "S F"),
    ("fragility.hazard", _section("fragility", hazard=None), "S F"),
    ("content of hazard.csv", _content("hazard.csv", "0.0001", "0.0002"), "S F"),
    # Records and their files.
    ("content of a record", _bytes("records/a.AT2", _waves(9)), "a S C F T M"),
    ("a byte of a record", lambda: _bytes("records/a.AT2", _waves(97) + b"\n")(), "a S C F T M"),
    ("date of a record", lambda: os.utime("records/a.AT2", (1e9, 1e9)), ""),
    ("date of a record in the future", lambda: os.utime("records/a.AT2", (9e9, 9e9)), ""),
    ("date of a list in the future", lambda: os.utime("structures.yaml", (9e9, 9e9)), ""),
    ("record away", lambda: Path("records/a.AT2").unlink(), "a S C F T M"),
    ("cell of the catalogue", lambda: write_catalogue("records", "a", "b", scale_factor="2"), NUMBERS),
    ("blank cells of the catalogue", lambda: write_catalogue("records", "a", "b", event=""), ""),
    ("records in another order", lambda: write_catalogue("records", "b", "a"), "S C F T M"),
    ("record renamed", _content("records/catalogue.csv", "b,b.AT2", "c,b.AT2"), "c S C F T M"),
    (
        "StationXML of the records",
        lambda: Path("records/station.xml").write_text("<b/>"),
        NUMBERS,
        _station_xml,
    ),
    ("file of a record renamed oddly", _odd_name, "b S C F T M"),
    ("file of an odd name edited", _bytes("records/b {x}<y>.AT2", _waves(9)), "b S C F T M", _odd_name),
    ("record less", lambda: write_catalogue("records", "a"), "S C F T M"),
    ("record more", _add_record, "p S C F T M"),
    # Structures.
    ("structure changed", _structures(BLOCK | {"height_m": 3.1}, WALL), PREDICTED),
    ("structure renamed", _structures(BLOCK | {"name": "pier"}, WALL), PREDICTED),
    ("structure added", _structures(BLOCK, WALL, BLOCK | {"name": "pier"}), PREDICTED),
    ("structure less", _structures(BLOCK), PREDICTED),
    ("structures in another order", _structures(WALL, BLOCK), PREDICTED),
    ("comment in the list", lambda: _content("structures.yaml", "- ", "# old\n- ")(), ""),
    ("terms of the checks", _structures(BLOCK | {"elastic_period_s": 0.3}, WALL), "S C"),
    # What was written is made again where it is not there; what serves the next run alone nobody misses.
    ("report away", _removed("a/report.pdf"), "a.report S C T M"),
    ("table of a record away", _removed("b/timings.csv"), "b.report S C T M"),
    ("pulses away", _removed("a/pulses.csv"), "a.pulses S C T M"),
    ("outcome away", _removed(".kept/outcomes/a.json"), "a.report S C T M"),
    ("table of the summary away", _removed("summary/provenance.json"), "S"),
    ("sums away", _removed("SHA256SUMS"), "S"),
    ("page to sign away", _removed("summary/structures.pdf"), "S C"),
    ("curves away", _removed("fragility/fragility.csv"), "S F"),
    ("rows of the trade away", _removed(".kept/rows/trade.json"), "S T"),
    ("cases away", _removed(".kept/cases/a.json"), ""),
    ("all memory of the scheduler away", lambda: shutil.rmtree(".snakemake"), ""),
]
