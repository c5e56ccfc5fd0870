//! A section: a heading of the second level, and what stands below it.

use plot::Chart;

use super::error::PageError;
use super::figure;
use super::table::Table;

/// A piece of a section.
#[derive(Debug, Clone)]
pub(super) enum Block {
    /// A paragraph.
    Text(String),
    /// Lines that keep their breaks and spaces: what a terminal shows.
    Lines(String),
    /// A table.
    Table(Table),
    /// A plot.
    Plot {
        /// What it shows.
        title: String,
        /// The conditions under which that was measured.
        subtitle: String,
        /// What the script draws, as JSON.
        data: String,
    },
    /// Markup of the program's own.
    Markup(String),
}

/// A part of a page, with a heading that the navigation leads to.
#[derive(Debug, Clone)]
pub struct Section {
    pub(super) title: String,
    pub(super) id: String,
    pub(super) blocks: Vec<Block>,
}

impl Section {
    /// An empty section with this heading.
    #[must_use]
    pub fn new(title: impl Into<String>) -> Self {
        let title = title.into();
        let id = slug(&title);
        Self { title, id, blocks: Vec::new() }
    }

    /// The same with a paragraph at its end.
    #[must_use]
    pub fn text(self, text: impl Into<String>) -> Self {
        self.block(Block::Text(text.into()))
    }

    /// The same with lines that keep their breaks and spaces.
    #[must_use]
    pub fn lines(self, lines: impl Into<String>) -> Self {
        self.block(Block::Lines(lines.into()))
    }

    /// The same with a table.
    #[must_use]
    pub fn table(self, table: Table) -> Self {
        self.block(Block::Table(table))
    }

    /// The same with a plot of this chart: the same points as in its picture.
    ///
    /// # Errors
    /// When the chart does not become JSON.
    pub fn plot(self, chart: &Chart) -> Result<Self, PageError> {
        let (title, subtitle) = (chart.title.clone(), chart.subtitle.clone().unwrap_or_default());
        Ok(self.block(Block::Plot { title, subtitle, data: figure::data(chart)? }))
    }

    /// The same with a piece of HTML that the program itself wrote: it is not escaped.
    #[must_use]
    pub fn markup(self, html: impl Into<String>) -> Self {
        self.block(Block::Markup(html.into()))
    }

    fn block(mut self, block: Block) -> Self {
        self.blocks.push(block);
        self
    }

    pub(super) fn has_plot(&self) -> bool {
        self.blocks.iter().any(|block| matches!(block, Block::Plot { .. }))
    }

    /// Makes the id different from those of the sections before it, as renderers of Markdown do: `-1`, `-2`.
    pub(super) fn number_from(&mut self, before: &[Self]) {
        let base = self.id.clone();
        let mut count = 0;
        while before.iter().any(|section| section.id == self.id) {
            count += 1;
            self.id = format!("{base}-{count}");
        }
    }
}

/// The id of a heading, as renderers of Markdown make it: lower case, hyphens for spaces, no punctuation.
pub(super) fn slug(title: &str) -> String {
    let kept = |c: char| match c {
        ' ' => Some('-'),
        '-' | '_' => Some(c),
        c if c.is_alphanumeric() => Some(c.to_ascii_lowercase()),
        _ => None,
    };
    title.chars().filter_map(kept).collect()
}
