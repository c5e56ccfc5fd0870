//! The corners are where they are said to be: each is looked for again, over every x.

mod common;

use std::collections::{HashMap, HashSet};

use hw_model::datapath::Signals;
use hw_model::design::Design;
use hw_model::quantise::real;
use hw_model::registers::Register;
use vectors::reference::reference;
use vectors::stimulus::corners::Corners;
use vectors::{Kind, Sample};

/// Every x the pipeline distinguishes.
fn range(design: &Design) -> std::ops::RangeInclusive<i64> {
    0..=design.datapath().front_end().greatest
}

fn by_row(design: &Design) -> HashMap<u32, Vec<Sample>> {
    let mut rows: HashMap<u32, Vec<Sample>> = HashMap::new();
    for sample in Corners::new(design, u64::MAX).samples() {
        rows.entry(sample.case.address).or_default().push(*sample);
    }
    rows
}

fn xs(samples: &[Sample]) -> HashSet<i64> {
    samples.iter().map(|sample| sample.case.x).collect()
}

#[test]
fn no_corner_comes_twice_and_all_are_counted() {
    for design in common::all_small() {
        let corners = Corners::new(&design, u64::MAX);
        let cases: HashSet<(u32, i64)> =
            corners.samples().iter().map(|sample| (sample.case.address, sample.case.x)).collect();
        assert_eq!(cases.len(), corners.samples().len());
        assert_eq!(cases.len() as u64, corners.available());
    }
}

#[test]
fn every_row_has_its_edges() {
    for design in common::all_small() {
        let input = design.config().input;
        let greatest = design.datapath().front_end().greatest;
        let rows = by_row(&design);
        for (address, row) in design.rows().iter().enumerate() {
            let xs = xs(&rows[&(address as u32)]);
            let q = input.one() - (row.epicentre * input.one() as f64).round() as i64;
            let mut wanted = vec![0, 1, greatest - 1, greatest, greatest + 1, q - 1, q, q + 1, input.max_bits()];
            wanted.extend([-1, input.min_bits()]);
            if design.datapath().degree() > 0 {
                wanted.extend([row.cut - 1, row.cut, row.cut + 1]);
            }
            for x in wanted.into_iter().filter(|&x| input.holds(x.into())) {
                assert!(xs.contains(&x), "{} row {address}: {x}", design.config().name);
            }
        }
    }
}

