"""What a file says of its numbers is read by one vocabulary at every door, and no word of it stands against another."""

from pathlib import Path

import numpy as np
import pytest

from rocking.errors import RecordError, UndeclaredError
from rocking.records import Accelerogram, read
from rocking.records.claims import Claim, Where, agreed, claims_of_name, other_quantity, vertical_in_name
from rocking.records.formats.format import Layout, Options, key
from rocking.records.kinds import RecordKind
from tests.refusals import refused
from tests.unit.records.test_layouts import MOTION, OTHER, TIMES, UP, table

G = 9.80665


def kinds(record: Accelerogram) -> set[str]:
    return {warning.kind for warning in record.warnings}


def at2(folder: Path, title: str = "QUAKE, STATION, 090", unit: str = "UNITS OF G", **more: object) -> Path:
    """An AT2 file of MOTION; first: its first line; end: below the numbers; factor: of the numbers."""
    numbers = MOTION * float(more.get("factor", 1 / G))
    rows = "\n".join("".join(f"{value:15.7E}" for value in row) for row in numbers.reshape(-1, 5))
    first = more.get("first", "PEER NGA STRONG MOTION DATABASE RECORD")
    head = f"{first}\n{title}\nACCELERATION TIME SERIES IN {unit}\n"
    path = folder / "made.AT2"
    path.write_text(
        f"{head}NPTS= {MOTION.size}, DT= .0100 SEC\n{rows}{more.get('end', chr(10))}", encoding="utf-8"
    )
    return path


@pytest.mark.parametrize("head", ["X,Y", "x,acc", "x-values,y-values", "Curve1,Curve2", "T,A"])
def test_a_column_that_climbs_evenly_is_time_whatever_its_name(tmp_path: Path, head: str) -> None:
    path = tmp_path / "made.csv"
    path.write_text(f"{head}\n{table(TIMES, MOTION, parted=',')}")
    (record,) = read(path, unit="m/s2")
    assert record.time_step == pytest.approx(0.01) and record.acceleration == pytest.approx(MOTION, abs=1e-6)


@pytest.mark.parametrize(("title", "vertical", "azimuth"), [
    ("QUAKE, STATION, UP (USGS STATIO", True, None), ("QUAKE, STATION, 090 (CDMG STATI", False, 90.0),
    ("QUAKE, STATION, V (USGS 12", True, None), ("QUAKE, STATION, 090", False, 90.0), ("QUAKE, STATION, DWN (",
    True, None),
])  # fmt: skip
def test_the_title_of_an_at2_may_be_cut_within_its_bracket(
    tmp_path: Path, title: str, vertical: bool, azimuth: float | None
) -> None:
    (record,) = read(at2(tmp_path, title))
    assert (record.vertical, record.azimuth) == (vertical, azimuth)


@pytest.mark.parametrize(("line", "vertical", "azimuth"), [
    ("vertical component", True, None), ("North-South component", False, 0.0), ("no word of it", False, None),
])  # fmt: skip
def test_a_line_of_an_at2_says_where_its_channel_points_where_its_title_does_not(
    tmp_path: Path, line: str, vertical: bool, azimuth: float | None
) -> None:
    (record,) = read(at2(tmp_path, f"QUAKE\n{line}"))
    assert (record.component, record.vertical, record.azimuth) == ("channel 1", vertical, azimuth)


def test_blank_lines_above_an_at2_leave_its_title_where_it_is(tmp_path: Path) -> None:
    path = at2(tmp_path, "QUAKE, STATION, UP")
    path.write_bytes(b"\n\n\n" + path.read_bytes())
    (record,) = read(path)
    assert (record.component, record.station, record.vertical) == ("UP", "STATION", True)


@pytest.mark.parametrize(
    "first", ["Scale factor = 8", "RECORD SCALED BY 2.5", "multiplied by 1.7 g", "Gain: 4"]
)
def test_a_factor_in_the_head_of_an_at2_is_reported(tmp_path: Path, first: str) -> None:
    assert RecordKind.FACTOR_NOT_APPLIED in kinds(read(at2(tmp_path, first=f"PEER {first}"))[0])
    assert not kinds(read(at2(tmp_path))[0])


