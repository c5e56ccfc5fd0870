"""`blysk.Pipeline`: the handshake, arrays of cycles, registers under way."""

import blysk
import numpy as np
import pytest


@pytest.fixture(params=["compact", "paper", "precise"])
def model(request):
    return blysk.Model.preset(request.param)


def test_a_result_comes_after_the_latency(model):
    pipeline = blysk.Pipeline(model)
    for _ in range(model.latency):
        assert not pipeline.tick(True, 63, 8304722).out_valid
    outputs = pipeline.tick()
    assert outputs.out_valid and outputs.in_ready
    assert (outputs.intensity, outputs.status) == model.evaluate(63, 8304722)


def test_arrays_are_their_cycles(model):
    rng = np.random.default_rng(2)
    count = 20_000
    valid, ready, reset = (rng.random(count) < chance for chance in (0.8, 0.7, 0.002))
    addresses, xs = rng.integers(0, 260, count), rng.integers(0, 1 << 24, count)
    ports = blysk.Pipeline(model).run(valid, addresses, xs, ready, reset)
    pipeline = blysk.Pipeline(model)
    for cycle in range(count):
        shown = pipeline.tick(
            bool(valid[cycle]), int(addresses[cycle]), int(xs[cycle]), bool(ready[cycle]), bool(reset[cycle])
        )
        assert shown.in_ready == ports["in_ready"][cycle] and shown.out_valid == ports["out_valid"][cycle]
        assert shown.intensity == ports["intensity"][cycle] and shown.status == ports["status"][cycle]
    assert ports["out_valid"].sum() > count / 4


def test_every_request_has_its_result_in_order(model):
    rng = np.random.default_rng(3)
    count = 5000
    valid, ready = rng.random(count) < 0.6, rng.random(count) < 0.6
    addresses, xs = rng.integers(0, 256, count, dtype=np.uint32), rng.integers(0, 1 << 24, count, dtype=np.uint32)
    pipeline = blysk.Pipeline(model)
    ports = pipeline.run(valid, addresses, xs, ready)
    flush = pipeline.run(np.zeros(200, bool), 0, 0)
    assert pipeline.is_empty
    taken = valid & ports["in_ready"]
    given = np.concatenate([ports["out_valid"] & ready, flush["out_valid"]])
    intensity = np.concatenate([ports["intensity"], flush["intensity"]])[given]
    assert np.array_equal(intensity, model.evaluate(addresses[taken], xs[taken])[0])


def test_ranks_show_the_request_that_stands_in_them(model):
    pipeline = blysk.Pipeline(model)
    assert not any(rank.valid or rank.loaded for rank in pipeline.ranks())
    for _ in range(model.latency):
        pipeline.tick(True, 63, 8304722)
    wanted = model.registers(address=63, x_bits=8304722)
    ranks = pipeline.ranks()
    assert [rank.name for rank in ranks] == model.ranks and all(rank.valid for rank in ranks)
    held = {path: register.bits for rank in ranks for path, register in rank.registers.items()}
    assert held == {path: register.bits for path, register in wanted.items()}
    valid, words = pipeline.words()
    assert all(valid) and words == [register.word for register in wanted.values()]
    pipeline.tick(reset=True)
    assert pipeline.is_empty and all(rank.loaded for rank in pipeline.ranks())


def test_outputs_do_not_clock(model):
    pipeline = blysk.Pipeline(model)
    pipeline.tick(True, 1, 5)
    before = pipeline.words()
    assert pipeline.outputs(True, 2, 6) == pipeline.outputs(True, 2, 6)
    assert pipeline.words() == before


def test_what_is_refused(model):
    pipeline = blysk.Pipeline(model)
    with pytest.raises(blysk.InputError, match="x: the bits"):
        pipeline.tick(True, 0, 1 << 40)
    with pytest.raises(blysk.InputError, match="sample 1: x: the bits"):
        pipeline.run(True, 0, [5, 1 << 40])
    with pytest.raises(blysk.InputError, match="x has 3 cycles and in_valid has 2"):
        pipeline.run([True, True], 0, [1, 2, 3])
    with pytest.raises(blysk.InputError, match="give an array"):
        pipeline.run(True, 0, 0)
    with pytest.raises(TypeError, match="in_valid are levels"):
        pipeline.run([0.5, 0.5], 0, 0)
