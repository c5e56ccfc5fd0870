"""`blysk.Model`: numbers, arrays, registers, and what is refused."""

import json
from collections.abc import Mapping

import blysk
import numpy as np
import pytest

PRESETS = ["paper", "blooming", "tangent", "compact", "precise", "schlick"]


@pytest.fixture(scope="module", params=PRESETS)
def model(request):
    return blysk.Model.preset(request.param)


@pytest.fixture(scope="module")
def compact():
    return blysk.Model.preset("compact")


def requests(model, count, seed=1):
    """Any address, some without a word, and any x that the input format holds."""
    rng = np.random.default_rng(seed)
    x = model.formats["x"]
    return rng.integers(0, 260, count), rng.integers(x.min_bits, x.max_bits + 1, count)


def test_a_highlight_is_a_real_number(compact):
    assert compact.highlight(64, 0.99) == 0.5257568359375
    assert abs(compact.highlight(64, 0.99) - 0.99**64) < 0.0067
    assert compact.highlight(1, 2.0) == 1.0
    assert compact.highlight(1, -1.0) == 0.0


def test_arrays_are_their_samples(model):
    addresses, xs = requests(model, 3000)
    intensity, status = model.evaluate(addresses, xs)
    assert (intensity.dtype, status.dtype) == (np.int64, np.uint8)
    wanted = [model.evaluate(int(a), int(x)) for a, x in zip(addresses, xs)]
    assert list(zip(intensity.tolist(), status.tolist())) == wanted
    for address in (0, 255, 259):
        intensity, status = model.evaluate(address, xs)
        assert list(zip(intensity.tolist(), status.tolist())) == [model.evaluate(address, int(x)) for x in xs]


def test_whole_numbers_of_any_kind_are_the_same(compact):
    addresses, xs = requests(compact, 500)
    wanted = compact.evaluate(addresses, xs)
    for kind in (np.uint32, np.int32, ">i8"):
        for got in (
            compact.evaluate(addresses.astype(kind), xs.astype(kind)),
            compact.evaluate(addresses, xs.astype(kind)),
            compact.evaluate(addresses.astype(kind), xs),
            compact.evaluate(addresses.tolist(), xs.tolist()),
        ):
            assert np.array_equal(got, wanted)
    apart = np.zeros(1000, np.int64)
    apart[::2] = xs
    assert np.array_equal(compact.evaluate(addresses, apart[::2]), wanted)
    assert np.array_equal(compact.evaluate(addresses[::-1], xs[::-1]), [half[::-1] for half in wanted])
    assert compact.evaluate(np.int64(63), np.uint32(8304722)) == (17228, 0)


def test_arrays_keep_their_shape_and_are_broadcast(compact):
    addresses, xs = requests(compact, 24)
    grid = compact.evaluate(addresses.reshape(2, 3, 4), xs.reshape(2, 3, 4))
    assert grid[0].shape == (2, 3, 4)
    assert np.array_equal(grid[0].ravel(), compact.evaluate(addresses, xs)[0])
    rows = compact.evaluate(np.arange(3)[:, None], xs[None, :])
    assert rows[0].shape == (3, 24)
    assert np.array_equal(rows[0][2], compact.evaluate(2, xs)[0])
    every = compact.evaluate(np.arange(256), 8304722)
    assert every[0].shape == (256,)
    assert every[0][63] == 17228
    none = np.array([], np.int64)
    assert compact.evaluate(none, none)[0].shape == (0,)
    assert compact.highlight(np.array([1.0, 64.0])[:, None], [0.5, 0.99, 1.0]).shape == (2, 3)


@pytest.fixture
def out():
    """Arrays for the answers to 500 requests, with what no answer is."""
    return np.full(500, -1, np.int64), np.full(500, 255, np.uint8)


