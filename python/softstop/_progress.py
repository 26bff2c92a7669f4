"""Progress of long work by tqdm, where that is installed."""

from __future__ import annotations

import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import Any

PATIENCE = 1.0
"""Seconds that work takes before its progress is shown."""

Teller = Callable[[str, int, int | None], None]


@contextmanager
def shown(progress: bool) -> Generator[Teller | None, None, None]:
    """Who is told of progress: what is counted, how much is done, and of how much."""
    tqdm = _tqdm() if progress else None
    if tqdm is None:
        yield None
        return
    bars: dict[str, Any] = {}
    begin = time.monotonic()

    def tell(what: str, done: int, total: int | None) -> None:
        if time.monotonic() - begin < PATIENCE:
            return
        if what not in bars:
            close()
            bars[what] = tqdm(desc=what, total=total, initial=done, leave=False)
        bars[what].total = total
        bars[what].update(done - bars[what].n)

    def close() -> None:
        for bar in bars.values():
            bar.close()
        bars.clear()

    try:
        yield tell
    finally:
        close()


def _tqdm() -> Any:
    try:
        from tqdm.auto import tqdm  # type: ignore[import-untyped, unused-ignore]
    except ImportError:
        return None
    return tqdm
