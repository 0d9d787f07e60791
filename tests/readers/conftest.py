"""Results of small studies, run by the built command, for the programs that users read them with.

SOMMERFELD_BIN is the command; ./test sets it.
"""

import csv
import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


# Columns of text.
WORDS = ["status", "bearing", "role"]


class Results:
    """A directory of results."""

    def __init__(self, directory):
        self.directory = directory
        self.summary = json.loads((directory / "summary.json").read_text())

    def path(self, name):
        return self.directory / name

    def table(self, name):
        """The columns of a table that hold numbers, by their header."""
        with open(self.directory / name, newline="") as file:
            header, *rows = csv.reader(file)
        columns = {}
        for column, values in zip(header, zip(*rows)):
            if column not in WORDS and not column.startswith("limit_"):
                columns[column] = [float(value) for value in values]
        return columns


def run(study, directory):
    command = os.environ.get("SOMMERFELD_BIN", str(ROOT / "target/debug/sommerfeld"))
    # A study that does not converge leaves results too; that it does not is another test's matter.
    ended = subprocess.run([command, "run", study, "--out", directory], capture_output=True, text=True)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return Results(Path(directory))


def cycle_study(directory, fields):
    """The big end of example 02 on a coarse grid, every fourth degree."""
    example = ROOT / "examples/02-big-end-diesel"
    text = (example / "study.toml").read_text()
    for old, new in [
        ("[film]\n", "[film]\ngrid = [48, 12]\n"),
        ("[load_cycle]\n", '[load_cycle]\ncrank_step = "4 deg"\n'),
    ]:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    (directory / "study.toml").write_text(text + f'\n[output]\nfields = "{fields}"\n')
    (directory / "loads.csv").write_bytes((example / "loads.csv").read_bytes())
    return directory / "study.toml"


@pytest.fixture(scope="session")
def steady(tmp_path_factory):
    """Example 01: an equilibrium with a groove and a limit."""
    study = ROOT / "examples/01-steady-main-bearing/study.toml"
    return run(study, tmp_path_factory.mktemp("steady"))


MIXED = """
schema = 1
title = "Slow bearing, rough and warm"
analysis = "equilibrium"

[bearing]
diameter = "72 mm"
width = "30 mm"
diametral_clearance = "72 um"

[[bearing.groove]]
kind = "axial"
angle = "180 deg"
length = "10 mm"
width = "24 mm"
pressure = "2 bar"

[bearing.surface]
roughness_journal = "0.2 um"
roughness_shell = "0.4 um"
boundary_friction = 0.08
contact = { law = "greenwood-tripp", factor = 1e-3, asperity_product = 0.05, modulus = "53.3 GPa" }

[oil]
oil = "nominal-5w-30"

[heat]
model = "field"
supply_temperature = "80 degC"
wall_coefficient = "20000 W/(m2.K)"
wall_temperature = "85 degC"

[film]
grid = [96, 24]
compare = ["plain"]

[operation]
speed = "150 rpm"
load = ["30 kN", "0 N"]
"""


@pytest.fixture(scope="session")
def mixed(tmp_path_factory):
    """An equilibrium with contact and a field of temperature, beside a plain bearing."""
    study = tmp_path_factory.mktemp("study") / "study.toml"
    study.write_text(MIXED)
    return run(study, tmp_path_factory.mktemp("mixed"))


@pytest.fixture(scope="session")
def cycle(tmp_path_factory):
    """A load cycle with the fields of every crank angle."""
    study = cycle_study(tmp_path_factory.mktemp("study"), "all")
    return run(study, tmp_path_factory.mktemp("cycle"))


@pytest.fixture(scope="session")
def cycle_frames(tmp_path_factory):
    """The same with the fields of the frames."""
    study = cycle_study(tmp_path_factory.mktemp("study"), "frames")
    return run(study, tmp_path_factory.mktemp("frames"))


@pytest.fixture(scope="session")
def cycle_none(tmp_path_factory):
    """The same without fields over crank angle."""
    study = cycle_study(tmp_path_factory.mktemp("study"), "none")
    return run(study, tmp_path_factory.mktemp("none"))


@pytest.fixture(scope="session")
def dimensionless(tmp_path_factory):
    """The dimensionless film: integrals alone."""
    directory = tmp_path_factory.mktemp("study")
    command = os.environ.get("SOMMERFELD_BIN", str(ROOT / "target/debug/sommerfeld"))
    subprocess.run([command, "new", "dimensionless", directory], check=True, capture_output=True)
    return run(directory / "dimensionless.toml", tmp_path_factory.mktemp("dimensionless"))