def test_answers_go_where_they_are_asked_for(model, out):
    addresses, xs = requests(model, 500)
    for arguments in (
        {"address": addresses, "x_bits": xs},
        {"address": 63, "x_bits": xs.astype(np.uint32)},
        {"address": addresses.tolist(), "x_bits": xs[::-1]},
        {"n": 64, "x": np.linspace(0, 1, 500)},
        {"address": 63, "x_bits": np.array(5)},
        {"address": np.arange(5)[:, None], "x_bits": xs[:100]},
    ):
        wanted = model.evaluate(**arguments)
        shape = wanted[0].shape
        used = tuple(array[: wanted[0].size].reshape(shape) for array in out)
        got = model.evaluate(**arguments, out=used)
        assert got[0] is used[0] and got[1] is used[1]
        assert np.array_equal(got[0], wanted[0]) and np.array_equal(got[1], wanted[1])


def test_neighbours_in_memory_do_not_overlap(compact):
    xs, intensity = np.split(np.arange(1000), 2)
    before = intensity.copy()
    compact.evaluate(63, xs, out=(intensity, np.empty(500, np.uint8)))
    assert np.array_equal(intensity, compact.evaluate(63, np.arange(500))[0])
    assert not np.array_equal(intensity, before) and np.array_equal(xs, np.arange(500))


def test_arrays_that_cannot_take_answers_stay_as_they_are(compact, out):
    xs = np.arange(500)
    intensity, status = out
    frozen = status.copy()
    frozen.setflags(write=False)
    apart = np.full(1000, 255, np.uint8)[::2]
    bytes_of = np.full(4008, 255, np.uint8)
    shared = bytes_of[8:].view(np.int64)
    shifted = bytes_of[1:4001].view(np.int64)
    for given, kind, text in (
        (intensity, TypeError, "out is a tuple of two arrays"),
        ((intensity,), TypeError, "out is a tuple of two arrays"),
        (list(out), TypeError, "out is a tuple of two arrays"),
        ((intensity, None), TypeError, "status is an array of uint8, not NoneType"),
        ((intensity, status.astype(np.int64)), TypeError, "status is an array of uint8, not one of int64"),
        ((intensity.astype(">i8"), status), TypeError, "intensity is an array of int64, not one of >i8"),
        ((intensity, status[1:]), blysk.InputError, r"status has the shape \(499,\), and the answers have \(500,\)"),
        ((intensity[None], status), blysk.InputError, r"the shape \(1, 500\), and the answers have \(500,\)"),
        ((intensity, apart), blysk.InputError, "status has gaps .* give a C-contiguous array"),
        ((shifted, status), blysk.InputError, "intensity has gaps"),
        ((intensity, frozen), blysk.InputError, "status is read-only"),
        ((shared, bytes_of[:500]), blysk.InputError, "intensity overlaps status; give an array that lies apart"),
        ((xs, status), blysk.InputError, "intensity overlaps x_bits; give"),
        ((intensity, xs.view(np.uint8)[:500]), blysk.InputError, "status overlaps x_bits"),
        ((intensity, xs.view(np.uint8)[-500:]), blysk.InputError, "status overlaps x_bits"),
    ):
        with pytest.raises(kind, match=text):
            compact.evaluate(63, xs, out=given)
        assert (intensity == -1).all() and (status == 255).all() and (bytes_of == 255).all()
        assert (frozen == 255).all() and (apart == 255).all() and np.array_equal(xs, np.arange(500))
    whole, reals = np.zeros(500, np.int64), np.ones(500)
    for name, arguments in (
        ("address", {"address": whole, "x_bits": xs}),
        ("n", {"n": reals, "x_bits": xs}),
        ("x", {"address": 1, "x": reals}),
    ):
        with pytest.raises(blysk.InputError, match=f"intensity overlaps {name};"):
            compact.evaluate(**arguments, out=(arguments[name].view(np.int64), status))
    assert (whole == 0).all() and (reals == 1).all()
    with pytest.raises(TypeError, match="one request is answered by numbers"):
        compact.evaluate(63, 5, out=out)
    assert (status == 255).all()


