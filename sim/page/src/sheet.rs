//! A page: its head, its verdict, its sections.

use askama::Template;

use super::assets;
use super::error::PageError;
use super::section::{Block, Section};
use super::table::Cell;

/// What a verdict says of its subject; it sets the colour and the sign beside the words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// What was checked holds.
    Good,
    /// What was checked does not hold.
    Bad,
    /// Nothing was checked: the page only tells.
    Plain,
}

impl Standing {
    const fn class(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Bad => "bad",
            Self::Plain => "plain",
        }
    }

    const fn sign(self) -> &'static str {
        match self {
            Self::Good => "✓",
            Self::Bad => "✗",
            Self::Plain => "i",
        }
    }
}

/// What a reader is told first: a sentence, and points below it.
#[derive(Debug, Clone)]
pub struct Verdict {
    standing: Standing,
    words: String,
    points: Vec<(String, String)>,
}

impl Verdict {
    /// A verdict of one sentence.
    #[must_use]
    pub fn new(standing: Standing, words: impl Into<String>) -> Self {
        Self { standing, words: words.into(), points: Vec::new() }
    }

    /// The same with a figure below the sentence: what it is, and its value with its unit.
    #[must_use]
    pub fn point(mut self, name: impl Into<String>, value: impl Into<String>) -> Self {
        self.points.push((name.into(), value.into()));
        self
    }
}

/// A page of HTML.
#[derive(Debug, Clone)]
pub struct Page {
    title: String,
    command: String,
    lead: Vec<String>,
    verdict: Option<Verdict>,
    sections: Vec<Section>,
    scripts: Vec<String>,
    live: bool,
}

impl Page {
    /// A page with this title, made by this command. An empty command is not shown.
    #[must_use]
    pub fn new(title: impl Into<String>, command: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            command: command.into(),
            lead: Vec::new(),
            verdict: None,
            sections: Vec::new(),
            scripts: Vec::new(),
            live: false,
        }
    }

    /// Adds a paragraph below the title.
    pub fn lead(&mut self, text: impl Into<String>) {
        self.lead.push(text.into());
    }

    /// Sets what a reader is told first.
    pub fn verdict(&mut self, verdict: Verdict) {
        self.verdict = Some(verdict);
    }

    /// Adds a section at the end. The id of its heading is made different from those before it.
    pub fn section(&mut self, mut section: Section) {
        section.number_from(&self.sections);
        self.sections.push(section);
    }

    /// Adds a script behind those of tables, plots and diagrams. It is the program's own, and is not escaped.
    pub fn script(&mut self, script: impl Into<String>) {
        self.scripts.push(script.into());
    }

    /// Lets the page ask the server that it comes from. Without this its policy forbids every request.
    pub const fn live(&mut self) {
        self.live = true;
    }

    /// The page as text.
    ///
    /// # Errors
    /// When the template is not filled in.
    pub fn to_html(&self) -> Result<String, PageError> {
        let plots = self.live || self.sections.iter().any(Section::has_plot);
        let mut text = Sheet { page: self, plots }.render()?;
        text.push('\n');
        Ok(text)
    }
}

/// The template, with what it shows.
#[derive(Template)]
#[template(path = "page.html")]
struct Sheet<'a> {
    page: &'a Page,
    /// Whether the page needs the plotting library.
    plots: bool,
}
