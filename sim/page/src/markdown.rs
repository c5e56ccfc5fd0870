//! Pages from Markdown: headings become sections, tables become tables that can be sorted, the rest is markup.

use pulldown_cmark::{CowStr, Event, HeadingLevel, Options, Parser, Tag, TagEnd, html};

use super::section::{Section, slug};
use super::table::{Cell, Table};

/// Where a link of the text leads in the page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Link {
    /// To this address: `#registers`, `compact.html`.
    To(String),
    /// Nowhere: its words stand without a link.
    Nowhere,
}

/// What the text has, as parts of a page.
#[derive(Debug, Clone, Default)]
pub struct Text {
    /// The heading of the first level.
    pub title: String,
    /// A section for each heading of the second level; the first has what stands before them.
    pub sections: Vec<Section>,
}

/// Reads Markdown (CommonMark with tables). `link` says where an address leads, `picture` gives the markup of a picture
/// by its address, where there is one. `first` is the heading of what stands above the first heading.
#[must_use]
pub fn read(text: &str, first: &str, link: &dyn Fn(&str) -> Link, picture: &dyn Fn(&str) -> Option<String>) -> Text {
    let mut reader = Reader { link, picture, text: Text::default(), open: Section::new(first), pending: Vec::new() };
    let mut events = Parser::new_ext(text, Options::ENABLE_TABLES);
    while let Some(event) = events.next() {
        reader.event(event, &mut events);
    }
    reader.finish()
}

struct Reader<'a> {
    link: &'a dyn Fn(&str) -> Link,
    picture: &'a dyn Fn(&str) -> Option<String>,
    text: Text,
    /// The section under way.
    open: Section,
    /// What has come since its last table.
    pending: Vec<Event<'a>>,
}

impl<'a> Reader<'a> {
    fn event(&mut self, event: Event<'a>, events: &mut Parser<'a>) {
        match event {
            Event::Start(Tag::Heading { level, .. }) => self.heading(level, events),
            Event::Start(Tag::Table(_)) => {
                let table = self.table(events);
                self.flush();
                self.open = std::mem::replace(&mut self.open, Section::new("")).table(table);
            }
            event => {
                let changed = self.changed(event, events);
                self.pending.extend(changed);
            }
        }
    }

    /// A link, a picture or a piece of markup, as the page has it; anything else as it is.
    fn changed(&self, event: Event<'a>, events: &mut Parser<'a>) -> Vec<Event<'a>> {
        match event {
            // Comments of generated files.
            Event::Html(_) | Event::InlineHtml(_) => Vec::new(),
            Event::Start(Tag::Image { dest_url, .. }) => {
                let (_, words) = inside(events, TagEnd::Image);
                let markup = (self.picture)(&dest_url).unwrap_or(words);
                vec![Event::InlineHtml(CowStr::from(markup))]
            }
            Event::Start(Tag::Link { dest_url, .. }) => {
                let (content, _) = inside(events, TagEnd::Link);
                match (self.link)(&dest_url) {
                    Link::Nowhere => content,
                    Link::To(address) => {
                        let mut markup = String::new();
                        html::push_html(&mut markup, content.into_iter());
                        let address = escaped(&address);
                        vec![Event::InlineHtml(CowStr::from(format!("<a href=\"{address}\">{markup}</a>")))]
                    }
                }
            }
            event => vec![event],
        }
    }

    fn heading(&mut self, level: HeadingLevel, events: &mut Parser<'a>) {
        let (content, words) = inside(events, TagEnd::Heading(level));
        match level {
            HeadingLevel::H1 => self.text.title = words,
            HeadingLevel::H2 => {
                self.flush();
                let before = std::mem::replace(&mut self.open, Section::new(words));
                self.text.sections.push(before);
            }
            level => {
                let mut markup = String::new();
                html::push_html(&mut markup, content.into_iter());
                let heading = format!("<{level} id=\"{}\">{markup}</{level}>\n", escaped(&slug(&words)));
                self.pending.push(Event::Html(CowStr::from(heading)));
            }
        }
    }

    fn table(&self, events: &mut Parser<'a>) -> Table {
        let (mut rows, mut row, mut cell) = (Vec::new(), Vec::new(), Vec::new());
        while let Some(event) = events.next() {
            match event {
                Event::End(TagEnd::Table) => break,
                Event::End(TagEnd::TableCell) => row.push(cell_of(std::mem::take(&mut cell))),
                Event::End(TagEnd::TableRow | TagEnd::TableHead) => rows.push(std::mem::take(&mut row)),
                Event::Start(Tag::TableHead | Tag::TableRow | Tag::TableCell) => {}
                event => cell.extend(self.changed(event, events)),
            }
        }
        let mut rows = rows.into_iter();
        let mut table = Table::new("", &rows.next().unwrap_or_default());
        rows.for_each(|row| table.row(row));
        table
    }

    /// What has come becomes markup of the section under way.
    fn flush(&mut self) {
        let mut markup = String::new();
        html::push_html(&mut markup, std::mem::take(&mut self.pending).into_iter());
        if !markup.trim().is_empty() {
            let markup = markup.replace("<pre>", "<pre tabindex=\"0\">");
            self.open = std::mem::replace(&mut self.open, Section::new("")).markup(markup);
        }
    }

    fn finish(mut self) -> Text {
        self.flush();
        self.text.sections.push(self.open);
        self.text.sections.retain(|section| !section.blocks.is_empty());
        self.text
    }
}

