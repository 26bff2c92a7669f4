"""Pictures with Matplotlib, where that is installed: what `plot()` of motions and results draws.

Each function draws into axes, new ones unless some are handed over, and returns them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ._softstop import MachineError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._batch import Motions
    from ._machine import Machine
    from ._motion import Motion
    from ._result import Attractors, Basin, Branch, Certainty, Design, Sweep, Zone

SAMPLES = 400
"""Points of a motion in each drive period."""
MARKS = {"SN": "o", "PD": "s", "NS": "^", "G": "D"}
"""Marks of special points."""


def new_axes(axes: Axes | None) -> Axes:
    """The axes themselves, or new ones.

    Raises
    ------
    ImportError
        If Matplotlib is not installed.
    """
    if axes is not None:
        return axes
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("plot() needs Matplotlib: pip install matplotlib") from error
    return pyplot.subplots()[1]


def _label(axes: Axes, machine: Machine, across: str, upwards: str) -> None:
    """Labels both axes with a quantity of motion or a key, with their units."""
    axes.set(xlabel=machine._inner.label(across), ylabel=machine._inner.label(upwards))


def _frequency(machine: Machine) -> str:
    """The key of the drive frequency in the machine's own unit."""
    return next(key for key in machine if key.startswith("excitation.frequency"))


def motion(motion: Motion, axes: Axes | None = None, periods: float = 4) -> Axes:
    """Position over time in the last drive periods, with the clearance and the impacts."""
    axes = new_axes(axes)
    begin = max(0.0, motion.duration - periods * motion.machine.period)
    count = round(SAMPLES * (motion.duration - begin) / motion.machine.period)
    times = np.linspace(begin, motion.duration, count + 1)
    axes.plot(times, motion.position(times), "k", linewidth=1)
    impacts = motion.impacts.time[motion.impacts.time >= begin]
    axes.plot(impacts, motion.position(impacts), "o", markersize=4, label="impacts")
    axes.axhline(motion.machine["clearance"], color="gray", linestyle="--", linewidth=1, label="clearance")
    _label(axes, motion.machine, "time", "position")
    axes.legend()
    return axes


def motions(motions: Motions, over: str | None = None, axes: Axes | None = None) -> Axes:
    """Before-impact velocities of the impacts that were kept over a value that was an array: a bifurcation diagram."""
    varied = [name for name, value in motions.values.items() if value.size > 1 and np.ptp(value) > 0]
    if over is not None and over not in motions.values:
        raise MachineError(f"over = {over!r}: must be one of {', '.join(motions.values) or 'the values that were arrays'}")
    name = over or (varied[0] if varied else "motion")
    number = motions.impacts.motion.astype(np.int64)
    label = motions.machine._inner.label
    values, across = number, name
    if name in motions.values:
        values, across = motions.values[name].ravel()[number], label(name.replace("__", "."))
    axes = new_axes(axes)
    axes.plot(values, motions.impacts.velocity, "k,")
    axes.set(xlabel=across, ylabel=label("before-impact velocity"))
    return axes


def attractors(found: Attractors, axes: Axes | None = None) -> Axes:
    """The motions that repeat, in the phase plane."""
    from ._batch import simulate

    axes = new_axes(axes)
    for it in found["motions"]:
        if it["kind"] != "periodic":
            continue
        motion = simulate(found.machine, start=(it["position"], it["velocity"]), periods=it["periods"])
        position, velocity = motion.sample(np.linspace(0, motion.duration, SAMPLES * it["periods"] + 1))
        axes.plot(position, velocity, linewidth=1, label=f"z = {it['z']}: {it['order']}, {100 * it['share']:.1f} %")
    _label(axes, found.machine, "position", "velocity")
    axes.legend()
    return axes


def zone(zone: Zone, axes: Axes | None = None) -> Axes:
    """Hysteresis zone and stretches of stable z = 1 over the drive frequency, with the hardest impacts."""
    axes = new_axes(axes)
    low, high = zone["frequency_g0"], zone["frequency_sn"]
    if low is not None and high is not None:
        axes.axvspan(low, high, alpha=0.15, label="hysteresis zone")
    for number, it in enumerate(zone["stretches"]):
        label = "stable z = 1" if number == 0 else None
        axes.plot([it["from"], it["to"]], [it["hardest"]] * 2, color="C0", marker="|", label=label)
        axes.plot([it["hardest_at"]], [it["hardest"]], "o", color="C1", label=label and "hardest impact")
    _label(axes, zone.machine, _frequency(zone.machine), "before-impact velocity")
    axes.set(ylim=(0, None))
    axes.legend()
    return axes


