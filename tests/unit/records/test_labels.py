"""What the names of columns, and the warnings above them, say of quantity, unit, direction and time step."""

from pathlib import Path

import numpy as np
import pytest

from rocking.errors import RecordError, UndeclaredError
from rocking.quantities import acceleration_factor
from rocking.records import Accelerogram, read
from rocking.records.direction import Direction
from rocking.records.formats.labels import ColumnLabel
from rocking.records.formats.layouts import NAME, AskedError
from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning
from tests.refusals import refused
from tests.unit.records.test_layouts import answered

TIMES = np.arange(600) * 0.01
WAVES = [
    np.sin(4 * TIMES + phase) * np.exp(-((TIMES - 3) ** 2)) * size
    for phase, size in ((0, 0.8), (1, 0.6), (2, 0.28))
]
FIRST = WAVES[0]
VELOCITY = np.concatenate([[0], np.cumsum((FIRST[1:] + FIRST[:-1]) / 2)]) * 0.01


def table(head: str, *columns: np.ndarray, parted: str = ",") -> str:
    rows = (parted.join(f"{value:.6f}" for value in row) for row in np.transpose(columns))
    return head + "\n".join(rows) + "\n"


def opened(folder: Path, content: str | bytes, **options) -> list[Accelerogram]:
    path = folder / "made.txt"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read(path, **options)


@pytest.mark.parametrize(
    ("label", "unit", "component"),
    [
        ("NS (cm/s²)", "cm/s2", "NS"),
        ("ew_m_s2", "m/s2", "ew"),
        ("Acc/g", "g", "Acc"),
        ("acc, cm/s2", "cm/s2", "acc"),
        ("Acc (N)", None, "N"),
        ("acc (N/S)", None, "N/S"),
        ("rot30 acc (g)", "g", "rot30 acc"),
        ("AccUD", None, "UD"),
        ("az", None, "z"),
        ("acc_v", None, "v"),
        ("IV.AMT..HNZ (gal)", "gal", "HNZ"),
        ("acc N-S m/s/s", "m/s2", "N-S"),
        ("a_g", None, "a_g"),
        ("z_g", None, "z"),
        ("u_g", None, "u_g"),
        ("vertical acceleration (m/s2)", "m/s2", "vertical"),
        ("Acc. N-S component (g)", "g", "N-S"),
        ("Ground acceleration (g)", "g", "Ground acceleration"),
        ("Z-direction (g)", "g", "Z"),
        ("acc in g", "g", "acc"),
        ("Acceleration in cm/s/s", "cm/s2", "Acceleration"),
        ("acceleration_ms2", "m/s2", "acceleration"),
        ("acc_m_per_s2", "m/s2", "acc"),
        ("accel (g's)", "g", "accel"),
        ("Linear Acceleration z (m/s^2)", "m/s2", "z"),
        ("Input acc NS (g)", "g", "NS"),
        ("Aceleración Vertical [cm/s2]", "cm/s2", "Vertical"),
        ("Componente EW (gal)", "gal", "EW"),
        ("Acc. (N-S)", None, "N-S"),
        ("Acc (UD) gal", "gal", "UD"),
        ("CH1-EW", None, "EW"),
        ("HNZ.acc", None, "HNZ"),
        ("EW_acc_g", None, "EW"),
        ("accVert", None, "Vert"),
        ("Ch 101", None, "Ch 101"),
        ("Comp 2", None, "Comp 2"),
        ("roof acc E", None, "roof acc E"),
    ],
)
def test_a_label_names_unit_and_component(label, unit, component):
    read_as = ColumnLabel(label)
    assert (read_as.unit, read_as.component, read_as.other) == (unit, component, "")