ENGINE = """
schema = 1
title = "Two bearings and a rod"
analysis = "engine"

[engine]
layout = "inline"
cylinders = 1
cylinder_spacing = "100 mm"
bore = "86 mm"
stroke = "86 mm"
rod_length = "145 mm"
piston_mass = "0.45 kg"
rod_mass = "0.58 kg"
rod_centre_of_gravity = "42 mm"
rod_inertia = "2.6e-3 kg.m2"
speed = SPEEDS

[engine.combustion]
compression_ratio = 10.5
heat = "1.45 kJ"

[[engine.combustion.burning]]
start = "-15 deg"
duration = "60 deg"

[[bearing]]
of = "main"
diameter = "54 mm"
width = "24 mm"
diametral_clearance = "42 um"

[[bearing]]
of = "big-end"
diameter = "48 mm"
width = "22 mm"
diametral_clearance = "38 um"

[oil]
viscosity = "8 mPa.s"

[film]
FILM

[orbit]
crank_step = "4 deg"

[limits]
minimum_film_thickness = { value = "1 um", source = "test" }
"""


def engine_study(directory, speeds, film):
    """A single-cylinder engine at these speeds, rpm."""
    speeds = "[" + ", ".join(f'"{speed} rpm"' for speed in speeds) + "]"
    study = directory / "engine.toml"
    study.write_text(ENGINE.replace("SPEEDS", speeds).replace("FILM", film))
    return study


@pytest.fixture(scope="session")
def engine(tmp_path_factory):
    """An engine at two speeds, its films on a coarse grid."""
    film = 'cavitation = "reynolds"\ngrid = [32, 8]'
    study = engine_study(tmp_path_factory.mktemp("study"), [2000, 3500], film)
    return run(study, tmp_path_factory.mktemp("engine"))


WORN = """
schema = 1
title = "A shell that ran in"
analysis = "load-cycle"

[bearing]
diameter = "72 mm"
width = "30 mm"
diametral_clearance = "72 um"

[bearing.surface]
roughness_journal = "0.8 um"
roughness_shell = "1.2 um"
boundary_friction = 0.08
contact = { law = "greenwood-tripp", factor = 1e-3, asperity_product = 0.05, modulus = "53.3 GPa" }

[oil]
viscosity = "2 mPa.s"

[load_cycle]
file = "loads.csv"
engine_speed = "1500 rpm"
crank_step = "6 deg"

[film]
cavitation = "reynolds"
grid = [32, 4]

[wear]
coefficient = "1e-16 m2/N"

[wear.running_in]
hours = "20 min"
settled_below = 0.0
"""


@pytest.fixture(scope="session")
def worn(tmp_path_factory):
    """A load cycle with contact after twenty minutes of running-in."""
    directory = tmp_path_factory.mktemp("study")
    (directory / "study.toml").write_text(WORN)
    (directory / "loads.csv").write_bytes((ROOT / "examples/02-big-end-diesel/loads.csv").read_bytes())
    return run(directory / "study.toml", tmp_path_factory.mktemp("worn"))


SURFACE = """
[bearing.surface]
roughness_journal = "0.8 um"
roughness_shell = "1.2 um"
boundary_friction = 0.08
contact = { law = "greenwood-tripp", factor = 1e-3, asperity_product = 0.05, modulus = "53.3 GPa" }
"""

WARM_OIL = """
[oil]
viscosity = { law = "vogel", a = "0.06 mPa.s", b = "1000 K", c = "180 K" }
density = "850 kg/m3"
heat_capacity = "2100 J/(kg.K)"

[heat]
model = "balance"
supply_temperature = "100 degC"

[wear]
coefficient = "1e-16 m2/N"
"""


@pytest.fixture(scope="session")
def worn_engine(tmp_path_factory):
    """An engine whose rough bearings wear and find their temperatures."""
    study = engine_study(tmp_path_factory.mktemp("study"), [1500], 'cavitation = "reynolds"\ngrid = [24, 4]')
    text = study.read_text().replace("\n[oil]\n" + 'viscosity = "8 mPa.s"\n', SURFACE + WARM_OIL)
    text = text.replace('\n[[bearing]]\nof = "big-end"', SURFACE + '\n[[bearing]]\nof = "big-end"')
    study.write_text(text.replace('crank_step = "4 deg"', 'crank_step = "8 deg"'))
    return run(study, tmp_path_factory.mktemp("worn-engine"))
