"""What the guide shows in Python runs as printed, block after block, and prints what it says."""

import re

from conftest import TOP

PAGE = TOP / "docs/tutorials/python.md"


def test_tutorial(monkeypatch, tmp_path, capsys):
    (tmp_path / "docs").symlink_to(TOP / "docs")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert len(blocks) == 4
    names = {}
    for block in blocks:
        exec(block, names)
    assert names["design"].machine.name == "loaded design"
    assert len(names["diagram"][0]) == len(names["batch"].impacts)
    printed = capsys.readouterr().out
    for said in re.findall(r"print\(.*\) +# ([\d.]+\d)(?:\.\.\.)?$", PAGE.read_text(encoding="utf-8"), re.MULTILINE):
        assert said in printed, said
