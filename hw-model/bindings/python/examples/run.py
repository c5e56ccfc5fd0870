"""Runs an example: python run.py EXAMPLE [SIMULATOR [CONFIGURATION [DIRECTORY]]].

EXAMPLE is emitted_rtl, own_dut or with_pyuvm; SIMULATOR is icarus or verilator (5.036 or newer), found in the path;
CONFIGURATION is the name of a preset or a file whose name ends in .json.
"""

import contextlib
import sys
from pathlib import Path

import blysk
from cocotb_tools.check_results import get_results
from cocotb_tools.runner import get_runner

HERE = Path(__file__).resolve().parent

#: The top module of an example that has one of its own, and its sources besides the emitted RTL.
OWN = {"own_dut": ("specular", [HERE / "own_dut.sv"])}


def model_of(configuration: str) -> blysk.Model:
    """The model of a preset, or of a file."""
    return (blysk.Model.from_file if configuration.endswith(".json") else blysk.Model.preset)(configuration)


def run(
    example: str, simulator: str, model: blysk.Model, directory: Path, alter: tuple[str, str, str] | None = None
) -> tuple[int, int]:
    """Emits the RTL of a model, builds it and runs the example. Returns how many tests there were, and failed.

    `alter` is a file of the RTL, a text in it, and what to put in its place: a mistake to be found.
    """
    rtl = directory / "rtl"
    if not rtl.exists():
        blysk.rtl(model, rtl, strategy="even", count=64)
    configuration = directory / "configuration.json"
    configuration.write_text(model.configuration)
    if alter is not None:
        file, old, new = alter
        text = (rtl / file).read_text()
        assert old in text, f"{file} has no {old}"
        (rtl / file).write_text(text.replace(old, new))
    top, more = OWN.get(example, ("blysk", []))
    runner = get_runner(simulator)
    runner.build(
        sources=[*(rtl / name for name in blysk.RTL_SOURCES), *more],
        hdl_toplevel=top,
        build_args=["-g2012"] if simulator == "icarus" else [],
        build_dir=directory / top,
        always=alter is not None,
    )
    results = directory / "results.xml"
    # Where a test fails, the runner ends the program; what the results say is for the caller.
    with contextlib.suppress(SystemExit):
        runner.test(
            test_module=example,
            hdl_toplevel=top,
            build_dir=directory / top,
            test_dir=rtl,  # the ROM image is found there
            results_xml=str(results),
            extra_env={"BLYSK_CONFIGURATION": str(configuration)},
        )
    return get_results(results)


if __name__ == "__main__":
    given = dict(enumerate(sys.argv[1:]))
    place = Path(given.get(3, "build")).resolve()
    tests, failed = run(given.get(0, "emitted_rtl"), given.get(1, "icarus"), model_of(given.get(2, "compact")), place)
    print(f"{tests} tests, {failed} failed")
    sys.exit(failed > 0 or tests == 0)
