//! The claims of \[Rom\], each computed and judged.
//!
//! A claim about exponents is judged for all of them: from which n it fails is found by bisection over
//! the integers up to [`GREATEST`], and the answer is then held against every n up to [`EXAMINED`] and
//! every power of two above. Where the answer rests on the error of a method on its epicentre, the
//! enclosures of [`bounds::certify`] must say the same at the last n and at the next. A claim about a printed formula
//! is judged by what the formula gives.

mod accuracy;
mod boundary;
mod claim;
mod comparison;
mod operations;
mod printed;
mod proof;
mod shape;
mod tail;

pub use boundary::{EXAMINED, GREATEST};
pub use claim::{Claim, ClaimsError, Evidence, Judgement};

/// Computes every claim, in the order of the paper.
///
/// # Errors
/// When a claim is not of a kind that can be judged; with the claims of the paper none is.
pub fn claims() -> Result<Vec<Claim>, ClaimsError> {
    let mut claims = printed::hermite()?;
    claims.extend(accuracy::claims()?);
    claims.extend(printed::three_point()?);
    claims.extend(shape::claims()?);
    claims.extend(operations::claims());
    claims.extend(printed::rational()?);
    claims.extend(tail::claims()?);
    Ok(claims)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_paper_claims_is_judged_as_the_numbers_say() {
        let claims = claims().unwrap();
        let verdict = |id: &str| claims.iter().find(|claim| claim.id == id).unwrap().verdict;
        assert_eq!(verdict("absolute-error"), Judgement::Holds);
        assert_eq!(verdict("relative-error"), Judgement::HoldsTo(114));
        let Judgement::HoldsTo(n) = verdict("schlick-epicentre") else { panic!() };
        assert!((120..128).contains(&n), "{n}");
        let ranges = ["tail-1-percent", "tail-3-percent", "tail-10-percent", "tail-ranges"];
        assert_eq!(ranges.map(verdict), [3, 4, 3, 3].map(Judgement::HoldsTo));
        let mut ids: Vec<&str> = claims.iter().map(|claim| claim.id).collect();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), claims.len());
    }

    #[test]
    fn every_verdict_has_its_numbers() {
        for claim in claims().unwrap() {
            assert!(!claim.evidence.is_empty(), "{}", claim.id);
            let next = matches!(claim.verdict, Judgement::HoldsTo(_));
            assert_eq!(claim.fails_from.is_some(), next, "{}", claim.id);
            for evidence in &claim.evidence {
                assert!(evidence.value.is_finite(), "{}: {evidence:?}", claim.id);
            }
        }
    }
}
