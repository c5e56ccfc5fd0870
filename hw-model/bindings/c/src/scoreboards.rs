//! Scoreboards: a DUT's ports judged cycle by cycle beside the model's.

use std::ffi::{CString, c_char};
use std::mem::MaybeUninit;

use crate::error::{Code, Failure, given, guard};
use crate::models::Model;
use crate::pointers::Out;

/// Judges a DUT: holds its ports against the clocked model's in every cycle from the first reset on.
///
/// One thread at a time may use a scoreboard.
pub struct Scoreboard {
    pub(crate) scoreboard: model::Scoreboard,
    /// Kept with the names that registers written by `model` point at.
    pub(crate) model: Model,
    /// What the DUT's registers hold, until the cycle is judged.
    pub(crate) registers: Option<Vec<Option<u64>>>,
    /// Texts that C was given.
    pub(crate) line: CString,
    pub(crate) summary: CString,
}

/// The ports of a DUT at a rising edge: what drives them and what they show.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Ports {
    /// `rst_i`.
    pub reset: bool,
    /// `in_valid_i`.
    pub in_valid: bool,
    /// `in_ready_o`.
    pub in_ready: bool,
    /// `out_valid_o`.
    pub out_valid: bool,
    /// `out_ready_i`.
    pub out_ready: bool,
    /// `address_i`.
    pub address: u32,
    /// `x_i`: the word on the port, two's complement; bits above its width are ignored.
    pub x: u64,
    /// `intensity_o`: the word on the port.
    pub intensity: u64,
    /// `status_o`: the word on the port.
    pub status: u64,
}

/// What a scoreboard has found so far.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Verdict {
    /// Whether results were taken, and nothing differed.
    pub passed: bool,
    /// Clock cycles seen.
    pub cycles: u64,
    /// Results taken.
    pub results: u64,
    /// Cycles in which a result waited.
    pub stalls: u64,
    /// Cycles in which a request could have been taken and there was none.
    pub bubbles: u64,
    /// Times that reset went high, after the first.
    pub resets: u64,
    /// Values held against the model's: results and, where they were shown, registers.
    pub compared: u64,
    /// Cycles in which something differed.
    pub failures: u64,
    /// `PASS 4096 results`, or `FAIL` with the reason. The bytes stay until the next call with this scoreboard.
    pub line: *const c_char,
}

pub(crate) const SCOREBOARD: &str = "the scoreboard";

impl Scoreboard {
    pub(crate) fn new(model: &Model) -> Self {
        Self {
            scoreboard: model::Scoreboard::new(&model.model),
            model: model.clone(),
            registers: None,
            line: CString::default(),
            summary: CString::default(),
        }
    }

    /// Judges one cycle, with the registers where they were given.
    pub(crate) fn cycle(&mut self, seen: &model::Seen) -> Result<(), Failure> {
        let registers = self.registers.take();
        match self.scoreboard.cycle(seen, registers.as_deref()) {
            Ok(()) => Ok(()),
            Err(difference) => Err(Failure::Differs(difference.to_string())),
        }
    }
}

/// Makes a scoreboard. `*scoreboard` is to be freed with `blysk_scoreboard_free`; after an error it is null.
/// Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_scoreboard_new(model: Option<&Model>, mut scoreboard: Out<*mut Scoreboard>) -> Code {
    guard(|| {
        scoreboard.put_null()?;
        scoreboard.put_handle(Scoreboard::new(given(model, "the model")?))
    })
}

/// Frees a scoreboard; null is left alone.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_scoreboard_free(scoreboard: Option<Box<Scoreboard>>) {
    guard(|| {
        drop(scoreboard);
        Ok(())
    });
}

/// Judges one clock cycle by the ports at the rising edge that ends it.
///
/// `BLYSK_CODE_DIFFERS` says that the DUT does something else than the model; `blysk_last_error` then tells cycle,
/// port or register, request, and what was expected. Later cycles are judged all the same. Cycles before the end of
/// the first reset are not compared: hardware may show anything there.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_scoreboard_cycle(scoreboard: Option<&mut Scoreboard>, ports: Option<&Ports>) -> Code {
    guard(|| {
        let ports = given(ports, "the ports")?;
        let scoreboard = given(scoreboard, SCOREBOARD)?;
        scoreboard.cycle(&model::Seen {
            reset: Some(ports.reset),
            in_valid: Some(ports.in_valid),
            in_ready: Some(ports.in_ready),
            address: Some(ports.address),
            x: Some(ports.x),
            out_valid: Some(ports.out_valid),
            out_ready: Some(ports.out_ready),
            intensity: Some(ports.intensity),
            status: Some(ports.status),
        })
    })
}

/// Writes what the scoreboard has found so far.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_scoreboard_verdict(
    scoreboard: Option<&mut Scoreboard>,
    verdict: Option<&mut MaybeUninit<Verdict>>,
) -> Code {
    guard(|| {
        let verdict = given(verdict, "the place for the verdict")?;
        let scoreboard = given(scoreboard, SCOREBOARD)?;
        let found = scoreboard.scoreboard.verdict();
        scoreboard.line = CString::new(found.line).unwrap_or_default();
        let counts = scoreboard.scoreboard.counts();
        verdict.write(Verdict {
            passed: found.passed,
            cycles: counts.cycles,
            results: counts.results,
            stalls: counts.stalls,
            bubbles: counts.bubbles,
            resets: counts.resets,
            compared: counts.compared,
            failures: counts.failures,
            line: scoreboard.line.as_ptr(),
        });
        Ok(())
    })
}
