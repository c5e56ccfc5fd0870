//! From proved widths to the least that keep the error as it is measured.
//!
//! The widths that a design proves add up the worst of every register, which never come together. So bits
//! are taken away while the chosen x of each row keep the error: single bits first, then one bit more in a
//! register for one or two fewer in others, where that is less hardware. Who cannot be narrowed any more is
//! measured at every x. Wherever it fails, the worst x is chosen from then on, and the search goes on from the
//! last state that passes it.

use hw_model::design::{Design, DesignError, Revision};
use hw_model::format::QFormat;
use hw_model::registers::Register;

use super::judge::{Judge, Place, greatest};
use crate::budget::NO_BUDGET;
use hw_model::stated::{Each, Hardware, ORDER, ROOMS, loosened, of_stated, stated, taken, tight, with_fraction};
use vectors::progress::Progress;

/// A state of the search: formats with no integer bit to spare.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct State {
    pub formats: Each<QFormat>,
    pub hardware: Hardware,
}

/// The design with these fraction bits, and room for every integer.
///
/// # Errors
/// When there is no such design.
pub(super) fn loose(base: &Design, formats: &Each<QFormat>) -> Result<Design, DesignError> {
    let revised = |room| {
        let widths = stated(&loosened(formats, room));
        base.revised(Revision { widths, error_budget_ulp: NO_BUDGET, ..base.revision() })
    };
    let [first, last] = ROOMS;
    revised(first).or_else(|_| revised(last))
}

/// The narrowest state that was found, and the greatest error of it; none where not even the proved widths
/// keep the error.
pub(super) fn narrow(
    base: &Design,
    judge: &mut Judge,
    progress: &dyn Progress,
) -> Result<Option<(State, Place)>, DesignError> {
    let start = of_stated(&base.widths());
    let Some(start) = attempt(base, judge, &start) else { return Ok(None) };
    let mut history = vec![start];
    while let Some(&state) = history.last() {
        if let Some(next) = improved(base, judge, &state) {
            history.push(next);
            continue;
        }
        let design = loose(base, &state.formats)?;
        let pieces = judge.measured(&design, progress);
        let failed: Vec<&Place> = pieces.iter().filter(|p| p.error > judge.error).collect();
        if failed.is_empty() {
            return Ok(greatest(&pieces).map(|worst| (state, worst)));
        }
        for place in failed {
            judge.choose(&design, place.address, place.x);
        }
        while let Some(last) = history.last()
            && !judge.may_pass(&loose(base, &last.formats)?)
        {
            history.pop();
        }
    }
    Ok(None)
}

/// The state with these fraction bits, if the chosen x keep the error.
fn attempt(base: &Design, judge: &mut Judge, formats: &Each<QFormat>) -> Option<State> {
    // A search tries what cannot be, such as a dividend that is no integer.
    let design = loose(base, formats).ok()?;
    if !judge.may_pass(&design) {
        return None;
    }
    let formats = tight(formats, &taken(&design));
    Some(State { formats, hardware: Hardware::of(&design, &formats) })
}

fn improved(base: &Design, judge: &mut Judge, state: &State) -> Option<State> {
    // By one layout of the ROM: a field that is constant in one state may be stored in another.
    let now = Hardware::of(base, &state.formats);
    let mut promising: Vec<(usize, Hardware, Each<QFormat>)> = moves()
        .filter_map(|moves| {
            let mut formats = state.formats;
            for &(register, more) in &moves {
                formats[register] = Some(with_fraction(formats[register]?, more)?);
            }
            Some((moves.len(), Hardware::of(base, &formats), formats))
        })
        .filter(|(_, hardware, _)| *hardware < now)
        .collect();
    promising.sort_by_key(|&(count, hardware, _)| (count, hardware));
    promising
        .iter()
        .filter_map(|(_, _, formats)| attempt(base, judge, formats))
        .find(|next| next.hardware < state.hardware)
}

/// One register a bit less; one a bit more and another less; one more and two less.
fn moves() -> impl Iterator<Item = Vec<(Register, i32)>> {
    let all = 0..ORDER.len();
    let single = all.clone().map(|less| vec![(less, -1)]);
    let exchanges = all.clone().flat_map(move |more| {
        let others = (0..ORDER.len()).filter(move |&less| less != more);
        others.flat_map(move |a| {
            let further = (a..ORDER.len()).filter(move |&b| b != more);
            let two = further.map(move |b| vec![(more, 1), (a, -1), (b, -1)]);
            std::iter::once(vec![(more, 1), (a, -1)]).chain(two)
        })
    });
    single
        .chain(exchanges)
        .map(|moves: Vec<(usize, i32)>| moves.into_iter().map(|(place, more)| (ORDER[place], more)).collect())
}
