"""results.h5 as h5py reads it, against the tables and the summary of the same run."""

import csv
import os
import re
import subprocess
import sys

import h5py
import numpy as np
import pytest

from conftest import ROOT

# Single precision of the fields over crank angle.
SINGLE = 1e-7


def datasets(file):
    found = {}
    file.visititems(lambda name, node: found.update({name: node} if isinstance(node, h5py.Dataset) else {}))
    return found


def film_force(pressure, angle, axial, bearing):
    """What the pressure does to the journal, N, by cell areas."""

    def widths(centres, start):
        """Cell widths: each face is its neighbour mirrored at the centre between them."""
        faces = [start]
        for centre in centres:
            faces.append(2 * centre - faces[-1])
        return np.diff(faces)

    width, radius = bearing["width"][()], bearing["diameter"][()] / 2
    phi = np.radians(angle[:])
    area = radius * np.outer(widths(phi, 0.0), widths(axial[:], -width / 2))
    load = pressure * area
    return -np.array([(load * np.cos(phi)[:, None]).sum(), (load * np.sin(phi)[:, None]).sum()])


@pytest.mark.parametrize("name", ["steady", "mixed", "cycle", "cycle_frames", "dimensionless", "engine", "worn", "worn_engine"])
def test_every_dataset_says_what_it_is(name, request):
    results = request.getfixturevalue(name)
    with h5py.File(results.path("results.h5")) as file:
        for key in ["program", "version", "analysis", "status", "title", "study", "study_hash"]:
            assert isinstance(file.attrs[key], str), key
        assert file.attrs["program"] == "sommerfeld"
        assert file.attrs["schema"] == 1
        assert file.attrs["status"] == results.summary["status"]
        assert file.attrs["study"].count("\n") > 5
        assert len(file.attrs["models"]) == len(results.summary["models"])
        found = datasets(file)
        assert len(found) > 5
        for path, dataset in found.items():
            assert isinstance(dataset.attrs["units"], str) and dataset.attrs["units"], path
            assert isinstance(dataset.attrs["long_name"], str), path
            assert dataset.dtype.kind == "f", path
            if dataset.ndim > 1 and not path.startswith("summary"):
                assert all(len(dimension) == 1 for dimension in dataset.dims), path
            if dataset.size >= 256:
                assert dataset.chunks and dataset.shuffle and dataset.compression == "gzip", path


def test_numbers_are_those_of_the_summary(steady, cycle, dimensionless):
    for results in [steady, cycle, dimensionless]:
        with h5py.File(results.path("results.h5")) as file:
            compare(file["summary"], results.summary)


def test_contact_and_temperature_are_fields_where_they_are_calculated(mixed, steady, cycle):
    with h5py.File(mixed.path("results.h5")) as file:
        film, summary = file["film"], mixed.summary
        assert film["contact_pressure"].attrs["units"] == "Pa"
        assert film["temperature"].attrs["units"] == "K"
        contact, temperature = film["contact_pressure"][:], film["temperature"][:]
        assert contact.shape == temperature.shape == film["pressure"].shape
        # The load goes to film and asperities: the force is that of both pressures.
        together = film["pressure"][:] + contact
        force = film_force(together, film["angle"], film["axial"], file["bearing"])
        assert np.linalg.norm(force - summary["force_n"]) < 0.01 * 30e3
        alone = film_force(film["pressure"][:], film["angle"], film["axial"], file["bearing"])
        carried = summary["contact_load_share"] * 30e3
        assert carried > 100
        assert abs(np.linalg.norm(force - alone) / carried - 1) < 0.02
        # The summary sees the peak between cells too.
        assert 0.8 < contact.max() / summary["peak_contact_pressure_pa"] < 1 + 1e-9
        # The film was solved in the temperatures of the round before the last one.
        hottest = summary["hottest_temperature_degc"] + 273.15
        assert abs(temperature.max() - hottest) <= summary["temperature_changes_k"][-1] < 0.1
        compare(file["summary/comparison/plain"], summary["comparison"]["plain"])
        assert file["summary/comparison/plain/minimum_film_thickness_m"][()] > 0
    for results, group in [(steady, "film"), (cycle, "fields")]:
        with h5py.File(results.path("results.h5")) as file:
            assert not {"contact_pressure", "temperature"} & set(file[group])


def compare(group, summary):
    for key, value in summary.items():
        if isinstance(value, dict) and key != "error":
            compare(group[key], value)
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            assert group[key][()] == value, key
            if key.endswith("_pa"):
                assert group[key].attrs["units"] == "Pa"


