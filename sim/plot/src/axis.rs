//! Axes: scale, range, and the words under the ticks.

use super::error::PlotError;

/// The least value a logarithmic axis shows; far below any error worth drawing.
pub(super) const LEAST_LOGARITHMIC: f64 = 1e-10;

/// How values are spread along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scale {
    /// Equal differences take equal lengths.
    #[default]
    Linear,
    /// Equal ratios take equal lengths; values are positive.
    Log,
}

/// One axis of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What is measured and in which unit: "error, %".
    pub label: String,
    /// How values are spread.
    pub scale: Scale,
    /// Lower and upper end; `None` for round numbers just outside the data.
    pub range: Option<(f64, f64)>,
}

impl Axis {
    /// A linear axis whose range follows from the data.
    #[must_use]
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Linear, range: None }
    }

    /// A logarithmic axis whose range follows from the data.
    #[must_use]
    pub fn log(label: impl Into<String>) -> Self {
        Self { scale: Scale::Log, ..Self::linear(label) }
    }

    /// The same axis from `low` to `high`.
    #[must_use]
    pub fn with_range(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }

    /// The ends of the axis for finite `values`, with `room` (a part of the length) to spare where
    /// the range follows from them: half a dot on the edge would be cut off.
    pub(super) fn bounds(&self, values: impl Iterator<Item = f64>, room: f64) -> Result<(f64, f64), PlotError> {
        let extent = |(low, high): (f64, f64), value: f64| (low.min(value), high.max(value));
        let data = values.fold((f64::INFINITY, f64::NEG_INFINITY), extent);
        if self.scale == Scale::Log {
            self.check_logarithmic(data.0)?;
        }
        let (low, high) = self.range.unwrap_or_else(|| match self.scale {
            Scale::Linear => {
                let (low, high) = widened(data);
                let spare = room * (high - low);
                round_outward((low - spare, high + spare))
            }
            Scale::Log => {
                let spare = (data.1 / data.0).powf(room);
                round_ratio_outward((data.0 / spare, data.1 * spare))
            }
        });
        if self.scale == Scale::Log {
            self.check_logarithmic(low)?;
        }
        // Ends that agree to 12 digits leave no room for ticks that differ.
        let apart = 1e-12 * low.abs().max(high.abs());
        if (high - low).is_finite() && high - low > apart {
            Ok((low, high))
        } else {
            Err(PlotError::Range { axis: self.label.clone(), low, high })
        }
    }

    fn check_logarithmic(&self, value: f64) -> Result<(), PlotError> {
        if value >= LEAST_LOGARITHMIC {
            return Ok(());
        }
        Err(PlotError::BelowLogarithmic { axis: self.label.clone(), value, least: LEAST_LOGARITHMIC })
    }

    /// Where a value lies between the ends: 0 at the low end, 1 at the high end.
    pub(super) fn fraction(&self, value: f64, (low, high): (f64, f64)) -> f64 {
        match self.scale {
            Scale::Linear => (value - low) / (high - low),
            Scale::Log => (value / low).ln() / (high / low).ln(),
        }
    }
}

/// A constant still needs an axis: half a unit, or a tenth of itself, either way.
fn widened((low, high): (f64, f64)) -> (f64, f64) {
    if high > low {
        return (low, high);
    }
    let margin = if low == 0.0 { 0.5 } else { 0.1 * low.abs() };
    (low - margin, high + margin)
}

/// The nearest multiples of a round step outside the data.
fn round_outward((low, high): (f64, f64)) -> (f64, f64) {
    let rough = (high - low) / 5.0;
    let decade = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|round| round * decade)
        .into_iter()
        .find(|step| *step >= rough * (1.0 - 1e-9))
        .unwrap_or(rough);
    // 1e-9 of a step: data that lies on a multiple but for its last bit stays there.
    let below = (low / step + 1e-9).floor() * step;
    let above = (high / step - 1e-9).ceil() * step;
    (below, above)
}

/// The nearest of 1, 2, 5 times a power of ten outside the data; the nearest power of ten where the
/// data spans so many that only those have a tick.
fn round_ratio_outward((low, high): (f64, f64)) -> (f64, f64) {
    let (first, last) = (low.log10().floor(), high.log10().ceil());
    if last - first > 3.0 {
        return (10_f64.powf(first), 10_f64.powf(last));
    }
    let rounds = |value: f64| {
        let decade = 10_f64.powf(value.log10().floor());
        [0.5, 1.0, 2.0, 5.0, 10.0, 20.0].map(|round| round * decade)
    };
    let below = rounds(low).into_iter().rfind(|round| *round <= low * (1.0 + 1e-9)).unwrap_or(low);
    let above =
        rounds(high).into_iter().find(|round| *round >= high * (1.0 - 1e-9) && *round > below * 1.5).unwrap_or(high);
    (below, above)
}

/// How the ticks of one axis are written: all as plain decimals where these are short, all as powers of ten elsewhere.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ticks {
    plain: bool,
}

