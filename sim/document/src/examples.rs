//! Requests followed through every rank.

use hw_model::datapath::Datapath;
use hw_model::design::Design;

use super::scenario::{Request, Scenario, name};
use super::table::Table;
use super::words::{literal, value};

/// The requests of a run and their results.
pub(super) fn requests(design: &Design, scenario: &Scenario) -> Table {
    let formats = design.datapath().formats();
    let columns = ["request", "address_i", "n", "x_i", "x", "region", "intensity_o", "intensity", "flags"];
    let mut table = Table::new(&columns);
    for (index, request) in scenario.requests.iter().enumerate() {
        let row = design.rows().get(request.address as usize);
        let exponent = row.map_or_else(|| "no word".to_owned(), |row| row.exponent.to_string());
        let result = &request.result;
        table.row([
            name(index),
            request.address.to_string(),
            exponent,
            format!("`{}`", literal(request.x, formats.input)),
            value(request.x, formats.input),
            result.region.name().to_owned(),
            format!("`{}`", literal(result.intensity, formats.output)),
            value(result.intensity, formats.output),
            result.status.to_string(),
        ]);
    }
    table
}

/// Every computed register of two requests, rank by rank.
pub(super) fn passages(datapath: &Datapath, scenario: &Scenario) -> Table {
    let mut table = Table::new(&["rank", "register", "A, bits", "A", "C, bits", "C"]);
    let (Some(a), Some(c)) = (scenario.requests.first(), scenario.requests.get(2)) else {
        return table;
    };
    let pass = |request: &Request| datapath.passage(request.address, request.x);
    let passages = [pass(a), pass(c)];
    for rank in 0..datapath.rank_count() {
        for register in datapath.registers(rank) {
            if !register.computed {
                continue;
            }
            let [a, c] = [&passages[0], &passages[1]].map(|passage| register.bits(&passage[rank]));
            let shown = |bits| format!("`{}`", literal(bits, register.format));
            table.row([
                format!("{rank}, {}", datapath.rank_name(rank)),
                format!("`{}`", register.name()),
                shown(a),
                value(a, register.format),
                shown(c),
                value(c, register.format),
            ]);
        }
    }
    table
}
