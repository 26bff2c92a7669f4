"""Kills Dask workers, shards and merges of a study at random moments, and compares what comes out with an undisturbed run.

    python scripts/dask/kills.py docs/studies/map.toml --kills 50

Whatever is killed, the same line is given again until it ends well; a study that is done before so many kills is begun
anew.
"""

import argparse
import filecmp
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).parent


def children(process):
    """The processes that the threads of a process have started."""
    found = []
    for path in pathlib.Path(f"/proc/{process}/task").glob("*/children"):
        try:
            found += map(int, path.read_text().split())
        except OSError:
            pass
    return found


def kind(process):
    """What a process below study.py is, if it is one to kill."""
    try:
        words = pathlib.Path(f"/proc/{process}/cmdline").read_bytes().split(b"\0")
    except OSError:
        return None
    if b"study" in words:
        return "merge" if b"merge" in words else "shard"
    return "worker" if any(b"spawn_main" in word for word in words) else None


def victims(process):
    """All processes below one that are to be killed, each with what it is."""
    for child in children(process):
        of = kind(child)
        if of:
            yield child, of
        yield from victims(child)


def disturb(line, chance, left, killed):
    """Runs a line, killing what it has started; true if it ended well."""
    run = subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while run.poll() is None:
        time.sleep(chance.uniform(0.1, 1.2))
        found = {}
        for process, of in victims(run.pid):
            found.setdefault(of, []).append(process)
        if not found or sum(killed.values()) >= left:
            continue
        of = chance.choice(sorted(found))
        try:
            os.kill(chance.choice(found[of]), signal.SIGKILL)
            killed[of] = killed.get(of, 0) + 1
            print(f"{sum(killed.values())}: a {of}", file=sys.stderr, flush=True)
        except ProcessLookupError:
            pass
    return run.returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=pathlib.Path, help="the study")
    parser.add_argument("--kills", type=int, default=50, help="how many")
    parser.add_argument("--seed", type=int, default=1, help="of the moments")
    parser.add_argument("--shards", type=int, default=16, help="of the study")
    parser.add_argument("--program", default="softstop", help="the program softstop")
    given = parser.parse_args()
    chance, killed, runs = random.Random(given.seed), {}, 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        whole, out = folder / "whole", folder / "out"
        subprocess.run([given.program, "study", given.study, "--csv", "--output", whole], check=True, capture_output=True)
        line = [sys.executable, HERE / "study.py", given.study, "--shards", str(given.shards)]
        line += ["--program", given.program, "--output", out, "--csv"]
        while sum(killed.values()) < given.kills:
            shutil.rmtree(out, ignore_errors=True)
            runs += 1
            while not disturb(line, chance, given.kills, killed):
                runs += 1
            print(f"{runs} runs, and a study done", file=sys.stderr, flush=True)
            for name in ["study.parquet", "study.csv"]:
                if not filecmp.cmp(whole / name, out / name, shallow=False):
                    sys.exit(f"{name} differs after {killed}")
            left = sorted(path.name for path in out.iterdir() if path.suffix not in (".blocks", ".parquet", ".csv", ".json"))
            if left:
                sys.exit(f"left behind: {left}")
    told = ", ".join(f"{count} {of}s" for of, count in sorted(killed.items()))
    print(f"{sum(killed.values())} kills ({told}) in {runs} runs: the same bytes")


if __name__ == "__main__":
    main()