/// The least and greatest value of every computed register, over every x, is reached by a corner.
#[test]
fn every_register_reaches_its_ends() {
    let mut compared = 0;
    for design in common::all_small() {
        let datapath = design.datapath();
        for (address, samples) in by_row(&design) {
            if address as usize >= design.rom().depth() {
                continue;
            }
            let passages =
                |xs: Vec<i64>| -> Vec<Vec<Signals>> { xs.into_iter().map(|x| datapath.passage(address, x)).collect() };
            let all = passages(range(&design).collect());
            let corners = passages(xs(&samples).into_iter().collect());
            for rank in 1..datapath.rank_count() {
                for register in datapath.registers(rank) {
                    if !register.computed || matches!(register.name(), "region" | "status") {
                        continue;
                    }
                    let ends = |passages: &[Vec<Signals>]| {
                        let bits = passages.iter().map(|ranks| register.bits(&ranks[rank]));
                        (bits.clone().min(), bits.max())
                    };
                    assert_eq!(ends(&corners), ends(&all), "{address} {rank} {register:?}");
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn the_worst_error_of_each_part_is_there() {
    for design in common::all_small() {
        let config = design.config();
        for (address, samples) in by_row(&design) {
            let Some(row) = design.rows().get(address as usize) else { continue };
            let error = |x: i64| {
                let intensity = design.datapath().evaluate(address, x).intensity;
                let power = reference(row.exponent, x, config.input);
                (real(intensity, config.output) - power).abs()
            };
            let has_polynomial = design.datapath().degree() > 0;
            let above = |x: i64| has_polynomial && x >= row.cut;
            for part in [true, false] {
                let worst = |xs: &mut dyn Iterator<Item = i64>| {
                    xs.filter(|&x| range(&design).contains(&x) && above(x) == part).map(error).fold(0.0, f64::max)
                };
                let found = worst(&mut xs(&samples).into_iter());
                assert_eq!(found, worst(&mut range(&design)), "{} {address} {part}", config.name);
            }
        }
    }
}

/// x whose t1 (c2 + c3·x in the power form) drops exactly half, by arithmetic of its own.
#[test]
fn a_tie_is_a_tie() {
    let design = common::small();
    let formats = design.datapath().formats().polynomial.unwrap();
    let field = |name| design.rom().layout().field(name).unwrap().format.fraction_bits();
    let (c3, c2) = (field(Register::C(0, 3)), field(Register::C(0, 2)));
    let common_place = (c3 + formats.v.fraction_bits()).max(c2);
    let drop = common_place - formats.t()[0].fraction_bits();
    assert!(drop > 1, "the small design must round t1");
    let mut ties = 0;
    for (address, samples) in by_row(&design) {
        let Some(row) = design.rom().row(address) else { continue };
        let distance = |x: i64| {
            let product = i128::from(row.get(Register::C(0, 3))) * i128::from(x);
            let product = product << (common_place - c3 - formats.v.fraction_bits());
            let sum = product + (i128::from(row.get(Register::C(0, 2))) << (common_place - c2));
            (sum.rem_euclid(1 << drop) - (1 << (drop - 1))).abs()
        };
        let cut = design.datapath().front_end().cut(row);
        let answered = |x: &i64| (cut..=*range(&design).end()).contains(x);
        let nearest = range(&design).filter(answered).map(distance).min();
        let found = xs(&samples).into_iter().filter(answered).map(distance).min();
        assert_eq!(found, nearest, "row {address}");
        ties += u32::from(found == Some(0));
    }
    assert!(ties > 0, "no row has an exact tie");
}

/// Where each x is enough for one reason only, every line has a tie of its own.
#[test]
fn every_line_that_rounds_has_its_tie() {
    let design = common::preset("paper");
    let corners = Corners::new(&design, u64::MAX);
    for register in ["t1", "t2", "t3", "divisor", "quotient"] {
        let kind = Kind::Tie(register);
        assert!(corners.samples().iter().any(|sample| sample.kind == kind), "{register}");
    }
}

/// s·2^e loses two bits in the centred design, so u is a tie where they are exactly 2: e is ⌊log2 n⌋,
/// and from e = 2 up nothing is lost.
#[test]
fn u_has_its_tie() {
    let design = common::centred();
    let one = design.config().input.one();
    let rows = by_row(&design);
    for (address, shift) in [(0, 0), (1, 1), (2, 1)] {
        let cut = design.rows()[address].cut;
        let is_tie = |x: &i64| (cut..=one).contains(x) && ((one - x) << shift) & 3 == 2;
        assert!(xs(&rows[&(address as u32)]).iter().any(is_tie), "row {address}");
    }
}

#[test]
fn the_divider_has_both_its_ends() {
    for design in [common::small(), common::below_one()] {
        let datapath = design.datapath();
        for (address, samples) in by_row(&design) {
            let Some(row) = design.rows().get(address as usize) else { continue };
            let end = match datapath.degree() {
                1.. => row.cut - 1,
                0 => *range(&design).end(),
            };
            let quotient = |x: i64| datapath.evaluate(address, x).division.digits;
            let zero = (0..=end).filter(|&x| quotient(x) == 0).max().unwrap();
            let greatest = (0..=end).map(quotient).max().unwrap();
            let xs = xs(&samples);
            assert!(xs.contains(&zero), "{address} {zero}");
            assert!(xs.iter().any(|&x| (0..=end).contains(&x) && quotient(x) == greatest));
        }
    }
}

#[test]
fn addresses_without_a_word_are_there() {
    for design in common::all_small() {
        let rom = design.rom();
        let last = (1 << rom.address_width()) - 1;
        let rows = by_row(&design);
        for address in [rom.depth() as u32, last] {
            assert!(rows[&address].len() >= 3);
            assert!(rows[&address].iter().all(|sample| sample.kind == Kind::NoWord));
        }
    }
}

#[test]
fn too_small_a_count_is_shared_over_the_rows() {
    let design = common::preset("paper");
    let depth = design.rom().depth();
    let corners = Corners::new(&design, 4096);
    assert_eq!(corners.samples().len(), 4096);
    assert!(corners.available() > 4096);
    let shares = |corners: &Corners| {
        let mut shares = vec![0; depth];
        for sample in corners.samples() {
            if let Some(share) = shares.get_mut(sample.case.address as usize) {
                *share += 1;
            }
        }
        shares
    };
    // Every row has the same number of corners, or all of its own.
    let (shares, whole) = (shares(&corners), shares(&Corners::new(&design, u64::MAX)));
    let most: u32 = *shares.iter().max().unwrap();
    for (address, (&share, &whole)) in shares.iter().zip(&whole).enumerate() {
        assert!(share + 1 >= most || share == whole, "row {address}: {share} of {whole}");
    }
    for kind in [Kind::One, Kind::Cut, Kind::WorstPolynomial, Kind::WorstTail, Kind::Zero] {
        let rows = corners.samples().iter().filter(|sample| sample.kind == kind).count();
        assert_eq!(rows, depth, "{kind}");
    }
    // Fewer than rows: spread over all of them, the first and the last included.
    let addresses: Vec<u32> = Corners::new(&design, 4).samples().iter().map(|sample| sample.case.address).collect();
    assert_eq!(addresses, [0, 85, 170, 255]);
}
