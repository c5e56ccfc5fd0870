//! What SystemVerilog imports besides: the same calls with every port as an argument of its own, and words as they are
//! on the wires. `dpi/blysk_dpi_pkg.sv` declares them. C does better with the structures of the other functions.

use std::ffi::{CString, c_char};
use std::mem::MaybeUninit;

use model::{Inputs, Seen};

use crate::error::{Code, Failure, given, guard};
use crate::formats::Interface;
use crate::models::Model;
use crate::pipelines::Pipeline;
use crate::pointers::{In, Out};
use crate::scoreboards::{SCOREBOARD, Scoreboard};

/// A level as SystemVerilog hands over a `logic`: 0, 1, 2 for z and 3 for x.
const fn level(logic: u8) -> Option<bool> {
    match logic {
        0 => Some(false),
        1 => Some(true),
        _ => None,
    }
}

/// The widths of a DUT's ports against those of the model.
fn check_widths(model: &Model, widths: [u32; 4]) -> Result<(), Failure> {
    let Interface { address, x, intensity, status, .. } = Interface::of(&model.model);
    let ports = [("address_i", address), ("x_i", x), ("intensity_o", intensity), ("status_o", status)];
    let wrong = ports.iter().zip(widths).find(|((_, format), width)| format.width != *width);
    let Some(((port, format), width)) = wrong else { return Ok(()) };
    let name = &model.model.design().config().name;
    let right = format.width;
    Err(Failure::Differs(format!(
        "{port} of the DUT has a width of {width}, and {right} in configuration {name}; is it another configuration?"
    )))
}

/// `blysk_scoreboard_new` for a DUT with ports of these widths in bits: other widths than the model's are
/// `BLYSK_CODE_DIFFERS`. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_dpi_scoreboard_new(
    model: Option<&Model>,
    address_width: u32,
    x_width: u32,
    intensity_width: u32,
    status_width: u32,
    mut scoreboard: Out<*mut Scoreboard>,
) -> Code {
    guard(|| {
        scoreboard.put_null()?;
        let model = given(model, "the model")?;
        check_widths(model, [address_width, x_width, intensity_width, status_width])?;
        scoreboard.put_handle(Scoreboard::new(model))
    })
}

/// `blysk_scoreboard_cycle` of a four-valued simulator. Single bits are 0, 1, 2 for z or 3 for x. The request and the
/// result are known where none of their bits is x or z: `request_known` and `result_known` are 1, and 0 otherwise.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_dpi_cycle(
    scoreboard: Option<&mut Scoreboard>,
    reset: u8,
    in_valid: u8,
    in_ready: u8,
    request_known: u8,
    address: u32,
    x: u64,
    out_valid: u8,
    out_ready: u8,
    result_known: u8,
    intensity: u64,
    status: u64,
) -> Code {
    guard(|| {
        let [request, result] = [request_known, result_known].map(|known| known == 1);
        given(scoreboard, SCOREBOARD)?.cycle(&Seen {
            reset: level(reset),
            in_valid: level(in_valid),
            in_ready: level(in_ready),
            address: request.then_some(address),
            x: request.then_some(x),
            out_valid: level(out_valid),
            out_ready: level(out_ready),
            intensity: result.then_some(intensity),
            status: result.then_some(status),
        })
    })
}

/// Registers that go in one call of [`blysk_dpi_registers`].
const TOGETHER: usize = 16;

/// What the DUT's registers hold at the edge that the next `blysk_dpi_cycle` judges: of `count` in all, in the order of
/// `blysk_registers`, the 16 from `first` on, or as many as are left.
///
/// `words` has 64 bits of a `logic` vector for each, the first register lowest: two pairs of 32 values and 32 marks of
/// z and x, as `svLogicVecVal` has them. Registers that no call tells are unknown.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_dpi_registers(
    scoreboard: Option<&mut Scoreboard>,
    count: u32,
    first: u32,
    words: In<u32>,
) -> Code {
    guard(|| {
        let scoreboard = given(scoreboard, SCOREBOARD)?;
        let wanted = scoreboard.model.model.probes().len();
        if count as usize != wanted {
            return Err(Failure::Differs(format!(
                "the DUT shows {count} registers, and the configuration has {wanted}; is it another configuration?"
            )));
        }
        let registers = scoreboard.registers.get_or_insert_with(|| vec![None; wanted]);
        let places = registers.iter_mut().skip(first as usize).take(TOGETHER);
        let words = words.get(4 * places.len(), "the words")?;
        for (place, parts) in places.zip(words.chunks_exact(4)) {
            *place = match parts {
                &[low, 0, high, 0] => Some(u64::from(high) << 32 | u64::from(low)),
                _ => None,
            };
        }
        Ok(())
    })
}

