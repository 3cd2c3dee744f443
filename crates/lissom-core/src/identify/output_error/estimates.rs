//! Estimates of friction, drive and beam from the identified arm.

use crate::friction::Root;
use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::friction_estimates::{Friction, LawEstimates};
use crate::identify::gravity_estimate::Gravity;
use crate::identify::methods::friction_law::{FrictionLaw, LawFit, LawTerm, Motion, Unused};
use crate::identify::output_error::found::OutputError;
use crate::identify::output_error::model::describes::{accepted_residual, is_left, is_sound};
use crate::identify::output_error::thresholds::KNOWS_MORE;
use crate::record::{Channels, TipQuantity};
use crate::replay::{DryTerms, FrictionNumber, ModalArm, Oscillator, Parameter};

impl OutputError {
    /// Friction, without the damping by the back-EMF of the command. With further terms the line is the law's own Coulomb and
    /// viscous friction.
    pub fn friction(&self, back_emf_viscous: f64) -> Friction {
        self.friction_at(back_emf_viscous, None)
    }

    /// The same with the line that is nearest to the law in some motion.
    fn friction_at(&self, back_emf_viscous: f64, motion: Option<&Motion>) -> Friction {
        let viscous = |direction: usize| {
            self.estimate_of(|arm| arm.viscous_nm_s_per_rad[direction] - back_emf_viscous)
        };
        let mean = |arm: &ModalArm| Parameter::Viscous.of(arm) - back_emf_viscous;
        let split = self.parameters.contains(&Parameter::ViscousDifference);
        let law = LawEstimates {
            coulomb: self.estimate(Parameter::Coulomb),
            forward: Some(self.estimate_of(|arm| arm.coulomb_nm + arm.offset_nm)),
            backward: Some(self.estimate_of(|arm| arm.coulomb_nm - arm.offset_nm)),
            viscous: Some(self.estimate_of(mean)),
            viscous_by_direction: split.then(|| (viscous(0), viscous(1))),
            ..self.terms()
        };
        let line = |arm: &ModalArm, motion: &Motion| -> [f64; 2] {
            let DryTerms { near_rest, root, with_load, .. } = &arm.dry_terms;
            let by_speed = |speed: f64| {
                let near = near_rest.map_or(0.0, |near| {
                    near.torque_nm * near.falloff.share(speed / near.speed_rad_s)
                });
                near + root.map_or(0.0, |r| r.torque_nm_per_root_rad_s * Root::growth(speed))
            };
            let by_load = |angle: f64| with_load.map_or(0.0, |w| w.coefficient * w.load_nm(angle));
            let [level, slope] = motion.line_of(by_speed, by_load);
            [arm.coulomb_nm + level, mean(arm) + slope]
        };
        let bends = law.near_rest.is_some() || law.root.is_some() || law.with_load.is_some();
        let offset = self.estimate(Parameter::Offset);
        let Some(motion) = motion.filter(|_| bends) else {
            return Friction {
                coulomb: law.coulomb,
                forward: law.forward,
                backward: law.backward,
                offset,
                viscous: law.viscous,
                law: law.has_terms().then_some(law),
            };
        };
        let scatter = motion.scatter(|motion| line(&self.arm, motion));
        let counted = |e: Estimate, i: usize| Some(Estimate { std: e.std.hypot(scatter[i]), ..e });
        let level = |sign: f64| {
            counted(self.estimate_of(|arm| line(arm, motion)[0] + sign * arm.offset_nm), 0)
        };
        Friction {
            coulomb: level(0.0),
            forward: level(1.0),
            backward: level(-1.0),
            offset,
            viscous: counted(self.estimate_of(|arm| line(arm, motion)[1]), 1),
            law: Some(law),
        }
    }

    /// Terms of friction other than Coulomb friction, offset and viscous friction.
    fn terms(&self) -> LawEstimates {
        let number = |number: FrictionNumber| self.estimate(Parameter::Friction(number));
        let any = |of: &dyn Fn(&DryTerms) -> f64| self.estimate_of(|arm| of(&arm.dry_terms));
        let near = |arm: &ModalArm| arm.dry_terms.near_rest.map_or(0.0, |n| n.torque_nm);
        let at_rest = || self.estimate_of(|arm| arm.coulomb_nm + near(arm));
        LawEstimates::of_terms(&self.arm.dry_terms, number, any, at_rest)
    }

    /// Terms of friction beyond Coulomb friction and one viscous coefficient, as terms of a law.
    pub fn law_terms(&self) -> Vec<(LawTerm, Vec<Estimate>)> {
        let mut terms = Vec::new();
        if let Some(difference) = self.estimate(Parameter::ViscousDifference) {
            terms.push((LawTerm::ViscousByDirection, vec![difference]));
        }
        let law = self.terms();
        terms.extend(law.law_terms());
        let with_load = self.arm.dry_terms.with_load.zip(law.with_load);
        terms.extend(with_load.map(|(w, e)| (LawTerm::WithLoad { load: w.load }, vec![e])));
        terms
    }

    /// Inertia J.
    pub fn inertia(&self) -> Option<Estimate> {
        self.estimate(Parameter::Inertia)
    }

    /// Friction, inertia and coupling.
    pub fn estimates(&self, channels: &Channels) -> DriveEstimates {
        self.estimates_at(channels, None)
    }

