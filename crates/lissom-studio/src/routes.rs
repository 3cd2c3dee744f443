//! Addresses of the application.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::{DefaultBodyLimit, State};
use axum::http::header::CONTENT_TYPE;
use axum::http::{HeaderName, StatusCode};
use axum::response::{IntoResponse, Response};
use axum::routing::{delete, get, post, put};
use axum::{Json, Router, middleware};
use lissom_io::result::ComparisonError;
use lissom_io::{ComparedFile, ParameterList, ResultFile};
use lissom_views::compare_page;
use serde::{Deserialize, Serialize};

use crate::app::Shared;
use crate::exports;
use crate::guard;
use crate::identification;
use crate::job::JobView;
use crate::log_cache::TracePoints;
use crate::opener;
use crate::planning::{PlanView, Wanted};
use crate::problem::Problem;
use crate::runs;
use crate::said::{Asked, Named, Said};
use crate::sample;
use crate::session::{FileKind, LogEntry, Session};
use crate::setup::Setup;
use crate::state_view::StateView;
use crate::uploads;

const PAGE: &str = include_str!("page/index.html");
const SCRIPT: &str = include_str!("page/studio.js");
const STYLE: &str = include_str!("page/studio.css");
/// Most bytes of a request that is no upload.
const REQUEST_BYTES: usize = 1 << 20;
/// Most pixels of a plot.
const PIXELS_MOST: usize = 8000;
const PIXELS: usize = 1000;

type Answer<T> = Result<Json<T>, Problem>;

/// All addresses.
pub(crate) fn router(app: Shared) -> Router {
    let with_key = Router::new()
        .route("/api/state", get(state))
        .route("/api/setup", put(put_setup))
        .route("/api/sample", post(add_sample))
        .route("/api/files/{name}", put(put_file).layer(DefaultBodyLimit::disable()))
        .route("/api/logs/{id}", delete(remove_log))
        .route("/api/logs/{id}/trace/{channel}", get(trace))
        .route("/api/logs/{id}/runs", put(put_runs))
        .route("/api/job", get(job).post(start_job).delete(stop_job))
        .route("/api/results/{id}", delete(remove_result))
        .route("/api/results/{id}/report", get(report))
        .route("/api/results/{id}/files/{name}", get(result_file))
        .route("/api/compare", get(compare))
        .route("/api/plan", post(make_plan))
        .route("/api/virtual", post(try_plan))
        .route_layer(middleware::from_fn_with_state(Arc::clone(&app), guard::need_key));
    Router::new()
        .route("/", get(|| async { ([(CONTENT_TYPE, "text/html; charset=utf-8")], PAGE) }))
        .route("/studio.js", get(|| async { ([(CONTENT_TYPE, "text/javascript")], SCRIPT) }))
        .route("/studio.css", get(|| async { ([(CONTENT_TYPE, "text/css")], style()) }))
        .route("/api/key", post(key))
        .merge(with_key)
        .fallback(|| async { Problem::not_found("address") })
        .layer(DefaultBodyLimit::max(REQUEST_BYTES))
        .layer(middleware::from_fn(guard::guard))
        .with_state(app)
}

/// The style of the report page, and what the application has in addition.
fn style() -> String {
    [lissom_report::PAGE_STYLE, STYLE].concat()
}

/// Runs work that takes time in another thread.
async fn in_thread<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, Problem> + Send + 'static,
) -> Result<T, Problem> {
    let done = tokio::task::spawn_blocking(work).await;
    done.unwrap_or_else(|_| Err(Problem::internal("this is an error in lissom")))
}

#[derive(Deserialize)]
struct Token {
    token: String,
}

#[derive(Serialize)]
struct Key {
    key: String,
}

async fn key(State(app): State<Shared>, Said(said): Said<Token>) -> Answer<Key> {
    let key = app.access.exchange(&said.token)?;
    // The file opens one more page.
    let token = app.access.new_token().map_err(Problem::internal)?;
    opener::write(app.folder.path(), &opener::address(app.port, &token))?;
    Ok(Json(Key { key }))
}

async fn state(State(app): State<Shared>) -> Answer<StateView> {
    in_thread(move || Ok(Json(StateView::of(&app)))).await
}

#[derive(Deserialize)]
struct NewSetup {
    revision: u64,
    setup: Setup,
}

