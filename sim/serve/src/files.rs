//! The page: the files that it is made of, compiled in.

use axum::http::header;
use axum::response::{IntoResponse, Response};
use page::assets;

/// A file of the page: its path, its kind, its bytes.
pub(crate) struct Asset {
    /// The path in an address.
    pub(crate) path: &'static str,
    kind: &'static str,
    text: &'static str,
}

macro_rules! asset {
    ($path:literal, $kind:expr, $file:literal) => {
        Asset { path: $path, kind: $kind, text: include_str!(concat!("../assets/", $file)) }
    };
}

/// A file that other pages have too.
const fn shared(path: &'static str, kind: &'static str, text: &'static str) -> Asset {
    Asset { path, kind, text }
}

const HTML: &str = "text/html; charset=utf-8";
const CSS: &str = "text/css; charset=utf-8";
const TEXT: &str = "text/plain; charset=utf-8";
const SCRIPT: &str = "text/javascript; charset=utf-8";

/// Every file of the page.
pub(crate) const ASSETS: [Asset; 14] = [
    asset!("/", HTML, "index.html"),
    asset!("/serve.css", CSS, "serve.css"),
    asset!("/serve.js", SCRIPT, "serve.js"),
    asset!("/ask.js", SCRIPT, "ask.js"),
    asset!("/highlight.js", SCRIPT, "highlight.js"),
    asset!("/curve.js", SCRIPT, "curve.js"),
    asset!("/widths.js", SCRIPT, "widths.js"),
    asset!("/clock.js", SCRIPT, "clock.js"),
    asset!("/wave.js", SCRIPT, "wave.js"),
    shared("/page.css", CSS, assets::STYLE),
    shared("/plots.js", SCRIPT, assets::PLOTS),
    shared("/uplot.js", SCRIPT, assets::UPLOT),
    shared("/uplot.css", CSS, assets::UPLOT_STYLE),
    shared("/uplot-license.txt", TEXT, assets::UPLOT_LICENSE),
];

impl IntoResponse for &Asset {
    fn into_response(self) -> Response {
        ([(header::CONTENT_TYPE, self.kind)], self.text).into_response()
    }
}
