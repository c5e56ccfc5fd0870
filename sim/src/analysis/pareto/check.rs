//! Whether a table that was kept still holds, in seconds and not in minutes: everything that costs nothing
//! is made again, each error is measured again where it was greatest, and a sample of all inputs must not
//! show a greater one.

use hw_model::highlight::{ExactPower, phong};

use super::contender::{Contender, Work};
use super::inputs::{Inputs, Samples};
use super::{ParetoReport, Row};

/// What does not hold of `kept`, in words; nothing if all does. `made` is of a sample of the same inputs.
#[must_use]
pub fn differences(
    kept: &[Row],
    made: &ParetoReport,
    contenders: &[Contender],
    inputs: &Inputs,
) -> Vec<String> {
    let names = |rows: &[Row]| rows.iter().map(|row| row.contender.clone()).collect::<Vec<_>>();
    let (had, has) = (names(kept), names(&made.contenders));
    if had != has {
        return vec![format!(
            "the contenders were {}; they are {}: check with the table's own --exponents, or make it again",
            had.join(", "),
            has.join(", ")
        )];
    }
    let mut found = Vec::new();
    for ((kept, made), contender) in kept.iter().zip(&made.contenders).zip(contenders) {
        let name = &kept.contender;
        found.extend(costs(kept).differences(&costs(made)).map(|d| format!("{name}: {d}")));
        for (place, kept, made) in [
            ("epicentre", Place::epicentre(kept), Place::epicentre(made)),
            ("[0, 1]", Place::whole(kept), Place::whole(made)),
        ] {
            found.extend(
                kept.difference(&made, contender, inputs).map(|d| format!("{name}, {place}: {d}")),
            );
        }
    }
    found
}

/// What follows from the configuration alone, each with what it is called in a sentence.
struct Costs([(&'static str, String); 5]);

impl Costs {
    /// A sentence for each that is another one.
    fn differences<'a>(&'a self, made: &'a Self) -> impl Iterator<Item = String> + 'a {
        self.0.iter().zip(&made.0).filter(|(kept, made)| kept != made).map(
            |((name, kept), (_, made))| {
                format!(
                    "{name} of the table: {kept}, now: {made}; use the table's own --exponents and --input, or \
                     make the table again"
                )
            },
        )
    }
}

fn costs(row: &Row) -> Costs {
    let or_none = |bits: Option<u64>| bits.map_or_else(|| "none".to_owned(), |b| b.to_string());
    Costs([
        ("bits of table or ROM", row.storage_bits.to_string()),
        ("latency", or_none(row.latency)),
        ("multipliers", row.multipliers.clone().unwrap_or_else(|| "none".to_owned())),
        ("bits of the divider", or_none(row.divider_bits)),
        ("description", row.what.clone()),
    ])
}

/// A greatest error and where it is.
struct Place {
    error: Option<f64>,
    n: Option<f64>,
    x: Option<f64>,
}

impl Place {
    const fn epicentre(row: &Row) -> Self {
        Self { error: row.epicentre_worst, n: row.epicentre_worst_n, x: row.epicentre_worst_x }
    }

    const fn whole(row: &Row) -> Self {
        Self { error: row.whole_worst, n: row.whole_worst_n, x: row.whole_worst_x }
    }

    fn difference(&self, made: &Self, contender: &Contender, inputs: &Inputs) -> Option<String> {
        let (Some(error), Some(n), Some(x)) = (self.error, self.n, self.x) else {
            return made
                .error
                .map(|error| format!("no error is given, and there is one of {error}"));
        };
        let Some(row) = inputs.exponents.position(n) else {
            return Some(format!("n = {n} is not measured now; use the table's own --exponents"));
        };
        let bits = (x / inputs.format.ulp()) as i64;
        if inputs.real(bits) != x || !(0..=inputs.greatest()).contains(&bits) {
            return Some(format!("x = {x} is not one of {}", inputs.format));
        }
        let again = error_at(contender, inputs, row, bits);
        // Two ways to an exact reference, and one rounding each.
        if (again - error).abs() > 1e-12 * error + 1e-30 {
            return Some(format!("{error:e} at n = {n}, x = {x}; now it is {again:e}"));
        }
        let greater = made.error.filter(|&made| made > error * (1.0 + 1e-12) + 1e-30)?;
        Some(format!("{error:e} was the greatest; now there is {greater:e}"))
    }
}

/// |value − x^n|, the reference an exact ratio of integers wherever there is one.
fn error_at(contender: &Contender, inputs: &Inputs, row: usize, bits: i64) -> f64 {
    let (mut samples, mut work) = (Samples::default(), Work::default());
    samples.fill(inputs, std::iter::once(bits));
    contender.engine.values(row, &samples, &mut work);
    let (n, value) = (inputs.exponents.as_slice()[row], work.wide[0]);
    let exact = (n.fract() == 0.0 && n <= f64::from(u32::MAX))
        .then(|| ExactPower::new(bits as u64, inputs.format.fraction_bits(), n as u32).ok())
        .flatten();
    let Some(exact) = exact else { return (value - phong(n, inputs.real(bits))).abs() };
    let nearest = exact.to_f64();
    // value − x^n = (value − nearest) + (nearest − x^n), the second in units of the last place.
    let ulp = nearest.next_up() - nearest;
    ((value - nearest) + exact.error_in_ulp(nearest) * ulp).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::error_report::Progress;
    use crate::analysis::pareto::compare;
    use crate::analysis::pareto::contender::Contenders;

    struct Quiet;
    impl Progress for Quiet {
        fn advance(&self, _samples: u64) {}
    }

    fn inputs(every: u64) -> Inputs {
        Inputs::new("UQ1.10".parse().unwrap(), "1..=8".parse().unwrap(), every).unwrap()
    }

    #[test]
    fn what_was_measured_holds_and_what_was_not_does_not() {
        let all = compare(&inputs(1), None, &[], &Quiet).unwrap();
        let part = compare(&inputs(7), None, &[], &Quiet).unwrap();
        let contenders = Contenders::new(&inputs(1)).unwrap().list;
        let see = |kept: &[Row]| differences(kept, &part, &contenders, &inputs(7));
        assert_eq!(see(&all.contenders), Vec::<String>::new());
        for (spoil, said) in [
            ((|row| row.storage_bits += 1) as fn(&mut Row), "bits of table or ROM of the table: "),
            (
                |row| row.latency = Some(99),
                "latency of the table: 99, now: none; use the table's own --exponents",
            ),
            (|row| row.whole_worst = row.whole_worst.map(|e| e * 1.001), "now it is"),
            (|row| row.whole_worst_x = row.epicentre_worst_x.map(|_| 0.0), "now it is"),
            (|row| row.epicentre_worst_x = Some(0.3), "is not one of"),
            (|row| row.epicentre_worst_n = Some(9.0), "not measured"),
            (|row| row.contender.push('!'), "the contenders were"),
        ] {
            let mut kept = all.contenders.clone();
            spoil(&mut kept[0]);
            let found = see(&kept);
            assert!(found.len() == 1 && found[0].contains(said), "{said}: {found:?}");
        }
    }
}
