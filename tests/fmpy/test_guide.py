"""What the guide shows in Python runs as printed, block after block."""

import importlib.util
import pathlib
import re
import shutil

PAGE = pathlib.Path(__file__).parents[2] / "docs/tutorials/fmu.md"


def test_tutorial(path, tmp_path, monkeypatch):
    shutil.copy(path, tmp_path / "softstop.fmu")
    shutil.copy(pathlib.Path(path).with_name("piercing-machine.ssp"), tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert len(blocks) == 5
    can_draw = importlib.util.find_spec("matplotlib") is not None
    names = {}
    for block in blocks:
        if can_draw or "matplotlib" not in block:
            exec(block, names)
    assert names["result"]["impact.count"][-1] == 10
    assert names["system"]["press.impact.count"][-1] == names["system"]["press.pierce.count"][-1] == 22