async fn put_setup(State(app): State<Shared>, Said(new): Said<NewSetup>) -> Answer<StateView> {
    in_thread(move || {
        app.check_reading(&new.setup)?;
        app.change(new.revision, |session| {
            session.setup = new.setup;
            let logs = session.logs.clone();
            session.setup.forget(|id| logs.iter().any(|log| log.id == id));
            Ok(())
        })?;
        Ok(Json(StateView::of(&app)))
    })
    .await
}

#[derive(Deserialize)]
struct Known {
    revision: u64,
}

async fn add_sample(State(app): State<Shared>, Said(known): Said<Known>) -> Answer<StateView> {
    in_thread(move || {
        if app.session().revision != known.revision || !app.session().logs.is_empty() {
            return Err(Problem::conflict(
                "there are logs already",
                "remove them first: the sample has a session of its own",
            ));
        }
        let names = sample::write(&app.folder.logs())?;
        app.change(known.revision, |session| {
            for name in names {
                let id = session.new_log();
                session.logs.push(LogEntry::of_file(id, name, None, FileKind::Log));
            }
            session.setup = sample::setup();
            Ok(())
        })?;
        Ok(Json(StateView::of(&app)))
    })
    .await
}

async fn put_file(
    State(app): State<Shared>,
    Named(name): Named<String>,
    body: Body,
) -> Answer<StateView> {
    let name = uploads::receive(&app.folder.logs(), &name, body, app.quota_bytes).await?;
    in_thread(move || {
        let path = app.folder.logs().join(&name);
        let added = add_file(&app, name);
        if added.is_err() {
            std::fs::remove_file(path)?;
        }
        added?;
        Ok(Json(StateView::of(&app)))
    })
    .await
}

/// Adds a file that has arrived. A log that cannot be read is refused.
fn add_file(app: &Shared, name: String) -> Result<(), Problem> {
    let path = app.folder.logs().join(&name);
    if lissom_formats::expands_beyond(&path, app.quota_bytes)? {
        let mb = app.quota_bytes / 1_000_000;
        let error = format!("{name} expands to more than {mb} MB");
        let hint = "start the command with the file as its argument, or split it";
        return Err(Problem::input(error, Some(hint.to_owned())));
    }
    let kind = FileKind::of(&path);
    let id = app.amend(Session::new_log)?;
    app.add(LogEntry::of_file(id, name, None, kind), false)
}

/// What is not there is removed already.
fn gone(removed: std::io::Result<()>) -> std::io::Result<()> {
    match removed {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(()),
        other => other,
    }
}

async fn remove_log(
    State(app): State<Shared>,
    Named(id): Named<u64>,
    Asked(known): Asked<Known>,
) -> Answer<StateView> {
    in_thread(move || {
        let (removed, is_used) = app.change(known.revision, |session| {
            let at = session.logs.iter().position(|log| log.id == id);
            let removed = session.logs.remove(at.ok_or_else(|| Problem::not_found("log"))?);
            session.setup.forget(|log| log != id);
            if session.logs.is_empty() {
                session.setup = Setup::default();
            }
            let is_used = session.logs.iter().any(|log| log.shares_file(&removed));
            Ok((removed, is_used))
        })?;
        app.cache.forget(id);
        if removed.path.is_none() && !is_used {
            gone(std::fs::remove_file(app.folder.logs().join(removed.name)))?;
        }
        Ok(Json(StateView::of(&app)))
    })
    .await
}

#[derive(Deserialize)]
struct NewRuns {
    revision: u64,
    /// Whether each run of the file is a log of its own.
    apart: bool,
}

async fn put_runs(
    State(app): State<Shared>,
    Named(id): Named<u64>,
    Said(new): Said<NewRuns>,
) -> Answer<StateView> {
    in_thread(move || {
        if new.apart {
            runs::take_apart(&app, new.revision, id)?;
        } else {
            runs::put_together(&app, new.revision, id)?;
        }
        Ok(Json(StateView::of(&app)))
    })
    .await
}

#[derive(Deserialize)]
struct Part {
    from: Option<f64>,
    to: Option<f64>,
    pixels: Option<usize>,
}

async fn trace(
    State(app): State<Shared>,
    Named((id, channel)): Named<(u64, usize)>,
    Asked(part): Asked<Part>,
) -> Answer<TracePoints> {
    in_thread(move || {
        let session = app.session();
        let log = session.log(id).ok_or_else(|| Problem::not_found("log"))?;
        let pixels = part.pixels.unwrap_or(PIXELS).clamp(1, PIXELS_MOST);
        let range = part.from.zip(part.to).map(|(from, to)| [from, to]);
        let time = session.setup.time_channel(&*app.inspection(&session, log)?);
        let points = app.log(&session, log)?.trace(channel.wrapping_sub(1), time, range, pixels);
        points.map(Json).ok_or_else(|| Problem::not_found("channel"))
    })
    .await
}

