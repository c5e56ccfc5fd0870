"""The examples in Icarus and in Verilator, and mistakes in the RTL that are named."""

import json
import os
import shutil
import sys
from pathlib import Path

import blysk
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


def compact_with(**fields):
    """The model of preset compact with other fields of its configuration."""
    return blysk.Model.from_json(json.dumps(json.loads(COMPACT.configuration) | fields))


COMPACT = blysk.Model.preset("compact")
EMBEDDED = blysk.Model.from_file(Path(__file__).resolve().parents[4] / "docs" / "examples" / "embedded.json")
SLICED = compact_with(pipelining={"ready_slice": "output"})
FREE_RUNNING = compact_with(handshake="none")


@pytest.mark.parametrize("preset", ["compact", "paper"])
def test_the_emitted_rtl_passes(simulator, preset, built, capfd):
    assert run("emitted_rtl", simulator, blysk.Model.preset(preset), built(simulator, preset)) == (1, 0)
    told = capfd.readouterr()
    assert "500 results, " in told.out + told.err


def test_a_design_of_ones_own_passes(simulator, built):
    assert run("own_dut", simulator, COMPACT, built(simulator, "compact")) == (2, 0)


def test_pyuvm_passes(simulator, built):
    assert run("with_pyuvm", simulator, COMPACT, built(simulator, "compact")) == (1, 0)


@pytest.mark.parametrize(
    ("model", "control"),
    [
        (EMBEDDED, ("enable", None, True)),
        (SLICED, ("valid_ready", "output", False)),
        (FREE_RUNNING, ("none", None, False)),
    ],
    ids=["embedded", "ready_slice", "free_running"],
)
def test_the_bench_follows_handshake_reset_and_slice(model, control, tmp_path):
    assert (model.handshake, model.ready_slice, model.reset_active_low) == control
    assert run("a_reset_between", "icarus", model, tmp_path) == (1, 0)


#: A file of the RTL, a text in it, and a mistake in its place.
WRONG_SIGN = ("blysk_stage.sv", "(addend <<< ADDEND_UP) - (product", "(addend <<< ADDEND_UP) + (product")
LOST_WITHOUT_ENABLE = ("blysk_handshake.sv", "(advance & offered) | (~advance & valid_q)", "advance & offered")

#: Where a mistake is first seen.
T1 = "stage1.t1 (polynomial.stage[1].multiply_add.t_q) is 0x"
VALID = "fetch.valid (handshake.valid_q[0]) is 0x0, and 0x1 in the model"


@pytest.mark.parametrize(
    ("simulator", "model", "mistake", "seen"),
    [
        ("icarus", COMPACT, WRONG_SIGN, T1),
        ("verilator", COMPACT, WRONG_SIGN, T1),
        ("icarus", SLICED, WRONG_SIGN, T1),
        ("icarus", EMBEDDED, LOST_WITHOUT_ENABLE, VALID),
    ],
    indirect=["simulator"],
    ids=["compact_icarus", "compact_verilator", "ready_slice", "embedded"],
)
def test_a_mistake_is_named_by_its_register(simulator, model, mistake, seen, tmp_path, capfd):
    assert run("emitted_rtl", simulator, model, tmp_path, mistake) == (1, 1)
    told = capfd.readouterr()
    assert seen in told.out + told.err
    assert seen != T1 or "in the model; it holds n = " in told.out + told.err


def test_a_mistake_shows_at_the_ports_where_registers_are_unknown(tmp_path, capfd):
    assert run("own_dut", "icarus", COMPACT, tmp_path, WRONG_SIGN) == (2, 2)
    told = capfd.readouterr()
    assert "intensity_o is 0x" in told.out + told.err
