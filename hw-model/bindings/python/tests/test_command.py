"""The same bits as `blysk evaluate`, for the same questions."""

import os
import subprocess

import blysk
import numpy as np
import pytest


@pytest.mark.parametrize("preset", ["compact", "paper", "precise"])
def test_the_command_answers_the_same(preset):
    model = blysk.Model.preset(preset)
    rng = np.random.default_rng(4)
    count = 100_000
    addresses, xs = rng.integers(0, 258, count), rng.integers(0, 1 << 24, count)
    questions = "address,x_bits\n" + "".join(f"{a},{x}\n" for a, x in zip(addresses, xs))
    answered = subprocess.run(
        [os.environ["BLYSK"], "evaluate", "--preset", preset, "--format", "csv", "-"],
        input=questions,
        capture_output=True,
        text=True,
        check=True,
    ).stdout.splitlines()
    columns = answered[0].split(",")
    place = columns.index("intensity_bits")
    intensity, status = model.evaluate(addresses, xs)
    assert len(answered) == count + 1
    assert [int(line.split(",")[place]) for line in answered[1:]] == intensity.tolist()
    place = columns.index("status")
    assert [int(line.split(",")[place]) for line in answered[1:]] == status.tolist()
    assert blysk.Status.NO_WORD in [blysk.Status(bits) for bits in set(status.tolist())]
