//! The contents of a `campaign.toml`, and limits for reading it.

use std::path::PathBuf;

use lissom_core::arm::Arm;
use lissom_core::identify::Options;
use lissom_core::record::Campaign;

use crate::arm_file::ArmFile;
use crate::config::ConfigError;

/// A campaign, with the other contents of its file.
#[derive(Debug, Clone)]
pub struct CampaignFile {
    /// The runs and their channels.
    pub campaign: Campaign,
    /// Known constants of the drive.
    pub known: DriveConstants,
    /// Options of the analysis.
    pub analysis: AnalysisOptions,
}

impl CampaignFile {
    /// The whole arm that `[drive] arm` gives for comparison; `None` if it gives none, or one without a drive or beam.
    ///
    /// # Errors
    /// [`ConfigError`] if its numbers do not make an arm.
    pub fn described_arm(&self) -> Result<Option<Arm>, ConfigError> {
        let (Some(arm), Some(path)) = (&self.known.arm, &self.known.arm_path) else {
            return Ok(None);
        };
        if arm.drive.is_none() || arm.beam_kind(path).is_err() {
            return Ok(None);
        }
        arm.simulated_arm(path).map(Some)
    }

    /// The options of its table `[analysis]`, the others by default.
    pub fn options(&self) -> Options {
        Options {
            window_s: self.analysis.window_s.clone(),
            harmonics: self.analysis.harmonics,
            ..Options::default()
        }
    }
}

/// Constants of the table `[drive]`, in SI.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DriveConstants {
    /// Torque constant as given: in N·m or N per ampere, per volt or per unit of command.
    pub torque_constant: Option<f64>,
    /// Resistance of the winding \[Ω\].
    pub resistance_ohm: Option<f64>,
    /// Back-EMF constant \[V·s/rad or V·s/m\].
    pub back_emf: Option<f64>,
    /// The arm to compare with.
    pub arm: Option<ArmFile>,
    /// The file of this arm.
    pub arm_path: Option<PathBuf>,
}

/// The table `[analysis]`: options of the analysis. Its `skip` is applied when logs are read.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AnalysisOptions {
    /// Lengths of the regression's windows \[s\]; empty if they are chosen from the data.
    pub window_s: Vec<f64>,
    /// Highest harmonic of a periodic run.
    pub harmonics: Option<usize>,
}

/// Limits for reading.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadOptions {
    /// Largest number of rows kept of a log, see [`LogOptions::max_rows`](crate::log::LogOptions::max_rows).
    pub max_rows: usize,
    /// Smallest number of samples of a piece between gaps.
    pub least_piece: usize,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self { max_rows: crate::log::LogOptions::default().max_rows, least_piece: 50 }
    }
}
