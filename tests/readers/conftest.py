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
            if column != "status":
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