    /// The same with the line of friction in some motion.
    pub(crate) fn estimates_at(
        &self,
        channels: &Channels,
        motion: Option<&Motion>,
    ) -> DriveEstimates {
        let tips = &channels.tips;
        let known = |i: usize| tips[i].calibrated && tips[i].quantity != TipQuantity::Acceleration;
        let coupling_by_tip = self.arm.coupling_by_tip().map_or(Vec::new(), |found| {
            let estimate =
                |i: usize| self.estimate_of(|arm| arm.coupling_by_tip().map_or(f64::NAN, |k| k[i]));
            (0..found.len()).map(|i| known(i).then(|| estimate(i))).collect()
        });
        let flexible = !self.arm.modes.is_empty();
        DriveEstimates {
            friction: self.friction_at(channels.command.back_emf_viscous, motion),
            inertia: self.inertia(),
            coupling: flexible.then(|| self.estimate_of(ModalArm::coupling_nm_per_rad)),
            coupling_by_tip,
            gravity: self.gravity(),
        }
    }

    /// Gravity's torque, where the campaign has it.
    fn gravity(&self) -> Option<Gravity> {
        let places = [Parameter::GravitySine, Parameter::GravityCosine];
        let places = places.map(|g| self.parameters.iter().position(|p| *p == g));
        let [Some(s), Some(c)] = places else { return None };
        let [sine, cosine] =
            [self.estimate(Parameter::GravitySine)?, self.estimate(Parameter::GravityCosine)?];
        Some(Gravity::new(sine, cosine, self.covariance[(s, c)]))
    }

    /// Modes with the motor clamped. One without stiffness is none: it stands for the modes above the others.
    pub fn mode_estimates(&self) -> Vec<ModeEstimate> {
        let mode = |j: usize| ModeEstimate {
            natural_frequency_rad_s: self.estimate_of(|arm| arm.clamped_modes()[j].0),
            damping_ratio: self.estimate_of(|arm| arm.clamped_modes()[j].1),
        };
        let mut ascending: Vec<&Oscillator> = self.arm.modes.iter().collect();
        ascending.sort_by(|a, b| a.omega_rad_s.total_cmp(&b.omega_rad_s));
        let of_beam = |j: &usize| ascending[*j].stiffness_nm_per_rad > 0.0;
        (0..ascending.len()).filter(of_beam).map(mode).collect()
    }

    /// Whether the arm is accepted and describes whole runs: in one window each, or in the longest windows over which
    /// neighbouring motions do not grow apart.
    pub fn describes_whole_runs(&self) -> bool {
        self.whole_runs && self.stands()
    }

    /// Whether some run is replayed in more than one window.
    pub fn is_in_windows(&self) -> bool {
        self.windows.windows(2).any(|pair| pair[0].run == pair[1].run)
    }

    /// Whether the axis is rigid: an arm without modes describes whole runs to the sensors' noise.
    pub fn is_rigid(&self) -> bool {
        self.describes_whole_runs() && self.arm.modes.is_empty() && !is_left(&self.left_over, 0.0)
    }

    /// Whether the arm is accepted. If whole runs are replayed, its residual may be at most a few times the
    /// sensors' noise; if shorter windows are replayed, it must be about that noise. If the regression's
    /// equation lacks a term, the limit of whole runs also holds for shorter windows, because the regression's
    /// estimates would be less accurate. Shorter windows must contain a period of each mode, unless sensors measure the position of each.
    pub fn stands(&self) -> bool {
        self.beyond_noise < self.accepted_residual
            && is_sound(&self.arm, &self.covariance)
            && self.sees_modes
            && (self.command_noise == 0.0 || !is_left(&self.left_over, self.command_noise))
    }

    /// The same beside the regression: over short windows more is accepted where its equation lacks a term, and nothing where
    /// it shows friction that varies, which would be taken for inertia and viscous friction and which standard errors do not count.
    #[must_use]
    pub(crate) fn beside_regression(self, lacks_term: bool, varies: bool) -> Self {
        let accepted_residual = match (lacks_term, varies && !self.whole_runs) {
            (true, _) => accepted_residual(true),
            (_, true) => 0.0,
            _ => self.accepted_residual,
        };
        Self { accepted_residual, ..self }
    }

    /// Whether the standard errors of inertia, viscous and Coulomb friction are clearly less than those of slip phases, in the
    /// geometric mean. Noise of the command disturbs a replay, but no equation of torques that has it on its right side.
    fn knows_more(&self, law: &FrictionLaw) -> bool {
        let LawFit { inertia, viscous, coulomb, .. } = &law.chosen;
        let own = [Parameter::Inertia, Parameter::Viscous, Parameter::Coulomb];
        let ratio = |(own, other): (Parameter, &Option<Estimate>)| -> f64 {
            let own = self.estimate(own).map_or(f64::INFINITY, |e| e.std);
            other.map_or(f64::NEG_INFINITY, |other| (own / other.std).ln())
        };
        let ratios = own.into_iter().zip([inertia, viscous, coulomb]).map(ratio);
        ratios.sum::<f64>() < -3.0 * KNOWS_MORE.ln()
    }

    /// The same beside slip phases: an arm that predicts their torque worse than the line, or than a law of friction, is not
    /// accepted. A lag alone is no reason: the replay has its own.
    #[must_use]
    pub(crate) fn beside_law(self, unused: Option<Unused>, law: Option<&FrictionLaw>) -> Self {
        let of_friction = |law: &&FrictionLaw| {
            law.chosen.terms.iter().any(|(term, _)| !matches!(term, LawTerm::CommandLag))
        };
        let lawful = law.filter(of_friction).map(|law| &law.unused);
        let is_worse = unused.as_ref().is_some_and(|unused| unused.is_worse(lawful));
        let disturbed = self.command_noise > 0.0 && self.arm.shapes.is_empty();
        let knows_less = disturbed && law.is_some_and(|law| !self.knows_more(law));
        let accepted_residual = if is_worse || knows_less { 0.0 } else { self.accepted_residual };
        Self { accepted_residual, unused, ..self }
    }
}