@pytest.mark.parametrize(
    "label",
    ["CH1 (V)", "CH1 (mV)", "acc (counts)", "counts", "shear (kN)", "NS (mm)", "NS (kine)", "NS (cm/s)", "rot (rad/s2)",
     "tilt (deg)", "strain", "acc (mGal)", "Arias intensity (m/s)", "roof drift",
     "acc x1e-3 (g)", "acc (10^-3 g)", "acc *1000 (g)", "CH1 (V/g)", "jerk (g/s)", "acc (g^2/Hz)", "acc (%)",
     "relative acc (g)", "normalized acc (g)", "1000*acc (g)",
     "Vel_cm_s", "disp_cm", "acc 0.1 gal", "acc 10 mm/s2", "acc^2 (g2)",
     "resultant (g)", "acc SRSS (g)", "vector sum (g)"],
)  # fmt: skip
def test_a_column_of_something_else_is_no_acceleration_whatever_unit_is_declared(tmp_path, label):
    with pytest.raises(RecordError) as caught:
        opened(tmp_path, table(f"time (s);{label}\n", TIMES, FIRST, parted=";"), unit="m/s2")
    assert caught.value.field in ("columns", "quantity", "layout")


@pytest.mark.parametrize(
    "head",
    [
        "Station: XYZ\nUnits: g\nTime  Acc\n",
        "Time;Acceleration, g\n",
        "Tiempo(seg);Aceleracion(g)\n",
    ],
)
def test_heads_that_leave_nothing_open_are_read(tmp_path, head):
    (record,) = opened(tmp_path, table(head, TIMES, FIRST, parted=";" if ";" in head else "  "))
    assert record.acceleration == pytest.approx(FIRST * 9.80665, abs=1e-5)
    assert record.time_step == pytest.approx(TIMES[1], rel=1e-9)


LANGUAGES = {
    "English": (
        "Time (s);Acc NS (gal);Acc EW (gal)", ["Station: A", "Sampling rate: 100 Hz", "Units: gal"], "Factor: 10",
    ),
    "Italian": (
        "Tempo (s);Accelerazione NS (gal);Accelerazione EO (gal)",
        ["Stazione: A", "Frequenza di campionamento: 100 Hz", "Unità di misura: gal"], "Fattore di scala: 10",
    ),
    "Spanish": (
        "Tiempo (s);Aceleración NS (gal);Aceleración EO (gal)",
        ["Estación: A", "Frecuencia de muestreo: 100 Hz", "Unidades: gal"], "Factor de escala: 10",
    ),
    "French": (
        "Temps (s);Accélération NS (gal);Accélération EO (gal)",
        ["Station : A", "Fréquence d'échantillonnage : 100 Hz", "Unité : gal"], "Facteur d'échelle : 10",
    ),
    "German": (
        "Zeit (s);Beschleunigung NS (gal);Beschleunigung OW (gal)",
        ["Station: A", "Abtastrate: 100 Hz", "Einheit: gal"], "Skalierung: 10",
    ),
    "Turkish": (
        "Zaman (s);İvme KG (gal);İvme DB (gal)",
        ["İstasyon: A", "Örnekleme frekansı: 100 Hz", "Birim: gal"], "Çarpan: 10",
    ),
    "Japanese": (
        "時間(s);加速度NS(gal);加速度EW(gal)", ["観測点: A", "サンプリング周波数: 100 Hz", "単位: gal"], "倍率: 10",
    ),
}  # fmt: skip
"""Language → names of columns, lines above a series, and a line on a factor."""


@pytest.mark.parametrize("language", LANGUAGES)
def test_heads_of_other_languages_are_read_as_the_english_one_is(tmp_path: Path, language: str) -> None:
    """Directions that are not known are said to be so, and a factor is asked, as it is in English."""
    names, lines, factor = LANGUAGES[language]
    of_columns = opened(tmp_path, table(f"{names}\n", TIMES, *WAVES[:2], parted=";"))
    assert len(of_columns) == 2
    for record, wave in zip(of_columns, WAVES, strict=False):
        assert record.acceleration == pytest.approx(wave / 100, abs=1e-7)
        is_unknown = record.azimuth is None
        assert (RecordKind.DIRECTION_UNKNOWN in {warning.kind for warning in record.warnings}) is is_unknown
    head = "\n".join(lines)
    (record,) = opened(tmp_path, table(f"{head}\n", FIRST))
    assert record.acceleration == pytest.approx(FIRST / 100, abs=1e-7)
    assert record.time_step == pytest.approx(0.01)
    with pytest.raises(AskedError):
        opened(tmp_path, table(f"{head}\n{factor}\n", FIRST))
    marked = "".join(f"# {line}\n" for line in (*lines, factor))
    with refused(UndeclaredError, "unit"):
        opened(tmp_path, table("".join(f"# {line}\n" for line in (*lines[:2], f"{lines[2]} * 100")), FIRST))
    (record,) = opened(tmp_path, table(marked, FIRST))
    assert RecordKind.FACTOR_NOT_APPLIED in {warning.kind for warning in record.warnings}


