//! The polynomial of every preset once more, in the compile-time types of the `fixed` crate.
//!
//! `I64F64` holds every value of these presets exactly (at most 34 integer bits before rounding, 45
//! fraction bits in a product), so a line is the type's own multiplication and addition, and its
//! rounding the type's own floor of a value half a place higher.

use fixed::types::I64F64;
use hw_model::config::Form;
use hw_model::datapath::formats::PolynomialFormats;
use hw_model::datapath::front_end::Region;
use hw_model::design::Design;
use hw_model::format::QFormat;
use hw_model::presets;
use hw_model::registers::Register;
use hw_model::rom::Row;

/// x for each row: an even spread of an odd number of steps, so that low bits are met in all patterns.
const STEPS: i64 = 997;

fn exact(bits: i64, format: QFormat) -> I64F64 {
    I64F64::from_bits(i128::from(bits) << (64 - format.fraction_bits()))
}

/// To the nearest multiple of 2^−fraction, a tie to the one above.
fn nearest_up(value: I64F64, fraction: u32) -> I64F64 {
    let half_place = I64F64::from_num(0.5) >> fraction;
    let place = I64F64::ONE >> fraction;
    let raised = value + half_place;
    raised - raised.rem_euclid(place)
}

/// t1, t2, t3 of one x, through the stages of the form.
fn stages(
    form: Form,
    formats: &PolynomialFormats,
    (row, segment): (&Row, usize),
    v: I64F64,
    output: QFormat,
) -> [I64F64; 3] {
    let [c0, c1, c2, c3] =
        std::array::from_fn(|power| exact(row.get(Register::C(segment, power)), formats.coefficients()[power]));
    let line = |multiplicand: I64F64, addend: I64F64, fraction: u32| {
        let product = multiplicand * v;
        let sum = if form == Form::Centred { addend - product } else { addend + product };
        nearest_up(sum, fraction)
    };
    let t1 = line(c3, c2, formats.t()[0].fraction_bits());
    let t2 = line(t1, c1, formats.t()[1].fraction_bits());
    [t1, t2, line(t2, c0, output.fraction_bits())]
}

#[test]
fn the_polynomial_of_every_preset_agrees_with_compile_time_types() {
    let mut compared = 0;
    for preset in presets::ALL {
        let design = Design::new(preset.config().unwrap()).unwrap();
        let (config, datapath) = (design.config(), design.datapath());
        let Some(formats) = &datapath.formats().polynomial else { continue };
        let one = config.input.one();
        // Ends of fewer bits than x get zeros behind them.
        let up = |format: Option<QFormat>| format.map_or(0, |f| config.input.fraction_bits() - f.fraction_bits());
        let (cut_up, hand_over_up) = (up(datapath.formats().cut), up(datapath.formats().hand_over));
        for (address, row) in datapath.rom().rows().iter().enumerate() {
            let cut = row.get(Register::Cut) << cut_up;
            let hand_over = row.get(Register::HandOver(1)) << hand_over_up;
            for step in 0..=STEPS {
                let x = cut + (one - cut) * step / STEPS;
                let segment = usize::from(x < hand_over);
                let start = if segment == 1 { hand_over } else { one };
                let shift = Register::Shift(segment);
                let s = exact(start - x, config.input);
                let v = match config.form {
                    Form::Power => exact(x, config.input),
                    Form::Centred => nearest_up(s << row.get(shift), formats.v.fraction_bits()),
                };
                let [t1, t2, t3] = stages(config.form, formats, (row, segment), v, config.output);
                let got = datapath.evaluate(address as u32, x);
                let intensity = t3.clamp(I64F64::ZERO, I64F64::ONE);
                assert_eq!(got.region, Region::Polynomial);
                let shown = [
                    exact(got.v, formats.v),
                    exact(got.t[0], formats.t()[0]),
                    exact(got.t[1], formats.t()[1]),
                    exact(got.t[2], formats.t()[2]),
                    exact(got.intensity, config.output),
                ];
                let place = format!("{} address {address} x = {x}", preset.name);
                assert_eq!(shown, [v, t1, t2, t3, intensity], "{place}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 5 * 256 * (STEPS + 1));
}
