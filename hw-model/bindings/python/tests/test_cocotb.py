"""The examples in Icarus and in Verilator, and mistakes in the RTL that are named."""

import os
import shutil
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "examples"))

from run import run  # noqa: E402

SIMULATORS = ["icarus", "verilator"]


@pytest.fixture(params=SIMULATORS)
def simulator(request, monkeypatch):
    """A simulator that is installed: its absence is a failure, and no reason to skip."""
    if request.param == "verilator":
        root = Path(os.environ["BLYSK_VERILATOR_ROOT"])
        monkeypatch.setenv("VERILATOR_ROOT", str(root))
        monkeypatch.setenv("PATH", f"{root / 'bin'}{os.pathsep}{os.environ['PATH']}")
    assert shutil.which({"icarus": "iverilog", "verilator": "verilator"}[request.param]), request.param
    return request.param


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """A place for what is built of each preset, once for all examples that run it."""
    top = tmp_path_factory.mktemp("built")
    return lambda simulator, preset: top / f"{preset}_{simulator}"


@pytest.mark.parametrize("preset", ["compact", "paper"])
def test_the_emitted_rtl_passes(simulator, preset, built, capfd):
    assert run("emitted_rtl", simulator, preset, built(simulator, preset)) == (1, 0)
    told = capfd.readouterr()
    assert "500 results, " in told.out + told.err


def test_a_design_of_ones_own_passes(simulator, built):
    assert run("own_dut", simulator, "compact", built(simulator, "compact")) == (2, 0)


def test_pyuvm_passes(simulator, built):
    assert run("with_pyuvm", simulator, "compact", built(simulator, "compact")) == (1, 0)


#: A file, a text, the mistake, and the register at which it is first seen.
MISTAKES = [
    (
        "blysk_stage.sv",
        "(addend <<< ADDEND_UP) - (product",
        "(addend <<< ADDEND_UP) + (product",
        "stage1.t1 (polynomial.stage[1].multiply_add.t_q)",
    ),
]


@pytest.mark.parametrize(("file", "old", "new", "register"), MISTAKES)
def test_a_mistake_is_named_by_its_register(simulator, file, old, new, register, tmp_path, capfd):
    assert run("emitted_rtl", simulator, "compact", tmp_path, (file, old, new)) == (1, 1)
    told = capfd.readouterr()
    assert register in told.out + told.err
    assert "in the model; it holds n = " in told.out + told.err


def test_a_mistake_shows_at_the_ports_where_registers_are_unknown(tmp_path, capfd):
    assert run("own_dut", "icarus", "compact", tmp_path, MISTAKES[0][:3]) == (2, 2)
    told = capfd.readouterr()
    assert "intensity_o is 0x" in told.out + told.err