@pytest.mark.parametrize("language", LANGUAGES)
def test_rates_in_other_languages_contradict_an_answer(tmp_path: Path, language: str) -> None:
    content = table("\n".join(LANGUAGES[language][1][:2]) + "\n", FIRST)
    with pytest.raises(AskedError) as asked:
        opened(tmp_path, content)
    assert asked.value.question is not None
    answered(tmp_path, asked.value.question, "a gal, dt .005")
    with refused(RecordError, "answer", "a gal, dt .005"):
        opened(tmp_path, content)
    (tmp_path / NAME).unlink()
    answered(tmp_path, asked.value.question, "a gal, dt .01")
    assert opened(tmp_path, content)[0].acceleration == pytest.approx(FIRST / 100, abs=1e-7)


def test_one_line_that_declares_unit_and_step_stands_above_one_series(tmp_path):
    (record,) = opened(tmp_path, table("Acceleration time history, dt = 0.005 s, units g\n", FIRST))
    assert record.acceleration == pytest.approx(FIRST * 9.80665, abs=1e-5)
    assert record.time_step == 0.005


def test_names_parted_by_blanks_may_have_units_of_their_own(tmp_path):
    rows = [np.arange(1, TIMES.size + 1), TIMES, FIRST, FIRST[::-1]]
    east, north = opened(tmp_path, table("no time(s) EW(gal) NS(gal)\n", *rows, parted=" "))
    assert (east.component, north.component) == ("EW", "NS")
    assert north.acceleration == pytest.approx(FIRST[::-1] * 0.01, abs=1e-7)


@pytest.mark.parametrize(
    ("unit", "factor"),
    [("ft/s2", 0.3048), ("in/s2", 0.0254), ("m s-2", 1.0), ("cm.s^-2", 0.01), ("m s**-2", 1.0), ("m/s*s", 1.0),
     ("milli-g", 9.80665e-3), ("µm/s²", 1e-6), ("gals", 0.01)],
)  # fmt: skip
def test_more_spellings_of_units(unit, factor):
    assert acceleration_factor(unit) == pytest.approx(factor, rel=1e-12)


@pytest.mark.parametrize(
    "head",
    ["Time,Acc,Vel,Disp\n", "t,a (m/s2),v (m/s),u (m)\n", "Time Acc Vel Disp\n"],
)
def test_velocity_and_displacement_beside_acceleration_are_left_out(tmp_path, head):
    parted = "," if "," in head else " "
    (record,) = opened(tmp_path, table(head, TIMES, FIRST, VELOCITY, VELOCITY, parted=parted), unit="m/s2")
    assert np.allclose(record.acceleration, FIRST, atol=1e-6)


@pytest.mark.parametrize("head", ["", "t a v\n", "t Ac Des\n", "Time Ag Q1\n"])
def test_a_velocity_that_nothing_calls_so_is_asked_for(tmp_path, head):
    with refused(AskedError, "layout"):
        opened(tmp_path, table(head, TIMES, FIRST, VELOCITY, parted=" "), unit="m/s2")


@pytest.mark.parametrize("units", ["s,g,g,g\n", "(s),(g),(g),(g)\n"])
def test_units_may_stand_below_the_names(tmp_path, units):
    records = opened(tmp_path, table(f"Time,NS,EW,UD\n{units}", TIMES, *WAVES))
    assert [(record.component, record.source.unit) for record in records] == [
        ("NS", "g"),
        ("EW", "g"),
        ("UD", "g"),
    ]


