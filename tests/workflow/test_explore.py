"""The page to explore a study, opened by a browser that reaches no host: choose, filter, play, without a complaint."""

import base64
import json
import math
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import detrend

from rocking.assessment.cracks import cracked
from rocking.assessment.rows import ComparisonRow, VerdictRow
from rocking.assessment.scene import load_scenes
from rocking.catalogue.catalogue import load_catalogue
from rocking.motion.integration import integrate
from rocking.pulses import extract_pulses
from rocking.reports.against import in_words
from rocking.reports.explore import BINS, RECORD_SCRIPT, drawings, explore_page, extremes
from rocking.reports.printing import number
from rocking.signal.processing import displacement
from rocking.sine_pulse import predict_maximum
from rocking.study.job import Study
from rocking.study.settings import read_settings
from rocking.tables import read_table
from tests.unit.study.made_jobs import outcomes_in, worked
from tests.workflow.write_study import write_study

PATIENCE = 100
"""s; a loaded machine, not the page, is what takes so long."""
HOSTILE = '</script><b>"arch"&\''
STRUCTURES = f"""
- {{name: pier, type: block, breadth_m: 0.8, height_m: 6.0}}
- {{name: parapet, type: block, breadth_m: 0.1, height_m: 1.5}}
- {{name: {json.dumps(HOSTILE)}, type: arch, radius_m: 10, thickness_m: 1.5, embrace_angle_deg: 157.5}}
- {{name: wall, type: wall, height_m: 3.2, hinge_height_m: 1.6, thickness_m: 0.25}}
- {{name: colonnade, type: frame, column_breadth_m: 1.1, column_height_m: 8.0, columns: 4, beam_mass_ratio: 0.3}}
- {{name: spire, type: spire, width_m: 3.0, height_m: 15.0, wall_thickness_m: 0.25, crack_height_m: 5.0}}
- {{name: vault, type: arch_on_piers, radius_m: 5, thickness_m: 0.8, embrace_angle_deg: 150, pier_width_m: 2.2,
   pier_height_m: 4}}
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory) -> tuple[Path, Study, list]:
    """A study of one strong record, assessed, with its page; one record more cannot be read."""
    folder = tmp_path_factory.mktemp("explore") / "study"
    write_study(folder, 2, duration=8.0)
    (folder / "records" / "synthetic_00001.AT2").write_text("no record", encoding="utf-8")
    return _explored(folder, STRUCTURES)


def _explored(folder: Path, structures: str) -> tuple[Path, Study, list]:
    """The page of the study of `structures` in a folder, what assessed it, and its records."""
    (folder / "structures.yaml").write_text(structures, encoding="utf-8")
    results = folder / "results"
    paths = {"catalogue": str(folder / "records" / "catalogue.csv"), "results": str(results)}
    choices = {"ensemble": {"members": 16}, "candidates": 0, "processing_variants": False}
    study = Study(load_scenes(folder / "structures.yaml"), read_settings(choices | paths))
    at = {"station_latitude": 37.5, "station_longitude": -122.2}
    epicentre = {"epicentre_latitude": 37.1, "epicentre_longitude": -121.9}
    records = [replace(record, **at, **epicentre) for record in load_catalogue(paths["catalogue"])]
    worked(records, study, results)
    (results / "summary").mkdir(parents=True, exist_ok=True)
    page = results / "summary" / "study.html"
    contents = [outcome.page for outcome in outcomes_in(results, records)]
    page.write_bytes(explore_page(contents, study.structures, f"A study of {HOSTILE}"))
    return page, study, list(records)


@pytest.fixture(scope="module")
def content(study) -> dict:
    """What the page and the files of its records carry."""
    return _content(study[0])


def _content(page: Path) -> dict:
    pattern = r'<script type="application/json" id="content">(.*?)</script>'
    (text,) = re.findall(pattern, page.read_text(encoding="utf-8"))
    content = json.loads(text)
    assert not any("motions" in record for record in content["records"]), "which the cells do not show"
    for record in content["records"]:
        own = (page.parents[1] / record["id"] / RECORD_SCRIPT).read_text(encoding="utf-8")
        record |= json.loads(own.removeprefix("rockingRecord(").removesuffix(");\n"))
    return content


def unpacked(packed: dict) -> np.ndarray:
    return np.frombuffer(base64.b64decode(packed["data"]), "<i2") * packed["scale"]


def test_a_trace_keeps_its_peaks_and_its_places():
    times = np.arange(0.0, 20.0, 0.001)
    values = 0.1 * np.sin(times)
    values[7777] = -3.0
    envelope = extremes(times, values, 0.0, 20.0)
    assert envelope.size == BINS and envelope.min() == -3.0
    assert abs((envelope.argmin() + 0.5) * 20 / BINS - times[7777]) < 20 / BINS
    # two samples of a line fill two of the bins; another has the value at its middle
    sparse = extremes(np.array([0.0, 6.0]), np.array([0.0, 12.0]), 0.0, 6.0)
    middles = (np.arange(BINS) + 0.5) * 12.0 / BINS
    assert np.abs(sparse - middles).max() <= 6.0 / BINS * (1 + 1e-9)
    assert sparse[1:-1] == pytest.approx(middles[1:-1], rel=1e-12) and sparse[-1] == 12.0


def test_drawings_are_those_of_the_structure(study):
    for structure in study[1].structures.values():
        frames = drawings(structure)
        points = unpacked(frames[17]["points"]).reshape(-1, 2)
        expected = np.vstack(structure.outline(frames[17]["rotation"]))
        count = sum(frames[17]["parts"])
        assert len(points) == count + frames[17]["hinges"] + 2 * len(frames[17]["marks"])
        assert np.allclose(points[:count], expected, atol=np.abs(points).max() / 32767)
        signs = {frame["rotation"] > 0 for frame in frames}
        assert signs == ({True} if structure.mechanism().one_sided else {True, False})


def test_the_page_carries_the_rotation_that_was_integrated(content, study):
    """The history that moves the drawing has the largest rotation of an integration done here."""
    _, assessed, records = study
    drawn = {name: item for name, item in content["records"][0]["cases"].items() if "history" in item}
    accelerograms, _ = assessed.open(records[0])
    component = accelerograms[0].component
    rows = read_table(ComparisonRow, study[0].parents[1] / records[0].id)
    cracks = {row.structure: row.crack for row in rows if row.component == component}
    for name, figure in drawn.items():
        mechanism = cracked(assessed.structures[name], cracks[name]).mechanism()
        response = integrate(mechanism, accelerograms[0], assessed.assessment.tolerance)
        largest = np.abs(unpacked(figure["history"])).max()
        # between the steps of a history the peak may lie a little higher; a fall is followed farther
        expected = response.rotation_ratio
        assert largest > 1 if math.isinf(expected) else math.isclose(largest, expected, rel_tol=0.01)
    assert drawn


def test_each_side_of_a_front_is_turned_by_its_own_critical_rotation(tmp_path):
    """Inwards a storey that is thinner above has another centre of mass over its toe than outwards."""
    sizes = "storey_heights_m: [3.0, 3.0], thicknesses_m: [0.6, 0.3], crack_height_m: 0"
    front = f"- {{name: front, type: facade, {sizes}, unit_weight_kN_m3: 20}}\n"
    write_study(tmp_path, 1, duration=8.0)
    page, _, _ = _explored(tmp_path, front)
    ((name, case),) = _content(page)["records"][0]["cases"].items()
    # areas 1.8 and .9 m², their middles .3 and .15 m from the outer face and 1.5 and 4.5 m up; thickness .6 m below
    outwards = (1.8 * 0.3 + 0.9 * 0.15) / 2.7
    height = (1.8 * 1.5 + 0.9 * 4.5) / 2.7
    expected = [math.atan2(outwards, height), math.atan2(0.6 - outwards, height)]
    assert case["critical"] == pytest.approx(expected, rel=1e-4), name


def test_the_page_carries_the_closed_form_of_each_case_and_the_path_of_the_ground(content, study):
    """Without the line that best fits the displacement, by scipy; each bin holds one of the samples within it."""
    _, assessed, records = study
    (accelerogram,), _ = assessed.open(records[0])
    pulse = extract_pulses(accelerogram).dominant
    for name in ("pier", "parapet", "wall"):
        block = assessed.structures[name].mechanism().equivalent_block()
        largest = predict_maximum(block, pulse).rotation_ratio
        assert content["records"][0]["cases"][name]["predicted"] == pytest.approx(min(largest, 1e9), rel=1e-5)
    ((_, motion),) = content["records"][0]["motions"].items()
    path = detrend(displacement(accelerogram))
    drawn = unpacked(motion["displacement"])
    expected = extremes(accelerogram.times, path, 0.0, accelerogram.duration)
    assert drawn == pytest.approx(expected, abs=np.abs(path).max() / 30000)


def test_the_numbers_beside_a_history_are_those_of_page_two(content, study):
    """Of comparison.csv, under the component that turns the structure farthest."""
    rows = read_table(ComparisonRow, study[0].parents[1] / study[2][0].id)
    moving = {name: item for name, item in content["records"][0]["cases"].items() if "history" in item}
    for name, case in moving.items():
        row = max(
            (row for row in rows if row.structure == name), key=lambda row: row.integrated_rotation_ratio
        )
        ratios = row.printed_rotation_ratio, row.predicted_rotation_ratio, row.integrated_rotation_ratio
        expected = [in_words(ratio) for ratio in ratios]
        if row.predicted_rotation_ratio == row.integrated_rotation_ratio == math.inf and not row.sees_fall:
            expected[1] = "falls later"
        assert case["numbers"] == expected
        assert case["outside"] == (row.printed_holds is False) and case["component"] == row.component
        assert f"λ {number(row.uplift_multiplier)} " in case["beside"][0] and row.crack in case["beside"][1]
    resting = set(study[1].structures) - set(moving)
    assert len(moving) > 2 and all(name in content["records"][0]["at_rest"] for name in resting)


def test_the_page_tells_the_reserve_that_the_table_holds(content, study):
    """The factors of verdicts.csv stand in the words; those of a spire, of its stacks, too, leave nothing out."""
    outcomes = outcomes_in(study[0].parent.parent, study[2])
    rows = {row.structure: row for outcome in outcomes for row in outcome.rows[VerdictRow]}
    cases = content["records"][0]["cases"]
    assert cases
    for name, case in cases.items():
        reserve = rows[name].reserve
        assert f"Reserve: {reserve}" in case["text"] if reserve else "Reserve:" not in case["text"]
    assert "spire" not in cases or "mechanism alone" not in cases["spire"]["text"]


def test_every_case_and_every_failure_is_on_the_page(content, study):
    assert [item["id"] for item in content["records"]] == ["synthetic_00000", "synthetic_00001"]
    assert list(content["records"][0]["cases"]) == list(study[1].structures)
    assert all("sha256" in case["text"] for case in content["records"][1]["cases"].values())
    assert HOSTILE in [one_item["name"] for one_item in content["structures"]]


def test_the_page_loads_nothing(study):
    text = study[0].read_text(encoding="utf-8")
    assert not re.findall(r"""(?:src|href)=["'](?!#|data:)""", re.sub(r"xlink:href=\"#", "#", text))
    assert "@import" not in text and "fetch(" not in text
    assert text.count("</script>") == 2  # that of the content and that of the script


