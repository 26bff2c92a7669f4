"""The machine, the table and the file of results."""

import json
import math
import os
import platform
from pathlib import Path

SETS = ["sse4_2", "avx", "avx2", "fma", "avx512f", "avx512dq", "neon", "asimd"]
HEAD = [
    "solver",
    "softstop safe is faster by",
    "softstop batch is faster by",
    "periods/s",
    "spread",
    "error: median, largest",
    "impact counts wrong",
    "tolerance",
    "motions",
    "version",
    "setting",
]


def machine():
    """What the figures were measured on."""
    told = _cpuinfo()
    flags = (told.get("flags") or told.get("Features") or "").split()
    load = os.getloadavg() if hasattr(os, "getloadavg") else (math.nan,) * 3
    return {
        "processor": told.get("model name") or platform.processor() or platform.machine(),
        "cores": os.cpu_count(),
        "instruction_sets": [name for name in SETS if name in flags],
        "system": platform.platform(terse=True),
        "python": platform.python_version(),
        "load_at_start": round(load[0], 2),
    }


def _cpuinfo():
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return {}
    pairs = (line.split(":", 1) for line in reversed(lines) if ":" in line)
    return {key.strip(): value.strip() for key, value in pairs}


def rows(own, results, peers, versions):
    """One mapping per line of the table: softstop, then the peers from fast to slow."""
    by_name = {peer.name: peer for peer in peers}
    ordered = sorted(results, key=lambda result: -(result.rate if result.rates else -1.0))
    return own + [_row(result, by_name[result.name], own, versions) for result in ordered]


def _row(result, peer, own, versions):
    row = {
        "solver": result.name,
        "version": versions.get(peer.package, ""),
        "setting": peer.setting,
        "status": result.status,
    }
    if not result.rates:
        return {**row, "reason": result.reason}
    # Both engines are timed by turns on the wall, the peers by processor time: the ratio of the engines holds
    # on a machine that others use, the rate itself does not.
    ahead = next((one["times_safe"] for one in own if "times_safe" in one), None)
    safe_ratio = result.safe_rate / result.rate
    return {
        **row,
        "tolerance": result.tolerance,
        "periods_per_second": result.rate,
        "slowest": min(result.rates),
        "fastest": max(result.rates),
        "error": _finite(result.error),
        "median_error": _finite(result.median_error),
        "impact_counts_wrong": result.differing,
        "compared": result.compared,
        "motions": result.trajectories,
        "periods": result.periods,
        "softstop_safe_periods_per_second": result.safe_rate,
        "safe_ratio": safe_ratio,
        "batch_ratio": safe_ratio * ahead if ahead else None,
    }


def _finite(value):
    return value if math.isfinite(value) else None


def table(lines):
    """A table in Markdown."""
    cells = [HEAD, *(_cells(line) for line in lines)]
    widths = [max(len(row[k]) for row in cells) for k in range(len(HEAD))]
    text = [
        "| " + " | ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)) + " |" for row in cells
    ]
    text.insert(1, "|" + "|".join("-" * (width + 2) for width in widths) + "|")
    return "\n".join(text)


def lead(lines, rival="heyoka-batch"):
    """How far softstop's batch engine is ahead of the fastest of the peers' batch modes; none if either
    was not measured."""
    ratios = (line.get("batch_ratio") for line in lines if line["solver"] == rival)
    ratio = next(ratios, None)
    return f"softstop batch is {_figure(ratio)} times as fast as {rival}" if ratio else ""


def _cells(line):
    last = [line.get("version", ""), line.get("setting", "")]
    if "periods_per_second" not in line:
        return [line["solver"], "", "", f"{line['status']}: {line['reason']}"[:100], *[""] * 5, *last]
    rate = line["periods_per_second"]
    spread = ""
    if "slowest" in line:
        spread = f"{100.0 * (line['fastest'] - line['slowest']) / rate:.0f} %"
    error = ", ".join(f"{line[key]:.1e}" for key in ("median_error", "error") if line.get(key) is not None)
    if line["status"].startswith("does not"):
        error += " (goal missed)"
    wrong = f"{line['impact_counts_wrong']} of {line['compared']}" if "compared" in line else ""
    motions = f"{line['motions']} x {line['periods']} periods" if "motions" in line else ""
    return [
        line["solver"],
        *(_figure(line[key]) if line.get(key) else "" for key in ("safe_ratio", "batch_ratio")),
        _figure(rate),
        spread,
        error,
        wrong,
        f"{line['tolerance']:.1e}" if line.get("tolerance") else "",
        motions,
        *last,
    ]


def _figure(value):
    """Three digits, thousands apart."""
    digits = max(0, 2 - math.floor(math.log10(value)))
    rounded = round(value, 2 - math.floor(math.log10(value)))
    return f"{rounded:,.{digits}f}"


def write(path, content):
    """Puts the file in place whole."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(path.name + ".part")
    part.write_text(json.dumps(content, indent=1) + "\n")
    os.replace(part, path)
