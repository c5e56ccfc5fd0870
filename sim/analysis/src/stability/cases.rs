//! The x at the edges of a row.

use hw_model::design::Design;

/// The x of a row, each with its name; those that the format has.
pub(super) fn cases(design: &Design, address: u32) -> Vec<(&'static str, i64)> {
    let config = design.config();
    let (one, format) = (config.input.one(), config.input);
    let mut all =
        vec![("least of the format", format.min_bits()), ("one ulp below 0", -1), ("0", 0), ("one ulp above 0", 1)];
    if let Some(row) = design.rows().get(address as usize) {
        let q = row.first_of_epicentre(config);
        all.extend([("one ulp below q", q - 1), ("q", q), ("one ulp above q", q + 1)]);
        if !row.segments.is_empty() {
            let cut = row.cut;
            all.extend([("one ulp below the cut", cut - 1), ("the cut", cut)]);
            all.push(("one ulp above the cut", cut + 1));
        }
        for segment in row.segments.iter().skip(1) {
            all.extend([("one ulp below the hand-over", segment.start - 1), ("the hand-over", segment.start)]);
        }
    }
    all.extend([
        ("one ulp below 1", one - 1),
        ("1", one),
        ("one ulp above 1", one + 1),
        ("greatest of the format", format.max_bits()),
    ]);
    all.retain(|&(_, x)| format.holds(x.into()));
    all
}
