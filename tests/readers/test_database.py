"""A database as h5py reads it: the lines of book/src/databases.md, and what a node must hold."""

import h5py
import numpy as np
import pytest

from conftest import ROOT, run

STUDY = """
schema = 1
title = "Small table"
analysis = "database"

[database]
scheme = "combined"
width_ratios = 0.5
target = 5e-3
samples = 100

[film]
cavitation = "gumbel"
"""


def text(value):
    """Text of an attribute: of fixed length, so that every program reads it."""
    return value.decode() if isinstance(value, bytes) else value


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """A small table."""
    directory = tmp_path_factory.mktemp("database")
    (directory / "table.toml").write_text(STUDY)
    run(directory / "table.toml", directory / "results")
    return directory / "results" / "table.h5"


def test_the_lines_of_the_book_run(file, capsys, monkeypatch):
    text = (ROOT / "book/src/databases.md").read_text()
    code = text.split("```python\n")[1].split("```")[0]
    monkeypatch.chdir(file.parent)
    exec(code, {})
    width_ratio, eccentricity, angle, along, across = map(float, capsys.readouterr().out.split())
    with h5py.File(file) as table:
        assert width_ratio == 0.5
        assert eccentricity == table["eccentricity"][10]
        assert angle == table["angle"][10, 8]
        assert [along, across] == [table["force_along"][0, 10, 8], table["force_across"][0, 10, 8]]


def test_what_the_book_says_of_the_nodes(file):
    with h5py.File(file) as table:
        eps, a, angle = table["eccentricity"][:], table["direction"][:], table["angle"][:]
        root = np.sqrt(1 - eps**2)
        s = (root / (3 - 2 * root))[:, None]
        t = np.tan(np.pi / 4 - angle / 2)
        np.testing.assert_allclose(np.arcsinh(t / s) / np.arcsinh(1 / s), np.broadcast_to(a, t.shape), atol=1e-9)
        np.testing.assert_allclose(np.diff(np.arctanh(eps)), np.arctanh(0.999) / (len(eps) - 1), rtol=1e-9)
        along, across = table["force_along"][0], table["force_across"][0]
        assert np.all(-(along * np.cos(angle) + across * np.sin(angle)) > 0)
        assert table["node_error"][:].max() == table.attrs["error_nodes_maximum"]
        # A film of B/D = 0.5 that only closes, relative eccentricity 0: about (B/D)^2 pi times 12/2 for a short
        # bearing of half a film, less what flows around.
        centred = -along[0, -1]
        assert 0.3 < centred / (4 * np.pi * 0.25) < 1
        for name in table:
            assert text(table[name].attrs["unit"]) in ("1", "rad") and len(table[name].attrs["meaning"]) > 5


def test_the_attributes_hold_what_it_was_built_from(file):
    with h5py.File(file) as table:
        attributes = {name: text(value) for name, value in table.attrs.items()}
    assert attributes["format"] == "sommerfeld-database" and attributes["scheme"] == "combined"
    assert attributes["closure"] == "gumbel" and attributes["inlet"] == "cyclic"
    assert list(attributes["width_ratios"]) == [0.5, 0.5]
    errors = [attributes[f"error_{name}"] for name in ("median", "quantile_999", "maximum")]
    assert 0 < errors[0] <= errors[1] <= errors[2] <= attributes["target"]
    assert attributes["samples"] == 100 and attributes["layout"] == 1
    assert len(attributes["check"]) == 16 and attributes["solver_version"]