def test_the_cycle_is_that_of_the_table(cycle):
    table = cycle.table("cycle.csv")
    with h5py.File(cycle.path("results.h5")) as file:
        assert len(file["cycle"]) == len(table) + 1
        for column, values in table.items():
            name, unit = re.fullmatch(r"(.*)\[(.*)\]", column).groups()
            dataset = file["cycle"][name]
            assert np.array_equal(dataset[:], values, equal_nan=True), column
            assert dataset.attrs["units"] == {"-": "1"}.get(unit, unit)
            if name != "crank_angle":
                assert dataset.dims[0][0] == file["cycle/crank_angle"]
        assert np.all(file["cycle/converged"][:] == 1.0)


def test_fields_belong_to_the_cycle(cycle):
    with h5py.File(cycle.path("results.h5")) as file:
        pressure, thickness = file["fields/pressure"], file["fields/film_thickness"]
        crank = file["fields/crank_angle"][:]
        assert pressure.shape == (180, 48, 12) and pressure.dtype == np.float32
        assert [d[0].name for d in pressure.dims] == [
            "/fields/crank_angle",
            "/fields/angle",
            "/fields/axial",
        ]
        # The cycle shows both its ends, the fields its last.
        assert np.allclose(crank, file["cycle/crank_angle"][1:], atol=1e-9)
        peak, least = file["cycle/peak_film_pressure"][1:], file["cycle/minimum_film_thickness"][1:]
        # The summary sees extremes between cells too: these bound those of the cells.
        cells = pressure[:].max(axis=(1, 2))
        assert np.all(cells <= peak * (1 + SINGLE))
        assert abs(cells.max() / peak.max() - 1) < 0.05
        assert np.all(thickness[:].min(axis=(1, 2)) >= least * (1 - SINGLE))
        fraction = file["fields/film_fraction"][:]
        assert fraction.min() >= 0 and fraction.max() <= 1
        assert np.all(pressure[:][fraction < 1] == 0)


def test_the_pressure_carries_the_load(cycle, steady):
    with h5py.File(cycle.path("results.h5")) as file:
        fields, table = file["fields"], file["cycle"]
        largest = np.hypot(table["load_x"][:], table["load_y"][:]).max()
        for number in range(0, 180, 15):
            force = film_force(fields["pressure"][number], fields["angle"], fields["axial"], file["bearing"])
            expected = np.array([table["force_x"][number + 1], table["force_y"][number + 1]])
            # A coarse grid: the cell's mean of the cosine differs from its centre by 7e-4.
            assert np.abs(force - expected).max() < 2e-3 * largest
    with h5py.File(steady.path("results.h5")) as file:
        film = file["film"]
        force = film_force(film["pressure"][:], film["angle"], film["axial"], file["bearing"])
        assert np.abs(force - file["summary/force_n"][:]).max() < 2e-3 * 50e3


def test_the_steady_film_is_that_of_the_table(steady):
    table = steady.table("film.csv")
    with h5py.File(steady.path("results.h5")) as file:
        for column, name in [
            ("pressure[Pa]", "pressure"),
            ("film_fraction[-]", "film_fraction"),
            ("film_thickness[m]", "film_thickness"),
        ]:
            assert np.array_equal(file["film"][name][:].ravel(), table[column])
        assert file["limits/minimum_film_thickness"].attrs["verdict"] == "ok"
        assert file["limits/minimum_film_thickness/limit"][()] == 4e-6


def test_accumulated_maps_follow_from_the_fields(cycle):
    with h5py.File(cycle.path("results.h5")) as file:
        shell, journal = file["accumulated/shell"], file["accumulated/journal"]
        pressure = file["fields/pressure"][:]
        scale = pressure.max()
        amplitude = (pressure.max(axis=0) - pressure.min(axis=0)) / 2
        assert np.abs(shell["maximum_pressure"][:] - pressure.max(axis=0)).max() < SINGLE * scale
        assert np.abs(shell["pressure_amplitude"][:] - amplitude).max() < SINGLE * scale
        thinnest = file["fields/film_thickness"][:].min(axis=0)
        assert np.allclose(shell["minimum_film_thickness"][:], thinnest, rtol=SINGLE)
        full = ((file["fields/film_fraction"][:] >= 1) & (pressure > 0)).mean(axis=0)
        assert np.allclose(shell["full_film_share"][:], full, atol=1e-12)
        # Interpolation cuts peaks and never adds to them.
        assert 0.9 * scale < journal["maximum_pressure"][:].max() <= scale * (1 + SINGLE)
        share = journal["full_film_share"][:]
        assert share.min() >= 0 and share.max() <= 1 + 1e-12


