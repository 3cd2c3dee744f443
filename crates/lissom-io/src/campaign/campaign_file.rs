//! What a `campaign.toml` says, and limits on reading it.

use std::path::PathBuf;

use lissom_core::record::Campaign;

use crate::arm_file::ArmFile;

/// A campaign with what its file says beyond its runs.
#[derive(Debug, Clone)]
pub struct CampaignFile {
    /// The runs and their channels.
    pub campaign: Campaign,
    /// What is known of the drive.
    pub known: DriveConstants,
    /// How it wants to be analysed.
    pub analysis: AnalysisOptions,
}

impl AsRef<Campaign> for CampaignFile {
    fn as_ref(&self) -> &Campaign {
        &self.campaign
    }
}

/// Constants of the table `[drive]`, in SI.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DriveConstants {
    /// As it was given: per ampere, per volt or per unit of command (N·m or N each).
    pub torque_constant: Option<f64>,
    /// Resistance of the winding \[Ω\].
    pub resistance_ohm: Option<f64>,
    /// Back-EMF constant \[V·s/rad or V·s/m\].
    pub back_emf: Option<f64>,
    /// The arm to compare with.
    pub arm: Option<ArmFile>,
    /// The file it stands in.
    pub arm_path: Option<PathBuf>,
}

/// The table `[analysis]`: wishes for the analysis. Its `skip` is carried out on reading.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AnalysisOptions {
    /// Lengths of the regression's windows \[s\]; empty where they are left to the data.
    pub window_s: Vec<f64>,
    /// Highest harmonic of a periodic run.
    pub harmonics: Option<usize>,
}

/// Limits on reading.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadOptions {
    /// Most rows kept of a log, see [`LogOptions::max_rows`](crate::log::LogOptions::max_rows).
    pub max_rows: usize,
    /// Fewest samples of a piece between gaps.
    pub least_piece: usize,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self { max_rows: crate::log::LogOptions::default().max_rows, least_piece: 50 }
    }
}
