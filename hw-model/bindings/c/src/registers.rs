//! Every register of every rank, for C.

use std::ffi::c_char;

use hw_model::quantise::real;
use model::Probe;

use crate::error::{Code, Failure, given, guard};
use crate::formats::Format;
use crate::models::Model;
use crate::pointers::Out;

/// A register of a rank, and what it holds.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Register {
    /// Its name with its part's, as in traces and waves: `stage1.t1`. The bytes stay as long as the model, or a
    /// pipeline or scoreboard made of it.
    pub name: *const c_char,
    /// Its path in the RTL below the top module: `polynomial.stage[1].multiply_add.t_q`. The bytes stay as those of
    /// the name.
    pub path: *const c_char,
    /// The rank that it stands in, counted from 0.
    pub rank: u32,
    /// Its format.
    pub format: Format,
    /// False until the rank has loaded a request: the RTL shows unknown bits there, and `bits` is 0.
    pub loaded: bool,
    /// The valid flag of its rank: whether the rank holds a request now.
    pub valid: bool,
    /// Its bits: the integer that they mean in its format.
    pub bits: i64,
    /// Its value: `bits / 2^fraction_bits`.
    pub value: f64,
}

/// What a register holds at a time.
pub(crate) struct Held {
    pub loaded: bool,
    pub valid: bool,
    pub bits: i64,
}

/// Writes every register into the room that C gave.
pub(crate) fn put(
    model: &Model,
    mut registers: Out<Register>,
    room: usize,
    held: impl Fn(usize, &Probe) -> Held,
) -> Result<(), Failure> {
    let probes = model.model.probes();
    if room < probes.len() {
        return Err(Failure::Room { wanted: probes.len(), got: room });
    }
    let places = registers.places(probes.len(), "the room for registers")?;
    for (index, ((place, probe), names)) in places.iter_mut().zip(probes).zip(&*model.names).enumerate() {
        let Held { loaded, valid, bits } = held(index, probe);
        let format = probe.register.format;
        place.write(Register {
            name: names.name.as_ptr(),
            path: names.path.as_ptr(),
            rank: u32::try_from(probe.rank).unwrap_or(u32::MAX),
            format: Format::of(format),
            loaded,
            valid,
            bits,
            value: real(bits, format),
        });
    }
    Ok(())
}

/// Writes what every register holds of one request on its way from the first rank to the last.
///
/// `registers` has room for `room` of them, at least `register_count` of the interface: they are written in the order
/// of ranks. `x` is bits in the input format. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_registers(
    model: Option<&Model>,
    address: u32,
    x: i64,
    registers: Out<Register>,
    room: usize,
) -> Code {
    guard(|| {
        let model = given(model, "the model")?;
        let bits = model.model.registers(address, x)?;
        put(model, registers, room, |index, _| Held { loaded: true, valid: true, bits: bits[index] })
    })
}
