"""report.html as a reader meets it: opened from the disk in a browser that has no network.

The browser is headless Chromium. A small load cycle is computed with the program itself
(SOMMERFELD_BIN), its report is opened, played with, and held against summary.json.
"""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest
from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

LARGEST_REPORT = 10_000_000
MOST_FRAMES = 72

# A small bearing with a hole in the journal and a load that turns and swells: seconds to compute.
STUDY = """
schema = 1
title = "Small load cycle"
analysis = "load-cycle"

[bearing]
diameter = "60 mm"
width = "24 mm"
diametral_clearance = "60 um"

[[bearing.groove]]
kind = "hole"
carried_by = "journal"
angle = "90 deg"
position = "0 mm"
diameter = "6 mm"
pressure = "4 bar"

[oil]
viscosity = "10 mPa.s"
temperature = "100 degC"

[film]
model = "field"
cavitation = "mass-conserving"
grid = [48, 12]

[load_cycle]
file = "loads.csv"
engine_speed = "2000 rpm"
period = "360 deg"
crank_step = "3 deg"

[limits]
minimum_film_thickness = { value = "1 um", source = "assumed for this test" }
"""

LOADS = """crank_angle[deg],load_x[N],load_y[N]
0,9000,0
60,5000,3000
120,-2000,4000
180,-4000,0
240,-2000,-4000
300,4000,-3000
"""


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Directory with the results of the study."""
    program = os.environ.get("SOMMERFELD_BIN")
    if not program:
        pytest.fail("SOMMERFELD_BIN must name the program to test; ./test sets it")
    directory = tmp_path_factory.mktemp("report")
    (directory / "study.toml").write_text(STUDY)
    (directory / "loads.csv").write_text(LOADS)
    run = subprocess.run(
        [program, "run", "study.toml", "--out", "results"],
        cwd=directory,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    return directory / "results"


@pytest.fixture(scope="module")
def summary(results):
    return json.loads((results / "summary.json").read_text())


def open_report(results, width, height, profile):
    options = webdriver.ChromeOptions()
    browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    driver = shutil.which("chromedriver")
    if not (browser and driver):
        pytest.fail("chromium and chromedriver are missing: apt-get install chromium chromium-driver")
    options.binary_location = browser
    for argument in [
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-dev-shm-usage",
        "--disable-background-networking",
        "--enable-unsafe-swiftshader",
        f"--user-data-dir={profile}",
        f"--window-size={width},{height}",
    ]:
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    page = webdriver.Chrome(options=options, service=webdriver.ChromeService(driver))
    page.set_page_load_timeout(180)
    # Headless windows have a least width; the size of the view is set apart from it.
    page.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False},
    )
    # What the browser shows of its own at its start is not the report's.
    page.get("about:blank")
    for log in ["browser", "performance"]:
        page.get_log(log)
    page.get((results / "report.html").resolve().as_uri())
    WebDriverWait(page, 180).until(lambda page: page.execute_script("return document.documentElement.dataset.drawn") == "true")
    return page


@pytest.fixture(scope="module", params=[(1280, 800), (420, 800)], ids=["desktop", "narrow"])
def page(request, results, tmp_path_factory):
    """The report in a browser window of a given size."""
    page = open_report(results, *request.param, tmp_path_factory.mktemp("profile"))
    yield page
    page.quit()


def requests(page):
    """Addresses the page asked for since the log was read last."""
    messages = (json.loads(entry["message"])["message"] for entry in page.get_log("performance"))
    return [
        message["params"]["request"]["url"]
        for message in messages
        if message["method"] == "Network.requestWillBeSent"
    ]


def pressure_map(page):
    """The numbers of the map of pressure as it is drawn."""
    return page.execute_script("return document.querySelector('[data-kind=film-pressure]').data[0].z")


def read_outs(page):
    return {element.get_attribute("data-read"): element.text for element in page.find_elements(By.CSS_SELECTOR, "[data-read]")}


def settle(page):
    """Waits until the pictures show the instant that the slider stands at."""
    WebDriverWait(page, 120).until(
        lambda page: page.execute_script(
            "return document.getElementById('film').dataset.shown === document.getElementById('frame').value"
        )
    )


def test_nothing_is_loaded_and_nothing_fails(page):
    address = page.current_url
    assert address.startswith("file://")
    foreign = [url for url in requests(page) if url != address and not url.startswith(("data:", "blob:"))]
    assert foreign == []
    assert [entry for entry in page.get_log("browser") if entry["level"] == "SEVERE"] == []


def test_every_figure_is_drawn(page):
    empty = page.execute_script(
        "return [...document.querySelectorAll('[data-kind]')].filter((e) => !e.data || e.data.length === 0).map((e) => e.dataset.kind)"
    )
    assert empty == []
    assert len(page.find_elements(By.CSS_SELECTOR, "[data-kind]")) >= 18


def test_figures_of_the_page_are_those_of_the_summary(page, summary):
    keys = [
        "minimum_film_thickness_m",
        "peak_film_pressure_pa",
        "maximum_specific_load_pa",
        "mean_power_loss_w",
        "mean_side_flow_m3_s",
        "mean_feed_flow_m3_s",
    ]
    for key in keys:
        card = page.find_element(By.CSS_SELECTOR, f"[data-key={key}]")
        assert float(card.get_attribute("data-value")) == pytest.approx(summary[key], rel=1e-12), key
    shown = page.find_element(By.CSS_SELECTOR, "[data-key=minimum_film_thickness_m] .value").text
    assert float(shown.split()[0]) == pytest.approx(1e6 * summary["minimum_film_thickness_m"], rel=1e-3)


def test_the_answer_stands_on_the_first_screen(page):
    height = page.execute_script("return innerHeight")
    for selector in [".verdict .headline", "[data-key=minimum_film_thickness_m] .value", "[data-key=peak_film_pressure_pa] .value"]:
        bottom = page.execute_script("return document.querySelector(arguments[0]).getBoundingClientRect().bottom + scrollY", selector)
        assert 0 < bottom < height, selector


def test_nothing_is_wider_than_the_window(page):
    wide, inner = page.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
    assert wide <= inner


def test_the_slider_drives_maps_body_and_read_outs(page):
    slider = page.find_element(By.ID, "frame")
    frames = int(slider.get_attribute("max")) + 1
    assert 4 < frames <= MOST_FRAMES
    slider.send_keys(Keys.HOME)
    settle(page)
    first, first_map = read_outs(page), pressure_map(page)
    assert slider.get_attribute("value") == "0"
    for _ in range(3):
        slider.send_keys(Keys.ARROW_RIGHT)
    assert slider.get_attribute("value") == "3"
    slider.send_keys(Keys.END)
    settle(page)
    later, later_map = read_outs(page), pressure_map(page)
    assert slider.get_attribute("value") == str(frames - 1)
    for name in ["crank", "load", "thickness", "pressure"]:
        assert first[name] != later[name], name
    assert first_map != later_map
    assert slider.get_attribute("aria-valuetext").startswith(later["crank"].split()[0])


def test_the_map_holds_the_peak_that_is_read_out(page):
    for button in page.find_elements(By.CSS_SELECTOR, "#jumps button"):
        page.execute_script("arguments[0].click()", button)
        settle(page)
        peak = max(value for row in pressure_map(page) for value in row if value is not None)
        # The read-out is the peak between cell middles, a few per cent above them on this grid.
        assert float(read_outs(page)["pressure"].split()[0]) == pytest.approx(peak, rel=0.1)


def test_play_runs_and_stops(page):
    play = page.find_element(By.ID, "play")
    slider = page.find_element(By.ID, "frame")
    before = slider.get_attribute("value")
    page.execute_script("arguments[0].click()", play)
    WebDriverWait(page, 120).until(lambda _: slider.get_attribute("value") != before)
    assert play.get_attribute("aria-label") == "Pause"
    page.execute_script("arguments[0].click()", play)
    assert play.get_attribute("aria-label") == "Play"


def test_no_action_left_an_error_or_asked_the_network(page):
    # Runs last: the log holds everything since the page was opened.
    assert [entry for entry in page.get_log("browser") if entry["level"] == "SEVERE"] == []
    assert [url for url in requests(page) if not url.startswith(("file:", "data:", "blob:"))] == []


def test_the_report_is_small_enough_to_send(results):
    assert Path(results / "report.html").stat().st_size <= LARGEST_REPORT


def test_the_limit_and_its_source_are_told(page):
    text = page.find_element(By.CSS_SELECTOR, ".verdict").text
    assert "assumed for this test" in text and "Limits kept" in text
