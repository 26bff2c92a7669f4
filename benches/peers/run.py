"""Measures softstop and its peers on the same motions in one run.

    python3 benches/peers/run.py                     all peers, some ten minutes and the installation
    python3 benches/peers/run.py --quick             a second each, to see that all is well
    python3 benches/peers/run.py --only heyoka       peers whose names begin so

Everything is installed under the target directory with pip and cargo. Prints a table and writes the
results as JSON. docs/peers.md says what is measured and how.
"""

import argparse
import sys
from pathlib import Path

import catalogue
import install
import own
import report
from link import Worker
from measure import GOAL, Measurement, Result, Truth

BUDGET, QUICK_BUDGET = 10.0, 1.0


def arguments():
    """The command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--quick", action="store_true", help=f"{QUICK_BUDGET:g} s per peer")
    parser.add_argument("--budget", type=float, help=f"seconds per peer (default {BUDGET:g})")
    parser.add_argument(
        "--only",
        action="append",
        metavar="NAME",
        help="peers whose names begin with NAME; may be given several times",
    )
    parser.add_argument("--list", action="store_true", help="name the peers and end")
    parser.add_argument(
        "--json", type=Path, default=install.PLACE / "results.json", help="file of the results"
    )
    given = parser.parse_args()
    if given.budget is None:
        given.budget = QUICK_BUDGET if given.quick else BUDGET
    if not given.budget > 0.0:
        parser.error(f"--budget is {given.budget}, but must be above 0 s")
    for name in given.only or []:
        if not any(peer.name.startswith(name) for peer in catalogue.PEERS):
            names = ", ".join(peer.name for peer in catalogue.PEERS)
            parser.error(f"--only is {name}, but must begin one of {names}")
    return given


def wanted(only):
    """The peers to measure."""
    if not only:
        return catalogue.PEERS
    return [peer for peer in catalogue.PEERS if peer.name.startswith(tuple(only))]


def say(text):
    """Tells how far we are."""
    print(text, file=sys.stderr, flush=True)


def python_workers(peers):
    """Workers by name, and for those that cannot be had the reason."""
    workers, missing = {}, {}
    for name in sorted({peer.worker for peer in peers} - {"rust"}):
        say(f"installing {catalogue.REQUIREMENTS[name]}")
        try:
            workers[name] = Worker(install.python_worker(name))
        except install.InstallError as error:
            missing[name] = str(error)
    return workers, missing


def measure(peers, workers, missing, truths, budget):
    """The results of all peers, one after the other."""
    results = []
    for peer in peers:
        if peer.worker in missing:
            result = Result(peer.name, "not available", missing[peer.worker])
        else:
            say(f"measuring {peer.name}")
            result = Measurement(peer.name, workers[peer.worker], truths, budget).run()
        say(f"  {result.status} {result.reason} {result.rate:,.0f} periods/s")
        results.append(result)
    return results


def versions():
    """The version of each package."""
    pinned = (requirement.split("==") for requirement in catalogue.REQUIREMENTS.values())
    return {**install.crate_versions(), **dict(pinned)}


def run(given):
    """Installs, measures and reports."""
    peers = wanted(given.only)
    machine = report.machine()
    say("building softstop and the Rust peers (minutes, the first time)")
    program = install.laboratory()
    workers = {"rust": Worker(install.rust_worker())}
    added, missing = python_workers(peers)
    workers |= added
    try:
        rust = workers["rust"]
        spans = (catalogue.PERIODS, catalogue.SHORT_PERIODS)
        truths = {periods: Truth(rust, periods) for periods in spans}
        say("measuring softstop")
        lines, remark = own.lines(rust, truths[catalogue.PERIODS], program)
        results = measure(peers, workers, missing, truths, given.budget)
    finally:
        for worker in workers.values():
            worker.close()
    lines = report.rows(lines, results, peers, versions())
    comparable = len(truths[catalogue.PERIODS].regular)
    print(f"{machine['processor']}, {machine['cores']} cores, {', '.join(machine['instruction_sets'])}")
    print(f"load at the start {machine['load_at_start']}")
    print(f"{comparable} of {catalogue.COUNT} motions are regular and compared\n")
    print(report.table(lines))
    for told in (report.lead(lines), remark):
        if told:
            print(f"\n{told}")
    content = {
        "machine": machine,
        "scene": catalogue.SCENE,
        "goal": GOAL,
        "budget_seconds": given.budget,
        "comparable_motions": comparable,
        "remark": remark,
        "solvers": lines,
    }
    report.write(given.json, content)
    say(f"\nwritten: {given.json}")


def main():
    """Runs, with plain words for what can go wrong."""
    given = arguments()
    if given.list:
        for peer in catalogue.PEERS:
            print(f"{peer.name:42}{peer.setting}")
        return 0
    try:
        run(given)
    except install.InstallError as error:
        say(f"cannot measure anything: {error}")
        return 1
    except KeyboardInterrupt:
        say("interrupted, nothing written")
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
