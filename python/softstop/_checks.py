"""What arguments must be: a wrong one is refused by its name before anything is computed."""

from __future__ import annotations

import functools
import inspect
import numbers
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ParamSpec, TypeVar

import numpy as np
import numpy.typing as npt

from . import _softstop

P = ParamSpec("P")
R = TypeVar("R")


def is_number(value: Any) -> bool:
    """Whether it is one number."""
    if isinstance(value, (bool, np.bool_, str, bytes, np.ma.MaskedArray)) or getattr(value, "ndim", 0) > 0:
        return False
    try:
        float(value)
    except (TypeError, ValueError, OverflowError):
        return False
    return True


def _is_whole(value: Any) -> bool:
    return is_number(value) and isinstance(value, numbers.Integral)


def _is_machine(value: Any) -> bool:
    return hasattr(value, "to_toml")


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, os.PathLike))


def _are(value: Any, fits: Callable[[Any], bool], least: int = 0, most: int = 1_000_000) -> bool:
    if isinstance(value, str) or not isinstance(value, (Sequence, np.ndarray)) or getattr(value, "ndim", 1) == 0:
        return False
    return least <= len(value) <= most and all(map(fits, value))


def pair(name: str, value: Any) -> tuple[Any, Any]:
    """Position and velocity of a start."""
    try:
        position, velocity = value
    except (TypeError, ValueError) as error:
        raise _softstop.MachineError(f"{name} = {value!r}: must be (position, velocity)") from error
    return position, velocity


def floats(name: str, value: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """An argument as an array of numbers; complex ones and words are none."""
    if np.ma.is_masked(value):
        raise _softstop.MachineError(f"{name} = {value!r}: must have no masked values")
    try:
        return np.asarray(value).astype(np.float64, casting="same_kind", copy=False)
    except (TypeError, ValueError) as error:
        raise _softstop.MachineError(f"{name} = {value!r}: must be a number or an array of numbers") from error


RULES: dict[str, tuple[Callable[[Any], bool], str]] = {
    "Machine": (_is_machine, "a Machine"),
    "Mapping[str, Any]": (lambda value: isinstance(value, Mapping), "a mapping"),
    "Mapping[str, Any] | str | os.PathLike[str]": (
        lambda value: (isinstance(value, Mapping) and not _is_machine(value)) or _is_path(value),
        "a mapping, or the path of a file",
    ),
    "Mapping[str, Change]": (lambda value: isinstance(value, Mapping), "a mapping"),
    "Point": (
        lambda value: _are(value, bool, 2, 2)
        and hasattr(value[0], "specials")
        and (isinstance(value[1], str) or _is_whole(value[1])),
        "(branch, point)",
    ),
    "Range": (lambda value: _are(value, is_number, 2, 2), "two numbers"),
    "Side": (
        lambda value: _are(value, is_number, 2, 3) and isinstance([*value, 0][2], numbers.Integral),
        "(low, high) or (low, high, cells)",
    ),
    "Sequence[float]": (lambda value: _are(value, is_number), "a sequence of numbers"),
    "Sequence[str]": (lambda value: _are(value, lambda one: isinstance(one, str)), "a sequence of strings"),
    "bool": (lambda value: isinstance(value, (bool, np.bool_)), "True or False"),
    "float": (is_number, "a number"),
    "int": (_is_whole, "a whole number"),
    "str": (lambda value: isinstance(value, str), "a string"),
    "str | os.PathLike[str]": (_is_path, "the path of a file"),
}
"""Which values an annotation allows, and what they are called. Keywords without a name of their own are not looked at."""


def checked(function: Callable[P, R]) -> Callable[P, R]:
    """The function, which raises `MachineError` for an argument that its annotation does not allow."""
    signature = inspect.signature(function)
    rules = {
        name: (RULES[kind], optional)
        for name, parameter in signature.parameters.items()
        for kind, optional in [(str(parameter.annotation).removesuffix(" | None"), "| None" in str(parameter.annotation))]
        if kind in RULES and parameter.kind is not inspect.Parameter.VAR_KEYWORD
    }

    @functools.wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        for name, value in signature.bind(*args, **kwargs).arguments.items():
            if name in rules:
                (fits, what), optional = rules[name]
                if not (optional and value is None) and not fits(value):
                    raise _softstop.MachineError(f"{name} = {value!r}: must be {what}")
        return function(*args, **kwargs)

    return call
