"""Runs the shards of a study on Dask workers, then merges them.

    python scripts/dask/study.py study.toml --shards 64
    python scripts/dask/study.py study.toml --shards 640 --scheduler tcp://head:8786

Without --scheduler the workers are processes of this machine, one for each core. All workers must see the study, its
machine's file, the program and the output folder at the same paths. A shard whose worker is killed is given to another
one, which goes on where the first was.
"""

import argparse
import os
import pathlib
import subprocess
import sys

from distributed import Client, KilledWorker, LocalCluster, as_completed


def run(command, threads):
    """One shard; what an earlier run of it has done is taken up."""
    environment = dict(os.environ, RAYON_NUM_THREADS=str(threads))
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)}\n{done.stderr}")


def compute(client, words, shards, threads):
    """All shards, each until it is done."""
    def submit(shard):
        command = [*words, "--shard", f"{shard}/{shards}", "--resume"]
        future = client.submit(run, command, threads, pure=False)
        shard_of[future.key] = shard
        return future

    shard_of, done = {}, 0
    futures = as_completed([submit(shard) for shard in range(1, shards + 1)])
    for future in futures:
        if isinstance(future.exception(), KilledWorker):
            futures.add(submit(shard_of[future.key]))
            continue
        future.result()
        done += 1
        print(f"{done} of {shards} shards", file=sys.stderr, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=pathlib.Path, help="the study")
    parser.add_argument("--shards", type=int, required=True, help="how many; some for each worker")
    parser.add_argument("--output", type=pathlib.Path, default="softstop-study", help="folder for shards and results")
    parser.add_argument("--program", default="softstop", help="the program softstop")
    parser.add_argument("--scheduler", help="address of a Dask scheduler")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="processes on this machine")
    parser.add_argument("--threads", type=int, default=1, help="threads that each shard uses")
    parser.add_argument("--csv", action="store_true", help="write study.csv, too")
    given = parser.parse_args()
    words = [given.program, "study", str(given.study.resolve()), "--output", str(given.output.resolve())]
    if given.scheduler:
        client = Client(given.scheduler)
    else:
        cluster = LocalCluster(given.workers, threads_per_worker=1, dashboard_address=None)
        client = Client(cluster)
    with client:
        compute(client, words, given.shards, given.threads)
    if not given.scheduler:
        cluster.close()
    merge = [*words[:2], "merge", *words[2:], *["--csv"] * given.csv]
    sys.exit(subprocess.run(merge, check=False).returncode)


if __name__ == "__main__":
    main()
