#!/usr/bin/env python3
"""Moves registers of an ECP5 netlist into the blocks that feed them.

A block RAM (DP16KD) and a multiplier (MULT18X18D) of the ECP5 have a register at their output. Yosys leaves it unused,
and so a rank behind the ROM's memory or behind a product costs flip-flops, wires to them, and the time of both; the
vendor's own tool uses it. A block's register is used here where every bit that it puts out goes to a flip-flop and
nowhere else, and all of these have the same clock and enable, and no reset: what the netlist computes, cycle by cycle,
stays the same.

    scripts/block_registers.py NETLIST.json    the netlist of `synth_ecp5 -json`, before nextpnr-ecp5; written again
"""

import json
import sys
from pathlib import Path

# What a flip-flop is controlled by, as Yosys leaves it.
CONTROL = ["CLK", "CE", "LSR"]
MODES = ["CEMUX", "CLKMUX", "LSRMUX"]
UNUSED_RESET = (None, "0")


def memory(block, clock, enable):
    """The outputs of a block RAM; it is read at port B, and with 36 bits over the outputs of both."""
    block["parameters"] |= {"REGMODE_A": "OUTREG", "REGMODE_B": "OUTREG"}
    return {"OCEA": enable, "OCEB": enable}


def multiplier(block, clock, enable):
    block["parameters"] |= {"REG_OUTPUT_CLK": "CLK0", "REG_OUTPUT_CE": "CE0", "REG_OUTPUT_RST": "RST0"}
    return {"CLK0": clock, "CE0": enable, "RST0": ["0"]}


BLOCKS = {"DP16KD": memory, "MULT18X18D": multiplier}


def readers(module):
    """The pins that read each bit, as (cell, pin); the module's own outputs have no cell."""
    found = {}
    pins = [(name, pin, cell["connections"][pin]) for name, cell in module["cells"].items()
            for pin, direction in cell["port_directions"].items() if direction != "output"]
    ports = [(None, name, port["bits"]) for name, port in module["ports"].items() if port["direction"] != "input"]
    for name, pin, bits in pins + ports:
        for bit in bits:
            found.setdefault(bit, []).append((name, pin))
    return found


def control(flip_flop):
    """Its clock, enable and reset, and what is done with them."""
    pins = [flip_flop["connections"].get(pin, [None])[0] for pin in CONTROL]
    return *pins, *(flip_flop["parameters"].get(mode) for mode in MODES)


def registers(cells, block, read):
    """The flip-flop behind each output of a block, if that is all that its outputs go to; otherwise none."""
    behind = {}
    for pin, direction in block["port_directions"].items():
        ends = [end for bit in block["connections"][pin] for end in read.get(bit, [])] if direction == "output" else []
        if ends:
            name, at = ends[0]
            if len(ends) > 1 or name is None or at != "DI" or cells[name]["type"] != "TRELLIS_FF":
                return {}
            behind[pin] = name
    controls = {control(cells[name]) for name in behind.values()}
    if len(controls) != 1:
        return {}
    (_, _, reset, enabled, clocked, _), = controls
    return behind if reset in UNUSED_RESET and (enabled, clocked) == ("CE", "CLK") else {}


def absorb(module):
    """Uses the registers of all blocks of a module that can be used; gives the number of flip-flops saved."""
    cells, read, saved = module["cells"], readers(module), 0
    for block in [cell for cell in cells.values() if cell["type"] in BLOCKS]:
        behind = registers(cells, block, read)
        if not behind:
            continue
        clock, enable, *_ = control(cells[next(iter(behind.values()))])
        pins = BLOCKS[block["type"]](block, [clock], [enable])
        block["connections"] |= pins
        block["port_directions"] |= dict.fromkeys(pins, "input")
        for pin, name in behind.items():
            block["connections"][pin] = cells.pop(name)["connections"]["Q"]
        saved += len(behind)
    return saved


def rewrite(path):
    """The same for the top module of a file; gives the number of flip-flops saved."""
    netlist = json.loads(path.read_text())
    tops = [module for module in netlist["modules"].values() if int(module["attributes"].get("top", "0"), 2)]
    if len(tops) != 1:
        sys.exit(f"{path}: {len(tops)} modules are marked as the top: use a netlist of synth_ecp5 -top NAME -json")
    saved = absorb(tops[0])
    path.write_text(json.dumps(netlist))
    return saved


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    print(f"{rewrite(Path(sys.argv[1]))} flip-flops moved into blocks")
