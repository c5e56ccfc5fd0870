#!/usr/bin/env python3
"""Maps every preset to the cells of a free library, as the emitted `make gates` does, and writes the table of gates in
docs/SYNTHESIS.md.

The ROM is left out: in an ASIC it is a macro, or there are few rows. Exit status 0: done; 1: a preset has no area.
"""

import argparse
import re
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LIBERTY = ROOT / "target/liberty/osu035_stdcells.lib"
WORK = ROOT / "target/gates"
DOCUMENT = ROOT / "docs/SYNTHESIS.md"
MARKERS = "<!-- gates: made by `make gates` -->", "<!-- end of gates -->"


def version():
    said = subprocess.run(["yosys", "-V"], check=True, capture_output=True, text=True).stdout
    return said.split()[1]


def gates(blysk, preset):
    """Area and NAND2 equivalents, the flip-flops among the cells, and the bits of the ROM."""
    place = WORK / preset
    emit = [*shlex.split(blysk), "rtl", "--preset", preset, "--count", "1", "--out", str(place)]
    subprocess.run(emit, check=True, stdout=subprocess.DEVNULL, cwd=ROOT)
    said = subprocess.run(["make", "--silent", "-C", place, "gates", f"LIBERTY={LIBERTY}"],
                          capture_output=True, text=True)
    found = re.search(r"^area (\d+), (\d+) NAND2 equivalents", said.stdout, re.M)
    if said.returncode != 0 or not found:
        sys.exit(f"{preset}: no area\n{said.stdout}{said.stderr}")
    report = (place / "build/gates.txt").read_text()
    flip_flops = sum(int(n) for n in re.findall(r"^\s+DFF\S*\s+(\d+)\s*$", report, re.M))
    rom = subprocess.run([*shlex.split(blysk), "rom", "--preset", preset], check=True, capture_output=True,
                         text=True, cwd=ROOT).stdout
    bits = re.search(r"(\d+) bits in all", rom)[1]
    return [f"`{preset}`", found[2], found[1], str(flip_flops), bits]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blysk", default="blysk", help="the command that writes the RTL")
    args = parser.parse_args()
    listed = subprocess.run([*shlex.split(args.blysk), "presets", "--format", "csv"], check=True,
                            capture_output=True, text=True, cwd=ROOT).stdout
    rows = []
    for preset in [line.split(",")[0] for line in listed.splitlines()[1:]]:
        rows.append(gates(args.blysk, preset))
        print(" ".join(rows[-1]), flush=True)
    head = "| configuration | NAND2 equivalents | area, µm² | flip-flops | ROM, bits (left out) |"
    table = "\n".join([head, "|---|---:|---:|---:|---:|", *(f"| {' | '.join(row)} |" for row in rows)])
    tools = f"Tools: yosys {version()} with its abc; cells: osu035_stdcells (0.35 µm), from qflow-tech-osu035."
    text = DOCUMENT.read_text()
    before, rest = text.split(MARKERS[0])
    _, after = rest.split(MARKERS[1])
    DOCUMENT.write_text(f"{before}{MARKERS[0]}\n{table}\n\n{tools}\n{MARKERS[1]}{after}")


if __name__ == "__main__":
    main()
