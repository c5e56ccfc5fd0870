//! Small sets of x that together kill what they should.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::rows::Mask;

/// Indices of the fewest masks that together have every bit of `wanted`; each bit must be in some mask.
///
/// Exact. Bits that no useful mask joins are looked for apart (each segment of a polynomial has its own). In each
/// group, breadth first over the sets of bits that can be had with one mask, with two, and so on; there
/// are at most 2^16. Some mask must bring the rarest bit that a set still lacks, so only those that have it
/// are added. Of equally small choices the first found is taken, which the order decides.
#[must_use]
pub fn fewest(masks: &[Mask], wanted: Mask) -> Vec<usize> {
    let useful = undominated(masks, wanted);
    let groups = groups(useful.iter().map(|&index| masks[index] & wanted));
    groups.into_iter().flat_map(|group| fewest_of_group(masks, group)).collect()
}

/// The masks joined where they have a bit in common.
fn groups(masks: impl Iterator<Item = Mask>) -> Vec<Mask> {
    let mut groups: Vec<Mask> = Vec::new();
    for mask in masks {
        let (joined, apart): (Vec<Mask>, Vec<Mask>) = groups.into_iter().partition(|group| group & mask != 0);
        groups = apart;
        groups.push(joined.into_iter().fold(mask, |union, group| union | group));
    }
    groups
}

fn fewest_of_group(masks: &[Mask], wanted: Mask) -> Vec<usize> {
    let useful = undominated(masks, wanted);
    let rarest = rarest_first(masks, &useful, wanted);
    // How each set was first reached: the set before it, and the mask that was added.
    let mut reached: HashMap<Mask, (Mask, usize)> = HashMap::new();
    let mut level: Vec<Mask> = vec![0];
    while !reached.contains_key(&wanted) && wanted != 0 && !level.is_empty() {
        let mut next = Vec::new();
        for &set in &level {
            let Some(lacking) = rarest.iter().find(|&&bit| set & bit == 0) else { continue };
            for &index in useful.iter().filter(|&&index| masks[index] & lacking != 0) {
                let union = (set | masks[index]) & wanted;
                if let Entry::Vacant(place) = reached.entry(union) {
                    place.insert((set, index));
                    next.push(union);
                }
            }
        }
        level = next;
    }
    chosen(&reached, wanted)
}

/// The bits of `wanted`, those first that the fewest masks have.
fn rarest_first(masks: &[Mask], useful: &[usize], wanted: Mask) -> Vec<Mask> {
    let mut bits: Vec<Mask> = (0..Mask::BITS).map(|place| 1 << place).filter(|bit| wanted & bit != 0).collect();
    bits.sort_by_key(|bit| useful.iter().filter(|&&index| masks[index] & bit != 0).count());
    bits
}

fn chosen(reached: &HashMap<Mask, (Mask, usize)>, wanted: Mask) -> Vec<usize> {
    let mut chosen = Vec::new();
    let mut set = wanted;
    while set != 0
        && let Some(&(before, index)) = reached.get(&set)
    {
        chosen.push(index);
        set = before;
    }
    chosen.reverse();
    chosen
}

/// The masks that are not part of another one; of equal ones the first.
fn undominated(masks: &[Mask], wanted: Mask) -> Vec<usize> {
    let mut order: Vec<usize> = (0..masks.len()).filter(|&i| masks[i] & wanted != 0).collect();
    order.sort_by_key(|&index| std::cmp::Reverse((masks[index] & wanted).count_ones()));
    let mut kept: Vec<usize> = Vec::new();
    for index in order {
        let mask = masks[index] & wanted;
        if kept.iter().all(|&other| mask & !masks[other] != 0) {
            kept.push(index);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The least number, by trying every choice.
    fn least(masks: &[Mask], wanted: Mask) -> usize {
        (0_u32..1 << masks.len())
            .filter(|choice| {
                let taken = (0..masks.len()).filter(|i| choice >> i & 1 == 1);
                taken.fold(0, |set, i| set | masks[i]) & wanted == wanted
            })
            .map(|choice| choice.count_ones() as usize)
            .min()
            .unwrap()
    }

    proptest! {
        #[test]
        fn no_smaller_choice_has_everything(
            masks in prop::collection::vec(any::<u32>(), 1..10),
            some in any::<u32>(),
            sparse in any::<bool>(),
        ) {
            // Few bits, so that groups come about.
            let thin = |mask: Mask| if sparse { mask & (mask >> 7) & 0x00ff_1fff } else { mask & 0xffff };
            let masks: Vec<Mask> = masks.into_iter().map(Mask::from).map(thin).collect();
            let all = masks.iter().fold(0, |set, mask| set | mask);
            for wanted in [all, all & Mask::from(some)] {
                let choice = fewest(&masks, wanted);
                let union = choice.iter().fold(0, |set, &index| set | masks[index]);
                prop_assert_eq!(union & wanted, wanted);
                prop_assert_eq!(choice.len(), least(&masks, wanted));
            }
        }
    }
}