/// What was seen so far: `6449 cycles, 1051 stalls, 972 bubbles, 3 resets, 40960 values compared`; an empty text for
/// null. The bytes stay until the next call of this function with this scoreboard.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_dpi_summary(scoreboard: Option<&mut Scoreboard>) -> *const c_char {
    text(scoreboard, |scoreboard| {
        scoreboard.summary = CString::new(scoreboard.scoreboard.counts().to_string()).unwrap_or_default();
        scoreboard.summary.as_ptr()
    })
}

/// `PASS 4096 results`, or `FAIL` with the reason; an empty text for null. The bytes stay until the next call of this
/// function with this scoreboard.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_dpi_verdict(scoreboard: Option<&mut Scoreboard>) -> *const c_char {
    text(scoreboard, |scoreboard| {
        scoreboard.line = CString::new(scoreboard.scoreboard.verdict().line).unwrap_or_default();
        scoreboard.line.as_ptr()
    })
}

/// A text that a scoreboard keeps.
fn text(scoreboard: Option<&mut Scoreboard>, keep: impl FnOnce(&mut Scoreboard) -> *const c_char) -> *const c_char {
    let mut kept = c"".as_ptr();
    guard(|| {
        kept = keep(given(scoreboard, SCOREBOARD)?);
        Ok(())
    });
    kept
}

/// `blysk_pipeline_tick` with words: x as it is on the port, two's complement; bits above its width are ignored.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_dpi_tick(
    pipeline: Option<&mut Pipeline>,
    reset: u8,
    in_valid: u8,
    address: u32,
    x: u64,
    out_ready: u8,
    in_ready: Option<&mut MaybeUninit<u8>>,
    out_valid: Option<&mut MaybeUninit<u8>>,
    intensity: Option<&mut MaybeUninit<u64>>,
    status: Option<&mut MaybeUninit<u8>>,
) -> Code {
    guard(|| {
        let place = "the place for an output";
        let (in_ready, out_valid) = (given(in_ready, place)?, given(out_valid, place)?);
        let (intensity, status) = (given(intensity, place)?, given(status, place)?);
        let clocked = &mut given(pipeline, "the pipeline")?.clocked;
        let formats = clocked.model().datapath().formats();
        let (input, output) = (formats.input, formats.output);
        let outputs = clocked.tick(&Inputs {
            reset: reset == 1,
            in_valid: in_valid == 1,
            address,
            x: input.from_word(x),
            out_ready: out_ready == 1,
        })?;
        in_ready.write(outputs.in_ready.into());
        out_valid.write(outputs.out_valid.into());
        intensity.write(output.to_word(outputs.intensity));
        status.write(outputs.status.bits());
        Ok(())
    })
}

/// The word on `intensity_o` and the flags on `status_o` that answer one request, without a clock. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_dpi_answer(
    model: Option<&Model>,
    address: u32,
    x: u64,
    intensity: Option<&mut MaybeUninit<u64>>,
    status: Option<&mut MaybeUninit<u8>>,
) -> Code {
    guard(|| {
        let place = "the place for an output";
        let (intensity, status) = (given(intensity, place)?, given(status, place)?);
        let model = &given(model, "the model")?.model;
        let formats = model.datapath().formats();
        let answer = model.evaluate(address, formats.input.from_word(x))?;
        intensity.write(formats.output.to_word(answer.intensity));
        status.write(answer.status.bits());
        Ok(())
    })
}