def branch(branch: Branch, axes: Axes | None = None) -> Axes:
    """Before-impact velocities over the parameter: stable solid, unstable dashed, with the special points."""
    axes = new_axes(axes)
    points = branch.points
    for number in np.unique(points.branch):
        own = points.branch == number
        value, velocity = points.value[own], points.before_impact_velocity[own]
        for is_stable, style in ((True, "-"), (False, "--")):
            near = points.stable[own] == is_stable
            # A line goes on to the point where it changes.
            near[1:] |= near[:-1] if is_stable else False
            axes.plot(value, np.where(near, velocity, np.nan), style, color=f"C{int(number)}", linewidth=1.2)
    specials = branch.specials
    for symbol in np.unique(specials.symbol) if len(specials) else ():
        rows = specials.symbol == symbol
        axes.plot(specials.value[rows], specials.before_impact_velocity[rows], MARKS[symbol], color="k", fillstyle="none", label=symbol)
    _label(axes, branch.machine, branch["parameter"], "before-impact velocity")
    if len(specials):
        axes.legend()
    return axes


def sweep(sweep: Sweep, axes: Axes | None = None) -> Axes:
    """Before-impact velocities over the parameter, upwards and downwards."""
    axes = new_axes(axes)
    steps = sweep.points
    for way, mark in (("up", "C0."), ("down", "C1.")):
        rows = steps.direction == way
        velocities = [[float(word) for word in str(cell).split()] for cell in steps.before_impact_velocities[rows]]
        values = np.repeat(steps.value[rows], [len(it) for it in velocities])
        if rows.any():
            axes.plot(values, np.concatenate(velocities), mark, markersize=2, label=way)
    _label(axes, sweep.machine, sweep["parameter"], "before-impact velocity")
    axes.legend()
    return axes


def basin(basin: Basin, axes: Axes | None = None) -> Axes:
    """The cells in the colours of the motions that they lead to."""
    axes = new_axes(axes)
    up, across = basin.dims
    for number, name in enumerate(basin.motions):
        axes.plot([], [], "s", color=f"C{number}", label=f"{name}: {100 * basin.shares[number]:.2f} %")
    from matplotlib.colors import to_rgb

    colors = np.array([to_rgb(f"C{number}") for number in range(len(basin.motions))])
    grid = basin["grid"]
    extent = (*grid["across"]["range"], *grid["up"]["range"])
    axes.imshow(colors[basin.labels], origin="lower", extent=extent, aspect="auto", interpolation="nearest")
    label = basin.machine._inner.label
    labels = {"x": f"initial {label('position')}", "v": f"initial {label('velocity')}", "phi": label("excitation.phase")}
    axes.set(xlabel=labels[across], ylabel=labels[up])
    axes.legend()
    return axes


def certainty(certainty: Certainty, axes: Axes | None = None) -> Axes:
    """The share of starts that lead to z = 1, with its 95 % interval, over the place in the zone."""
    axes = new_axes(axes)
    table = certainty.tables["certainty"]
    axes.fill_between(table.place, table.certainty_low, table.certainty_high, alpha=0.3)
    axes.plot(table.place, table.certainty)
    axes.set(xlabel="place in the zone, 0 at g0, 1 at s_SN", ylabel="certainty of z = 1", ylim=(0, 1))
    return axes


def design(design: Design, axes: Axes | None = None) -> Axes:
    """The branch of the design over the drive frequency, and the design on it."""
    from ._commands import continue_

    machine, found = design.machine, design["design"]
    name = _frequency(machine)
    width = found["zone_to"] - found["zone_from"]
    axes = branch(continue_(machine, name, (found["zone_from"] - 0.1 * width, found["zone_to"] + 0.1 * width)), axes)
    axes.plot([found["frequency"]], [found["before_impact_velocity"]], "*", color="C1", markersize=12, label="design")
    axes.legend()
    return axes
