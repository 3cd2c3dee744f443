//! The responses of a campaign, in the form that Section 4 needs.

use crate::identify::equivalent::data::{EquivalentData, StdSource};
use crate::identify::equivalent::refusal::EquivalentRefusal;
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::{MotorData, TipForm};
use crate::identify::responses::response_point::ResponsePoint;
use crate::identify::responses::response_table::tip_model;
use crate::identify::responses::thresholds::RESPONSE_FLOOR;
use crate::record::{Campaign, Channels};

impl EquivalentData {
    /// Takes the responses that [`identify`](fn@crate::identify::identify) has computed: θ_i/θ_m of those
    /// tips that measure angles, at the frequencies where all of them are known, and the motor's response
    /// where no finding speaks against it.
    ///
    /// # Errors
    /// [`EquivalentRefusal::NoAngle`] if no tip measures an angle.
    pub fn of_campaign(
        campaign: &Campaign,
        responses: &[ResponsePoint],
    ) -> Result<Self, EquivalentRefusal> {
        let channels: &Channels = &campaign.channels;
        // A tip that stands still in every run has no response anywhere.
        let shown = |i: usize| responses.iter().any(|p| p.tips.get(i).copied().flatten().is_some());
        let angle = |i: &usize| {
            let tip = &channels.tips[*i];
            let any = Response { value: num_complex::Complex64::ONE, std: 1.0 };
            tip_model(tip.quantity, tip.calibrated, any).0 == TipForm::Angle && shown(*i)
        };
        let angles: Vec<usize> = (0..channels.tips.len()).filter(angle).collect();
        if angles.is_empty() {
            return Err(EquivalentRefusal::NoAngle);
        }
        let at = |point: &ResponsePoint| -> Option<Vec<Response>> {
            let each = angles.iter().map(|&i| {
                let tip = &channels.tips[i];
                let measured = point.tips.get(i).copied().flatten()?;
                Some(trusted(tip_model(tip.quantity, tip.calibrated, measured).1))
            });
            each.collect()
        };
        let rows: Vec<(f64, Vec<Response>)> =
            responses.iter().filter_map(|p| Some((p.omega_rad_s, at(p)?))).collect();
        let motor: Vec<(f64, Response)> = responses
            .iter()
            .filter(|p| !p.flagged)
            .filter_map(|p| Some((p.omega_rad_s, trusted(p.motor_corrected?))))
            .collect();
        let motor = MotorData {
            omega_rad_s: motor.iter().map(|p| p.0).collect(),
            response: motor.iter().map(|p| p.1).collect(),
            torque_per_command: channels.command.torque_per_unit(),
        };
        Ok(Self {
            names: angles.iter().map(|&i| channels.tips[i].name.clone()).collect(),
            omega_rad_s: rows.iter().map(|r| r.0).collect(),
            outputs: (0..angles.len()).map(|i| rows.iter().map(|r| r.1[i]).collect()).collect(),
            motor: Some(motor).filter(|m| !m.response.is_empty()),
            std_source: StdSource::Floored,
        })
    }
}

fn trusted(response: Response) -> Response {
    Response { std: response.std.hypot(RESPONSE_FLOOR * response.value.norm()), ..response }
}