async fn job(State(app): State<Shared>) -> Json<Option<JobView>> {
    Json(app.job().map(|job| job.view()))
}

async fn start_job(State(app): State<Shared>, Said(known): Said<Known>) -> Answer<JobView> {
    in_thread(move || {
        let session = app.session();
        if session.revision != known.revision {
            return Err(Problem::conflict(
                "another page has changed this session meanwhile",
                "this page shows the session as it is now; start again",
            ));
        }
        Ok(Json(identification::start(&app, session)?.view()))
    })
    .await
}

async fn stop_job(State(app): State<Shared>) -> Answer<JobView> {
    let job = app.job().ok_or_else(|| Problem::not_found("identification"))?;
    job.stop();
    Ok(Json(job.view()))
}

async fn remove_result(State(app): State<Shared>, Named(id): Named<u64>) -> Answer<StateView> {
    in_thread(move || {
        let removed = app.amend(|session| {
            let at = session.results.iter().position(|result| result.id == id);
            at.map(|at| session.results.remove(at))
        })?;
        let removed = removed.ok_or_else(|| Problem::not_found("result"))?;
        gone(std::fs::remove_dir_all(app.folder.result(removed.id)))?;
        Ok(Json(StateView::of(&app)))
    })
    .await
}

/// The folder of a result of the session.
fn result_folder(app: &Shared, id: u64) -> Result<std::path::PathBuf, Problem> {
    let session = app.session();
    let result = session.result(id).ok_or_else(|| Problem::not_found("result"))?;
    Ok(app.folder.result(result.id))
}

async fn report(State(app): State<Shared>, Named(id): Named<u64>) -> Result<Response, Problem> {
    Ok(fragment(in_thread(move || exports::report(&result_folder(&app, id)?)).await?))
}

/// A part of a page, as plain text: nothing of it may run if a browser opens it by itself.
fn fragment(text: String) -> Response {
    ([(CONTENT_TYPE, "text/plain; charset=utf-8")], text).into_response()
}

async fn result_file(
    State(app): State<Shared>,
    Named((id, name)): Named<(u64, String)>,
) -> Result<Response, Problem> {
    let file = in_thread(move || exports::export(&result_folder(&app, id)?, &name)).await?;
    let save = (HeaderName::from_static("content-disposition"), "attachment");
    Ok((StatusCode::OK, [(CONTENT_TYPE, file.content_type), save], file.content).into_response())
}

#[derive(Deserialize)]
struct Chosen {
    /// Numbers of results, with commas between them.
    results: String,
}

async fn compare(
    State(app): State<Shared>,
    Asked(chosen): Asked<Chosen>,
) -> Result<Response, Problem> {
    let text = in_thread(move || {
        let session = app.session();
        let mut lists = Vec::new();
        for text in chosen.results.split(',') {
            let id = text.parse().ok().and_then(|id| session.result(id));
            let result = id.ok_or_else(|| Problem::not_found("result"))?;
            let file = ResultFile::read(&app.folder.result(result.id).join("result.json"))?;
            lists.push((format!("{} ({})", result.name, result.id), ParameterList::of(&file)));
        }
        let found = ComparedFile::of(&lists).map_err(|error| match error {
            ComparisonError::Copy { file, other } => Problem::input(
                format!("{other} and {file} have the same estimates, to the last digit"),
                Some("what differs between them changes no estimate".to_owned()),
            ),
            error => lissom_io::Error::from(error).into(),
        })?;
        Ok(compare_page::page("Comparison", &found).to_fragment())
    })
    .await?;
    Ok(fragment(text))
}

async fn make_plan(State(app): State<Shared>, Said(wanted): Said<Wanted>) -> Answer<PlanView> {
    in_thread(move || {
        let (planned, view) = wanted.planned()?;
        app.keep_plan(planned);
        Ok(Json(view))
    })
    .await
}

/// Simulates the plan that was made last: no page sends a plan, which could name files.
async fn try_plan(State(app): State<Shared>) -> Answer<JobView> {
    in_thread(move || {
        let planned = app.planned().ok_or_else(|| Problem::not_found("plan"))?;
        Ok(Json(identification::start_virtual(&app, app.session(), planned)?.view()))
    })
    .await
}
