//! Models: made, asked, freed.

use std::mem::MaybeUninit;
use std::path::Path;
use std::sync::Arc;

use model::Addresses;

use crate::abi::ABI_VERSION;
use crate::error::{Code, Failure, given, guard};
use crate::formats::Interface;
use crate::names::{Names, names};
use crate::pointers::{In, Out, Text};

/// The golden model of one configuration.
///
/// It never changes, so that any number of threads may ask one model at a time. Pipelines and scoreboards keep what
/// they need of it: it may be freed before them.
#[derive(Clone)]
pub struct Model {
    pub(crate) model: model::Model,
    pub(crate) names: Arc<[Names]>,
}

impl Model {
    /// Makes a model, where the caller's header is that of this library.
    fn make(abi: u32, mut out: Out<*mut Self>, make: impl FnOnce() -> Result<model::Model, Failure>) -> Code {
        guard(|| {
            out.put_null()?;
            if abi != ABI_VERSION {
                return Err(Failure::Abi(abi));
            }
            let model = make()?;
            let names = names(&model);
            out.put_handle(Self { model, names })
        })
    }
}

/// Makes the model of a preset, such as `compact`; `blysk presets` lists them.
///
/// `abi` is `BLYSK_ABI_VERSION` of the header that the caller was compiled with. `*model` is to be freed with
/// `blysk_model_free`; after an error it is null. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_model_preset(abi: u32, name: Text, model: Out<*mut Model>) -> Code {
    Model::make(abi, model, || Ok(model::Model::preset(name.get("the preset's name")?)?))
}

/// Makes the model of a configuration as JSON text; `docs/CONFIGURATION.md` has its fields. As `blysk_model_preset`
/// else. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_model_from_json(abi: u32, json: Text, model: Out<*mut Model>) -> Code {
    Model::make(abi, model, || Ok(model::Model::from_json(json.get("the configuration")?)?))
}

/// Makes the model of a configuration in a file of JSON. As `blysk_model_preset` else. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_model_from_file(abi: u32, path: Text, model: Out<*mut Model>) -> Code {
    Model::make(abi, model, || Ok(model::Model::from_file(Path::new(path.get("the path")?))?))
}

/// Frees a model; null is left alone. No other thread may be using it.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_model_free(model: Option<Box<Model>>) {
    guard(|| {
        drop(model);
        Ok(())
    });
}

/// Writes the formats of the ports, the latency and the sizes of the pipeline. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_model_interface(model: Option<&Model>, interface: Option<&mut MaybeUninit<Interface>>) -> Code {
    guard(|| {
        let interface = given(interface, "the place for the interface")?;
        interface.write(Interface::of(&given(model, "the model")?.model));
        Ok(())
    })
}

/// Writes the intensity, in [0, 1], that the hardware answers to the exponent `n` and `x` = cos γ.
///
/// `x` is rounded to the input format, and brought to its ends where it lies outside. An `n` without a ROM word is
/// `BLYSK_CODE_EXPONENT`, an `x` that is not finite `BLYSK_CODE_X`. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_highlight(
    model: Option<&Model>,
    n: f64,
    x: f64,
    intensity: Option<&mut MaybeUninit<f64>>,
) -> Code {
    guard(|| {
        let intensity = given(intensity, "the place for the intensity")?;
        intensity.write(given(model, "the model")?.model.highlight(n, x)?);
        Ok(())
    })
}

/// Writes the ROM address of the exponent `n`, for `blysk_evaluate` and for the port `address_i`. An `n` without a
/// ROM word is `BLYSK_CODE_EXPONENT`. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_address(model: Option<&Model>, n: f64, address: Option<&mut MaybeUninit<u32>>) -> Code {
    guard(|| {
        given(address, "the place for the address")?.write(given(model, "the model")?.model.address(n)?);
        Ok(())
    })
}

/// Writes the bits of a real `x` in the input format: the nearest, a tie to even; the format's end for an `x` beyond
/// it. An `x` that is not finite is `BLYSK_CODE_X`. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_x_bits(model: Option<&Model>, x: f64, bits: Option<&mut MaybeUninit<i64>>) -> Code {
    guard(|| {
        given(bits, "the place for the bits")?.write(given(model, "the model")?.model.x_bits(x)?);
        Ok(())
    })
}

/// Answers `count` requests, bit for bit as the hardware does.
///
/// `addresses` has `address_count` ROM addresses: 1 for all requests, or `count`, one for each; an address without a
/// ROM word is no error but a flag of the status. `x` has `count` values, bits in the input format; bits that it does
/// not hold are `BLYSK_CODE_X`, and the sentence names the first such sample. `intensity` and `status` have room for
/// `count` values each: bits in the output format, and flags (`BLYSK_STATUS_…`). After an error they hold nothing of
/// use. The four arrays may not overlap. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_evaluate(
    model: Option<&Model>,
    addresses: In<u32>,
    address_count: usize,
    x: In<i64>,
    count: usize,
    mut intensity: Out<i64>,
    mut status: Out<u8>,
) -> Code {
    guard(|| {
        let model = &given(model, "the model")?.model;
        let addresses = addresses.get(address_count, "the addresses")?;
        let x = x.get(count, "x")?;
        let intensity = intensity.filled(count, 0, "the room for intensities")?;
        let status = status.filled(count, 0, "the room for status flags")?;
        let addresses = match addresses {
            [address] => Addresses::One(*address),
            each if each.len() == count => Addresses::Each(each),
            other => return Err(Failure::Addresses { wanted: count, got: other.len() }),
        };
        Ok(model.evaluate_all(addresses, x, intensity, status)?)
    })
}
