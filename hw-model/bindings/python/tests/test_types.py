"""The types that the package says it has are those that it has."""

import subprocess
import sys
from pathlib import Path

import blysk

PACKAGE = Path(blysk.__file__).parent


def run(*arguments):
    told = subprocess.run([sys.executable, "-m", *arguments], capture_output=True, text=True)
    assert told.returncode == 0, told.stdout + told.stderr


def test_the_package_keeps_its_types(tmp_path):
    assert (PACKAGE / "py.typed").is_file()
    run("mypy", "--strict", "--cache-dir", str(tmp_path), "-p", "blysk")


def test_the_stubs_are_of_the_module(tmp_path):
    # The list of names is pyo3's own.
    (tmp_path / "allowed").write_text("blysk._native.__all__\n")
    run("mypy.stubtest", "blysk._native", "--ignore-disjoint-bases", "--allowlist", str(tmp_path / "allowed"))


def test_a_caller_has_types(tmp_path):
    caller = tmp_path / "caller.py"
    caller.write_text(
        "import blysk\n"
        "model = blysk.Model.preset('compact')\n"
        "value: float = model.highlight(64.0, 0.99)\n"
        "intensity, status = model.evaluate([1, 2], [3, 4])\n"
        "total: int = int(intensity.sum())\n"
        "bits: int = model.registers(64.0, 0.99)['x_q'].bits\n"
        "ready: bool = blysk.Pipeline(model).tick().in_ready\n"
    )
    run("mypy", "--strict", "--cache-dir", str(tmp_path), str(caller))
