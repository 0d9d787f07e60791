"""The report of an engine as a reader meets it: pages, speeds, figures, in a browser without a network.

The results are made up (the preview of the layout, built with the tests): what is tested is the page.
"""

import os
import subprocess
from pathlib import Path

import pytest
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select, WebDriverWait

from test_report import open_report, requests

LARGEST_REPORT = 10_000_000


@pytest.fixture(scope="module")
def previews(tmp_path_factory):
    """Directories of made-up results."""
    program = os.environ.get("SOMMERFELD_BIN")
    if not program:
        pytest.fail("SOMMERFELD_BIN must name the program to test; ./test sets it")
    preview = Path(program).parent / "examples" / "report_preview"
    directory = tmp_path_factory.mktemp("previews")
    subprocess.run([preview, directory], check=True, timeout=300)
    return directory


@pytest.fixture(scope="module")
def engine(previews, tmp_path_factory):
    page = open_report(previews / "engine-speeds", 1280, 800, tmp_path_factory.mktemp("profile"))
    yield page
    page.quit()


def drawn(page):
    WebDriverWait(page, 180).until(lambda page: page.execute_script("return document.documentElement.dataset.drawn") == "true")


def go(page, anchor):
    page.execute_script("arguments[0].click()", page.find_element(By.CSS_SELECTOR, f".pages a[href='#{anchor}']"))
    WebDriverWait(page, 60).until(lambda page: page.execute_script("return document.querySelector('.page.open').id") == anchor)
    drawn(page)


def empty_figures(page):
    """Kinds of the figures of the open page in which nothing is drawn and nothing is said."""
    return page.execute_script(
        "return [...document.querySelectorAll('.page.open [data-kind]')]"
        ".filter((e) => !(e.data && e.data.length) && e.childElementCount === 0).map((e) => e.dataset.kind)"
    )


def test_the_engine_stands_first_with_every_figure(engine):
    assert engine.execute_script("return document.querySelector('.page.open').id") == "engine"
    assert len([p for p in engine.find_elements(By.CSS_SELECTOR, ".page") if p.is_displayed()]) == 1
    assert empty_figures(engine) == []
    assert len(engine.find_elements(By.CSS_SELECTOR, ".tiles a svg path.curve")) == 13


def test_a_bearing_opens_at_the_chosen_speed(engine):
    go(engine, "b-main-3")
    assert empty_figures(engine) == []
    card = ".page.open .at.chosen [data-key=minimum_film_thickness_m] .value"
    before = engine.find_element(By.CSS_SELECTOR, card).text
    curve = "return document.querySelector('.page.open [data-kind=thickness]').data[0].y"
    slow = min(engine.execute_script(curve))
    assert float(before.split()[0]) == pytest.approx(slow, rel=2e-2)
    Select(engine.find_element(By.ID, "speed")).select_by_index(6)
    drawn(engine)
    after = engine.find_element(By.CSS_SELECTOR, card).text
    fast = min(engine.execute_script(curve))
    assert fast < slow and before != after
    assert float(after.split()[0]) == pytest.approx(fast, rel=2e-2)
    Select(engine.find_element(By.ID, "speed")).select_by_index(0)
    drawn(engine)


def test_the_load_of_hinges_stands_beside_that_of_the_elastic_shaft(engine):
    go(engine, "b-main-1")
    names = engine.execute_script("return document.querySelector('.page.open [data-kind=load-models]').data.map((one) => one.name)")
    assert names == ["elastic shaft", "hinges at the mains"]
    go(engine, "b-big-end-1")
    assert engine.find_elements(By.CSS_SELECTOR, ".page.open [data-kind=load-models]") == []


def test_a_field_of_the_overview_opens_its_bearing_and_speed(engine):
    go(engine, "engine")
    engine.execute_script(
        "document.querySelector('[data-kind=overview-thickness]').emit('plotly_click', { points: [{ y: 'big-end-2', x: 3 }] })"
    )
    WebDriverWait(engine, 60).until(lambda page: page.execute_script("return document.querySelector('.page.open').id") == "b-big-end-2")
    drawn(engine)
    assert engine.find_element(By.ID, "speed").get_attribute("value") == "3"


def test_nothing_is_loaded_and_nothing_fails(engine):
    # Runs after the pages were opened: the log holds everything since the report was.
    assert [entry for entry in engine.get_log("browser") if entry["level"] == "SEVERE"] == []
    assert [url for url in requests(engine) if not url.startswith(("file:", "data:", "blob:"))] == []


@pytest.mark.parametrize("name", ["engine", "shaft"])
def test_nothing_is_wider_than_a_narrow_window(previews, tmp_path_factory, name):
    page = open_report(previews / name, 420, 800, tmp_path_factory.mktemp("profile"))
    try:
        wide, inner = page.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
        assert wide <= inner
        assert empty_figures(page) == []
    finally:
        page.quit()


def test_the_reports_are_small_enough_to_send(previews):
    for report in previews.glob("*/report.html"):
        assert report.stat().st_size <= LARGEST_REPORT, report
