//! Clocked pipelines: made, clocked, looked into, freed.

use std::mem::MaybeUninit;

use model::Clocked;

use crate::error::{Code, Failure, given, guard};
use crate::models::Model;
use crate::pointers::{In, Out};
use crate::registers::{self, Held, Register};

/// The clocked pipeline of a model: its registers, and one call a clock cycle.
///
/// One thread at a time may use a pipeline; different threads may use different pipelines of one model.
pub struct Pipeline {
    model: Model,
    pub(crate) clocked: Clocked,
}

/// What drives the ports during one clock cycle.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Inputs {
    /// `rst_i`: clears every valid flag at the edge.
    pub reset: bool,
    /// `in_valid_i`: `address` and `x` are a request.
    pub in_valid: bool,
    /// `out_ready_i`: a result can be taken.
    pub out_ready: bool,
    /// `address_i`: the ROM address.
    pub address: u32,
    /// `x_i`: bits in the input format.
    pub x: i64,
}

/// What the ports show at the rising edge that ends the cycle.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Outputs {
    /// `in_ready_o`: a request is taken.
    pub in_ready: bool,
    /// `out_valid_o`: `intensity` and `status` are a result.
    pub out_valid: bool,
    /// `status_o`: flags, `BLYSK_STATUS_…`.
    pub status: u8,
    /// `intensity_o`: bits in the output format.
    pub intensity: i64,
}

impl From<&Inputs> for model::Inputs {
    fn from(inputs: &Inputs) -> Self {
        let &Inputs { reset, in_valid, out_ready, address, x } = inputs;
        Self { reset, in_valid, address, x, out_ready }
    }
}

impl From<model::Outputs> for Outputs {
    fn from(outputs: model::Outputs) -> Self {
        let model::Outputs { in_ready, out_valid, intensity, status } = outputs;
        Self { in_ready, out_valid, status: status.bits(), intensity }
    }
}

const PIPELINE: &str = "the pipeline";

/// Makes an empty pipeline, as after reset. `*pipeline` is to be freed with `blysk_pipeline_free`; after an error it
/// is null. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_pipeline_new(model: Option<&Model>, mut pipeline: Out<*mut Pipeline>) -> Code {
    guard(|| {
        pipeline.put_null()?;
        let model = given(model, "the model")?.clone();
        let clocked = Clocked::new(&model.model);
        pipeline.put_handle(Pipeline { model, clocked })
    })
}

/// Frees a pipeline; null is left alone.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_pipeline_free(pipeline: Option<Box<Pipeline>>) {
    guard(|| {
        drop(pipeline);
        Ok(())
    });
}

/// Makes the pipeline as new: empty, and no rank has loaded anything. (`reset` of the inputs is what hardware does: it
/// clears flags and leaves data.)
#[unsafe(no_mangle)]
pub extern "C" fn blysk_pipeline_reset(pipeline: Option<&mut Pipeline>) -> Code {
    guard(|| {
        let pipeline = given(pipeline, PIPELINE)?;
        pipeline.clocked = Clocked::new(&pipeline.model.model);
        Ok(())
    })
}

/// Writes what the ports show when a step is done with these inputs.
fn show(
    pipeline: Option<&mut Pipeline>,
    inputs: Option<&Inputs>,
    outputs: Option<&mut MaybeUninit<Outputs>>,
    step: impl FnOnce(&mut Clocked, &model::Inputs) -> Result<model::Outputs, model::Error>,
) -> Code {
    guard(|| {
        let outputs = given(outputs, "the place for the outputs")?;
        let inputs = given(inputs, "the inputs")?.into();
        outputs.write(step(&mut given(pipeline, PIPELINE)?.clocked, &inputs)?.into());
        Ok(())
    })
}

/// One clock cycle: writes what the ports show with these inputs at the rising edge that ends the cycle; then the edge.
///
/// Bits of x that the input format does not hold are `BLYSK_CODE_X`, and then no cycle has passed.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_pipeline_tick(
    pipeline: Option<&mut Pipeline>,
    inputs: Option<&Inputs>,
    outputs: Option<&mut MaybeUninit<Outputs>>,
) -> Code {
    show(pipeline, inputs, outputs, Clocked::tick)
}

/// Writes what the ports show with these inputs before the edge, which `blysk_pipeline_clock` then brings. It may be
/// called as often as the inputs change within a cycle.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_pipeline_combinational(
    pipeline: Option<&mut Pipeline>,
    inputs: Option<&Inputs>,
    outputs: Option<&mut MaybeUninit<Outputs>>,
) -> Code {
    show(pipeline, inputs, outputs, Clocked::combinational)
}

/// The rising edge, with the inputs of the last `blysk_pipeline_combinational`.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_pipeline_clock(pipeline: Option<&mut Pipeline>) -> Code {
    guard(|| {
        given(pipeline, PIPELINE)?.clocked.clock();
        Ok(())
    })
}

/// `blysk_pipeline_tick` for `count` cycles: `inputs` has one element a cycle, and `outputs` room for as many. The
/// arrays may not overlap. Where an x does not fit, the cycles before it have passed.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_pipeline_run(
    pipeline: Option<&mut Pipeline>,
    inputs: In<Inputs>,
    count: usize,
    mut outputs: Out<Outputs>,
) -> Code {
    guard(|| {
        let pipeline = given(pipeline, PIPELINE)?;
        let inputs = inputs.get(count, "the inputs")?;
        let places = outputs.places(count, "the room for outputs")?;
        for (inputs, place) in inputs.iter().zip(places) {
            place.write(pipeline.clocked.tick(&inputs.into())?.into());
        }
        Ok(())
    })
}

/// Writes what every register holds before the next edge. `registers` has room for `room` of them, at least
/// `register_count` of the interface: they are written in the order of ranks.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_pipeline_ranks(pipeline: Option<&mut Pipeline>, registers: Out<Register>, room: usize) -> Code {
    guard(|| -> Result<(), Failure> {
        let Pipeline { model, clocked } = given(pipeline, PIPELINE)?;
        let ranks = clocked.ranks();
        registers::put(model, registers, room, |_, probe| {
            let rank = &ranks[probe.rank];
            let bits = if rank.loaded { probe.register.bits(&rank.signals) } else { 0 };
            Held { loaded: rank.loaded, valid: rank.valid, bits }
        })
    })
}
