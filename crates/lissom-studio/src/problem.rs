//! What the page shows when something does not work.

use std::path::{MAIN_SEPARATOR, Path};

use axum::Json;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::Serialize;

/// An error with a way out, as the page gets it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Problem {
    #[serde(skip)]
    pub(crate) status: StatusCode,
    /// What is wrong.
    pub(crate) error: String,
    /// What the user can do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) hint: Option<String>,
}

impl Problem {
    /// Input that cannot be used.
    pub(crate) fn input(error: impl Into<String>, hint: Option<String>) -> Self {
        Self { status: StatusCode::UNPROCESSABLE_ENTITY, error: error.into(), hint }
    }

    /// Something that does not fit what is going on.
    pub(crate) fn conflict(error: &str, hint: &str) -> Self {
        Self { status: StatusCode::CONFLICT, error: error.to_owned(), hint: Some(hint.to_owned()) }
    }

    /// Something that does not exist.
    pub(crate) fn not_found(what: &str) -> Self {
        let error = format!("there is no such {what}");
        Self { status: StatusCode::NOT_FOUND, error, hint: None }
    }

    /// Something that is not allowed.
    pub(crate) fn forbidden(error: &str, hint: Option<&str>) -> Self {
        let hint = hint.map(str::to_owned);
        Self { status: StatusCode::FORBIDDEN, error: error.to_owned(), hint }
    }

    /// The same without the names of a folder that people do not know.
    pub(crate) fn without_folder(self, folder: &Path) -> Self {
        let folder = format!("{}{MAIN_SEPARATOR}", folder.display());
        Self { error: self.error.replace(&folder, ""), ..self }
    }

    /// A failure of the program itself or of the disk.
    pub(crate) fn internal(error: impl std::fmt::Display) -> Self {
        Self { status: StatusCode::INTERNAL_SERVER_ERROR, error: error.to_string(), hint: None }
    }
}

impl From<lissom_io::Error> for Problem {
    fn from(error: lissom_io::Error) -> Self {
        Self::input(error.to_string(), error.hint())
    }
}

impl From<std::io::Error> for Problem {
    fn from(error: std::io::Error) -> Self {
        let is_full = error.kind() == std::io::ErrorKind::StorageFull;
        let hint = "free space there, or start lissom studio with --folder on another disk";
        let problem = Self::internal(error);
        if !is_full {
            return problem;
        }
        let error = "the disk of the session's folder is full".to_owned();
        Self { error, hint: Some(hint.to_owned()), ..problem }
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        (self.status, Json(self)).into_response()
    }
}
