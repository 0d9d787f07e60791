"""A run as a terminal shows it: one bar for all speeds, with the time left."""

import os
import pty
import re
import subprocess

from conftest import ROOT, engine_study


def shown(command):
    """What a command writes to the terminal on its standard error, and its exit code."""
    terminal, its_end = pty.openpty()
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=its_end) as process:
        os.close(its_end)
        text = b""
        while True:
            try:
                piece = os.read(terminal, 4096)
            except OSError:
                # The other end is closed.
                break
            if not piece:
                break
            text += piece
        code = process.wait()
    os.close(terminal)
    return text.decode(), code


def test_twenty_speeds_share_one_bar_that_tells_the_time_left(tmp_path):
    film = 'model = "short-bearing"\ncavitation = "gumbel"'
    study = engine_study(tmp_path, range(1000, 5000, 200), film)
    command = os.environ.get("SOMMERFELD_BIN", str(ROOT / "target/debug/sommerfeld"))
    text, code = shown([command, "run", study, "--out", tmp_path / "results"])
    assert code == 0, text
    steps = re.findall(r"(\d+) %  (\d+) of 60 orbits at 20 speeds  (\S+) left", text)
    assert len(steps) >= 5, text
    shares = [int(share) for share, _, _ in steps]
    done = [int(done) for _, done, _ in steps]
    assert shares == sorted(shares) and done == sorted(done)
    assert shares[0] < 20 and shares[-1] > 80
