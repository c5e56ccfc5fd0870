#!/usr/bin/env python3
"""The integers of `blysk refine` against those of Sollya's fpminimax.

fpminimax (N. Brisebarre, S. Chevillard, "Efficient polynomial L-infinity approximations", ARITH 2007) looks
for the best polynomial whose coefficients are multiples of given units, by lattice reduction. It knows
nothing of the lines between the coefficients, which round as well. Here both sets of integers go through the
same data path, over every representable x of the epicentre, and the greatest errors are compared.

Sollya is asked for 1 + a1*u + a2*u^2 + a3*u^3, the constant fixed, in the variable of the centred form,
u = (1 - x)*2^e, for coefficients of the same fraction bits. Its answer is measured by giving it to the model
as steps from the rounded coefficients.

Without Sollya the script says so and ends with status 0; with it, comparing nothing is a failure.
"""

import argparse
import csv
import io
import json
import math
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

EXPONENTS = [4, 7, 16, 33, 64, 100, 128, 256]
FRACTIONS = [12, 14, 16, 18]
# Of the 32 cases, ours are to be no worse in all but a few.
LEAST_CASES = 24
LEAST_GOOD = 20

# u = 0 itself, where every monomial vanishes, is no place for an exchange; the constant 1 is exact there.
SCRIPT = """
prec = 200!; display = decimal!; verbosity = 0!;
n = {n}; e = {e};
last = (1 - (1/2)^(1/n))*2^e;
p = fpminimax((1 - x*2^(-e))^n, [|1, 2, 3|], [|{f}, {f}, {f}|], [2^(-24); last], fixed, absolute, 1);
display = powers!;
print("RESULT", coeff(p, 1)*2^{f}, coeff(p, 2)*2^{f}, coeff(p, 3)*2^{f});
"""


def integer(text):
    """An integer as Sollya shows it with powers of two: -13 * 2^(4)."""
    found = re.fullmatch(r"(-?\d+)(?: \* 2\^\((-?\d+)\))?", text.strip())
    if not found:
        raise RuntimeError(f"not an integer: {text!r}")
    return int(found[1]) << int(found[2] or 0)


def fpminimax(program, n, e, fraction):
    """c1, c2, c3 of 1 - u*(c1 - u*(c2 - u*c3)), in units of the last place."""
    text = SCRIPT.format(n=n, e=e, f=fraction)
    done = subprocess.run([program], input=text, capture_output=True, text=True, check=False)
    term = r"(-?\d+(?: \* 2\^\(-?\d+\))?)"
    found = re.search(rf"RESULT {term} {term} {term}\s*$", done.stdout, re.MULTILINE)
    if not found:
        raise RuntimeError(f"n = {n}, {fraction} bits: no answer:\n{done.stdout}{done.stderr}")
    a1, a2, a3 = map(integer, found.groups())
    return {"c1": -a1, "c2": a2, "c3": -a3}


def configuration(n, fraction):
    """One row; t1 and t2 with two bits more than the coefficients, u and output those of compact_minimax."""
    return {
        "name": f"n{n}_{fraction}",
        "method": "minimax",
        "exponents": str(n),
        "input": "UQ1.23",
        "output": "UQ1.15",
        "form": "centred",
        "tail": "zero",
        "cut": "epicentre",
        # The widths are given, and what they cost is what is compared.
        "error_budget_ulp": 1e6,
        "widths": {
            "u": "UQ1.18",
            "c3": f"Q2.{fraction}",
            "c2": f"Q3.{fraction}",
            "c1": f"Q3.{fraction}",
            "c0": "UQ1.0",
            "t1": f"Q3.{fraction + 2}",
            "t2": f"Q3.{fraction + 2}",
        },
    }


class Blysk:
    """The command, in a directory of its own."""

    def __init__(self, command, directory):
        self.command, self.directory = command, pathlib.Path(directory)

    def row(self, config, *arguments):
        """The only line of a printed table, by column."""
        path = self.directory / "config.json"
        path.write_text(json.dumps(config))
        command = [*self.command, arguments[0], "--config", str(path), *arguments[1:]]
        done = subprocess.run([*command, "--format", "csv"], capture_output=True, text=True, check=False)
        if done.returncode:
            raise RuntimeError(f"{shlex.join(command)}:\n{done.stderr}")
        (row,) = csv.DictReader(io.StringIO(done.stdout))
        return row

    def integers(self, config):
        row = self.row(config, "rom")
        return {name: int(row[f"{name}_bits"]) for name in ("c1", "c2", "c3")}

    def measured(self, config):
        """The greatest error of a configuration as it is."""
        return float(self.row(config, "refine", "--reach", "0")["before"])

    def refined(self, config):
        """Before and after the search."""
        row = self.row(config, "refine")
        return float(row["before"]), float(row["after"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--blysk", required=True, help="the command, such as target/release/blysk")
    parser.add_argument("--sollya", default="sollya", help="Sollya's command")
    options = parser.parse_args()
    program = shutil.which(options.sollya)
    if program is None:
        print("SKIPPED Sollya is not there (Debian package sollya): nothing was compared")
        return 0
    compared = good = better = 0
    print("greatest error in output ulp, through the data path, every representable x of the epicentre")
    print(f"{'n':>4} {'bits':>4} {'rounded':>9} {'fpminimax':>9} {'refine':>9}")
    with tempfile.TemporaryDirectory() as directory:
        blysk = Blysk(shlex.split(options.blysk), directory)
        for n in EXPONENTS:
            for fraction in FRACTIONS:
                config = configuration(n, fraction)
                rounded, ours = blysk.refined(config)
                base = blysk.integers(config)
                answer = fpminimax(program, n, int(math.log2(n)), fraction)
                steps = {name: answer[name] - base[name] for name in base}
                theirs = blysk.measured({**config, "coefficient_steps": [{"n": n, **steps}]})
                compared += 1
                good += ours <= theirs
                better += ours < theirs
                shown = [f"{error * 2**15:9.4f}" for error in (rounded, theirs, ours)]
                verdict = "" if ours <= theirs else "  worse"
                print(f"{n:4} {fraction:4} {' '.join(shown)}{verdict}", flush=True)
    verdict = f"{good} of {compared} cases are no worse than fpminimax's, {better} better"
    if compared < LEAST_CASES or good < LEAST_GOOD:
        print(f"FAIL {verdict}; {LEAST_GOOD} are wanted")
        return 1
    print(f"PASS {verdict}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