@pytest.mark.parametrize(
    ("warnings", "step"),
    [("# units: cm/s2\n# dt = 0.005 s\n", 0.005), ("% Unidades: cm/s2\n% Tasa de muestreo: 200 Hz\n", 0.005),
     ("$ acceleration in cm/s2\n$ sampling interval (s): 0.02\n", 0.02)],
)  # fmt: skip
def test_warnings_declare_unit_and_step(tmp_path, warnings, step):
    (record,) = opened(tmp_path, table(warnings, 100 * FIRST))
    assert record.time_step == pytest.approx(step) and np.allclose(record.acceleration, FIRST, atol=1e-7)
    with refused(RecordError, "time_step", 0.01):
        opened(tmp_path, table(warnings, 100 * FIRST), time_step=0.01)


@pytest.mark.parametrize(
    "warnings",
    ["# PGA: 0.35 (g)\n", "# scale factor in g\n", "# acc in g\n# units: gal\n", "# Geoscope (G)\n"],
)
def test_a_warning_on_the_peak_or_two_that_differ_declare_no_unit(tmp_path, warnings):
    with refused(RecordError, "unit"):
        opened(tmp_path, table(warnings, FIRST), time_step=0.01)


def test_directions_in_the_last_warning_name_the_columns(tmp_path):
    records = opened(tmp_path, table("# made\n# EW NS UD\n", *WAVES), unit="m/s2", time_step=0.01)
    assert [(record.azimuth, record.vertical) for record in records] == [
        (90, False),
        (0, False),
        (None, True),
    ]


def test_times_may_stand_in_the_last_column(tmp_path):
    (record,) = opened(tmp_path, table("NS (m/s2),time (s)\n", FIRST, TIMES))
    assert record.time_step == 0.01 and np.allclose(record.acceleration, FIRST, atol=1e-6)


@pytest.mark.parametrize("above", ["600\n100\n", "0.01\n"])
def test_a_rate_or_a_step_above_the_samples_is_no_sample(tmp_path, above):
    step = None if "600" in above else 0.01
    (record,) = opened(tmp_path, table(above, FIRST), unit="m/s2", time_step=step)
    assert record.time_step == 0.01 and np.allclose(record.acceleration, FIRST, atol=1e-6)


def test_a_spreadsheet_in_utf_16_with_quotes_and_a_line_for_itself(tmp_path):
    content = table("Time (s);Acc (g)\n", TIMES, FIRST, parted=";")
    quoted = (
        "sep=;\n" + "\n".join('"' + line.replace(";", '";"') + '"' for line in content.splitlines()) + "\n"
    )
    for text in (content.encode("utf-16"), quoted.encode(), content.replace(".", ",").encode("utf-16")):
        (record,) = opened(tmp_path, text)
        assert record.source.unit == "g" and np.allclose(record.acceleration, 9.80665 * FIRST, atol=1e-5)


def test_the_exponents_of_fortran(tmp_path):
    content = "".join(f"{value:15.7E}\n" for value in FIRST).replace("E", "D")
    (record,) = opened(tmp_path, content, unit="m/s2", time_step=0.01)
    assert np.allclose(record.acceleration, FIRST, atol=1e-7)


def test_a_count_and_a_step_above_two_columns(tmp_path):
    (record,) = opened(tmp_path, "600 0.01\n" + table("", TIMES, FIRST, parted=" "), unit="m/s2")
    assert record.acceleration.size == 600 and record.time_step == 0.01


def test_three_channels_of_which_none_is_called_vertical_are_told(tmp_path):
    content = table("time (s),Ch1 (m/s2),Ch2 (m/s2),Ch3 (m/s2)\n", TIMES, *WAVES)
    for record in opened(tmp_path, content):
        kinds = {warning.kind for warning in record.warnings}
        assert RecordKind.SOME_MAY_BE_VERTICAL in kinds
        assert RecordKind.CHANNEL_OF_VELOCITY not in kinds
    named = table("time (s),X (m/s2),Y (m/s2),Z (m/s2)\n", TIMES, *WAVES)
    assert RecordKind.SOME_MAY_BE_VERTICAL not in {
        one_warning.kind for one_warning in opened(tmp_path, named)[0].warnings
    }


