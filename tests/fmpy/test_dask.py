"""The shards of a study on a Dask cluster of processes, one of which is killed in the middle."""

import pathlib
import subprocess
import sys
import time

import psutil
import pytest
from conftest import TOP

PROGRAM = TOP / "target" / "release" / "softstop"
SCRIPT = TOP / "scripts" / "dask" / "study.py"
STUDY = """
machine = "unloaded"
outputs = ["z", "velocity"]
[[axis]]
parameter = "eta"
from = 0.8
to = 1.8
count = 300
[[axis]]
parameter = "rho"
from = 2
to = 24
count = 200
"""


def worker_of_a_shard(script):
    """A worker with a shard under way; none if there is none."""
    for process in script.children(recursive=True):
        try:
            if process.name() == PROGRAM.name and "--shard" in process.cmdline():
                return process.parent()
        except psutil.Error:
            pass
    return None


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_a_killed_worker_loses_nothing(tmp_path):
    study = tmp_path / "study.toml"
    study.write_text(STUDY)
    whole, parts = tmp_path / "whole", tmp_path / "parts"
    subprocess.run([PROGRAM, "study", study, "--output", whole], check=True, capture_output=True)
    run = subprocess.Popen(
        [sys.executable, SCRIPT, study, "--program", PROGRAM, "--shards", "6", "--workers", "2",
         "--output", parts],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
    )
    script, killed = psutil.Process(run.pid), 0
    while run.poll() is None:
        worker = worker_of_a_shard(script) if killed < 3 else None
        if worker is not None:
            worker.kill()
            killed += 1
            time.sleep(1.0)
        time.sleep(0.02)
    assert run.returncode == 0, run.stderr.read()
    assert killed > 0
    table = "study.parquet"
    assert pathlib.Path(parts / table).read_bytes() == pathlib.Path(whole / table).read_bytes()