def test_the_journal_sees_what_turns_by(cycle):
    """The map of the journal from the fields, turned by the integral of the journal's speed."""
    with h5py.File(cycle.path("results.h5")) as file:
        fields, table = file["fields"], file["cycle"]
        time = np.radians(table["crank_angle"][:]) / (2000 * np.pi / 30)
        speed = table["journal_speed"][:]
        turned = np.concatenate([[0], np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(time))])[1:]
        angle = np.radians(fields["angle"][:])
        largest = np.zeros((48, 12))
        for number, turn in enumerate(turned):
            for j in range(12):
                row = fields["pressure"][number][:, j]
                seen = np.interp(angle + turn, angle, row, period=2 * np.pi)
                largest[:, j] = np.maximum(largest[:, j], seen)
        found = file["accumulated/journal/maximum_pressure"][:]
        # The speed is only known at the rows of the table.
        assert np.abs(found - largest).max() < 0.02 * largest.max()


def test_fields_are_a_choice(cycle, cycle_frames, cycle_none):
    with h5py.File(cycle.path("results.h5")) as every, h5py.File(cycle_frames.path("results.h5")) as few:
        crank, found = every["fields/crank_angle"][:], few["fields/crank_angle"][:]
        assert found.shape == (72,)
        places = [np.abs(crank - angle).argmin() for angle in found]
        assert np.array_equal(every["fields/pressure"][:][places], few["fields/pressure"][:])
        assert set(np.diff(places)) == {2, 3}
    with h5py.File(cycle_none.path("results.h5")) as none:
        assert "fields" not in none and "accumulated" in none and "cycle" in none


def test_nothing_half_is_left(cycle):
    names = [path.name for path in cycle.directory.rglob("*")]
    assert not [name for name in names if name.endswith(".part")]


def test_the_recipe_of_the_readme_runs(cycle):
    readme = (ROOT / "README.md").read_text()
    recipes = [block for block in re.findall(r"```python\n(.*?)```", readme, re.S) if "results.h5" in block]
    assert len(recipes) == 1
    ended = subprocess.run(
        [sys.executable, "-c", recipes[0]],
        cwd=cycle.directory,
        env=os.environ,
        capture_output=True,
        text=True,
    )
    assert ended.returncode == 0, ended.stderr
    megapascals = float(re.search(r"([\d.]+) MPa", ended.stdout).group(1))
    peak = cycle.summary["peak_film_pressure_pa"]
    assert 0.95 * peak < 1e6 * megapascals <= 1.001 * peak, ended.stdout


BEARINGS = ["main-1", "main-2", "big-end-1"]
SPEEDS = {"2000rpm": 2000.0, "3500rpm": 3500.0}


def name_and_unit(column):
    name, unit = re.fullmatch(r"(.*)\[(.*)\]", column).groups()
    return name, {"-": "1"}.get(unit, unit)


def same_columns(group, table):
    """Every column of a table stands in the group, with its unit, number by number."""
    for column, values in table.items():
        name, unit = name_and_unit(column)
        assert np.array_equal(group[name][:], values, equal_nan=True), column
        assert group[name].attrs["units"] == unit, column


def test_an_engine_has_a_group_for_each_speed_and_bearing(engine):
    with h5py.File(engine.path("results.h5")) as file:
        assert "hinge" in file.attrs["load_model"]
        assert set(file["speeds"]) == set(SPEEDS)
        for label, rpm in SPEEDS.items():
            speed = file["speeds"][label]
            assert speed["speed"][()] == rpm and speed["speed"].attrs["units"] == "rpm"
            same_columns(speed["engine"], engine.table(f"{label}/engine.csv"))
            same_columns(speed["orders"], engine.table(f"{label}/orders.csv"))
            assert set(speed["bearings"]) == set(BEARINGS)
            for name in BEARINGS:
                bearing = speed["bearings"][name]
                assert bearing.attrs["role"] == name.rsplit("-", 1)[0]
                assert bearing.attrs["status"] == "converged"
                same_columns(bearing["cycle"], engine.table(f"{label}/cycle-{name}.csv"))
                assert np.all(bearing["cycle/converged"][:] == 1.0)
                film, pressure = bearing["worst/film_thickness"], bearing["worst/pressure"]
                assert film.shape == pressure.shape == (32, 8)
                assert (film.attrs["units"], pressure.attrs["units"]) == ("m", "Pa")
                # Fields over the cycle are those of the first speed.
                assert ("fields" in bearing) == (rpm == 2000.0)