/// What stands before the end of a tag, and its words alone.
fn inside<'a>(events: &mut Parser<'a>, end: TagEnd) -> (Vec<Event<'a>>, String) {
    let content: Vec<Event<'a>> = events.take_while(|event| *event != Event::End(end)).collect();
    let words = |event: &Event<'a>| match event {
        Event::Text(text) | Event::Code(text) => text.to_string(),
        Event::SoftBreak => " ".to_owned(),
        _ => String::new(),
    };
    let text = content.iter().map(words).collect();
    (content, text)
}

/// A cell of plain text as text, so that numbers are known as such; one with markup as markup.
fn cell_of(content: Vec<Event<'_>>) -> Cell {
    if content.iter().all(|event| matches!(event, Event::Text(_))) {
        let words = content.iter().map(|event| if let Event::Text(text) = event { text } else { "" });
        return Cell::Text(words.collect());
    }
    let mut markup = String::new();
    html::push_html(&mut markup, content.into_iter());
    Cell::Markup(markup)
}

/// Text for an attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Page;

    #[test]
    fn headings_tables_links_and_pictures_find_their_place() {
        let text = "<!-- made -->\n\n# Hardware: `a`\n\nOne [page](b.md#x) and [another](c.md).\n\n![d](d.svg)\n\n\
                    ## Registers\n\n| register | n |\n|---|---|\n| `t3` | 4 |\n\n### More\n\na < b\n";
        let link = |to: &str| if to == "c.md" { Link::Nowhere } else { Link::To("#x".to_owned()) };
        let read = read(text, "Overview", &link, &|name| (name == "d.svg").then(|| "<svg></svg>".to_owned()));
        assert_eq!(read.title, "Hardware: a");
        let mut page = Page::new(read.title, "");
        read.sections.into_iter().for_each(|section| page.section(section));
        let html = page.to_html().unwrap();
        for part in [
            "<h2 id=\"overview\">Overview</h2>",
            "<p>One <a href=\"#x\">page</a> and another.</p>",
            "<p><svg></svg></p>",
            "<h2 id=\"registers\">Registers</h2>",
            "<td><code>t3</code></td><td class=\"number\">4</td>",
            "<h3 id=\"more\">More</h3>\n<p>a &lt; b</p>",
        ] {
            assert!(html.contains(part), "{part} in {html}");
        }
        assert!(!html.contains("made"), "comments are left out");
    }
}
