//! From a chart to SVG: with `legend.rs` and `spots.rs` the only file that knows the plotting crate.

use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::plot::{LegendEntry, LegendPosition, LinePlot, LineStyle, ScatterPlot};
use kuva::render::annotations::ReferenceLine as DrawnLine;
use kuva::render::layout::{ComputedLayout, Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;
use kuva::render::render_utils::generate_ticks_log;

use super::axis::{Scale, Ticks};
use super::chart::{Bounds, Chart, Mark, Series};
use super::error::PlotError;
use super::legend::{entry, plain, rule_entry};
use super::reference::fits_on_line;
use super::{spots, style, words};

impl Chart {
    /// The chart as SVG text. The same chart gives the same text.
    ///
    /// # Errors
    /// When there is nothing to draw, a coordinate is not finite, or an axis cannot show it.
    pub fn to_svg(&self) -> Result<String, PlotError> {
        self.check_points()?;
        let bounds = self.bounds()?;
        Ok(svg(self, bounds))
    }
}

/// Draws a chart whose points were checked and whose axes have these ends.
fn svg(chart: &Chart, bounds: Bounds) -> String {
    let plots: Vec<Plot> = chart.series.iter().enumerate().flat_map(drawn).collect();
    let named = |(index, series)| entry(chart, index, series);
    let mut entries: Vec<LegendEntry> = chart.series.iter().enumerate().flat_map(named).collect();
    entries.extend(spots::entries(chart));
    let mut layout = labels(chart, axes(chart, bounds, Layout::auto_from_plots(&plots)));
    for line in &chart.reference_lines {
        let mut rule = DrawnLine::horizontal(line.value)
            .with_color(style::REFERENCE_COLOUR)
            .with_dasharray(style::REFERENCE_DASHES);
        if fits_on_line(chart, bounds, line) {
            rule = rule.with_label(plain(&line.label));
        } else {
            entries.extend(rule_entry(chart, &line.label));
        }
        layout = layout.with_reference_line(rule);
    }
    let layout = fitted(chart, legend(layout, entries));
    let computed = ComputedLayout::from_layout(&layout);
    let mut scene = render_multiple(plots, layout);
    spots::draw(chart, &computed, &mut scene);
    scene.height = (scene.height - style::FOOT).ceil();
    let view = format!("<svg viewBox=\"0 0 {} {}\" ", scene.width, scene.height);
    // The backend leaves out the view box, without which a page cannot resize the picture.
    let svg = SvgBackend::new().with_pretty(true).render_scene(&scene);
    steady_identifier(&svg.replacen("<svg ", &view, 1))
}

fn axes(chart: &Chart, bounds: Bounds, layout: Layout) -> Layout {
    let layout = layout
        .with_width(style::size(chart.size).0)
        .with_font_family(style::FONT_FAMILY)
        .with_tick_size(style::SMALL_SIZE)
        .with_body_size(style::SMALL_SIZE)
        .with_grid_line_width(0.7)
        .with_x_tick_format(ticks(chart.x_axis.scale, bounds.x))
        .with_y_tick_format(ticks(chart.y_axis.scale, bounds.y))
        .with_x_axis_min(bounds.x.0)
        .with_x_axis_max(bounds.x.1)
        .with_y_axis_min(bounds.y.0)
        .with_y_axis_max(bounds.y.1);
    let layout = match chart.x_axis.scale {
        Scale::Linear => layout,
        Scale::Log => layout.with_log_x(),
    };
    match chart.y_axis.scale {
        Scale::Linear => layout,
        Scale::Log => layout.with_log_y(),
    }
}

fn labels(chart: &Chart, layout: Layout) -> Layout {
    let (wide, high) = (style::text_width(chart.size), style::size(chart.size).1);
    let layout = layout
        .with_title(broken(&chart.title, style::TITLE_SIZE, wide))
        .with_title_size(style::TITLE_SIZE)
        .with_label_size(style::LABEL_SIZE)
        .with_x_label(broken(&chart.x_axis.label, style::LABEL_SIZE, wide))
        .with_x_label_offset(0.0, -4.0)
        .with_y_label(broken(&chart.y_axis.label, style::LABEL_SIZE, high))
        .with_wrap(usize::MAX);
    match &chart.subtitle {
        None => layout,
        Some(subtitle) => {
            layout.with_subtitle(broken(subtitle, style::SMALL_SIZE, wide)).with_subtitle_size(style::SMALL_SIZE)
        }
    }
}

fn ticks(scale: Scale, ends: (f64, f64)) -> TickFormat {
    let ticks = Ticks::new(scale, ends);
    TickFormat::Custom(Arc::new(move |value| ticks.label(value)))
}

/// Below the axes, where it covers no curve however many there are.
fn legend(layout: Layout, entries: Vec<LegendEntry>) -> Layout {
    layout
        .with_legend_entries(entries)
        .with_legend_position(LegendPosition::OutsideBottomColumns)
        .with_legend_box(false)
}

/// The layout with the height that leaves the drawing area its own: lines of text add to the
/// picture and take nothing from the curves.
fn fitted(chart: &Chart, layout: Layout) -> Layout {
    let height = style::size(chart.size).1;
    let trial = 2.0 * height;
    let layout = layout.with_height(trial);
    let computed = ComputedLayout::from_layout(&layout);
    let area = computed.plot_height();
    let layout = layout.with_height(trial - area + height);
    // The backend leaves room for its own words at logarithmic ticks, which are shorter than ours.
    let lacking = widest_tick(chart, &computed) - computed.y_tick_label_px;
    if chart.y_axis.scale == Scale::Linear || lacking <= 0.0 {
        return layout;
    }
    layout.with_force_margins(computed.margin_left + lacking, computed.margin_right).with_y_label_offset(-lacking, 0.0)
}

fn widest_tick(chart: &Chart, computed: &ComputedLayout) -> f64 {
    let ticks = generate_ticks_log(computed.y_range.0, computed.y_range.1);
    let words = Ticks::new(chart.y_axis.scale, computed.y_range);
    let width = |tick| words::width(&words.label(tick), style::SMALL_SIZE);
    ticks.into_iter().map(width).fold(0.0, f64::max)
}

fn drawn((index, series): (usize, &Series)) -> Vec<Plot> {
    let points = series.points.iter().copied();
    let mark = series.visible_mark();
    let colour = style::colour_of(series.colour.unwrap_or(index), mark);
    let dots = || ScatterPlot::new().with_data(series.points.iter().copied()).with_color(colour).with_size(2.5).into();
    if mark == Mark::Points {
        return vec![dots()];
    }
    let stroke = match style::dashes(mark) {
        Some(dashes) => LineStyle::Custom(dashes.to_owned()),
        None => LineStyle::Solid,
    };
    let line = LinePlot::new()
        .with_data(points)
        .with_color(colour)
        .with_stroke_width(style::stroke_width(mark))
        .with_line_style(stroke)
        .into();
    if series.dots { vec![line, dots()] } else { vec![line] }
}

/// Text broken to a length. The backend breaks it at these ends of line and nowhere else.
fn broken(text: &str, size: u32, length: f64) -> String {
    words::lines(&plain(text), size, length).join("\n")
}

/// Names the clip path after the picture's own content. The backend numbers its clip paths through
/// the life of the process: the same chart would differ from one call to the next. A fixed name
/// would make pictures that share a page clip one another.
fn steady_identifier(svg: &str) -> String {
    const MARK: &str = "kuva-clip-";
    let Some((_, after)) = svg.split_once(&format!("<clipPath id=\"{MARK}")) else {
        return svg.to_owned();
    };
    let number: String = after.chars().take_while(char::is_ascii_digit).collect();
    let renamed = |name: &str| {
        svg.replace(&format!("id=\"{MARK}{number}\""), &format!("id=\"{name}\""))
            .replace(&format!("url(#{MARK}{number})"), &format!("url(#{name})"))
    };
    let digest = renamed("").bytes().fold(FNV_OFFSET, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(FNV_PRIME));
    renamed(&format!("area-{digest:016x}"))
}

// FNV-1a: a name, not a proof of anything.
const FNV_OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0000_0100_0000_01b3;
