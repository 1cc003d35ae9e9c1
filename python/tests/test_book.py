"""The book's page about Python shows what is so."""

from __future__ import annotations

import doctest
from pathlib import Path

import pytest

PAGE = next(
    (at / "docs" / "python.md" for at in Path(__file__).resolve().parents if (at / "docs" / "python.md").exists()), None
)


@pytest.mark.skipif(PAGE is None, reason="the tests stand alone, without the book")
def test_the_page_of_the_book(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert PAGE is not None
    monkeypatch.chdir(tmp_path)
    text = PAGE.read_text("utf-8").replace("```", "")
    examples = doctest.DocTestParser().get_doctest(text, {}, PAGE.name, str(PAGE), 0)
    assert len(examples.examples) > 15
    told: list[str] = []
    failed = doctest.DocTestRunner().run(examples, out=told.append)
    assert failed.failed == 0, "".join(told)