def test_exponents_and_real_numbers(compact):
    xs = np.linspace(-0.1, 1.1, 777)
    highlights = compact.highlight(64, xs)
    assert highlights.tolist() == [compact.highlight(64, x) for x in xs]
    exponents = np.resize([1, 2, 64, 256], 777)
    assert compact.highlight(exponents, xs).tolist() == [compact.highlight(n, x) for n, x in zip(exponents, xs)]
    intensity, status = compact.evaluate(n=64, x=xs)
    assert np.array_equal(intensity * compact.formats["intensity"].ulp, highlights)
    assert set(status.tolist()) <= {0, int(blysk.Status.ABOVE_ONE), int(blysk.Status.CLAMPED)}
    assert compact.evaluate(n=64, x=0.99) == compact.evaluate(63, 8304722) == (17228, 0)
    by_bits = compact.evaluate(compact.address(64), [compact.x_bits(x) for x in xs])
    assert np.array_equal(by_bits[0], intensity)


def test_every_register_has_its_rtl_name(model):
    registers = model.registers(64, 0.99)
    assert list(registers) == [probe.path for probe in model.probes]
    assert len(registers) == len(model.probes) > 10
    intensity, status = model.evaluate(n=64, x=0.99)
    assert registers["clamp.intensity_q"].bits == intensity
    assert registers["clamp.intensity_q"].value == model.highlight(64, 0.99)
    assert registers["clamp.status_q"].bits == status
    assert registers["x_q"].bits == model.x_bits(0.99)
    for path, register in registers.items():
        assert register.path == path
        assert register.format.min_bits <= register.bits <= register.format.max_bits
        assert register.value == register.bits * register.format.ulp == register.format.value(register.bits)
        assert register.format.bits(register.word) == register.bits
        assert 0 <= register.rank < model.latency
    assert registers.items() == model.registers(address=63, x_bits=8304722).items()
    assert model.formats["clamp.intensity"] == registers["clamp.intensity_q"].format


def test_registers_are_a_mapping(compact):
    registers = compact.registers(64, 0.99)
    assert isinstance(registers, Mapping)
    as_dict = dict(registers)
    assert list(as_dict) == list(registers) == list(registers.keys())
    assert as_dict.keys() == registers.keys() and list(as_dict.values()) == list(registers.values())
    assert "x_q" in registers and registers.get("x_q") == registers["x_q"] == as_dict["x_q"]
    assert registers["x_q"] != compact.registers(64, 0.98)["x_q"] and registers["x_q"] != registers["fetch_status"]
    assert "x" not in registers and 5 not in registers
    assert registers.bits() == {path: register.bits for path, register in registers.items()}
    assert registers.get("x") is None and registers.get("x", 7) == 7
    with pytest.raises(KeyError, match="^'x'$"):
        registers["x"]
    assert repr(registers).startswith("Registers({'x_q': Register(fetch.x = 8304722 (0.99")
    first, *_, last = (rank.registers for rank in blysk.Pipeline(compact).ranks())
    assert "x_q" in first and "x_q" not in last and list(last) == ["clamp.intensity_q", "clamp.status_q"]


def test_rom_and_coefficients_are_those_of_the_rows(model):
    rom, real = model.rom(), model.coefficients
    assert np.array_equal(rom["n"], model.exponents) and np.array_equal(real["n"], np.arange(1, 257))
    registers = model.registers(64, 0.5)
    fetched = [register for register in registers.values() if register.rank == 0 and "rom." in register.path]
    assert fetched
    for register in fetched:
        assert register.bits == rom[register.name.removeprefix("fetch.")][63], register.name
    assert np.allclose(real["q"], 0.5 ** (1 / real["n"]))


def test_a_polynomial_in_real_numbers(compact):
    real = compact.coefficients
    v = 1 - 0.99 - real["start"][63]
    value = sum(real[f"c{power}"][63] * (-v) ** power for power in range(4))
    assert abs(value - compact.highlight(64, 0.99)) < 1e-4


def test_a_configuration_comes_back(model, tmp_path):
    again = blysk.Model.from_json(model.configuration)
    (tmp_path / "mine.json").write_text(model.configuration)
    file = blysk.Model.from_file(tmp_path / "mine.json")
    addresses, xs = requests(model, 1000)
    for other in (again, file):
        assert other.configuration == model.configuration
        assert np.array_equal(other.evaluate(addresses, xs), model.evaluate(addresses, xs))
    assert json.loads(model.configuration)["name"] == model.name
    assert model.latency == len(model.ranks) and model.ranks[0] == "fetch"
    assert [port.name for port in model.ports][:3] == ["clk_i", "rst_i", "in_valid_i"]