impl Ticks {
    /// For an axis with these ends.
    pub(super) fn new(scale: Scale, (low, high): (f64, f64)) -> Self {
        // Ticks of a logarithmic axis stand closer, and most are powers of ten.
        let plain = match scale {
            Scale::Linear => 1e-3..1e6,
            Scale::Log => 1e-2..1e4,
        };
        let plain = |size: f64| size == 0.0 || plain.contains(&(size * (1.0 + 1e-9)));
        // The ticks of a linear axis are about a fifth of its length apart.
        let least = if scale == Scale::Log { low.abs() } else { (high - low) / 5.0 };
        Self { plain: plain(least) && plain(low.abs().max(high.abs())) }
    }

    /// The words under a tick.
    pub(super) fn label(self, value: f64) -> String {
        let size = value.abs();
        let text = match size {
            0.0 => "0".to_owned(),
            _ if self.plain => trimmed(format!("{size:.6}")),
            _ => power_of_ten(size),
        };
        let sign = if value < 0.0 { "−" } else { "" };
        format!("{sign}{text}")
    }
}

fn power_of_ten(size: f64) -> String {
    let scientific = format!("{size:.3e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let raised: String = exponent.chars().map(superscript).collect();
    match trimmed(digits.to_owned()).as_str() {
        "1" => format!("10{raised}"),
        digits => format!("{digits}·10{raised}"),
    }
}

fn trimmed(decimal: String) -> String {
    if !decimal.contains('.') {
        return decimal;
    }
    decimal.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn superscript(digit: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    match digit.to_digit(10) {
        Some(digit) => DIGITS[digit as usize],
        None => '⁻',
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_read_as_a_person_would_write_them() {
        let written = |scale, ends, ticks: &[f64]| {
            let axis = Ticks::new(scale, ends);
            ticks.iter().map(|&tick| axis.label(tick)).collect::<Vec<_>>()
        };
        assert_eq!(written(Scale::Linear, (-2.5, 5.0), &[0.0, 0.1 + 0.2, -2.5]), ["0", "0.3", "−2.5"]);
        assert_eq!(written(Scale::Linear, (0.0, 15e3), &[0.0, 15e3]), ["0", "15000"]);
        assert_eq!(written(Scale::Linear, (0.0, 2e6), &[0.0, 2e6]), ["0", "2·10⁶"]);
        assert_eq!(written(Scale::Linear, (0.0, 1e-3), &[1e-4, 1e-3]), ["10⁻⁴", "10⁻³"]);
        assert_eq!(written(Scale::Log, (0.01, 1e3), &[0.01, 200.0, 1000.0]), ["0.01", "200", "1000"]);
        // One notation for all: a power of ten beside decimals reads as something else.
        assert_eq!(written(Scale::Log, (1e-3, 10.0), &[1e-3, 0.1, 1.0, 10.0]), ["10⁻³", "10⁻¹", "10⁰", "10¹"]);
        assert_eq!(written(Scale::Log, (1.0, 10_f64.powf(4.0)), &[2.0, 10_f64.powf(4.0)]), ["2·10⁰", "10⁴"]);
    }

    #[test]
    fn ranges_are_round_and_hold_the_data() {
        let linear = |values: &[f64]| Axis::linear("y").bounds(values.iter().copied(), 0.0);
        assert_eq!(linear(&[0.0, 0.67]), Ok((0.0, 0.8)));
        assert_eq!(linear(&[0.0, 1.0]), Ok((0.0, 1.0)));
        let log = |values: &[f64]| Axis::log("y").bounds(values.iter().copied(), 0.0);
        assert_eq!(log(&[1.0, 256.0]), Ok((1.0, 500.0)));
        for constant in [0.0, 3.0, -1e9] {
            let (low, high) = linear(&[constant]).unwrap();
            assert!(low < constant && constant < high);
        }
        let (low, high) = log(&[0.06, 200.0]).unwrap();
        assert!((low - 0.01).abs() < 1e-12 && (high - 1000.0).abs() < 1e-9);
        let (low, high) = log(&[5.0]).unwrap();
        assert!(low <= 5.0 && 5.0 < high);
    }

    #[test]
    fn ranges_that_are_none_are_refused() {
        for (low, high) in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            let axis = Axis::linear("y").with_range(low, high);
            assert!(matches!(axis.bounds([1.0].into_iter(), 0.0), Err(PlotError::Range { .. })));
        }
        for value in [0.0, -1.0] {
            let refused = Axis::log("y").bounds([value, 1.0].into_iter(), 0.0);
            assert!(matches!(refused, Err(PlotError::BelowLogarithmic { .. })));
        }
        let refused = Axis::log("y").with_range(0.0, 2.0).bounds([1.0].into_iter(), 0.0);
        assert!(matches!(refused, Err(PlotError::BelowLogarithmic { .. })));
    }
}
