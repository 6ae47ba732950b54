"""What the guide shows of Python runs."""

import re
from pathlib import Path

import pytest
from conftest import ROOT

CHAPTERS = sorted((ROOT / "src/guide").glob("*.md"))
BLOCKS = [
    (chapter.stem, text) for chapter in CHAPTERS for text in re.findall(r"^```python\n(.*?)^```$", chapter.read_text(), re.M | re.S)
]


def test_there_are_blocks() -> None:
    assert len(BLOCKS) >= 2


@pytest.mark.parametrize(("chapter", "text"), BLOCKS, ids=[f"{name}-{i}" for i, (name, _) in enumerate(BLOCKS)])
def test_blocks_run(chapter: str, text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cases").symlink_to(ROOT / "cases")
    exec(compile(text, chapter, "exec"), {})
