from pathlib import Path

import pytest

import curveflow as cf


def test_a_page_is_one_file_that_is_not_replaced_unasked(circle: cf.Scene, tmp_path: Path):
    result, path = cf.run(circle), tmp_path / "circle.html"
    result.view(path)
    page = path.read_text(encoding="utf-8")
    assert page.startswith("<!DOCTYPE html>") and "<title>Circle</title>" in page
    with pytest.raises(cf.StorageError, match="already exists"):
        result.view(path)
    result.view(path, replace=True)
    with pytest.raises(cf.StorageError, match="ends in .html"):
        result.view(tmp_path / "circle.h5")