SPELLINGS = {
    "CM/S/S": 0.01, "M/S/S": 1.0, "MM/SEC/SEC": 1e-3, "m/sec²": 1.0, "cm/s^2": 0.01, "CM/SEC**2": 0.01, "GAL": 0.01,
    "gals": 0.01, "mg": G / 1000, "G": G, "(g)": G, "cm/seg2": 0.01, "м/с²": 1.0, "Гал": 0.01, "% g": G / 100,
    "cm / s 2": 0.01, "CM PER SEC PER SEC": 0.01, "meters/second^2": 1.0, "cm/sn²": 0.01, "inch/s2": 0.0254,
    "μm/s²": 1e-6,
    "IN/S/S": 0.0254, "FT/S/S": 0.3048, "cm/s2": 0.01, "m s-2": 1.0,
}  # fmt: skip


@pytest.mark.parametrize(("unit", "value"), SPELLINGS.items())
def test_a_unit_is_read_in_any_spelling_at_every_door(tmp_path: Path, unit: str, value: float) -> None:
    """Of an AT2, of a header above a table, and of a column."""
    bare = unit.strip("()")
    (tmp_path / "a.txt").write_text(
        f"# units: {bare}\n{table(TIMES, MOTION / value, digits='.9g')}", encoding="utf-8"
    )
    (tmp_path / "b.txt").write_text(
        f"t;NS ({bare})\n{table(TIMES, MOTION / value, parted=';', digits='.9g')}", "utf-8"
    )
    for path in (
        at2(tmp_path, unit=f"UNITS OF {unit}", factor=1 / value),
        tmp_path / "a.txt",
        tmp_path / "b.txt",
    ):
        try:
            (record,) = read(path)
        except RecordError as error:
            assert error.field == "unit"  # asked, never read as another
            assert unit in ("m s-2",)
            continue
        assert record.acceleration == pytest.approx(MOTION, rel=1e-4, abs=1e-5), path


def test_an_at2_in_whose_unit_it_would_be_too_weak_is_asked_and_the_user_settles_it(
    tmp_path: Path,
) -> None:
    """Else its values were 980 times too small, in silence: no peak stands in such a head."""
    path = at2(tmp_path, unit="UNITS OF CM/S/S")
    with refused(UndeclaredError, "unit") as caught:
        read(path)
    assert "CM/S/S" in str(caught.value) and "in g" in str(caught.value) and "unit=" in str(caught.value)
    for unit, value in (("g", G), ("cm/s2", 0.01)):
        (record,) = read(path, unit=unit)
        assert record.acceleration == pytest.approx(MOTION * value / G, rel=1e-5)
    with refused(RecordError, "unit"):
        read(path, unit="mg")


@pytest.mark.parametrize(
    "unit", ["UNITS OF G*1000", "UNITS OF G, but in cm/s/s", "UNITS OF G (%)", "UNITS OF VOLTS"]
)
def test_a_unit_next_to_a_factor_or_another_is_asked(tmp_path: Path, unit: str) -> None:
    with refused(UndeclaredError, "unit"):
        read(at2(tmp_path, unit=unit))


@pytest.mark.parametrize(("head", "kind"), [
    ("# PGA = 0.9 g\nt NS(g)\n", RecordKind.PEAK_UNLIKE_HEADER), ("# максимальное ускорение: 0.9 g\nt NS(g)\n",
    RecordKind.PEAK_UNLIKE_HEADER), ("# Max. Acc. (gal) = 900\nt NS(g)\n", RecordKind.PEAK_UNLIKE_HEADER),
    ("# amplified by 2\nt NS(g)\n", RecordKind.FACTOR_NOT_APPLIED), ("# vertical\nt NS(g)\n",
    RecordKind.DIRECTION_SAID_TWICE),
])  # fmt: skip
def test_a_peak_or_a_direction_that_is_not_that_of_the_column_is_reported(
    tmp_path: Path, head: str, kind: str
) -> None:
    path = tmp_path / "made.txt"
    path.write_text(head + table(TIMES, 0.1 * MOTION))
    assert kind in kinds(read(path)[0])
    path.write_text(head.partition("\n")[2] + table(TIMES, 0.1 * MOTION))
    assert not kinds(read(path)[0])


