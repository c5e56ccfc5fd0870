#!/usr/bin/env python3
"""The certified bounds of `blysk certify` against Sollya's supnorm.

Sollya (S. Chevillard, M. Joldes, C. Lauter) encloses the supremum norm of polynomial minus function on
its own: Taylor models and sums of squares in arithmetic of any precision (S. Chevillard, J. Harrison,
M. Joldes, C. Lauter, "Efficient and accurate computation of upper bounds of approximation errors", 2011).
The polynomial given to it is solved here, at 300 bits, from the conditions of the method as they stand
(`f(1) = 1, f(q) = Q, ...`), not from any formula of the project. Both enclosures are of the same number:
they must have a point in common.

Roots and coefficients are rounded to 300 bits, the interval's end q outwards: that moves the norm by less than
1e-60, which no comparison of doubles sees.

Without Sollya the script says so and ends with status 0; with it, comparing nothing is a failure.
"""

import argparse
import csv
import io
import re
import shlex
import shutil
import subprocess
import sys

# From the first n at which a method is not x^n itself.
EXPONENTS = {
    "hermite": [4, 5, 6, 7, 8, 10, 12, 16, 20, 24, 31, 32, 48, 64, 96, 100, 114, 115, 128, 200, 256,
                300, 512, 777, 1000, 1024],
    "three_point": [4, 8, 16, 32, 64, 128, 256, 1024],
    "quadratic": [3, 4, 8, 16, 32, 64, 128, 256, 1024],
    "tangent": [2, 4, 8, 16, 32, 64, 128, 256, 1024],
}
LEAST = 20

# Newton's divided differences on the nodes 1, q, then q again where the slope is given (n Q/q) or l, then
# 0; Sollya multiplies it out.
POLYNOMIALS = {
    "hermite": """d1 = (Q - 1)/(q - 1); s1 = n*Q/q; d2 = (s1 - d1)/(q - 1);
                  d3 = (1 + d1*(0 - 1) + d2*(0 - 1)*(0 - q))/(q^2);
                  f = 1 + d1*(x - 1) + d2*(x - 1)*(x - q) + d3*(x - 1)*(x - q)^2;""",
    "three_point": """l = round(G^(1/n), 300, RN); d1 = (Q - 1)/(q - 1); s1 = (G - Q)/(l - q); d2 = (s1 - d1)/(l - 1);
                      d3 = (1 + d1*(0 - 1) + d2*(0 - 1)*(0 - q))/(q*l);
                      f = 1 + d1*(x - 1) + d2*(x - 1)*(x - q) + d3*(x - 1)*(x - q)*(x - l);""",
    "quadratic": """d1 = (Q - 1)/(q - 1); s1 = n*Q/q; d2 = (s1 - d1)/(q - 1);
                    f = 1 + d1*(x - 1) + d2*(x - 1)*(x - q);""",
    "tangent": """k = round(sqrt(Q/q), 300, RN); u = (1 - k)/(1 - q); v = (q - k)/(1 - q); f = x*(u*x - v)^2;""",
}

# 2^-30: how far the ends of Sollya's enclosure may be apart, relatively.
SCRIPT = """
prec = 300!; display = decimal!; verbosity = 0!;
n = {n}; Q = {q}; G = {g};
q = round(Q^(1/n), 300, RD);
{polynomial}
p = horner(f);
p = roundcoefficients(p, [|300...|]);
r = supnorm(p, x^n, [q; 1], {kind}, 2^(-30));
print("RESULT", inf(r), sup(r));
"""


def sollya(program, method, n, kind, levels):
    """Sollya's enclosure of the norm, as two floats (outwards by a part in 10^15)."""
    q, g = levels
    text = SCRIPT.format(n=n, q=q, g=g, kind=kind, polynomial=POLYNOMIALS[method])
    done = subprocess.run([program], input=text, capture_output=True, text=True, check=False)
    found = re.search(r"RESULT (\S+) (\S+)", done.stdout)
    if not found:
        raise RuntimeError(f"{method}, n = {n}: Sollya gives no enclosure:\n{done.stdout}{done.stderr}")
    low, high = map(float, found.groups())
    return low * (1 - 1e-15), high * (1 + 1e-15)


def certified(command, method, exponents):
    """Our enclosures, by exponent."""
    listed = ",".join(map(str, exponents))
    arguments = ["certify", "--method", method, "--exponents", listed, "--format", "csv"]
    done = subprocess.run(command + arguments, capture_output=True, text=True, check=True)
    return {float(row["n"]): row for row in csv.DictReader(io.StringIO(done.stdout))}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--blysk", required=True, help="the command, such as target/release/blysk")
    parser.add_argument("--sollya", default="sollya", help="Sollya's command")
    options = parser.parse_args()
    program = shutil.which(options.sollya)
    if program is None:
        print("SKIPPED Sollya is not there (Debian package sollya): nothing was compared")
        return 0
    command = shlex.split(options.blysk)
    # What --q and --g are unless said: 1/2, and the double next to 1/18, as an exact quotient.
    levels = ("1/2", f"{int(1 / 18 * 2**60)}/2^60")
    compared, failed = 0, 0
    for method, exponents in EXPONENTS.items():
        rows = certified(command, method, exponents)
        for n in exponents:
            row = rows[float(n)]
            for kind, name in (("absolute", "absolute"), ("relative", "relative")):
                ours = float(row[f"{name}_lower"]), float(row[f"{name}_upper"])
                theirs = sollya(program, method, n, kind, levels)
                compared += 1
                if not (ours[0] <= theirs[1] and theirs[0] <= ours[1]):
                    failed += 1
                    print(f"FAIL {method}, n = {n}, {name}: {ours} and Sollya's {theirs} are disjoint")
        print(f"{method}: {len(exponents)} exponents, absolute and relative")
    if failed or compared < 2 * LEAST:
        print(f"FAIL {failed} of {compared} enclosures have no point in common with Sollya's")
        return 1
    print(f"PASS {compared} enclosures have a point in common with Sollya's")
    return 0


if __name__ == "__main__":
    sys.exit(main())
