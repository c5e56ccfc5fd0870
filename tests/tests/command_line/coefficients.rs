//! `blysk coefficients`: every digit of what the model fits.

use blysk_tests::bench;
use blysk_tests::cli::{csv_rows, number};
use hw_model::fit::{Levels, Method, fit};

const COLUMNS: &str = "method,n,a,b,c,d,k1,k2,k3";

#[test]
fn seventeen_digits_give_the_same_number() {
    let bench = bench!();
    let mut compared = 0;
    for (method, q, g) in
        [("hermite", 0.5, 1.0 / 18.0), ("three_point", 0.6, 0.1), ("tangent", 0.4, 0.05), ("quadratic", 0.5, 0.01)]
    {
        for (list, exponents) in [("1..=4", vec![1.0, 2.0, 3.0, 4.0]), ("2.5,1e6", vec![2.5, 1e6])] {
            let text =
                bench.good(&format!("coefficients --method {method} --exponents {list} --q {q} --g {g} --format csv"));
            assert_eq!(text.lines().next(), Some(COLUMNS));
            let rows = csv_rows(&text);
            assert_eq!(rows.len(), exponents.len(), "{text}");
            for (row, n) in rows.iter().zip(exponents) {
                let wanted = fit(method.parse().unwrap(), n, Levels::new(q, g).unwrap()).unwrap();
                let cubic = wanted.cubic().unwrap();
                let (power, k) = (&cubic.power, &cubic.centred);
                assert_eq!(row["method"], method);
                let all = [n, power.a, power.b, power.c, power.d, k.k1, k.k2, k.k3];
                for (column, wanted) in COLUMNS.split(',').skip(1).zip(all) {
                    assert_eq!(number(row, column), wanted, "{method} n = {n}: {column}");
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 4 * 6 * 8);
}

#[test]
fn a_ratio_has_its_two_under_a_and_b() {
    let bench = bench!();
    for method in ["rational", "schlick"] {
        let text = bench.good(&format!("coefficients --method {method} --exponents 1.5,64,1e15 --format csv"));
        let rows = csv_rows(&text);
        assert_eq!(rows.len(), 3);
        for row in rows {
            let n = number(&row, "n");
            let wanted = fit(method.parse().unwrap(), n, Levels::default()).unwrap();
            let ratio = wanted.rational().unwrap();
            assert_eq!((number(&row, "a"), number(&row, "b")), (ratio.a, ratio.b), "{row:?}");
            for column in ["c", "d", "k1", "k2", "k3"] {
                assert_eq!(row[column], "", "{method}: {column}");
            }
        }
    }
}

/// The composite is two lines for each exponent, each named after what it is.
#[test]
fn the_composite_is_its_two_parts() {
    let bench = bench!();
    let of = |method: &str| bench.good(&format!("coefficients --method {method} --exponents 3,64 --format csv"));
    let (composite, hermite, rational) = (of("composite"), of("hermite"), of("rational"));
    let lines = |text: &str| text.lines().skip(1).map(str::to_owned).collect::<Vec<_>>();
    let (hermite, rational) = (lines(&hermite), lines(&rational));
    let wanted: Vec<String> = hermite.into_iter().zip(rational).flat_map(|(h, r)| [h, r]).collect();
    assert_eq!(lines(&composite), wanted);
}

#[test]
fn json_and_csv_say_the_same() {
    let bench = bench!();
    let print =
        |format: &str| bench.good(&format!("coefficients --method schlick --exponents 2.5,64 --format {format}"));
    let json: Vec<serde_json::Value> = serde_json::from_str(&print("json")).unwrap();
    let csv = csv_rows(&print("csv"));
    assert_eq!((json.len(), csv.len()), (2, 2));
    for (json, csv) in json.iter().zip(&csv) {
        let keys: Vec<&String> = json.as_object().unwrap().keys().collect();
        assert_eq!(keys.len(), 9, "{keys:?}");
        assert_eq!(json["method"], "schlick");
        assert!(json["k1"].is_null());
        for column in ["n", "a", "b"] {
            assert_eq!(json[column].as_f64().unwrap(), number(csv, column));
        }
    }
}

/// n names the row: two exponents never look the same, whatever the digits of the coefficients.
#[test]
fn the_table_has_every_digit_of_n() {
    let bench = bench!();
    let list = "2.123456789,100001,1000001.5,1e9,1e15";
    let table = bench.good(&format!("coefficients --method tangent --exponents {list}"));
    let shown: Vec<&str> = table.lines().skip(1).map(|line| line.split_whitespace().nth(1).unwrap()).collect();
    assert_eq!(shown.join(","), list, "{table}");
}

/// The table for people says the same, in five digits.
#[test]
fn the_table_has_five_digits() {
    let bench = bench!();
    let table = bench.good("coefficients --method hermite --exponents 64");
    let cubic = *fit(Method::Hermite, 64.0, Levels::default()).unwrap().cubic().unwrap();
    let cells: Vec<&str> = table.lines().last().unwrap().split_whitespace().collect();
    assert_eq!((cells[0], cells[1], cells.len()), ("hermite", "64", 9), "{table}");
    for (cell, wanted) in cells[2..5].iter().zip([cubic.power.a, cubic.power.b, cubic.power.c]) {
        let shown: f64 = cell.parse().unwrap();
        assert!((shown / wanted - 1.0).abs() < 1e-4, "{shown} for {wanted}");
    }
}
