"""What the Python package answers: python answers.py CONFIGURATION REQUESTS CYCLES ANSWERS SHOWN.

All but the configuration are files of 64-bit integers, one line of a table after the other.
"""

import sys

import blysk
import numpy as np

configuration, requests, cycles, answers, shown = sys.argv[1:]
model = blysk.Model.from_file(configuration)

address, x = np.fromfile(requests, dtype=np.int64).reshape(-1, 2).T
np.stack(model.evaluate(address, x), axis=1, dtype=np.int64, casting="unsafe").tofile(answers)

reset, in_valid, address, x, out_ready = np.fromfile(cycles, dtype=np.int64).reshape(-1, 5).T
ports = blysk.Pipeline(model).run(
    in_valid.astype(bool), address, x, out_ready=out_ready.astype(bool), reset=reset.astype(bool)
)
columns = [ports[name] for name in ("in_ready", "out_valid", "intensity", "status")]
np.stack(columns, axis=1, dtype=np.int64, casting="unsafe").tofile(shown)
