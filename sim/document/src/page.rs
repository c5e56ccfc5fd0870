//! The page of one configuration, and the page that says what all have in common.

use askama::Template;
use hw_model::datapath::{Datapath, Status};
use hw_model::design::Design;
use hw_model::pipelining::LineStep;
use hw_model::registers::Register;
use hw_model::rtl::SOURCES;

use super::facts::Facts;
use super::scenario::Scenario;
use super::table::Table;
use super::words::places;
use super::{clock, control, examples, flip_flops, lines, paths, ports, registers};

#[derive(Template)]
#[template(path = "hardware.md", escape = "none")]
struct Page<'a> {
    command: &'a str,
    design: &'a Design,
    datapath: &'a Datapath,
    name: &'a str,
    source: &'a str,
    ports: Table,
    status: Table,
    rom: Table,
    rom_words: Table,
    registers: Table,
    ranks: Table,
    paths: Table,
    regions: Table,
    lines: Table,
    variable: String,
    bound: String,
    budget: String,
    scenarios: &'a [Scenario],
    requests: Table,
    passages: Table,
    differences: Vec<String>,
    estimates: Table,
}

/// The page of a configuration. `source` is the option that chooses it.
pub(super) fn page(
    design: &Design,
    scenarios: &[Scenario],
    command: &str,
    source: &str,
) -> Result<String, askama::Error> {
    let datapath = design.datapath();
    let facts = Facts::new(design);
    // The run with a request of each kind and no more.
    let first = &scenarios[0];
    let page = Page {
        command,
        design,
        datapath,
        name: &design.config().name,
        source,
        ports: ports::ports(datapath),
        status: ports::status(design),
        rom: ports::rom(design),
        rom_words: ports::words(design),
        registers: registers::registers(&facts),
        ranks: flip_flops::ranks(datapath),
        paths: paths::paths(datapath),
        regions: lines::regions(datapath),
        lines: lines::lines(datapath),
        variable: lines::variable(datapath),
        bound: places(bound(design), 4),
        budget: places(design.config().error_budget_ulp, 6),
        scenarios,
        requests: examples::requests(design, first),
        passages: examples::passages(datapath, first),
        differences: control::differences(datapath),
        estimates: clock::estimates(datapath),
    };
    Ok(page.render()? + "\n")
}

/// The bound of the error of coefficients and data path over all rows, in output ulp.
pub(super) fn bound(design: &Design) -> f64 {
    design.bounds().iter().fold(0.0, |most, bound| bound.total().max(most))
}

impl Page<'_> {
    fn front_end_ranks(&self) -> String {
        let (compare, choose) = (self.datapath.rank_of(Register::Region), self.datapath.rank_of(Register::V));
        if compare == choose {
            return format!("rank {choose}");
        }
        format!("ranks {compare} and {choose}: the comparisons, and behind them the choice of the variable")
    }

    /// Where the dividend is taken in, as wide as the other labels beside it.
    fn dividend_rank(&self) -> String {
        format!("{:<12}", format!("rank {}", self.datapath.rank_of(Register::Divisor)))
    }

    /// What the ranks of a multiply-add take in.
    fn line_ranks(&self) -> String {
        let pipelining = self.datapath.pipelining();
        let step = |index| match pipelining.line_step(index) {
            LineStep::Operands => "copies of the operands",
            LineStep::Partial => "products of pieces of the operands",
            LineStep::Product => "the product",
            LineStep::Sum => "the sum, not rounded yet",
            LineStep::Result => "the result",
        };
        let steps: Vec<&str> = (0..pipelining.line_ranks()).map(step).collect();
        format!("Ranks of each multiply-add, one after the other: {}.", steps.join("; "))
    }

    fn digits_of(&self) -> String {
        let Some(divider) = self.datapath.divider() else { return String::new() };
        let (all, each) = (divider.digit_count, divider.digits_per_stage);
        let last = all - (divider.digit_stages() - 1) * each;
        if last == each {
            format!("{each} in each of {} ranks", divider.digit_stages())
        } else {
            format!("{each} in each of {} ranks and {last} in one more", divider.digit_stages() - 1)
        }
    }
}

/// One line of the list of pages.
pub(super) struct Entry {
    /// The name of the configuration, and of its page.
    pub(super) name: String,
    /// The description that the configuration has of itself.
    pub(super) description: String,
    /// Its latency in clock cycles.
    pub(super) latency: usize,
}

#[derive(Template)]
#[template(path = "hardware_common.md", escape = "none")]
struct Common<'a> {
    command: &'a str,
    pages: &'a [Entry],
    sources: Vec<&'static str>,
    status_width: u32,
}

/// Bits of the status of a configuration without a domain, which all that are documented are.
const STATUS_WIDTH: u32 = Status::NAMES.len() as u32 - 1;

/// What every configuration has in common, and where their pages are.
pub(super) fn common(pages: &[Entry], command: &str) -> Result<String, askama::Error> {
    let sources = SOURCES.iter().map(|&(name, _)| name).collect();
    let page = Common { command, pages, sources, status_width: STATUS_WIDTH };
    Ok(page.render()? + "\n")
}
