//! Who may ask: whoever was given the one-time token, from a page of this server only.
//!
//! Any program of the machine and any page in the browser can reach the port. A page that is opened with the token in the
//! fragment of its address, which no server and no log sees, exchanges it for a key, and sends the key as a header: unlike a
//! cookie it does not go to other ports. Names other than those of the loopback interface are refused as `Host`, so that no
//! page can reach the server by a name that it owns.

use std::sync::{Mutex, PoisonError};

use axum::extract::{Request, State};
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, HOST, ORIGIN, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{HeaderMap, HeaderName, HeaderValue};
use axum::middleware::Next;
use axum::response::{IntoResponse as _, Response};
use subtle::ConstantTimeEq as _;

use crate::app::Shared;
use crate::problem::Problem;
use crate::studio_error::StudioError;

/// The header with the key.
pub(crate) const KEY_HEADER: &str = "x-lissom-key";
const RANDOM_BYTES: usize = 32;
/// Most pages that may be open: the oldest key then ends.
const KEYS_MOST: usize = 32;
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; \
                      base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
const NEW_ADDRESS: &str = "open the address that the command prints, or its file `open.html`";

/// Token and keys.
#[derive(Debug, Default)]
pub(crate) struct Access {
    /// The token that is not used yet.
    token: Mutex<String>,
    keys: Mutex<Vec<String>>,
}

impl Access {
    /// Makes a new token, and returns it; the one before ends.
    pub(crate) fn new_token(&self) -> Result<String, StudioError> {
        let token = random()?;
        self.token.lock().unwrap_or_else(PoisonError::into_inner).clone_from(&token);
        Ok(token)
    }

    /// Exchanges the token for a key. The token is then used up.
    pub(crate) fn exchange(&self, token: &str) -> Result<String, Problem> {
        let mut known = self.token.lock().unwrap_or_else(PoisonError::into_inner);
        if known.is_empty() || !same(&known, token) {
            return Err(Problem::forbidden("this address has been used", Some(NEW_ADDRESS)));
        }
        known.clear();
        let key = random().map_err(Problem::internal)?;
        let mut keys = self.keys.lock().unwrap_or_else(PoisonError::into_inner);
        if keys.len() == KEYS_MOST {
            keys.remove(0);
        }
        keys.push(key.clone());
        Ok(key)
    }

    fn knows(&self, key: &str) -> bool {
        let keys = self.keys.lock().unwrap_or_else(PoisonError::into_inner);
        keys.iter().fold(false, |found, known| found | same(known, key))
    }
}

fn same(a: &str, b: &str) -> bool {
    a.as_bytes().ct_eq(b.as_bytes()).into()
}

fn random() -> Result<String, StudioError> {
    let mut bytes = [0; RANDOM_BYTES];
    getrandom::fill(&mut bytes).map_err(|_| StudioError::NoRandom)?;
    Ok(hex(&bytes))
}

/// Bytes as hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    let digit = |half: u8| char::from_digit(u32::from(half), 16).unwrap_or('0');
    bytes.iter().flat_map(|byte| [digit(byte >> 4), digit(byte & 15)]).collect()
}

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
        let status = axum::http::StatusCode::UNAUTHORIZED;
        Problem { status, ..problem }.into_response()
    }
}