@pytest.mark.parametrize(("name", "word"), [
    ("PULDWN", "DWN"), ("RSN1_XYZUP", "UP"), ("A-ESODWN", "DWN"), ("TAB-V1", "V1"), ("x_HNZ_2016", "HNZ"),
    ("XX.MADE..HGZ.D", "HGZ"),
    ("made_UD", "UD"), ("made-VERT", "VERT"), ("scaled_up", ""), ("20200101T102244Z", ""), ("made.v1", ""),
    ("made_NS", ""), ("UD_made", "UD"), ("made_UD_g", "UD"), ("düşey_acc", "düşey"), ("Cap_Vert_NS", ""),
])  # fmt: skip
def test_a_vertical_is_known_by_the_name_of_its_file_with_any_ending(name: str, word: str) -> None:
    for ending in ("", ".AT2", ".ATH", ".thf", ".rec", ".hst", ".his", ".acc1", ".gm", ".txt.gz"):
        assert vertical_in_name(f"{name}{ending}") == word


@pytest.mark.parametrize("name", [
    "velocityHistory", "VelocityTH", "groundVel", "vel_ns", "kobe_VEL", "velocidad", "vitesse", "hiz_verisi",
    "Geschwindigkeit",
    "made_disp", "spostamento", "deplacement", "desplazamiento", "station.VT2", "made.dt2", "скорость",
])  # fmt: skip
def test_velocity_is_refused_by_the_name_of_a_file_of_bare_numbers(tmp_path: Path, name: str) -> None:
    path = tmp_path / f"{name}.txt"
    path.write_text(table(TIMES, MOTION))
    with refused(RecordError, "quantity"):
        read(path, unit="m/s2")
    path.write_text("t,NS acc (m/s2)\n" + table(TIMES, MOTION, parted=","))
    with refused(UndeclaredError, "unit") as asked:
        read(path)
    assert "NS acc (m/s2)" in str(asked.value) and "its name" in str(asked.value)
    assert read(path, unit="m/s2")


@pytest.mark.parametrize("text", [
    "velocity (cm/s)", "vitesse", "velocidad", "hız", "速度", "скорость", "ταχύτητα", "displacement", "変位",
    "перемещение", "cm/s",
])  # fmt: skip
def test_other_quantities_are_known_in_the_languages_of_heads(text: str) -> None:
    assert other_quantity(text) in ("velocity", "displacement")
    assert other_quantity(f"acceleration, not {text}") is None


@pytest.mark.parametrize(
    "head", ["PGV = 30 cm/s", "Max velocity 30 cm/s at 2.3 s", "Arias intensity 1.2 m/s"]
)
def test_a_peak_velocity_next_to_a_unit_of_acceleration_is_no_other_quantity(
    tmp_path: Path, head: str
) -> None:
    path = tmp_path / "made.csv"
    for above in (f"# {head}\nt,NS (m/s2)\n", f"# {head}\n# units: m/s2\nt,NS\n"):
        path.write_text(above + table(TIMES, 0.1 * MOTION, parted=","))
        assert read(path)[0].acceleration == pytest.approx(0.1 * MOTION, abs=1e-6)
    assert read(at2(tmp_path, first=head))
    path.write_text(f"# {head}\nt,NS\n" + table(TIMES, 0.1 * MOTION, parted=","))
    with refused(RecordError, "quantity"):
        read(path, unit="m/s2")


@pytest.mark.parametrize(
    "text", ["shear wave velocity 300 m/s", "Vs30", "velocidad de muestreo", "加速度", "cm/s/s", "cm/s^2"]
)
def test_the_velocity_of_a_site_or_of_a_recorder_is_no_record(text: str) -> None:
    assert other_quantity(text) is None


ENDS = [
    "\n/&\n",
    "\nEND\n",
    "\n*** End Data ***\n",
    "\nEOF",
    "\n};\n",
    "\nLEE $\n",
    "/&\n",
    "*** End Data ***\n",
    "\nend of file\n",
    "END\n",
    "\n----\n",
    "  NaN NaN\n",
]


