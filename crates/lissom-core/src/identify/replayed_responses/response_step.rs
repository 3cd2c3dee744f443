//! Computes the frequency responses of a campaign and their rational models.

use nalgebra::DMatrix;

use crate::identify::estimate::Estimate;
use crate::identify::findings::Finding;
use crate::identify::output_error::OutputError;
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::run_analysis::{RunAnalysis, RunKind};
use crate::identify::replayed_responses::friction_waveform::FrictionWaveform;
use crate::identify::replayed_responses::replayed_bands::ReplayedBands;
use crate::identify::responses::bands::{against, general, uncertain};
use crate::identify::responses::models::{motor_and_beam, motor_model};
use crate::identify::responses::rational::{BeamFit, MotorFit};
use crate::identify::responses::response_point::ResponsePoint;
use crate::identify::responses::response_table::{Replayed, response_table, weak_points};
use crate::identify::thresholds::STEPPED_SINES_LEAST;
use crate::record::Campaign;

/// Makes response tables of a prepared campaign.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ResponseTables<'a> {
    pub(crate) prepared: &'a Prepared<'a>,
    /// Coulomb friction in the command's unit, by the best method that needs no replay.
    pub(crate) coulomb_command: Option<Estimate>,
}

/// Responses, the models of them, and what was found about them.
pub(crate) struct Responses {
    pub(crate) points: Vec<ResponsePoint>,
    pub(crate) motor_model: Option<MotorFit>,
    pub(crate) beam_model: Option<BeamFit>,
    pub(crate) findings: Vec<Finding>,
}

impl<'a> ResponseTables<'a> {
    /// Raw responses; those of tips to the motor do not depend on friction.
    pub(crate) fn without_friction_known(&self) -> Vec<ResponsePoint> {
        self.with_square_wave(None)
    }

    /// Corrected for friction as a square wave of this amplitude.
    pub(crate) fn with_square_wave(&self, coulomb_command: Option<Estimate>) -> Vec<ResponsePoint> {
        self.table(coulomb_command, &Replayed::default())
    }

    /// Rational model of the motor from responses corrected for friction as a square wave of this amplitude.
    pub(crate) fn model_with(&self, coulomb: Estimate, beam: Option<&BeamFit>) -> Option<MotorFit> {
        let constant = self.prepared.campaign().channels.command.torque_per_unit();
        motor_model(&self.with_square_wave(Some(coulomb)), constant, beam)
    }

    /// Corrected by the output-error method where its arm describes whole runs, with models of motor and beam.
    ///
    /// `tips` is the beam's model from the tips' responses. `by_regression` are models of the regressions' estimates: they
    /// are better than bands of a sweep or of ordinary moves, and bands that contradict them are flagged. `rigid` is the
    /// model of an axis that the output-error method found rigid: noise in responses looks like a pole and a zero side
    /// by side.
    pub(crate) fn with_models(
        &self,
        replay: Option<&'a OutputError>,
        tips: Option<BeamFit>,
        by_regression: Option<(MotorFit, Option<BeamFit>)>,
        rigid: Option<MotorFit>,
    ) -> Responses {
        let replayed = replay.map_or_else(Replayed::default, |found| self.replayed(found));
        let mut points = self.table(self.coulomb_command, &replayed);
        let motor = by_regression.as_ref().map(|(motor, _)| motor);
        let unreplayed = motor.filter(|_| replayed.bands.is_none());
        let contradicted = unreplayed.and_then(|motor| against(&mut points, motor));
        let stepped = points.iter().filter(|p| p.run.is_some()).count() >= STEPPED_SINES_LEAST;
        let (motor, beam) = by_regression.filter(|_| !stepped).unzip();
        let known = (rigid.or(motor), beam.flatten().or(tips));
        let constant = self.prepared.campaign().channels.command.torque_per_unit();
        let (motor_model, beam_model) =
            motor_and_beam(self.prepared.campaign(), &points, constant, known);
        let mut findings: Vec<Finding> = contradicted.into_iter().collect();
        // After the models: they weigh each band by its standard error.
        findings.extend(uncertain(&mut points));
        findings.extend(weak_points(&points, self.prepared.runs()));
        Responses { points, motor_model, beam_model, findings }
    }

    fn table(&self, coulomb: Option<Estimate>, replayed: &Replayed<'_>) -> Vec<ResponsePoint> {
        let (campaign, runs) = (self.prepared.campaign(), self.prepared.runs());
        response_table(campaign, runs, coulomb, replayed, self.prepared.findings())
    }

    /// Responses without friction of the runs that were replayed.
    fn replayed(&self, found: &'a OutputError) -> Replayed<'a> {
        let (used, runs) = (self.prepared.used(), self.prepared.runs());
        let place = |run: usize| self.prepared.kept().iter().position(|&k| k == run);
        let sinusoidal = |(index, run): (usize, &RunAnalysis)| {
            let RunKind::Sinusoidal(steady) = &run.kind else { return None };
            let run = place(index)?;
            FrictionWaveform { found, campaign: used, run, steady }.response()
        };
        let general: Vec<usize> = general(runs).into_iter().filter_map(place).collect();
        Replayed {
            sinusoidal: runs.iter().enumerate().map(sinusoidal).collect(),
            bands: ReplayedBands::new(found, used, &general).map(|bands| Box::new(bands) as Box<_>),
        }
    }
}

/// The model of an axis without tips that the replay found rigid.
pub(crate) fn rigid_model(campaign: &Campaign, replay: &OutputError) -> Option<MotorFit> {
    if !(campaign.channels.tips.is_empty() && replay.is_rigid()) {
        return None;
    }
    let command = &campaign.channels.command;
    let viscous = replay.friction(command.back_emf_viscous).viscous?;
    // Without correlation: the linear models of an accepted arm have its own covariance.
    let drive = [replay.inertia()?, viscous];
    MotorFit::of_estimates(&drive, &DMatrix::identity(2, 2), None, command)
}
