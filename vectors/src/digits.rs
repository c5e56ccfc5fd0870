//! Real numbers for people: as many digits as say something.

/// A number with this many significant digits, without trailing zeros: plain where that is short,
/// else with an exponent.
#[must_use]
pub fn digits(value: f64, significant: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let scientific = format!("{value:.*e}", significant - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let power: i32 = exponent.parse().unwrap_or(0);
    let trim = |text: &str| {
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text.to_owned() }
    };
    if (-4..significant as i32).contains(&power) {
        let decimals = (significant as i32 - 1 - power).max(0) as usize;
        return trim(&format!("{value:.decimals$}"));
    }
    format!("{}e{power}", trim(mantissa))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn digits_are_short_where_they_can_be() {
        let shown = [
            (0.0, "0"),
            (1.0, "1"),
            (0.5, "0.5"),
            (256.0, "256"),
            (1e9, "1000000000"),
            (1e20, "1e20"),
            (-1273.8121570995304, "-1273.8121570995304"),
            (0.1, "0.10000000000000001"),
            (1.5e-7, "1.4999999999999999e-7"),
        ];
        for (value, text) in shown {
            assert_eq!(digits(value, 17), text);
        }
        assert_eq!(digits(0.005065107904901528, 6), "0.00506511");
        assert_eq!(digits(999_999.7, 6), "1e6");
    }

    proptest! {
        #[test]
        fn seventeen_digits_come_back(bits in any::<u64>()) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            prop_assert_eq!(digits(value, 17).parse::<f64>().unwrap(), value);
        }
    }
}