@pytest.mark.parametrize("end", ENDS)
def test_a_mark_of_the_end_is_passed_over(tmp_path: Path, end: str) -> None:
    (record,) = read(at2(tmp_path, end=end))
    assert record.acceleration.size == MOTION.size and record.acceleration == pytest.approx(MOTION, abs=1e-5)


@pytest.mark.parametrize(("name", "typed"), [
    ("kobe_dt0.005", {"time_step": 0.01}), ("kobe_200Hz", {"time_step": 0.01}), ("kobe dt 0.0025",
    {"time_step": 0.01}),
    ("kobe_100sps", {"time_step": 0.02}), ("acc_cm_s2", {"unit": "g"}), ("acc_m_s2", {"unit": "cm/s2"}),
    ("made_gal", {"unit": "g"}),
])  # fmt: skip
def test_what_a_name_says_is_held_against_what_is_typed(tmp_path: Path, name: str, typed: dict) -> None:
    path = tmp_path / f"{name}.txt"
    path.write_text(table(0.2 * MOTION))
    with refused(RecordError, *next(iter(typed.items()))):
        read(path, **{"unit": "m/s2" if "unit" not in typed else None, "time_step": 0.01} | typed)
    said = {claim.what: claim.value for claim in claims_of_name(path.name)}
    assert read(path, **({"unit": "m/s2", "time_step": 0.01} | said))


@pytest.mark.parametrize(
    "name", ["bandpass_0.1-25Hz", "25 Hz filtered", "kobe_5Hz_pulse", "rsn_100", "g_station", "hz100"]
)
def test_a_number_in_a_name_that_is_no_rate_says_nothing(name: str) -> None:
    assert claims_of_name(f"{name}.txt") == ()


def test_a_person_settles_what_a_file_says_twice_and_contradicts_nothing_that_it_says() -> None:
    head, column = Claim("unit", "mg", Where.HEAD), Claim("unit", "g", Where.COLUMN)
    with refused(UndeclaredError, "unit"):
        agreed("unit", [head, column])
    assert agreed("unit", [head, column, Claim("unit", "mg", Where.OPTION)]) == "mg"
    with refused(RecordError, "unit", "gal"):
        agreed("unit", [head, column, Claim("unit", "gal", Where.ANSWER)])
    assert agreed("unit", [Claim("unit", "gal", Where.COLUMN), Claim("unit", "cm/s2", Where.HEAD)]) == "gal"
    assert agreed("unit", []) is None and agreed("time_step", [head]) is None


@pytest.mark.parametrize("head", [
    "時間(s),南北動 加速度(gal),東西動 加速度(gal),上下動 加速度(gal)\n",
    "время (с);СЮ (см/с2);ВЗ (см/с2);верт (см/с2)\n",
])  # fmt: skip
def test_heads_in_other_scripts_are_read(tmp_path: Path, head: str) -> None:
    path = tmp_path / "made.csv"
    parted = ";" if ";" in head else ","
    path.write_text(head + table(TIMES, 100 * MOTION, 100 * OTHER, 100 * UP, parted=parted), encoding="utf-8")
    north, east, up = read(path)
    assert (north.azimuth, east.azimuth, up.vertical) == (0.0, 90.0, True)
    assert north.acceleration == pytest.approx(MOTION, abs=1e-6)


def test_a_layout_holds_the_declared_count_against_each_column() -> None:
    layout = Layout("m/s2", {"samples": key("N"), "step": key("DT")})
    columns = np.column_stack([MOTION, OTHER])
    read_of = layout.channels(f"N: {len(columns)}\nDT: 0.01", columns, ["NS", "EW"], Options())
    assert [record.acceleration.size for record in read_of] == [MOTION.size] * 2
    with refused(RecordError, "samples", MOTION.size):
        layout.channels(
            f"N: {MOTION.size}\nDT: 0.01", columns[: MOTION.size * 4 // 5], ["NS", "EW"], Options()
        )
