"""Vectors, RTL, the judgement of a log, and error reports."""

import csv
import json
import os
import subprocess

import blysk
import numpy as np
import pytest


@pytest.fixture(scope="module")
def compact():
    return blysk.Model.preset("compact")


def answers(model, directory):
    """The log of a design that answers as the model: its columns, and a row for each vector."""
    with open(directory / "vectors.csv", newline="") as table:
        vectors = list(csv.DictReader(line for line in table if not line.startswith("#")))
    intensity, status = model.evaluate([int(v["address"]) for v in vectors], [int(v["x_bits"]) for v in vectors])
    return [[f"{i:x}", f"{s:x}"] for i, s in zip(intensity, status)]


def write(rows, log):
    log.write_text("\n".join(["intensity,status", *(",".join(row) for row in rows)]) + "\n")


def test_a_bundle_is_written_and_judged(compact, tmp_path):
    manifest = blysk.vectors(compact, tmp_path / "vectors", strategy="corners", count=300, seed=7)
    assert manifest["counts"]["vectors"] == 300 and manifest["hardware"]["latency"] == compact.latency
    rows = answers(compact, tmp_path / "vectors")
    write(rows, tmp_path / "log.csv")
    verdict = blysk.check(tmp_path / "vectors", tmp_path / "log.csv")
    assert verdict.holds and (verdict.vectors, verdict.failing) == (300, 0) and verdict.text == "PASS 300 vectors"
    rows[41][0] = f"{int(rows[41][0], 16) ^ 1:x}"
    write(rows, tmp_path / "wrong.csv")
    verdict = blysk.check(tmp_path / "vectors", tmp_path / "wrong.csv")
    assert not verdict.holds and verdict.failing == 1
    assert verdict.text.startswith("FAIL vector 41: n = ") and "intensity: got 0x" in verdict.text
    told = subprocess.run(
        [os.environ["BLYSK"], "check", "--vectors", tmp_path / "vectors", "--log", tmp_path / "wrong.csv"],
        capture_output=True,
        text=True,
    )
    assert (told.returncode, told.stdout) == (1, verdict.text + "\n")


def test_the_same_call_writes_the_same_bytes(compact, tmp_path):
    for place in ("a", "b"):
        blysk.rtl(compact, tmp_path / place, strategy="random", count=32, seed=3)
    names = sorted(path.name for path in (tmp_path / "a").iterdir())
    assert set(blysk.RTL_SOURCES) <= set(names) and "blysk_tb.sv" in names
    for name in names:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes(), name


def test_stimulus_is_that_of_the_vectors(compact, tmp_path):
    blysk.vectors(compact, tmp_path, strategy="random", count=50, seed=9)
    addresses, xs = blysk.stimulus(compact, strategy="random", count=50, seed=9)
    intensity, status = compact.evaluate(addresses, xs)
    assert answers(compact, tmp_path) == [[f"{i:x}", f"{s:x}"] for i, s in zip(intensity, status)]


def test_files_that_are_refused(compact, tmp_path):
    with pytest.raises(blysk.FileError, match="is not a strategy; use mixed"):
        blysk.vectors(compact, tmp_path, strategy="best")
    with pytest.raises(blysk.FileError, match="a bundle of 0 vectors"):
        blysk.vectors(compact, tmp_path, count=0)
    with pytest.raises(blysk.FileError, match="manifest"):
        blysk.check(tmp_path / "none", tmp_path / "log.csv")
    (tmp_path / "file").write_text("")
    with pytest.raises(blysk.FileError):
        blysk.vectors(compact, tmp_path / "file" / "below", strategy="random", count=4)


def test_a_report_has_a_row_for_each_exponent(compact):
    report = blysk.report(compact)
    assert {len(column) for column in report.values()} == {256}
    assert report["holds"].all() and not report["full_range_holds"].all()
    assert report["total_abs"].max() < 0.0067 < report["full_range_abs"].max()
    assert np.array_equal(report["n"], compact.exponents)
    assert not blysk.report(compact, bound=1e-6)["holds"].any()
    with pytest.raises(blysk.InputError, match="at most 1"):
        blysk.report(compact, bound=2)


def test_a_bound_counts_every_x():
    narrow = json.loads(blysk.Model.preset("compact").configuration) | {"input": "UQ1.10", "exponents": "1..=8"}
    # Its cut is stated for other x.
    del narrow["widths"]
    model = blysk.Model.from_json(json.dumps(narrow))
    bound = model.bound()
    assert bound.points == 8 * 1025
    every = np.arange(1025)
    for n in range(1, 9):
        error = np.abs(model.evaluate(n=n, x_bits=every)[0] * model.formats["intensity"].ulp - (every / 1024) ** n)
        assert error.max() <= bound.full_range.error
        if n == bound.full_range.n:
            assert error.max() >= bound.full_range.at_least - 1e-12
    assert bound.epicentre.error < 0.0067 and bound.epicentre.at_least <= bound.epicentre.error
    assert model.bound() is not None
