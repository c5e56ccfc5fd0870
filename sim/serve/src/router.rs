//! Which path answers what.

use std::sync::Arc;
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::{DefaultBodyLimit, FromRequest, Request, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::{MethodRouter, get, post};
use axum::{Router, middleware};
use serde::Serialize;
use serde::de::DeserializeOwned;
use tokio::time::timeout;
use vectors::limits::MOST_SERVED_TEXT;

use crate::answers::{
    AlterAsk, Altered, Beginning, ClockAsk, Clocked, Curve, CurveAsk, Hardware, HardwareAsk, Highlight, HighlightAsk,
    OpenAsk, Opened, archive,
};
use crate::app::App;
use crate::files::ASSETS;
use crate::guard::{Guard, guard};
use crate::refusal::Refusal;

/// The longest body: a configuration, which has more characters as a text in JSON, and what is asked about it.
const MOST_BODY: usize = 2 * MOST_SERVED_TEXT;

/// How long the body of a request is waited for.
const PATIENCE: Duration = Duration::from_secs(10);

/// The router of the server on this port.
pub(crate) fn router(app: Arc<App>, port: u16) -> Router {
    let pages =
        ASSETS.iter().fold(Router::new(), |router, asset| router.route(asset.path, get(move || async move { asset })));
    pages
        .route("/api/begin", get(begin))
        .route("/api/hardware", answer(|app, ask: HardwareAsk| Hardware::of(&*app.cache.get(&ask.configuration)?)))
        .route(
            "/api/highlight",
            answer(|app, ask: HighlightAsk| Highlight::of(&*app.cache.get(&ask.configuration)?, &ask)),
        )
        .route("/api/curve", answer(|app, ask: CurveAsk| Curve::of(&*app.cache.get(&ask.configuration)?, &ask)))
        .route("/api/alter", answer(|app, ask: AlterAsk| Altered::of(&*app.cache.get(&ask.configuration)?, &ask)))
        .route(
            "/api/clock/open",
            answer(|app, ask: OpenAsk| Opened::new(app.cache.get(&ask.configuration)?, &app.sessions)),
        )
        .route("/api/clock", answer(|app, ask: ClockAsk| Clocked::of(&app.sessions, &ask)))
        .route("/api/rtl", post(rtl))
        .fallback(|| async { Refusal::new(StatusCode::NOT_FOUND, "there is nothing at this path") })
        .method_not_allowed_fallback(|| async {
            Refusal::new(
                StatusCode::METHOD_NOT_ALLOWED,
                "this path is asked by GET where it is of the page, else by POST",
            )
        })
        .layer(DefaultBodyLimit::max(MOST_BODY))
        .layer(middleware::from_fn_with_state(Arc::new(Guard::new(port)), guard))
        .with_state(app)
}

async fn begin(State(app): State<Arc<App>>) -> Response {
    json(&Beginning::new(&app.start))
}

/// Answers a question in JSON by JSON, on a worker.
fn answer<A, R>(of: fn(&App, A) -> Result<R, Refusal>) -> MethodRouter<Arc<App>>
where
    A: DeserializeOwned + Send + 'static,
    R: Serialize + Send + 'static,
{
    post(async move |State(app): State<Arc<App>>, request: Request| -> Result<Response, Refusal> {
        let ask = read(request).await?;
        let shared = Arc::clone(&app);
        let found = app.pool.run(move || of(&shared, ask)).await?;
        Ok(json(&found))
    })
}

async fn rtl(State(app): State<Arc<App>>, request: Request) -> Result<Response, Refusal> {
    let ask: HardwareAsk = read(request).await?;
    let shared = Arc::clone(&app);
    let made = app.pool.run(move || archive(&*shared.cache.get(&ask.configuration)?, &shared.directory())).await?;
    Ok(([(header::CONTENT_TYPE, "application/zip")], made).into_response())
}

fn json(answer: &impl Serialize) -> Response {
    match serde_json::to_string(answer) {
        Ok(text) => ([(header::CONTENT_TYPE, "application/json")], text).into_response(),
        Err(error) => Refusal::own(error).into_response(),
    }
}

/// The question in the body of a request.
async fn read<A: DeserializeOwned>(request: Request) -> Result<A, Refusal> {
    let kind = request.headers().get(header::CONTENT_TYPE).and_then(|kind| kind.to_str().ok()).unwrap_or_default();
    if !kind.split(';').next().is_some_and(|kind| kind.trim().eq_ignore_ascii_case("application/json")) {
        let message = "a question is JSON: say Content-Type: application/json";
        return Err(Refusal::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, message));
    }
    let body = timeout(PATIENCE, Bytes::from_request(request, &())).await;
    let body = body.map_err(|_| Refusal::new(StatusCode::REQUEST_TIMEOUT, "the question did not come to its end"))?;
    let body = body.map_err(|refused| match refused.status() {
        StatusCode::PAYLOAD_TOO_LARGE => Refusal::new(
            StatusCode::PAYLOAD_TOO_LARGE,
            format!("a question has at most {MOST_BODY} bytes, the configuration in it {MOST_SERVED_TEXT}"),
        ),
        status => Refusal::new(status, refused.body_text()),
    })?;
    serde_json::from_slice(&body)
        .map_err(|error| Refusal::new(StatusCode::BAD_REQUEST, format!("no question: {error}")))
}