@pytest.fixture
def page(study, browser) -> Callable:
    """The page, freshly opened; call it with a selector to get what stands there. It complains of nothing."""
    from selenium.webdriver.support.ui import WebDriverWait

    browser.get(study[0].as_uri())
    chosen = lambda at: at.find_elements("css selector", "button[aria-pressed='true']")  # noqa: E731
    WebDriverWait(browser, PATIENCE).until(chosen)
    yield lambda selector: browser.find_elements("css selector", selector)
    assert [entry for entry in browser.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")] == []


def visible(page: Callable) -> list:
    return [element for element in page("#matrix tbody button") if element.is_displayed()]


def moving(page: Callable):
    """Choose the wall, which rocks, and return its cell."""
    (cell,) = page("button[data-record='0'][data-structure='3']")
    cell.click()
    return cell


def picture(browser) -> str:
    return browser.execute_script("return document.getElementById('mechanism').outerHTML")


def test_it_begins_with_a_case_that_moves_and_a_cell_opens_its_case(page):
    assert len(page("button[aria-pressed='true']")) == 1
    assert page("#histories #rotation")[0].get_attribute("points")
    assert "1 record, 7 structures" in page("header")[0].text and HOSTILE in page("h1")[0].text
    cell = moving(page)
    assert cell.get_attribute("aria-pressed") == "true"
    assert page("#title")[0].text.startswith("wall (") and "synthetic_00000" in page("#title")[0].text
    assert len(page("#histories #rotation")[0].get_attribute("points").split()) > BINS / 2
    assert page("#facts a")[0].get_attribute("href").endswith("/synthetic_00000/report.pdf")


def test_scrubbing_moves_the_mechanism_and_the_cursor(page, browser):
    moving(page)
    rest, begun = picture(browser), page("#cursor")[0].get_attribute("x1")
    script = "const s = document.getElementById('scrub'); s.value = 420; s.dispatchEvent(new Event('input'))"
    browser.execute_script(script)
    assert picture(browser) != rest
    assert float(page("#cursor")[0].get_attribute("x1")) > float(begun)


def test_it_plays_and_pauses(page, browser):
    from selenium.webdriver.support.ui import WebDriverWait

    moving(page)
    rest = picture(browser)
    (play,) = page("#play")
    play.click()
    WebDriverWait(browser, PATIENCE).until(lambda at: int(page("#scrub")[0].get_attribute("value")) > 5)
    assert picture(browser) != rest
    # A slow browser may come to the end by itself, even between the look and the click.
    WebDriverWait(browser, PATIENCE).until(lambda at: play.text == "Play" or play.click())


def test_page_two_of_a_record_opens_by_its_address(page, browser, study, content):
    """A strip for each structure that moves: its numbers, a band as high as the closed form, a mark where it falls."""
    browser.get(f"{study[0].as_uri()}#synthetic_00000")
    cases = content["records"][0]["cases"]
    moving = {name: case for name, case in cases.items() if "history" in case}
    strips = {row.find_element("css selector", "b").text: row for row in page("#strips tbody tr")[1:]}
    assert set(strips) == set(moving)
    for name, row in strips.items():
        told = [one_element.text for one_element in row.find_elements("css selector", "td")[1:]]
        assert told == moving[name]["numbers"]
        assert bool(row.find_elements("css selector", ".falls")) == (told[2] == "falls")
        heights = [
            float(other_element.get_attribute("height"))
            for other_element in row.find_elements("css selector", ".band")
        ]
        sides = 1 if moving[name]["one_sided"] else 2
        reach = min(moving[name]["predicted"], 1.25)
        assert heights == pytest.approx([60 * sides * reach / 2.5] if reach else [], abs=1e-3)
    page("#strips summary")[0].click()
    assert not any(element.is_displayed() for element in page("#strips table"))


def test_the_map_has_the_stations_of_the_earthquake_in_the_colour_of_the_chosen_structure(page, browser):
    """The record that could not be read has no place; a click on a station chooses it."""
    from selenium.webdriver.support.ui import WebDriverWait

    cell = moving(page)
    assert page("#map")[0].is_displayed() and not page("#map circle"), "it is drawn when it is opened"
    page("#map summary")[0].click()
    (circle,) = WebDriverWait(browser, 5).until(lambda _: page("#map circle"))
    assert cell.get_attribute("data-verdict").replace(" ", "-") in circle.get_attribute("class").split()
    fill = "return getComputedStyle(arguments[0])."
    assert browser.execute_script(f"{fill}fill", circle) == browser.execute_script(
        f"{fill}backgroundColor", cell
    )
    assert page("#map summary")[0].text.startswith("Map: wall at 1 station")
    page("button[data-record='1'][data-structure='3']")[0].click()
    WebDriverWait(browser, PATIENCE).until(lambda at: not page("#map")[0].is_displayed())
    page("button[data-record='0'][data-structure='0']")[0].click()
    (circle,) = page("#map circle")
    circle.click()
    assert page("#title")[0].text.startswith("pier (")


def test_every_structure_is_drawn(page, browser):
    drawn = set()
    for cell in page("button[data-record='0']"):
        cell.click()
        drawn.add(picture(browser))
    assert len(drawn) == 7


def test_the_ground_lies_below_the_feet_of_the_piers_and_not_through_them(page, browser):
    """In the drawing y grows upwards, from the springings; the piers reach as far below them as they are high."""
    page("button[data-record='0'][data-structure='6']")[0].click()
    (ground, *_) = page("#mechanism #moving > line")
    points = [
        re.split("[ ,]+", element.get_attribute("points").strip()) for element in page("#mechanism polygon")
    ]
    lowest = min(float(number) for values in points for number in values[1::2])
    assert float(ground.get_attribute("y1")) == pytest.approx(lowest, abs=0.05) and lowest < -1


def test_columns_that_the_width_hides_are_told_and_a_dark_screen_gets_a_dark_page(page, browser):
    from selenium.webdriver.support.ui import WebDriverWait

    narrow = {"width": 220, "height": 800, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", narrow)
    told = lambda: page("#beyond")[0].text  # noqa: E731
    looks = lambda at: page("#matrix")[0].get_attribute("class").split()  # noqa: E731
    WebDriverWait(browser, PATIENCE).until(lambda at: "signs" in looks(at))
    assert told() == "" and len(visible(page)) == 14, "signs alone have room for all"
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", narrow | {"width": 120})
    WebDriverWait(browser, PATIENCE).until(lambda at: re.fullmatch(r"\d of 2 records to the right →", told()))
    browser.execute_script("document.querySelector('.matrix').scrollLeft = 9999")
    WebDriverWait(browser, PATIENCE).until(lambda at: re.fullmatch(r"← \d of 2 records to the left", told()))
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    ink = "return getComputedStyle(document.body).{}.match(/\\d+/g).reduce((a, b) => a + Number(b), 0)"
    for scheme, is_dark in (("dark", True), ("light", False)):
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
        paper, text = (browser.execute_script(ink.format(choice)) for choice in ("backgroundColor", "color"))
        assert (paper < text) == is_dark and abs(paper - text) > 400


def test_the_filters_leave_what_they_name(page):
    everything = len(visible(page))
    (text,) = page("#text")
    text.send_keys("colon")
    assert {one_element.get_attribute("data-structure") for one_element in visible(page)} == {"4"}
    text.clear()
    text.send_keys(" ")
    (choice,) = page("#verdict option:nth-child(4)")
    choice.click()
    assert {element.get_attribute("data-verdict") for element in visible(page)} == {"cannot be told"}
    assert 0 < len(visible(page)) < everything


def test_the_keyboard_is_enough(page, browser):
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import WebDriverWait

    cells = page("#matrix tbody button[data-record='0']")
    cells[0].click()
    cells[0].send_keys(Keys.ARROW_DOWN)
    second = browser.switch_to.active_element
    assert second == cells[1]
    second.send_keys(Keys.ARROW_RIGHT)
    failed = browser.switch_to.active_element
    assert failed.get_attribute("data-record") == "1"
    failed.send_keys(Keys.ENTER)
    WebDriverWait(browser, PATIENCE).until(lambda at: "synthetic_00001" in page("#title")[0].text)


def test_a_record_that_failed_says_why(page, browser):
    from selenium.webdriver.support.ui import WebDriverWait

    (cell,) = page("button[data-record='1'][data-structure='0']")
    cell.click()
    WebDriverWait(browser, PATIENCE).until(lambda _: "sha256" in page("#facts")[0].text)


def test_each_cell_has_an_address(page, browser, study):
    moving(page)
    assert browser.execute_script("return location.hash") == "#synthetic_00000/wall"
    browser.get(study[0].as_uri() + "#synthetic_00000/spire")
    assert page("#title")[0].text.startswith("spire")
    browser.execute_script("location.hash = '#synthetic_00000/colonnade'")
    assert page("#title")[0].text.startswith("colonnade")


def test_with_more_structures_than_records_each_structure_has_a_row_and_the_worst_cell_comes_first(
    page, content
):
    rows = lambda: [int(row.get_attribute("data-row")) for row in page("#matrix tbody tr")]  # noqa: E731
    heads = [element.text.split("\n")[0] for element in page("#matrix thead th")]
    assert heads == ["Structure", "synthetic_00000", "synthetic_00001"], "the record that failed comes last"
    names = [item["name"] for item in content["structures"]]
    severity = [content["records"][0]["cases"][name]["severity"] for name in names]
    worst_first = sorted(range(7), key=lambda place: severity[place], reverse=True)
    assert [severity[place] for place in rows()] == [severity[place] for place in worst_first]
    first = page("#matrix tbody button")[0]
    assert (first.get_attribute("data-record"), first.get_attribute("data-structure")) == (
        "0",
        str(worst_first[0]),
    )
    page("#matrix thead button")[0].click()
    assert rows() == list(range(7)), "the order of the list"
    page("#matrix thead button")[1].click()
    assert [severity[place] for place in rows()] == [severity[place] for place in worst_first]
    assert [one_element.get_attribute("aria-sort") for one_element in page("#matrix thead th")][:2] == [
        None,
        "descending",
    ]


@pytest.mark.parametrize(("width", "height"), [(1280, 800), (390, 844)])
def test_drawing_and_traces_are_in_view(page, browser, width, height):
    """On a screen without scrolling; on a telephone nothing is wider than the screen."""
    sized = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", sized)
    moving(page)
    edge = "return document.querySelector('{}').getBoundingClientRect().{}"
    if width > 800:
        assert browser.execute_script("return window.scrollY") == 0
        assert browser.execute_script(edge.format("#histories", "bottom")) <= height
    assert browser.execute_script("return document.documentElement.scrollWidth") <= width
    assert browser.execute_script(edge.format("#mechanism", "right")) <= width
    assert browser.execute_script(edge.format("#matrix tbody button", "right")) <= width, "one whole cell"
    told = ("record", "predict")
    warnings = [
        one_element
        for one_element in page("#histories text")
        if any(word in one_element.text for word in told)
    ]
    assert len(warnings) == 2
    for warning in warnings:
        frames = [element.rect for element in page("#histories rect")]
        below = min(frame["y"] for frame in frames if frame["y"] > warning.rect["y"])
        assert warning.rect["y"] + 0.8 * warning.rect["height"] <= below, "no trace runs through it"
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_hostile_names_stay_text(page):
    (cell,) = page("button[data-record='0'][data-structure='2']")
    cell.click()
    assert page("#title")[0].text.startswith(HOSTILE)
    assert not page("#matrix b, #title b, #facts b")
