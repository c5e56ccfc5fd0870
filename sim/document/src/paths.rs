//! Where each register is in the RTL.

use hw_model::datapath::Datapath;
use vectors::rtl::probes::{probes, valid_path};

use super::table::Table;

/// A register in one rank, or in several whose paths count up.
#[derive(Debug, PartialEq, Eq)]
struct Run {
    name: String,
    first: usize,
    last: usize,
    path: Indexed,
    /// The index in the last rank.
    to: Option<usize>,
}

/// A path, cut at its last index.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Indexed {
    before: String,
    index: Option<usize>,
    after: String,
}

impl Indexed {
    fn new(path: &str) -> Self {
        let whole = || Self { before: path.to_owned(), index: None, after: String::new() };
        let Some((before, rest)) = path.rsplit_once('[') else { return whole() };
        let Some((index, after)) = rest.split_once(']') else { return whole() };
        let Ok(index) = index.parse() else { return whole() };
        Self { before: before.to_owned(), index: Some(index), after: after.to_owned() }
    }
}

impl Run {
    /// True where this is what the register is in the next rank.
    fn goes_on(&self, name: &str, rank: usize, path: &Indexed) -> bool {
        let next = self.to.map(|to| to + 1);
        self.name == name
            && self.last + 1 == rank
            && (&self.path.before, &self.path.after) == (&path.before, &path.after)
            && next.is_some_and(|next| path.index == Some(next))
    }

    fn text(&self) -> String {
        let Indexed { before, index, after } = &self.path;
        match (index, self.to) {
            (Some(from), Some(to)) if *from < to => format!("`{before}[{from} … {to}]{after}`"),
            (Some(index), _) => format!("`{before}[{index}]{after}`"),
            (None, _) => format!("`{before}`"),
        }
    }
}

/// Every register of every rank, and the valid flags, with its path below `blysk`.
pub(super) fn paths(datapath: &Datapath) -> Table {
    let flags = (0..datapath.rank_count()).map(|rank| ("valid".to_owned(), rank, valid_path(rank)));
    let registers = probes(datapath).into_iter();
    let registers = registers.map(|probe| (probe.register.name().to_owned(), probe.rank, probe.path));
    let mut table = Table::new(&["register", "ranks", "path"]);
    for run in runs(registers.chain(flags)) {
        let Run { name, first, last, .. } = &run;
        let ranks = if first == last { first.to_string() } else { format!("{first}–{last}") };
        table.row([format!("`{name}`"), ranks, run.text()]);
    }
    table
}

/// In the order in which registers first appear.
fn runs(places: impl Iterator<Item = (String, usize, String)>) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (name, rank, path) in places {
        let path = Indexed::new(&path);
        match runs.iter_mut().rfind(|run| run.name == name) {
            Some(run) if run.goes_on(&name, rank, &path) => {
                run.last = rank;
                run.to = path.index;
            }
            _ => {
                let to = path.index;
                // Beside what the same register is in the ranks before.
                let place = runs.iter().rposition(|run| run.name == name);
                let place = place.map_or(runs.len(), |place| place + 1);
                runs.insert(place, Run { name, first: rank, last: rank, path, to });
            }
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_that_count_up_are_one_run() {
        let places = [(0, "a[0].q"), (1, "a[1].q"), (2, "b[2].q"), (4, "b[3].q"), (5, "c")];
        let places = places.map(|(rank, path)| ("r".to_owned(), rank, path.to_owned()));
        let texts: Vec<String> =
            runs(places.into_iter()).iter().map(|run| format!("{}-{} {}", run.first, run.last, run.text())).collect();
        assert_eq!(texts, ["0-1 `a[0 … 1].q`", "2-2 `b[2].q`", "4-4 `b[3].q`", "5-5 `c`"]);
    }
}