def test_what_is_refused_says_what_would_be_right(compact, tmp_path):
    def said(kind, call):
        with pytest.raises(kind) as caught:
            call()
        return str(caught.value)

    assert issubclass(blysk.BlyskError, ValueError)
    text = said(blysk.ConfigurationError, lambda: blysk.Model.preset("shiny"))
    assert text == 'there is no preset "shiny"; the presets are paper, blooming, tangent, compact, precise, schlick'
    assert said(blysk.ConfigurationError, lambda: blysk.Model.from_json("{")).startswith("configuration, at `{`: ")
    assert "cannot read" in said(blysk.ConfigurationError, lambda: blysk.Model.from_file(tmp_path / "none.json"))
    text = said(blysk.ExponentError, lambda: compact.highlight(2.5, 0.5))
    assert text == "the ROM has no word for n = 2.5; it has 1..=256"
    assert "sample 1: the ROM has no word" in said(blysk.ExponentError, lambda: compact.highlight([1, 300], [0.5, 0.5]))
    assert "NaN" in said(blysk.InputError, lambda: compact.highlight(64, float("nan")))
    text = said(blysk.InputError, lambda: compact.evaluate(63, [5, 1 << 24]))
    assert text == "sample 1: x: the bits 16777216 do not fit UQ1.23, which holds 0 to 16777215"
    assert "whole number from 0" in said(blysk.InputError, lambda: compact.evaluate(-1, [5]))
    assert "whole number from 0" in said(blysk.InputError, lambda: compact.evaluate([-1], [5]))
    assert "shape" in said(blysk.InputError, lambda: compact.evaluate([1, 2], [1, 2, 3]))
    text = said(TypeError, lambda: compact.evaluate(63, np.array([0.5])))
    assert text == "x_bits are whole numbers: give int64 or uint32, not float64"
    assert "not uint64" in said(TypeError, lambda: compact.evaluate(63, np.array([5], np.uint64)))
    assert "not bool" in said(TypeError, lambda: compact.evaluate(63, np.array([True])))
    assert "real numbers" in said(TypeError, lambda: compact.highlight(64, ["a"]))
    assert "not both" in said(TypeError, lambda: compact.evaluate(63, 5, n=64))
    assert "not both" in said(TypeError, lambda: compact.evaluate(63))
    assert "one request" in said(TypeError, lambda: compact.registers([1, 2], 0.5))


@pytest.mark.parametrize("format", ["UQ1.23", "Q2.22"])
def test_the_first_x_outside_the_format_is_named(compact, format):
    model = blysk.Model.from_json(compact.configuration.replace("UQ1.23", format))
    x = model.formats["x"]
    xs = np.resize([x.min_bits, 0, x.max_bits], 3000)
    wanted = model.evaluate(63, xs)
    assert np.array_equal(wanted, model.evaluate(np.full(3000, 63), xs))
    for refused in (x.min_bits - 1, x.max_bits + 1, -(1 << 63), (1 << 63) - 1):
        outside = xs.copy()
        outside[[1999, 2500]] = refused
        with pytest.raises(blysk.InputError, match=f"^sample 1999: x: the bits {refused} do not fit {format},"):
            model.evaluate(63, outside)


def test_threads_share_a_model(compact):
    from concurrent.futures import ThreadPoolExecutor

    addresses, xs = requests(compact, 200_000)
    wanted = compact.evaluate(addresses, xs)
    with ThreadPoolExecutor(4) as pool:
        for got in pool.map(lambda _: compact.evaluate(addresses, xs), range(8)):
            assert np.array_equal(got, wanted)


def test_documentation_is_there():
    for name in ("evaluate", "highlight", "registers", "bound", "rom", "preset"):
        assert getattr(blysk.Model, name).__doc__, name
    assert blysk.Model.coefficients.__doc__ and blysk.Pipeline.run.__doc__ and blysk.report.__doc__