def test_key_figures_of_bearings_follow_from_their_cycles(engine):
    table = engine.table("bearings.csv")
    with open(engine.path("bearings.csv"), newline="") as file:
        rows = list(csv.DictReader(file))
    assert [(float(row["speed[rpm]"]), row["bearing"]) for row in rows] == [
        (rpm, name) for rpm in SPEEDS.values() for name in BEARINGS
    ]
    listed = [
        bearing for speed in engine.summary["speeds"] for bearing in speed["bearings"]
    ]
    with h5py.File(engine.path("results.h5")) as file:
        for number, (row, summary) in enumerate(zip(rows, listed, strict=True)):
            label = f"{float(row['speed[rpm]']):g}rpm"
            bearing = file["speeds"][label]["bearings"][row["bearing"]]
            cycle = bearing["cycle"]
            load = np.hypot(cycle["load_x"][:], cycle["load_y"][:])
            # Fixed loads: the file writes their components, the table their size.
            assert np.isclose(load.max(), table["maximum_load[N]"][number], rtol=1e-12)
            area = bearing["bearing/width"][()] * bearing["bearing/diameter"][()]
            assert np.isclose(load.max() / area, table["maximum_specific_load[Pa]"][number], rtol=1e-12)
            least = cycle["minimum_film_thickness"][:].min()
            assert least == table["minimum_film_thickness[m]"][number] == summary["minimum_film_thickness_m"]
            peak = cycle["peak_film_pressure"][:].max()
            assert peak == table["peak_film_pressure[Pa]"][number] == summary["peak_film_pressure_pa"]
            # The last row repeats the first: one period.
            lost = cycle["power_loss"][1:].mean()
            assert np.isclose(lost, table["mean_power_loss[W]"][number], rtol=1e-9)
            verdict = row["limit_minimum_film_thickness"]
            assert verdict == ("OK" if least >= 1e-6 else "exceeded")
            assert summary["limits"][0]["verdict"] == verdict.lower()
            assert (row["bearing"], row["role"], row["status"]) == tuple(summary[key] for key in ["name", "role", "status"])


def test_loads_of_an_engine_are_tables_of_loads(engine):
    with h5py.File(engine.path("results.h5")) as file:
        for label, rpm in SPEEDS.items():
            for name in BEARINGS:
                with open(engine.path(f"{label}/loads-{name}.csv"), newline="") as text:
                    comment, header, *rows = csv.reader(text)
                assert comment[0].startswith("#") and name in comment[0]
                columns = dict(zip(header, np.array(rows, dtype=float).T, strict=True))
                load = file["speeds"][label]["bearings"][name]["load"]
                same_columns(load, columns)
                assert len(columns["crank_angle[deg]"]) == 180
                assert np.allclose(np.diff(columns["crank_angle[deg]"]), 4.0)
                # Seen from shells that stand; the rod swings against the crank: sin(swing) = ratio sin(angle).
                assert np.all(columns["shell_speed[rad/s]"] == 0.0)
                angle, ratio = np.radians(columns["crank_angle[deg]"]), 43 / 145
                swing = ratio * np.cos(angle) / np.sqrt(1 - (ratio * np.sin(angle)) ** 2)
                expected = rpm * np.pi / 30 * (1 + (swing if name == "big-end-1" else 0))
                assert np.allclose(columns["journal_speed[rad/s]"], expected, rtol=1e-9)


def surface_integral(values, group, radius, width):
    """Integral over a surface whose faces mirror each other at the centres, m2 times the value."""

    def widths(centres, start):
        faces = [start]
        for centre in centres:
            faces.append(2 * centre - faces[-1])
        return np.diff(faces)

    phi = np.radians(group["angle"][:])
    return (values * radius * np.outer(widths(phi, 0.0), widths(group["axial"][:], -width / 2))).sum()


