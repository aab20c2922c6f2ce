"""What the lines of text above numbers say of unit, time step and direction."""

from pathlib import Path

import numpy as np
import pytest

from rocking.errors import RecordError
from rocking.records.claims import Declarations
from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning
from tests.refusals import refused
from tests.unit.records.test_labels import FIRST, TIMES, WAVES, opened, table

BARE = table("", FIRST)
TIMED = table("time (s),acc (m/s2)\n", TIMES, FIRST)


@pytest.mark.parametrize(
    ("comment", "component", "azimuth", "vertical"),
    [
        ("Componente: HNZ", "HNZ", None, True),
        ("COMP: UD", "UD", None, True),
        ("COMP. EW", "EW", 90.0, False),
        ("Channel: HNN", "HNN", 0.0, False),
        ("Sensor orientation: N26W (reference)", "N26W", 334.0, False),
        ("Kobe, KJMA, vertical component", "vertical", None, True),
        ("Kobe 1995, vertical ground motion", "vertical", None, True),
        ("KOBE 1995 KJMA UP", "UP", None, True),
        ("El Centro 1940 N00E, corrected", "N00E", 0.0, False),
        ("El Centro 1940 North South Component (Peknold Version)", "North-South", 0.0, False),
        ("IMPERIAL VALLEY 10/15/79 2319, EL CENTRO ARRAY 6, 230", "230", 230.0, False),
    ],
)
@pytest.mark.parametrize(
    "above", ["# {}\n" + TIMED, "{}\n" + TIMED, "# {}\n" + BARE, "{}\n600 0.01\n" + BARE]
)
def test_the_direction_of_a_lone_series_is_what_its_comments_say(
    tmp_path: Path, comment, component, azimuth, vertical, above
):
    options = {} if "m/s2" in above else {"unit": "m/s2"}
    if above == "# {}\n" + BARE:
        options["time_step"] = 0.01
    (record,) = opened(tmp_path, above.format(comment), **options)
    assert (record.component, record.azimuth, record.vertical) == (component, azimuth, vertical)
    assert record.acceleration == pytest.approx(FIRST, abs=1e-6)


@pytest.mark.parametrize(
    "comment",
    [
        "Channel 1", "Channel: 101", "3 component accelerometer", "Components: NS, EW, UD", "Horizontal component",
        "a vertical fault", "RECORD OF STATION ONE", "NS and UD components", "Component: H1", "direction unknown",
        "Site class E ground motion", "class E record", "station N record", "Kobe, 600", "Kobe, 200", "A, B, 600",
    ],
)  # fmt: skip
def test_what_names_no_direction_declares_none(comment):
    assert Declarations.of([comment]).only("direction") is None


def test_two_comments_that_differ_declare_nothing():
    assert Declarations.of(["Component: NS", "Component: EW"]).only("direction") is None


def test_a_direction_at_the_head_of_a_column_is_not_overruled(tmp_path: Path):
    (record,) = opened(tmp_path, "# Component: UD\n" + table("time (s),NS (m/s2)\n", TIMES, FIRST))
    assert (record.azimuth, record.vertical) == (0.0, False)


@pytest.mark.parametrize(
    "comment",
    ["dt = 0.005 s", "Time step of 0.005 s", "INTERVALO DE MUESTREO (SEGUNDOS): 0.005", "Muestreo : 0.005 seg",
     "Sampling rate (Hz),200", "Sampling frequency: 200 Hz", "Frecuencia de muestreo: 200", "Time step 0.005, units g",
     "equal spacing of 0.005 sec", "at intervals of 0.005 sec.", "sampled at 200 Hz", "Record (dt = 0.005 s)",
     "dt (ms) = 5", "Abtastintervall: 5 ms", "Δt = 0.005 s", "dt = 1/200 s", "paso de tiempo: 0.005 s",
     "SAMPLING RATE (HZ) 200", "intervallo di campionamento: 0,005 s",
     "taxa de amostragem: 200 Hz", "örnekleme aralığı (sn): 0.005", "采样率: 200",
     "шаг по времени: 0.005 с", "частота дискретизации: 200 Гц", "ρυθμός δειγματοληψίας: 200 Hz", "fs: 0.2 kHz",
     "delta_t = 0.005 s", "Samplerate: 200 Hz", "freq. campionamento: 200 Hz", "サンプリングレート: 200 Hz"],
)  # fmt: skip
def test_comments_declare_the_step(comment):
    assert Declarations.of([comment]).only("time_step") == pytest.approx(0.005, rel=1e-12)


