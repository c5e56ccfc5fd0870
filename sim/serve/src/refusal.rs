//! Why a request is not answered, as a status and a sentence.

use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use hw_model::config::ConfigError;
use serde::Serialize;
use vectors::configuration_file::ConfigurationError;

/// Why a request is not answered.
#[derive(Debug, Clone)]
pub(crate) struct Refusal {
    status: StatusCode,
    error: Problem,
}

/// What the page is told of it.
#[derive(Debug, Clone, Serialize)]
struct Problem {
    /// What is wrong, and what would be right.
    message: String,
    /// The line of the configuration's text, counted from 1, where the error is at a place.
    line: Option<usize>,
    /// The column on that line, counted from 1.
    column: Option<usize>,
}

#[derive(Serialize)]
struct Body<'a> {
    error: &'a Problem,
}

impl Refusal {
    /// With any status.
    pub(crate) fn new(status: StatusCode, message: impl Into<String>) -> Self {
        Self { status, error: Problem { message: message.into(), line: None, column: None } }
    }

    /// A request that is well formed and asks for what there is not.
    pub(crate) fn unusable(message: impl ToString) -> Self {
        Self::new(StatusCode::UNPROCESSABLE_ENTITY, message.to_string())
    }

    /// More work than the server does for one request, or than it can do now.
    pub(crate) fn too_much(message: impl Into<String>) -> Self {
        Self::new(StatusCode::SERVICE_UNAVAILABLE, message)
    }

    /// A fault of the server's own.
    pub(crate) fn own(message: impl ToString) -> Self {
        Self::new(StatusCode::INTERNAL_SERVER_ERROR, message.to_string())
    }
}

impl From<ConfigurationError> for Refusal {
    fn from(error: ConfigurationError) -> Self {
        let mut refusal = Self::unusable(&error);
        if let ConfigurationError::Refused { error: ConfigError::Json(error), .. } = &error {
            (refusal.error.line, refusal.error.column) = (Some(error.line()), Some(error.column()));
        }
        refusal
    }
}

impl IntoResponse for Refusal {
    fn into_response(self) -> Response {
        // A struct of texts and numbers: writing it cannot fail.
        let body = serde_json::to_string(&Body { error: &self.error }).unwrap_or_default();
        (self.status, [(header::CONTENT_TYPE, "application/json")], body).into_response()
    }
}
