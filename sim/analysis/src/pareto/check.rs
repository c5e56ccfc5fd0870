//! Whether a table that was kept still holds, in seconds and not in minutes: everything that costs nothing
//! is made again, each error is measured again where it was greatest, and a sample of all inputs must not
//! show a greater one.

use hw_model::highlight::{ExactPower, phong};

use super::contender::{Contender, Work};
use super::inputs::{Inputs, Samples};
use super::table::stand;
use super::{ContenderRow, ParetoReport};

/// What [`differences`] cannot look at, in words: nothing where the table is of the inputs that are measured. A mean
/// square is one of all inputs of the table, and so is the number of those.
#[must_use]
pub fn not_checked(kept: &[ContenderRow], inputs: &Inputs) -> Option<String> {
    let every = kept.first().map_or(1, |row| row.every);
    (every != inputs.every).then(|| {
        format!(
            "not checked, as every {} x was measured here: that the table is of every {every}, and its columns \
             epicentre_rms and whole_rms; say --every {every} to check them",
            inputs.every
        )
    })
}

/// What does not hold of `kept`, in words; nothing if all does. `made` is of a sample of the same inputs.
#[must_use]
pub fn differences(
    kept: &[ContenderRow],
    made: &ParetoReport,
    contenders: &[Contender],
    inputs: &Inputs,
) -> Vec<String> {
    let names = |rows: &[ContenderRow]| rows.iter().map(|row| row.contender.clone()).collect::<Vec<_>>();
    let (had, has) = (names(kept), names(&made.contenders));
    if had != has {
        return vec![format!(
            "the contenders were {}; they are {}: check with the table's own --exponents, or make it again",
            had.join(", "),
            has.join(", ")
        )];
    }
    let mut found = Vec::new();
    let same_inputs = not_checked(kept, inputs).is_none();
    found.extend(one_every(kept));
    found.extend(fronts(kept));
    for ((kept, made), contender) in kept.iter().zip(&made.contenders).zip(contenders) {
        let name = &kept.contender;
        found.extend(costs(kept).differences(&costs(made)).map(|d| format!("{name}: {d}")));
        for (place, kept, made) in [
            ("epicentre", Place::epicentre(kept), Place::epicentre(made)),
            ("[0, 1]", Place::whole(kept), Place::whole(made)),
        ] {
            found.extend(kept.difference(&made, contender, inputs).map(|d| format!("{name}, {place}: {d}")));
        }
        if same_inputs {
            found.extend(mean_squares(kept, made).map(|d| format!("{name}: {d}")));
        }
    }
    found
}

/// The K of a table of every K-th x, which all of its lines share.
fn one_every(kept: &[ContenderRow]) -> Option<String> {
    let every = kept.first()?.every;
    let other = kept.iter().find(|row| row.every != every || row.every == 0)?;
    Some(format!(
        "{}: every {} x, where the table begins with every {every}; a table is of one number of x",
        other.contender, other.every
    ))
}

/// Which contenders are on the fronts, and which dominate the others, follows from the other columns.
fn fronts(kept: &[ContenderRow]) -> impl Iterator<Item = String> {
    let mut made = kept.to_vec();
    stand(&mut made);
    let standing = |row: &ContenderRow| {
        let said = |front: Option<bool>, by: &Option<String>| match (front, by) {
            (None, None) => "not compared".to_owned(),
            (Some(true), None) => "on the front".to_owned(),
            (Some(false), Some(by)) => format!("dominated by {by}"),
            _ => "neither on the front nor dominated".to_owned(),
        };
        [
            said(row.hardware_epicentre_front, &row.hardware_epicentre_dominated_by),
            said(row.hardware_whole_front, &row.hardware_whole_dominated_by),
        ]
    };
    let pairs: Vec<_> = kept.iter().map(standing).zip(made.iter().map(standing)).collect();
    let names: Vec<String> = kept.iter().map(|row| row.contender.clone()).collect();
    names.into_iter().zip(pairs).flat_map(|(name, (kept, made))| {
        let places = ["epicentre", "[0, 1]"].into_iter().zip(kept.into_iter().zip(made));
        places.filter(|(_, (kept, made))| kept != made).map(move |(place, (kept, made))| {
            format!("{name}, hardware by error on {place}: {kept}, and by the other columns {made}")
        })
    })
}

/// The roots of mean squares, where the table is of the same inputs.
fn mean_squares(kept: &ContenderRow, made: &ContenderRow) -> impl Iterator<Item = String> {
    let same = |kept: Option<f64>, made: Option<f64>| match (kept, made) {
        (Some(kept), Some(made)) => (kept - made).abs() <= 1e-12 * made,
        (kept, made) => kept == made,
    };
    let pairs =
        [("epicentre_rms", kept.epicentre_rms, made.epicentre_rms), ("whole_rms", kept.whole_rms, made.whole_rms)];
    let shown = |rms: Option<f64>| rms.map_or_else(|| "none".to_owned(), |rms| format!("{rms:e}"));
    pairs
        .into_iter()
        .filter(move |&(_, kept, made)| !same(kept, made))
        .map(move |(column, kept, made)| format!("{column}: {}, now {}", shown(kept), shown(made)))
}

