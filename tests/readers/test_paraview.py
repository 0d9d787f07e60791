"""The films as VTK, the library of ParaView, reads them, against the tables of the same run."""

import h5py
import numpy as np
import pyvista

NAMES = ["pressure [Pa]", "film fraction", "film thickness [m]"]


def read(results):
    return pyvista.get_reader(results.path("film.pvd"))


def integrate(film):
    """Force on the journal, N, and area of the surface, m2."""
    cells = film.compute_cell_sizes(length=False, volume=False)
    area = cells.cell_data["Area"]
    centres = film.cell_centers().points[:, :2]
    normal = centres / np.linalg.norm(centres, axis=1)[:, None]
    pressure = film.cell_data["pressure [Pa]"]
    return -((pressure * area)[:, None] * normal).sum(axis=0), area.sum()


def test_a_steady_film_is_one_closed_surface(steady):
    reader = read(steady)
    assert reader.time_values == [0.0]
    film = reader.read()[0]
    assert isinstance(film, pyvista.StructuredGrid)
    assert film.dimensions == (129, 33, 1)
    assert sorted(film.cell_data.keys()) == sorted(NAMES)
    rows = film.points.reshape(33, 129, 3)
    assert np.array_equal(rows[:, 0], rows[:, -1])
    assert np.allclose(np.hypot(rows[..., 0], rows[..., 1]), 0.050, rtol=1e-6)
    assert np.allclose([rows[..., 2].min(), rows[..., 2].max()], [-0.025, 0.025])


def test_the_steady_film_is_that_of_the_table(steady):
    film, table = read(steady).read()[0], steady.table("film.csv")
    columns = ["pressure[Pa]", "film_fraction[-]", "film_thickness[m]"]
    for name, column in zip(NAMES, columns):
        found = film.cell_data[name].reshape(32, 128).T.ravel()
        assert np.allclose(found, table[column], rtol=1e-6), name
    # Each value stands where the table says: cell centres, but for the bend of the cell.
    centres = film.cell_centers().points.reshape(32, 128, 3).transpose(1, 0, 2).reshape(-1, 3)
    angle = np.radians(table["angle[deg]"])
    radius = np.hypot(centres[:, 0], centres[:, 1])
    assert np.abs(centres[:, 0] - radius * np.cos(angle)).max() < 0.01 * 0.05
    assert np.abs(centres[:, 1] - radius * np.sin(angle)).max() < 0.01 * 0.05
    assert np.abs(1e3 * centres[:, 2] - table["axial[mm]"]).max() < 0.2


def test_contact_and_temperature_are_shown_where_they_are_calculated(mixed):
    film = read(mixed).read()[0]
    own = ["contact pressure [Pa]", "temperature [K]"]
    assert sorted(film.cell_data.keys()) == sorted(NAMES + own)
    hottest = mixed.summary["hottest_temperature_degc"] + 273.15
    # As in results.h5, and single precision.
    bar = mixed.summary["temperature_changes_k"][-1] + 1e-4
    assert abs(film.cell_data["temperature [K]"].max() - hottest) <= bar < 0.1
    assert 0 < film.cell_data["contact pressure [Pa]"].max() <= mixed.summary["peak_contact_pressure_pa"] * (1 + 1e-6)


def test_the_pressure_carries_the_load(steady, cycle):
    force, area = integrate(read(steady).read()[0])
    assert abs(area / (np.pi * 0.100 * 0.050) - 1) < 1e-3
    assert np.linalg.norm(force - np.array(steady.summary["force_n"])) < 0.01 * 50e3
    reader, table = read(cycle), cycle.table("cycle.csv")
    largest = cycle.summary["maximum_load_n"]
    for number in range(0, 72, 8):
        reader.set_active_time_point(number)
        row = np.abs(np.array(table["crank_angle[deg]"]) - reader.time_values[number]).argmin()
        force, _ = integrate(reader.read()[0])
        expected = [table["force_x[N]"][row], table["force_y[N]"][row]]
        assert np.linalg.norm(force - expected) < 0.015 * largest, number


def test_a_cycle_has_its_frames(cycle):
    reader = read(cycle)
    assert len(reader.time_values) == 72
    assert np.all(np.diff(reader.time_values) > 0) and reader.time_values[-1] == 720.0
    table = cycle.table("cycle.csv")
    crank = np.array(table["crank_angle[deg]"])
    for number in [0, 30, 71]:
        reader.set_active_time_point(number)
        film = reader.read()[0]
        row = np.abs(crank - reader.time_values[number]).argmin()
        assert film.cell_data["pressure [Pa]"].max() <= table["peak_film_pressure[Pa]"][row] * (1 + 1e-6)
        least = table["minimum_film_thickness[m]"][row]
        assert film.cell_data["film thickness [m]"].min() >= least * (1 - 1e-6)
    assert len(list(cycle.path("paraview").iterdir())) == 72


def test_wear_of_both_surfaces_is_shown(worn):
    for name, own in [("shell", ["wear depth per hour [m]", "worn depth [m]"]), ("journal", [])]:
        surface = pyvista.read(worn.path("paraview") / f"wear-{name}.vts")
        assert isinstance(surface, pyvista.StructuredGrid) and surface.dimensions == (33, 5, 1)
        common = ["friction energy [J/m2]", "mean pressure velocity [W/m2]", "peak pressure velocity [W/m2]",
                  "wear load [J/m2]"]
        assert sorted(surface.cell_data.keys()) == sorted(common + own)
        with h5py.File(worn.path("results.h5")) as file:
            group = file[f"accumulated/{name}"]
            found = surface.cell_data["wear load [J/m2]"].reshape(4, 32).T
            assert np.allclose(found, group["wear_load"][:], rtol=1e-6)
            if name == "shell":
                worn_off = surface.cell_data["worn depth [m]"].reshape(4, 32).T
                assert np.allclose(worn_off, file["running_in/shell/worn_depth"][:], rtol=1e-6)
        # The film wears the shell where the load presses the journal: a cell of the map lies there.
        if name == "shell":
            deepest = surface.cell_data["wear depth per hour [m]"].argmax()
            x, y, _ = surface.cell_centers().points[deepest]
            angle = np.degrees(np.arctan2(y, x)) % 360
            apart = (angle - worn.summary["wear_depth_angle_deg"] + 180) % 360 - 180
            assert abs(apart) < 1
    assert read(worn).time_values[-1] == 720.0
