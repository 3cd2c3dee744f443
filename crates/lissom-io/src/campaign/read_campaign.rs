//! Reads a `campaign.toml` and its logs.

use std::path::Path;

use super::campaign_drive;
use super::campaign_file::{AnalysisOptions, CampaignFile, ReadOptions};
use super::campaign_load::{self, CampaignLoad};
use super::campaign_signals::signals;
use super::load_runs::load;
use super::run_spec::{RunSpec, runs};
use crate::config::{ConfigError, Source, Table};
use crate::io_error::Error;
use crate::units::Dimension;

/// Reads a `campaign.toml` and its logs.
///
/// # Errors
/// [`Error::Config`] and [`Error::Campaign`] for the file itself and its `arm.toml`,
/// [`Error::Log`] and [`Error::Record`] for the logs.
pub fn read_campaign(path: &Path) -> Result<CampaignFile, Error> {
    read_campaign_with(path, &ReadOptions::default())
}

/// Reads a `campaign.toml` and its logs, with other limits.
///
/// # Errors
/// As [`read_campaign`].
pub fn read_campaign_with(path: &Path, options: &ReadOptions) -> Result<CampaignFile, Error> {
    read(&Source::read(path)?, None, options)
}

/// Reads a campaign whose `campaign.toml` is a text. Files in it are relative to the working directory; errors call the
/// text `name`.
///
/// # Errors
/// As [`read_campaign`].
pub fn read_campaign_text(name: &str, text: String) -> Result<CampaignFile, Error> {
    read(&Source::new(Path::new(name), text), None, &ReadOptions::default())
}

/// Reads only `log`, with the columns and units of the campaign at `path`. The `skip` in its `[analysis]` applies too.
///
/// # Errors
/// As [`read_campaign`].
pub fn read_campaign_like(path: &Path, log: &Path) -> Result<CampaignFile, Error> {
    read(&Source::read(path)?, Some(log), &ReadOptions::default())
}

fn read(source: &Source, log: Option<&Path>, options: &ReadOptions) -> Result<CampaignFile, Error> {
    let document = source.parse()?;
    let root = source.root(&document);
    root.only(&["signals", "drive", "load", "analysis", "runs"])?;
    let mut signals = signals(&root.need("signals")?.table()?)?;
    let drive = root.get("drive").map(|v| v.table()).transpose()?;
    let (command, known, sign) =
        campaign_drive::drive(drive.as_ref(), signals.axis, &signals.command, source.folder())?;
    signals.command.reading.gain *= sign;
    signals.command.reading.offset *= sign;
    let load_table = root.get("load").map(|v| v.table()).transpose()?;
    let on_motor = load_table.map(|table| campaign_load::load(&table, &signals));
    let on_motor = on_motor.transpose()?.unwrap_or_default();
    let (analysis, skip_s) = match root.get("analysis") {
        Some(value) => analysis(&value.table()?)?,
        None => (AnalysisOptions::default(), None),
    };
    let (folder, runs) = match log {
        Some(log) => (Path::new(""), vec![RunSpec::of_log(log, skip_s)]),
        None => (source.folder(), runs(&root.need("runs")?, skip_s)?),
    };
    let campaign = load(folder, &signals, command, &runs, options)?;
    let campaign = match on_motor {
        CampaignLoad { mgl_nm: Some(mgl_nm), .. } => campaign.with_known_gravity(mgl_nm)?,
        CampaignLoad { gravity: true, .. } => campaign.with_gravity()?,
        CampaignLoad { .. } => campaign,
    };
    Ok(CampaignFile { campaign, known, analysis })
}

fn analysis(table: &Table<'_>) -> Result<(AnalysisOptions, Option<f64>), ConfigError> {
    table.only(&["window", "harmonics", "skip"])?;
    let windows = table.get("window").map_or_else(Vec::new, |value| value.one_or_list());
    let window_s =
        windows.iter().map(|v| v.positive(Dimension::TIME)).collect::<Result<Vec<_>, _>>()?;
    let harmonics = table.get("harmonics").map(|v| v.whole(1, 99)).transpose()?;
    let harmonics = harmonics.and_then(|count| usize::try_from(count).ok());
    let skip_s = table.get("skip").map(|v| v.not_negative(Dimension::TIME)).transpose()?;
    Ok((AnalysisOptions { window_s, harmonics }, skip_s))
}