/// What follows from the configuration alone, each with what it is called in a sentence.
struct Costs([(&'static str, String); 7]);

impl Costs {
    /// A sentence for each that is another one.
    fn differences<'a>(&'a self, made: &'a Self) -> impl Iterator<Item = String> + 'a {
        self.0.iter().zip(&made.0).filter(|(kept, made)| kept != made).map(|((name, kept), (_, made))| {
            format!(
                "{name} of the table: {kept}, now: {made}; use the table's own --exponents and --input, or \
                     make the table again"
            )
        })
    }
}

fn costs(row: &ContenderRow) -> Costs {
    let or_none = |bits: Option<u64>| bits.map_or_else(|| "none".to_owned(), |b| b.to_string());
    Costs([
        ("kind", row.kind.clone()),
        ("multiplier_bits", or_none(row.multiplier_bits)),
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
    const fn epicentre(row: &ContenderRow) -> Self {
        Self { error: row.epicentre_worst, n: row.epicentre_worst_n, x: row.epicentre_worst_x }
    }

    const fn whole(row: &ContenderRow) -> Self {
        Self { error: row.whole_worst, n: row.whole_worst_n, x: row.whole_worst_x }
    }

    fn difference(&self, made: &Self, contender: &Contender, inputs: &Inputs) -> Option<String> {
        let (Some(error), Some(n), Some(x)) = (self.error, self.n, self.x) else {
            return made.error.map(|error| format!("no error is given, and there is one of {error}"));
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
    use crate::pareto::compare;
    use crate::pareto::contender::Contenders;
    use vectors::progress::Progress;

    struct Quiet;
    impl Progress for Quiet {
        fn advance(&self, _samples: u64) {}
    }

    fn inputs(every: u64) -> Inputs {
        Inputs::new("UQ1.10".parse().unwrap(), "1..=8".parse().unwrap(), every).unwrap()
    }

    #[test]
    fn what_was_measured_holds_and_what_was_not_does_not() {
        let all = compare(&inputs(1), &[], None, &[], &Quiet).unwrap();
        let part = compare(&inputs(7), &[], None, &[], &Quiet).unwrap();
        let contenders = Contenders::new(&inputs(1), &[]).unwrap().list;
        let see = |kept: &[ContenderRow]| differences(kept, &part, &contenders, &inputs(7));
        assert_eq!(see(&all.contenders), Vec::<String>::new());
        for (spoil, said) in [
            ((|row| row.storage_bits += 1) as fn(&mut ContenderRow), "bits of table or ROM of the table: "),
            (|row| row.latency = Some(99), "latency of the table: 99, now: none; use the table's own --exponents"),
            (|row| row.whole_worst = row.whole_worst.map(|e| e * 1.001), "now it is"),
            (|row| row.whole_worst_x = row.epicentre_worst_x.map(|_| 0.0), "now it is"),
            (|row| row.epicentre_worst_x = Some(0.3), "is not one of"),
            (|row| row.epicentre_worst_n = Some(9.0), "not measured"),
            (|row| row.contender.push('!'), "the contenders were"),
            (|row| row.kind = "f16".to_owned(), "kind of the table: f16"),
            (|row| row.multiplier_bits = Some(1), "multiplier_bits of the table: 1"),
            (|row| row.every = 3, "a table is of one number of x"),
            (|row| row.hardware_whole_front = Some(true), "on the front"),
            (|row| row.hardware_epicentre_dominated_by = Some("me".to_owned()), "epicentre"),
        ] {
            let mut kept = all.contenders.clone();
            spoil(&mut kept[0]);
            let found = see(&kept);
            assert!(found.len() == 1 && found[0].contains(said), "{said}: {found:?}");
        }
    }

    #[test]
    fn mean_squares_are_checked_where_the_inputs_are_the_same() {
        let all = compare(&inputs(1), &[], None, &[], &Quiet).unwrap();
        let contenders = Contenders::new(&inputs(1), &[]).unwrap().list;
        assert_eq!(not_checked(&all.contenders, &inputs(1)), None);
        assert!(not_checked(&all.contenders, &inputs(7)).unwrap().contains("whole_rms"));
        for spoil in [
            (|row| row.epicentre_rms = row.epicentre_rms.map(|rms| rms * 1.001)) as fn(&mut ContenderRow),
            |row| row.whole_rms = row.whole_rms.map(|rms| rms * (1.0 + 1e-9)),
            |row| row.whole_rms = None,
        ] {
            let mut kept = all.contenders.clone();
            spoil(&mut kept[2]);
            let found = differences(&kept, &all, &contenders, &inputs(1));
            assert!(found.len() == 1 && found[0].contains("_rms"), "{found:?}");
        }
    }
}
