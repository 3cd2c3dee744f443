//! Which requests are served: those for a name of the loopback interface, from a page of this server, with a key.
//!
//! Names other than those of the loopback interface are refused as `Host`, so that no page can reach the server by a name that
//! it owns.

use axum::extract::{Request, State};
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, HOST, ORIGIN, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode};
use axum::middleware::Next;
use axum::response::{IntoResponse as _, Response};

use crate::access::NEW_ADDRESS;
use crate::app::Shared;
use crate::problem::Problem;

/// The header with the key.
const KEY_HEADER: &str = "x-lissom-key";
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; \
                      base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Refuses requests of other names and other pages, and adds the headers of every answer.
pub(crate) async fn guard(request: Request, next: Next) -> Response {
    let mut response = match local(request.headers()) {
        Ok(()) => next.run(request).await,
        Err(problem) => problem.into_response(),
    };
    let headers = response.headers_mut();
    let fixed = [
        (CONTENT_SECURITY_POLICY, POLICY),
        (X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (REFERRER_POLICY, "no-referrer"),
        (CACHE_CONTROL, "no-store"),
        (HeaderName::from_static("x-frame-options"), "DENY"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
        (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
    ];
    for (name, value) in fixed {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}

/// Whether a request is for a name of the loopback interface, and from a page of the same address if from a page.
fn local(headers: &HeaderMap) -> Result<(), Problem> {
    let text = |name: &HeaderName| {
        let mut all = headers.get_all(name).iter();
        let first = all.next().map(|value| value.to_str().unwrap_or("?").to_ascii_lowercase());
        if all.next().is_some() { Some("?".to_owned()) } else { first }
    };
    let host = text(&HOST).unwrap_or_default();
    let (name, port) = match host.strip_prefix("[::1]") {
        Some(port) => ("[::1]", port),
        None => host.find(':').map_or((host.as_str(), ""), |at| host.split_at(at)),
    };
    let is_port = |text: &str| {
        text.is_empty() || text.strip_prefix(':').is_some_and(|port| port.parse::<u16>().is_ok())
    };
    if !["localhost", "127.0.0.1", "[::1]"].contains(&name) || !is_port(port) {
        return Err(Problem::forbidden(
            "only localhost, 127.0.0.1 and [::1] are served",
            Some("for another machine use ssh -L and open http://localhost:PORT"),
        ));
    }
    match text(&ORIGIN) {
        Some(origin) if origin != format!("http://{host}") => {
            Err(Problem::forbidden("a page of another address asked", None))
        }
        _ => Ok(()),
    }
}

/// Refuses requests without a key.
pub(crate) async fn need_key(State(app): State<Shared>, request: Request, next: Next) -> Response {
    let headers = request.headers();
    let from = headers.get("sec-fetch-site").and_then(|value| value.to_str().ok());
    if from.is_some_and(|site| site != "same-origin") {
        return Problem::forbidden("a page of another address asked", None).into_response();
    }
    let key = headers.get(KEY_HEADER).and_then(|value| value.to_str().ok()).unwrap_or_default();
    if app.access.knows(key) {
        next.run(request).await
    } else {
        let problem = Problem::forbidden("this page has no key, or an old one", Some(NEW_ADDRESS));
        let status = StatusCode::UNAUTHORIZED;
        Problem { status, ..problem }.into_response()
    }
}