def test_a_column_of_a_floor_is_told(tmp_path):
    _, roof = opened(tmp_path, table("time (s),ground (g),roof (g)\n", TIMES, FIRST, WAVES[1]))
    assert RockingWarning.of(RecordKind.IN_A_STRUCTURE, place="roof") in roof.warnings


def test_text_above_a_table_is_passed_over_where_nothing_is_left_open(tmp_path):
    above = "Input file: made\nTime step: 0.01 sec\n\nTime   Acceleration  Velocity\n[sec]   [g]   [cm/sec]\n"
    (record,) = opened(tmp_path, table(above, TIMES, FIRST, 981 * VELOCITY, parted=" "))
    assert record.source.unit == "g" and np.allclose(record.acceleration, 9.80665 * FIRST, atol=1e-5)
    above = "INSTITUTO GEOFISICO\nUNIDADES : cm/s2\nAceleracion maxima (g): 0.3\n\n   T  Z  N  E\n"
    upwards, north, east = opened(tmp_path, table(above, TIMES, *WAVES, parted=" "))
    assert (upwards.vertical, north.azimuth, east.azimuth) == (True, 0, 90) and north.source.unit == "cm/s2"


@pytest.mark.parametrize(
    "above",
    [
        "Scale factor 0.5\nTime (s) Acc (g)\n",
        "made\nTime Acc\n",
        "made\nUnits: gal\nNS EW\n",
        "made\nno names\n",
        "made\nat home\nTime Acc\n",
    ],
)
def test_what_text_and_names_leave_open_is_asked_for(tmp_path, above):
    with pytest.raises(AskedError):
        opened(tmp_path, table(above, TIMES, FIRST, parted=" "))


def test_quoted_cells_may_hold_commas(tmp_path):
    rows = "".join(f'"{a:.2f}","{b:.6f}"\n'.replace(".", ",") for a, b in zip(TIMES, FIRST, strict=True))
    (record,) = opened(tmp_path, '"Time, s","Acc, g"\n' + rows)
    assert record.time_step == 0.01 and np.allclose(record.acceleration, 9.80665 * FIRST, atol=1e-5)


@pytest.mark.parametrize(
    ("name", "named"),
    [
        ("ELC_vel.txt", ("quantity", "velocity")),
        ("disp-x.dat", ("quantity", "displacement")),
        ("S.semv", ("quantity", "velocity")),
    ],
)
def test_a_name_that_speaks_of_another_quantity_is_asked(tmp_path, name, named):
    path = tmp_path / name
    path.write_text(table("", TIMES, FIRST, parted=" "), encoding="utf-8")
    with refused(RecordError, *named):
        read(path, unit="m/s2")
    path.rename(tmp_path / "Velletri_NS.txt")
    assert read(tmp_path / "Velletri_NS.txt", unit="m/s2")


@pytest.mark.parametrize(
    ("content", "word"),
    [
        (b"\x93NUMPY\x01\x00v\x00", "numpy"),
        (b"MATLAB 5.0 MAT-file, made", "MATLAB"),
        (b'{"dt": 0.01}', "JSON"),
    ],
)
def test_files_of_programs_are_named(tmp_path, content, word):
    with pytest.raises(RecordError, match=word):
        opened(tmp_path, content)


@pytest.mark.parametrize(
    ("title", "unit"), [("Made at Geoscope (G)", None), ("Acceleration (G)", "g"), ("made, in g", None)]
)
def test_a_title_declares_a_unit_only_of_the_numbers(tmp_path, title, unit):
    content = table(f"{title}\n600 0.01 NPTS, STEP\n", FIRST)
    if unit is None:
        with refused(RecordError, "unit"):
            opened(tmp_path, content)
    else:
        assert opened(tmp_path, content)[0].source.unit == unit