@pytest.mark.parametrize(
    "comment",
    [
        "Unit,gal",
        "Units;cm/s2",
        "UNIDADES: cm/s^2",
        "units cm/s/s",
        "units of gal",
        "(cm/s2) of acceleration",
        "unidade de aceleração: cm/s2",
        "ACC_UNITS=gal",
        "'acc_unit': 'cm/s2'",
        "yunit: cm/s^2",
        "aceleración en cm/seg2",
        "единицы: см/с²",
        "Μονάδα: gal",
        "ускорение, cm s^-2",
        "加速度(gal)",
        "values given in cm / s2.",
        "ivme (cm/sn²)",
    ],
)
def test_comments_declare_the_unit(comment):
    assert Declarations.of([comment]).only("unit") in ("gal", "cm/s2")


COLOMBIA = """SERVICIO GEOLOGICO COLOMBIANO- RED NACIONAL DE ACELEROGRAFOS DE COLOMBIA
SISMO DE PRUEBA 2017/01/12 16:06:32 MW=5.3
CODIGO DE LA ESTACION: CPRU
LATITUD DE LA ESTACION (GRADOS): 6.2
DISTANCIA EPICENTRAL: 65.466 km
INTERVALO DE MUESTREO (SEGUNDOS): 0.01
NUMERO DE DATOS: 600
UNIDADES: cm/s^2
ESCALA MAXIMA (G): 2
TIPO DE DATOS: NO CORREGIDO
         EW                  VER                  NS
"""


def test_three_columns_of_colombia_are_read_below_their_header(tmp_path: Path):
    columns = [wave * 100 for wave in WAVES]
    east, up, north = opened(tmp_path, table(COLOMBIA, *columns, parted="    "))
    assert [record.azimuth for record in (east, north)] == [90.0, 0.0]
    assert up.vertical
    for record, wave in zip((east, up, north), WAVES, strict=True):
        assert record.acceleration == pytest.approx(wave, abs=1e-7)
        assert record.time_step == 0.01


EL_CENTRO = """Data for El Centro 1940 North South Component (Peknold Version)
600 points at equal spacing of 0.01 sec
Points are listed in the format of 8F10.5, i.e., 8 points across in
a row with 5 decimal places
The units are (g)
*** Begin data ***
"""


@pytest.mark.parametrize("mark", ["", "#"])
def test_a_wrapped_series_is_read_below_prose_that_leaves_nothing_open(tmp_path: Path, mark):
    head = "".join(f"{mark}{line}\n" for line in EL_CENTRO.splitlines())
    numbers = [f"{value:10.5f}" for value in FIRST]
    rows = "\n".join("".join(numbers[at : at + 8]) for at in range(0, 600, 8))
    (record,) = opened(tmp_path, head + rows + "\n")
    assert (record.azimuth, record.time_step) == (0.0, 0.01)
    assert record.acceleration == pytest.approx(FIRST * 9.80665, abs=6e-5)


def test_three_columns_below_prose_are_asked(tmp_path: Path):
    with refused(RecordError, "layout"):
        opened(tmp_path, table("units g, dt = 0.01 s\nthree channels\n", *WAVES, parted="  "))


def wrapped(numbers, per_row: int) -> str:
    cells = [f"{value:.5f}" for value in numbers]
    return "\n".join(" ".join(cells[at : at + per_row]) for at in range(0, len(cells), per_row)) + "\n"


@pytest.mark.parametrize(
    ("above", "per_row"), [("", 1), ("", 5), ("", 8), ("600\n", 1), ("600\n0.01\n", 1), ("0.01\n600\n", 1)]
)
def test_a_series_below_one_title_is_read_once_unit_and_step_are_declared(tmp_path: Path, per_row, above):
    step = {} if "0.01" in above else {"time_step": 0.01}
    content = "El Centro 1940\n" + above + wrapped(FIRST, per_row)
    (record,) = opened(tmp_path, content, unit="m/s2", **step)
    assert record.acceleration == pytest.approx(FIRST, abs=6e-6)
    assert record.time_step == 0.01
    with refused(RecordError, "unit"):
        opened(tmp_path, content)


@pytest.mark.parametrize("title", ["El Centro, scale factor 2", "UNITS: 0.1 mm", "a = counts"])
def test_a_title_that_may_speak_of_a_factor_is_asked(tmp_path: Path, title):
    with refused(RecordError, "layout"):
        opened(tmp_path, title + "\n" + wrapped(FIRST, 8), unit="m/s2", time_step=0.01)


