"""Builds a top module in Icarus and runs test_axis.py in it: run_axis.py TOP SOURCE..., in the directory of both."""

import sys
from pathlib import Path

from cocotb_tools.runner import get_results, get_runner

top, *sources = sys.argv[1:]
place = Path.cwd() / "build"
runner = get_runner("icarus")
runner.build(sources=sources, hdl_toplevel=top, build_dir=place, build_args=["-g2012", "-Wno-timescale"],
             timescale=("1ns", "1ps"), always=True)
results = runner.test(hdl_toplevel=top, test_module="test_axis", build_dir=place, test_dir=Path.cwd(),
                      results_xml=str(place / "results.xml"))
run, failed = get_results(results)
sys.exit(0 if run == 1 and failed == 0 else 1)