@pytest.mark.parametrize(
    ("name", "along", "vertical"),
    [
        ("Norte", 0.0, False),
        ("Sud", 180.0, False),
        ("East-West", 90.0, False),
        ("E–W", 90.0, False),
        ("Kuzey-Güney", 0.0, False),
        ("N45°E", 45.0, False),
        ("Düşey", None, True),
        ("上下", None, True),
        ("roof vertical", None, True),
        ("Ch. 3 - HNZ", None, True),
        ("horizontal and vertical", None, False),
    ],
)
def test_names_of_directions(name, along, vertical):
    assert (Direction.of(name).azimuth, Direction.of(name).vertical) == (along, vertical)


@pytest.mark.parametrize("head", ["s,m/s2\n", "sec,(m/s2)\n", "[s],[m/s²]\n"])
def test_a_head_of_units_alone_is_one(tmp_path, head):
    (record,) = opened(tmp_path, table(head, TIMES, FIRST))
    assert record.acceleration == pytest.approx(FIRST, abs=1e-6)


def test_a_suffix_is_a_unit_beside_times(tmp_path):
    for head in ("time_s,acc_g\n", "t,acc_g\n", "time,acc_g\n"):
        (record,) = opened(tmp_path, table(head, TIMES, FIRST))
        assert record.acceleration == pytest.approx(FIRST * 9.80665, abs=1e-5)
    with refused(RecordError, "unit"):
        opened(tmp_path, table("acc_g\n", FIRST), time_step=0.01)


def test_numbers_of_columns_are_no_azimuths(tmp_path):
    (record,) = opened(tmp_path, table(",0\n", np.arange(600), FIRST), unit="m/s2", time_step=0.01)
    assert record.azimuth is None
    east = opened(tmp_path, table("time,0,90\n", TIMES, *WAVES[:2]), unit="m/s2")[1]
    assert east.azimuth == 90.0


def test_the_filling_of_the_last_row_is_left_out(tmp_path):
    numbers = [f"{value:.6f}" for value in FIRST] + ["NaN"] * 2
    rows = "\n".join(" ".join(numbers[at : at + 7]) for at in range(0, 602, 7)) + "\n"
    (record,) = opened(tmp_path, "# Component: HNZ\n# units: m/s2, dt = 0.01 s\n" + rows)
    assert record.vertical
    assert record.acceleration == pytest.approx(FIRST, abs=1e-6)
    assert RecordKind.ROW_FILLED_UP in {warning.kind for warning in record.warnings}
    with refused(RecordError, "samples", "NaN"):
        opened(tmp_path, "# units: m/s2, dt = 0.01 s\n" + rows.replace(numbers[300], "NaN", 1))


@pytest.mark.parametrize(
    ("last", "is_left_out"),
    [("6.000,NaN,NaN", True), ("NaN,nan,NaN\n\n", True), ("6.000,NaN,0.1", False), ("6.000,0.1,NaN", False)],
)
def test_a_last_row_of_columns_without_a_value_is_left_out(tmp_path, last, is_left_out):
    page = table("t (s),NS (m/s2),EW (m/s2)\n", TIMES, *WAVES[:2]) + last
    if not is_left_out:
        with refused(RecordError, "samples", "NaN"):
            opened(tmp_path, page)
        return
    for record, wave in zip(opened(tmp_path, page), WAVES, strict=False):
        assert record.acceleration == pytest.approx(wave, abs=1e-5)
        assert RecordKind.ROW_FILLED_UP in {warning.kind for warning in record.warnings}


@pytest.mark.parametrize(
    "others", ["gx,gy", "gyro_x,mag_z", "roll,pitch", "Gyro X (deg/s),Mag X (uT)", "wx (dps),T (bar)"]
)
def test_the_other_axes_of_a_sensor_are_no_accelerations(tmp_path, others):
    content = table(f"t,ax,az,{others}\n", TIMES, *WAVES, FIRST[::-1])
    with pytest.raises(AskedError) as asked:
        opened(tmp_path, content, unit="m/s2")
    answered(tmp_path, asked.value.question, "t, X m/s2, Z m/s2, -, -")
    records = opened(tmp_path, content)
    assert [(record.component, record.vertical) for record in records] == [("X", False), ("Z", True)]
