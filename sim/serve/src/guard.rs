//! Who is answered: a browser or a program on this machine that means this server.
//!
//! A page of another site could have its name resolve to 127.0.0.1 (DNS rebinding); its requests then carry that name
//! as their Host. Or it could send a form here; a browser says in Origin which page sends it.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use crate::refusal::Refusal;

/// What a browser may do with an answer: scripts, styles and requests of this server alone, no frame around the page.
const HEADERS: [(HeaderName, HeaderValue); 6] = [
    (
        header::CONTENT_SECURITY_POLICY,
        HeaderValue::from_static(
            "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; \
             base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
        ),
    ),
    (header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff")),
    (header::REFERRER_POLICY, HeaderValue::from_static("no-referrer")),
    (header::CACHE_CONTROL, HeaderValue::from_static("no-store")),
    (HeaderName::from_static("cross-origin-opener-policy"), HeaderValue::from_static("same-origin")),
    (HeaderName::from_static("cross-origin-resource-policy"), HeaderValue::from_static("same-origin")),
];

/// The names of this server.
#[derive(Debug)]
pub(crate) struct Guard {
    hosts: Vec<String>,
}

impl Guard {
    /// Of the server on this port of 127.0.0.1.
    pub(crate) fn new(port: u16) -> Self {
        let names = ["127.0.0.1", "localhost"];
        let mut hosts: Vec<String> = names.iter().map(|name| format!("{name}:{port}")).collect();
        if port == 80 {
            hosts.extend(names.map(str::to_owned));
        }
        Self { hosts }
    }

    fn refuse(&self, request: &Request) -> Option<Refusal> {
        let headers = request.headers();
        let authority = request.uri().authority().map(|authority| authority.as_str());
        let host = only(headers, &header::HOST);
        if !host.is_some_and(|host| self.is_own(host)) || authority.is_some_and(|authority| !self.is_own(authority)) {
            let own = self.hosts.join(" or ");
            return Some(Refusal::new(StatusCode::FORBIDDEN, format!("the Host of a request must be {own}")));
        }
        let from_elsewhere = headers.contains_key(header::ORIGIN)
            && !only(headers, &header::ORIGIN)
                .and_then(|origin| origin.strip_prefix("http://"))
                .is_some_and(|origin| self.is_own(origin));
        let works = ![Method::GET, Method::HEAD].contains(request.method());
        if works && from_elsewhere {
            let message = "only the page of this server may ask: the Origin of the request is another one";
            return Some(Refusal::new(StatusCode::FORBIDDEN, message));
        }
        None
    }

    fn is_own(&self, host: &str) -> bool {
        self.hosts.iter().any(|own| own.eq_ignore_ascii_case(host))
    }
}

/// The value of a header that must be there once.
fn only<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Option<&'a str> {
    let mut values = headers.get_all(name).iter();
    let value = values.next()?.to_str().ok()?;
    values.next().is_none().then_some(value)
}

/// Refuses a request that is not meant for this server, and puts the security headers on every answer.
pub(crate) async fn guard(State(guard): State<Arc<Guard>>, request: Request, next: Next) -> Response {
    let mut response = match guard.refuse(&request) {
        Some(refusal) => refusal.into_response(),
        None => next.run(request).await,
    };
    response.headers_mut().extend(HEADERS);
    response
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::body::Body;

    fn refused(method: Method, uri: &str, headers: &[(&str, &str)]) -> bool {
        let mut request = Request::builder().method(method).uri(uri);
        for (name, value) in headers {
            request = request.header(*name, *value);
        }
        Guard::new(8064).refuse(&request.body(Body::empty()).unwrap()).is_some()
    }

    #[test]
    fn a_host_is_one_of_two() {
        for host in ["127.0.0.1:8064", "localhost:8064", "LOCALHOST:8064"] {
            assert!(!refused(Method::GET, "/", &[("host", host)]), "{host}");
        }
        for host in ["127.0.0.1", "127.0.0.1:80", "evil.example:8064", "[::1]:8064", "127.0.0.1:8064.evil.example", ""]
        {
            assert!(refused(Method::GET, "/", &[("host", host)]), "{host}");
        }
        assert!(refused(Method::GET, "/", &[]));
        assert!(refused(Method::GET, "/", &[("host", "localhost:8064"), ("host", "localhost:8064")]));
        assert!(refused(Method::GET, "http://evil.example/", &[("host", "localhost:8064")]));
        assert!(!refused(Method::GET, "http://localhost:8064/", &[("host", "localhost:8064")]));
    }

    #[test]
    fn an_origin_is_asked_of_what_works() {
        let host = ("host", "localhost:8064");
        for origin in ["http://localhost:8064", "http://127.0.0.1:8064"] {
            assert!(!refused(Method::POST, "/api/check", &[host, ("origin", origin)]), "{origin}");
        }
        for origin in ["null", "https://localhost:8064", "http://evil.example", "http://localhost:80640", ""] {
            assert!(refused(Method::POST, "/api/check", &[host, ("origin", origin)]), "{origin}");
            assert!(!refused(Method::GET, "/", &[host, ("origin", origin)]), "{origin}");
        }
        assert!(!refused(Method::POST, "/api/check", &[host]), "a program says no origin");
    }
}