def test_a_header_of_whole_numbers_is_no_motion(tmp_path: Path):
    with refused(RecordError, "layout"):
        opened(tmp_path, "TITLE\n1940 5 18 600 0\n" + wrapped(FIRST, 5), unit="gal", time_step=0.01)
    (record,) = opened(tmp_path, "TITLE\n0 0 0 0 0\n" + wrapped(FIRST, 5), unit="gal", time_step=0.01)
    assert record.acceleration.size == 605


@pytest.mark.parametrize(
    "end", ["# end\n", "END\n", "End of data", "EOF\n", "\n\n// 600 rows\n", "}\n", "];\n"]
)
def test_what_ends_the_numbers_is_no_number(tmp_path: Path, end):
    (record,) = opened(tmp_path, TIMED + end)
    assert record.acceleration == pytest.approx(FIRST, abs=1e-6)
    with refused(RecordError, "samples", "max"):
        opened(tmp_path, TIMED + "max 3.2\n")


@pytest.mark.parametrize(
    "comment",
    ["600 points at 0.01 s", "NPTS = 600", "NUMERO DE DATOS: 600", "Number of points: 600, 8 points across",
     "NPTS 600", "Anzahl der Werte: 600", "numero di punti: 600", "número de amostras: 600", "データ数: 600",
     "число точек: 600", "nokta sayısı: 600", "αριθμός σημείων: 600", "Samples = 600", "npoints = 600",
     "cantidad de datos: 600"],
)  # fmt: skip
def test_the_number_of_samples_that_comments_declare_is_held_against_them(tmp_path: Path, comment):
    head = f"# {comment}\n# units: m/s2\n# dt = 0.01 s\n"
    assert opened(tmp_path, head + wrapped(FIRST, 8))[0].acceleration.size == 600
    with refused(RecordError, "samples", 600):
        opened(tmp_path, head + wrapped(FIRST[:592], 8))
    (record,) = opened(tmp_path, head + wrapped(np.append(FIRST, np.zeros(4)), 8))
    assert RockingWarning.of(RecordKind.SAMPLES_SURPLUS, declared=600, held=604) in record.warnings


@pytest.mark.parametrize(
    "above",
    ["dt = 0.01\n", "El Centro 1940\ndt = 0.01 s\n", "Sampling rate: 100 Hz\nComponent: NS\n600 points\n"],
)
def test_lines_each_of_which_declares_something_leave_only_the_unit_open(tmp_path: Path, above):
    (record,) = opened(tmp_path, above + wrapped(FIRST, 1), unit="m/s2")
    assert record.time_step == 0.01
    assert record.acceleration == pytest.approx(FIRST, abs=6e-6)
    with refused(RecordError, "layout"):
        opened(tmp_path, above + "k = 7\n" + wrapped(FIRST, 1), unit="m/s2")


FACTORS = [
    "acceleration x 1000 (g)", "Accel. in cm/s2 * 100", "units: m/s2 (x0.01)", "acceleration in g times 1000",
    "acceleration in g, multiplied by 1000", "units: g; fattore di scala 2", "unit = gal x 0.1",
]  # fmt: skip


@pytest.mark.parametrize("comment", FACTORS)
def test_a_unit_beside_a_factor_is_not_taken(tmp_path: Path, comment):
    content = f"# {comment}\n" + table("t,acc\n", TIMES, FIRST)
    with refused(RecordError, "unit"):
        opened(tmp_path, content)
    (record,) = opened(tmp_path, content, unit="g")
    assert record.acceleration == pytest.approx(FIRST * 9.80665, abs=1e-5)


@pytest.mark.parametrize("comment", ["scale factor: 9.81", "Faktor 2", *FACTORS[:2], "gain 1.5"])
def test_a_factor_in_a_comment_is_told_and_not_applied(tmp_path: Path, comment):
    (record,) = opened(tmp_path, f"# {comment}\n" + TIMED)
    assert record.acceleration == pytest.approx(FIRST, abs=1e-6)
    assert RockingWarning.of(RecordKind.FACTOR_NOT_APPLIED, text=comment) in record.warnings
    (record,) = opened(tmp_path, "# number of points: 600\n" + TIMED)
    assert RecordKind.FACTOR_NOT_APPLIED not in {warning.kind for warning in record.warnings}
