"""softstop's own figures."""

import json
import statistics
import subprocess

from catalogue import PERIODS, request
from measure import REPEATS, SCALAR

# The one place where the figures of the program are read.
THROUGHPUT = ["throughput", "--format", "json"]
KEY = "periods_per_second_per_core"


def lines(worker, truth, program):
    """The lines of the table: the safe engine as the peers are measured, and what the program says of
    its engines, if it has the command; and a remark if not."""
    told, remark = _throughput(program)
    own = [_scalar(worker, truth)]
    for engine in ("safe", "scalar", "batch", "each_impact"):
        if engine in told:
            setting = "softstop-lab " + " ".join(THROUGHPUT)
            if "lanes" in told[engine]:
                setting += f": {told[engine]['instructions']}, {told[engine]['lanes']} lanes"
            name = "softstop safe (program)" if engine == "safe" else f"softstop {engine}".replace("_", " ")
            lead = {"times_safe": told[engine]["times_safe"]} if engine == "batch" else {}
            own.append(
                {
                    **lead,
                    "solver": name,
                    "setting": setting,
                    "status": "measured",
                    "periods_per_second": told[engine][KEY],
                    "slowest": told[engine]["spread"][0],
                    "fastest": told[engine]["spread"][1],
                }
            )
    return own, remark


def _scalar(worker, truth):
    line = request(SCALAR, 0.0, PERIODS, truth.order)
    times = [worker.ask(line, 60.0)[0] for _ in range(2 * REPEATS)]
    rates = [PERIODS * len(truth.order) / seconds for seconds in times]
    return {
        "solver": "softstop safe",
        "setting": "closed forms; every peer is compared with it",
        "status": "measured",
        "periods_per_second": statistics.median(rates),
        "slowest": min(rates),
        "fastest": max(rates),
        "motions": len(truth.order),
        "periods": PERIODS,
    }


def _throughput(program):
    try:
        done = subprocess.run(
            [program, *THROUGHPUT], capture_output=True, text=True, check=False, timeout=300
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return {}, f"no figure of the batch engine: {error}"
    if done.returncode:
        lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
        return {}, f"no figure of the batch engine: {lines[0]}"
    return json.loads(done.stdout), ""
