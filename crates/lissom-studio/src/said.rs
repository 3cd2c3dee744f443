//! What a page sends in a body, an address or a query; what cannot be read is answered as every error is.

use axum::Json;
use axum::extract::{FromRequest, FromRequestParts, Path, Query, Request};
use axum::http::StatusCode;
use axum::http::request::Parts;
use serde::de::DeserializeOwned;

use crate::problem::Problem;

/// JSON that a page sends.
pub(crate) struct Said<T>(pub(crate) T);

/// Names and numbers in an address.
pub(crate) struct Named<T>(pub(crate) T);

/// What a query asks for.
pub(crate) struct Asked<T>(pub(crate) T);

fn refused(status: StatusCode, error: String) -> Problem {
    Problem { status, error, hint: None }
}

impl<T: DeserializeOwned, S: Send + Sync> FromRequest<S> for Said<T> {
    type Rejection = Problem;

    async fn from_request(request: Request, state: &S) -> Result<Self, Problem> {
        let said = Json::from_request(request, state).await;
        said.map(|Json(said)| Self(said)).map_err(|r| refused(r.status(), r.body_text()))
    }
}

impl<T: DeserializeOwned + Send, S: Send + Sync> FromRequestParts<S> for Named<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let named = Path::from_request_parts(parts, state).await;
        named.map(|Path(named)| Self(named)).map_err(|r| refused(r.status(), r.body_text()))
    }
}

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Asked<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let asked = Query::from_request_parts(parts, state).await;
        asked.map(|Query(asked)| Self(asked)).map_err(|r| refused(r.status(), r.body_text()))
    }
}
