//! What bindings call answers what the data path answers, and refuses what cannot be answered.

use hw_model::presets;
use model::{Addresses, Clocked, Code, Error, Inputs, Model};
use proptest::prelude::*;

fn any_preset() -> impl Strategy<Value = Model> {
    let models: Vec<Model> = presets::ALL.iter().map(|preset| Model::preset(preset.name).unwrap()).collect();
    proptest::sample::select(models)
}

/// A model with requests of any address (some without a word) and any x that the input format holds.
fn requests(count: usize) -> impl Strategy<Value = (Model, Vec<(u32, i64)>)> {
    any_preset().prop_flat_map(move |model| {
        let input = model.datapath().formats().input;
        let request = (0_u32..260, input.min_bits()..=input.max_bits());
        (Just(model), prop::collection::vec(request, 1..count))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn arrays_are_their_samples((model, requests) in requests(2500)) {
        let (addresses, xs): (Vec<u32>, Vec<i64>) = requests.into_iter().unzip();
        let (mut intensities, mut status) = (vec![0; xs.len()], vec![0; xs.len()]);
        model.evaluate_all(Addresses::Each(&addresses), &xs, &mut intensities, &mut status).unwrap();
        for (index, (&address, &x)) in addresses.iter().zip(&xs).enumerate() {
            let answer = model.evaluate(address, x).unwrap();
            prop_assert_eq!((intensities[index], status[index]), (answer.intensity, answer.status.bits()));
        }
        let one = addresses[0];
        model.evaluate_all(Addresses::One(one), &xs, &mut intensities, &mut status).unwrap();
        for (index, &x) in xs.iter().enumerate() {
            let answer = model.evaluate(one, x).unwrap();
            prop_assert_eq!((intensities[index], status[index]), (answer.intensity, answer.status.bits()));
        }
    }

    #[test]
    fn the_last_registers_are_the_answer((model, requests) in requests(20)) {
        for (address, x) in requests {
            let answer = model.evaluate(address, x).unwrap();
            let registers = model.registers(address, x).unwrap();
            let last = |name: &str| {
                let place = model.probes().iter().position(|probe| probe.name == name).unwrap();
                registers[place]
            };
            prop_assert_eq!(last("clamp.intensity"), answer.intensity);
            prop_assert_eq!(last("clamp.status"), i64::from(answer.status.bits()));
        }
    }
}

#[test]
fn the_clock_brings_each_answer_after_the_latency() {
    let model = Model::preset("paper").unwrap();
    let mut pipeline = Clocked::new(&model);
    drop(model.clone());
    for cycle in 0..200_u32 {
        let request = |cycle: u32| (cycle % 256, i64::from(cycle) * 40_000);
        let (address, x) = request(cycle);
        let inputs = Inputs { in_valid: true, address, x, out_ready: true, ..Inputs::default() };
        let outputs = pipeline.tick(&inputs).unwrap();
        match cycle.checked_sub(model.latency() as u32) {
            None => assert!(!outputs.out_valid),
            Some(asked) => {
                let (address, x) = request(asked);
                let answer = model.evaluate(address, x).unwrap();
                assert_eq!((outputs.intensity, outputs.status), (answer.intensity, answer.status));
            }
        }
    }
}

#[test]
fn highlights_of_arrays_are_those_of_their_samples() {
    let model = Model::preset("precise").unwrap();
    let xs: Vec<f64> = (0..3000).map(|i| f64::from(i) / 2900.0).collect();
    let exponents: Vec<f64> = (0..3000).map(|i| f64::from(1 + i % 256)).collect();
    let mut values = vec![0.0; xs.len()];
    model.highlight_all(Addresses::Each(&exponents), &xs, &mut values).unwrap();
    for ((&n, &x), &value) in exponents.iter().zip(&xs).zip(&values) {
        assert_eq!(model.highlight(n, x).unwrap(), value);
    }
    model.highlight_all(Addresses::One(64.0), &xs, &mut values).unwrap();
    for (&x, &value) in xs.iter().zip(&values) {
        assert_eq!(model.highlight(64.0, x).unwrap(), value);
    }
}

#[test]
fn what_cannot_be_answered_is_refused_with_its_place() {
    let model = Model::preset("compact").unwrap();
    let said = |error: Error| (error.code(), error.to_string());
    let (code, text) = said(Model::preset("shiny").unwrap_err());
    assert_eq!(code, Code::NoPreset);
    assert!(text.starts_with("there is no preset \"shiny\"; the presets are paper"), "{text}");
    let (code, text) = said(Model::from_json("{").unwrap_err());
    assert_eq!((code, text.starts_with("configuration, at `{`: ")), (Code::Configuration, true), "{text}");
    let (code, text) = said(model.highlight(2.5, 0.5).unwrap_err());
    assert_eq!((code, text.as_str()), (Code::Exponent, "the ROM has no word for n = 2.5; it has 1..=256"));
    let (code, text) = said(model.evaluate(0, -1).unwrap_err());
    assert_eq!(code, Code::X);
    assert_eq!(text, "x: the bits -1 do not fit UQ1.23, which holds 0 to 16777215");

    let (mut intensities, mut status) = (vec![0; 3000], vec![0; 3000]);
    let mut xs = vec![5_i64; 3000];
    xs[2077] = 1 << 24;
    for addresses in [Addresses::One(7), Addresses::Each(&[7; 3000])] {
        let (code, text) = said(model.evaluate_all(addresses, &xs, &mut intensities, &mut status).unwrap_err());
        assert_eq!((code, text.starts_with("sample 2077: x: the bits 16777216 ")), (Code::X, true), "{text}");
    }
    let few = model.evaluate_all(Addresses::Each(&[7; 5]), &xs, &mut intensities, &mut status);
    assert_eq!(
        said(few.unwrap_err()),
        (Code::Argument, "address has 5 elements and x has 3000; give as many".to_owned())
    );
    let below = model.evaluate_all(Addresses::One(-1_i64), &[5_i64], &mut [0], &mut [0]);
    assert_eq!(below.unwrap_err().code(), Code::Argument);
}