def test_wear_is_a_map_of_shell_and_journal(worn):
    with h5py.File(worn.path("results.h5")) as file:
        summary, bearing = worn.summary, file["bearing"]
        radius, width = bearing["diameter"][()] / 2, bearing["width"][()]
        shell, journal = file["accumulated/shell"], file["accumulated/journal"]
        units = {
            "wear_load": "J/m2",
            "friction_energy": "J/m2",
            "peak_pressure_velocity": "W/m2",
            "mean_pressure_velocity": "W/m2",
        }
        for group in [shell, journal]:
            for name, unit in units.items():
                assert group[name].attrs["units"] == unit, name
                assert group[name].shape == group["maximum_pressure"].shape
                assert [dimension[0].name for dimension in group[name].dims] == [
                    group["angle"].name, group["axial"].name]
            assert np.array_equal(group["friction_energy"][:], 0.08 * group["wear_load"][:])
            assert np.all(group["peak_pressure_velocity"][:] >= group["mean_pressure_velocity"][:])
        assert "wear_depth_per_hour" not in journal
        depth = shell["wear_depth_per_hour"]
        assert depth.attrs["units"] == "m"
        assert depth[:].max() == summary["wear_depth_per_hour_m"] > 0
        # Archard: k times the wear load, 45 000 cycles an hour.
        cycles = 1500 / 2 * 60
        assert np.allclose(depth[:], 1e-16 * cycles * shell["wear_load"][:], rtol=1e-12)
        volume = surface_integral(depth[:], shell, radius, width)
        assert abs(volume / summary["wear_volume_per_hour_m3"] - 1) < 1e-9
        # Both surfaces take the same work.
        works = [surface_integral(group["wear_load"][:], group, radius, width) for group in [shell, journal]]
        assert abs(works[0] / works[1] - 1) < 1e-9
        # As power: friction of asperities over a cycle.
        power = 0.08 * works[0] * cycles / 3600
        assert abs(power / summary["boundary_power_w"] - 1) < 0.02


def test_running_in_is_the_table_and_the_worn_shell(worn):
    table = worn.table("running-in.csv")
    with h5py.File(worn.path("results.h5")) as file:
        group, bearing = file["running_in"], file["bearing"]
        assert group.attrs["end"] == worn.summary["running_in_end"] == "time-over"
        for column, values in table.items():
            name, unit = column.rstrip("]").split("[")
            assert np.allclose(group[name][:], values, rtol=1e-12, equal_nan=True), name
            assert group[name].attrs["units"] == {"-": "1"}.get(unit, unit)
            # The axis itself is a scale and has none.
            assert name == "time" or group[name].dims[0][0].name == group["time"].name
        assert group["time"][-1] == 1200.0 and len(group["time"]) > 2
        depth = group["shell/worn_depth"]
        assert depth.shape == file["accumulated/shell/wear_load"].shape
        assert depth[:].max() == group["worn_depth"][-1] == worn.summary["running_in_depth_m"]
        radius, width = bearing["diameter"][()] / 2, bearing["width"][()]
        volume = surface_integral(depth[:], group["shell"], radius, width)
        assert abs(volume / group["worn_volume"][-1] - 1) < 1e-9
        roughness = group["shell_roughness"][:]
        # It falls until no summit is left above the mean plane: sqrt(1/2 - 1/(2 pi)) of what it was.
        plateau = 1.2e-6 * np.sqrt(0.5 - 0.5 / np.pi)
        assert roughness[0] == 1.2e-6 and np.all(np.diff(roughness) <= 0)
        assert abs(roughness[-1] / plateau - 1) < 1e-9


def test_bearings_of_an_engine_wear_and_are_warm(worn_engine):
    table = worn_engine.table("bearings.csv")
    bearings = worn_engine.summary["bearings"]
    with h5py.File(worn_engine.path("results.h5")) as file:
        group = file["speeds/1500rpm/bearings"]
        for row, bearing in enumerate(bearings):
            own = group[bearing["name"]]
            depth = own["accumulated/shell/wear_depth_per_hour"]
            assert depth.attrs["units"] == "m" and depth.ndim == 2
            # To the last digit but one: the summary's is a product in another order.
            assert abs(depth[:].max() / bearing["wear_depth_per_hour_m"] - 1) < 4e-16
            assert bearing["wear_depth_per_hour_m"] == table["wear_depth_per_hour[m]"][row]
            assert bearing["wear_volume_per_hour_m3"] == table["wear_volume_per_hour[m3]"][row]
            assert own["accumulated/journal/friction_energy"][:].max() > 0
            warm = own["heat/effective_temperature"]
            assert warm.attrs["units"] == "K"
            assert abs(warm[()] - 273.15 - bearing["effective_temperature_degc"]) < 1e-9
            assert bearing["outlet_temperature_degc"] > bearing["effective_temperature_degc"] > 100
            assert table["effective_temperature[degC]"][row] == bearing["effective_temperature_degc"]
