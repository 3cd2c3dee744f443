//! The model of an arm, with everything that the options ask for.

use std::f64::consts::TAU;

use indicatif::ProgressBar;
use lissom::arm::Arm;
use lissom::beam::{
    Base, Beam as ArmBeam, BeamError, Damping, LumpedBeam, MOST_CHECKED, MOST_MASSES, ModalBeam,
    angle_per_current, properties,
};
use lissom::drive::{Coulomb, Motor};
use lissom::lti::{StateSpace, ZeroPoleGain};
use lissom_io::BeamKind;
use lissom_io::model::{Function, Model, Responses};
use lissom_views::digits::shown;
use num_complex::Complex64;

use super::any_beam::{Beam, MOST_DENSE, beam_failure};
use super::load_study;
use crate::args::model_args::ModelArgs;
use crate::shared::failure::Failure;

/// Largest number of masses for which matrices and polynomials are printed.
pub(crate) const MOST_SHOWN: usize = 6;

/// Largest number of masses for which transfer functions and responses of all masses are given. With more masses they
/// are those of the tip, unless `--all` is given.
const MOST_LISTED: usize = 20;

/// Relative accuracy that a state space should have.
const KEPT: f64 = 1e-6;

/// Largest phase of the waves along a beam \[rad\] for which responses are computed.
const WAVES_MOST: f64 = 1e5;

/// Steps of the progress bar, without frequencies and loads.
pub(crate) const STEPS: usize = 7;

/// A beam, its drive, and the options.
pub(crate) struct Task<'a> {
    pub(crate) args: &'a ModelArgs,
    pub(crate) beam: &'a Beam,
    pub(crate) drive: Option<(Motor, Coulomb)>,
    pub(crate) omega_rad_s: Option<Vec<f64>>,
    pub(crate) bar: ProgressBar,
}

impl Task<'_> {
    /// Computes the model.
    pub(crate) fn model(&self) -> Result<Model, Failure> {
        let beam = self.beam;
        self.check_reach(self.omega_rad_s.as_deref().unwrap_or(&[]))?;
        self.step("natural frequencies");
        let count = self.frequency_count();
        let natural_frequencies_rad_s = beam.frequencies_rad_s(Base::Clamped, count);
        let rotor = |(motor, _): &(Motor, Coulomb)| Base::Rotor(motor.inertia_kg_m2());
        let coupled = self.drive.as_ref().map(|drive| beam.frequencies_rad_s(rotor(drive), count));
        let mut model = Model {
            kind: beam.kind(),
            mass_kg: beam.mass_kg(),
            position_m: beam.position_m().to_vec(),
            mass_along_kg: beam.mass_along_kg(),
            hub_radius_m: beam.hub_radius_m(),
            payload: beam.payload(),
            inertia_kg_m2: beam.inertia_kg_m2(),
            matrices: None,
            natural_frequencies_rad_s,
            coupled_frequencies_rad_s: coupled,
            modes: None,
            tip_zeros: None,
            functions: Vec::new(),
            state_space: None,
            truncated: None,
            response: None,
            payload_study: None,
            properties: None,
            notes: Vec::new(),
            warnings: Vec::new(),
        };
        self.step("zeros");
        let highest = model.natural_frequencies_rad_s.last().copied().unwrap_or(0.0);
        model.tip_zeros = beam.tip_zeros(highest, count);
        match beam {
            Beam::Lumped(lumped) => self.lumped(lumped, &mut model)?,
            Beam::Distributed(_) => self.distributed(&mut model),
            Beam::Modal(modal) => self.modal(modal, &mut model)?,
        }
        if model.tip_zeros.is_none() && beam.kind() == BeamKind::Distributed {
            model.warnings.push(
                "the zeros of the tip's response cannot be counted: the parts of the beam differ by too \
                 many orders of magnitude"
                    .to_owned(),
            );
        }
        if let Some(missing) = model.tip_zeros.as_ref().map(|z| z.missing).filter(|m| *m > 0) {
            model.warnings.push(format!("{missing} zeros of the tip's response were not found"));
        }
        if let Some(omega) = &self.omega_rad_s {
            model.response = Some(self.response(omega, &mut model));
        }
        if !self.args.payload.is_empty() {
            let count = if beam.len() <= MOST_DENSE { count } else { self.args.modes };
            let cases =
                load_study::study(&self.args.arm, beam, &self.args.payload, count, &self.bar)?;
            model.payload_study = Some(cases);
        }
        if self.args.properties {
            self.step("properties");
            self.properties(&mut model)?;
        }
        self.bar.finish_and_clear();
        Ok(model)
    }

    fn step(&self, what: &'static str) {
        self.bar.set_message(what);
        self.bar.inc(1);
    }

    fn frequency_count(&self) -> usize {
        match self.beam {
            Beam::Lumped(beam) if beam.len() <= MOST_MASSES => usize::MAX,
            _ => self.args.modes,
        }
    }

    /// The masses for which transfer functions and responses are given.
    fn listed(&self) -> Vec<usize> {
        let n = self.beam.len();
        let most = if self.args.all { MOST_DENSE } else { MOST_LISTED };
        if n <= most { (0..n).collect() } else { vec![n - 1] }
    }

    fn lumped(&self, beam: &LumpedBeam, model: &mut Model) -> Result<(), Failure> {
        let n = beam.len();
        self.step("modes");
        if n <= MOST_MASSES {
            let count = if n <= MOST_DENSE { usize::MAX } else { self.args.modes };
            model.modes = Some(beam.modes(count));
        }
        if n > MOST_DENSE {
            model.notes.push(format!(
                "matrices, transfer functions and state space are not given for more than {MOST_DENSE} \
                 masses"
            ));
            let lowest = self.args.modes;
            model.notes.push(if n > MOST_MASSES {
                format!(
                    "only the lowest {lowest} of {n} natural frequencies and {} zeros are given (--modes), \
                     without mode shapes",
                    n - 1
                )
            } else {
                format!("only the shapes of the lowest {lowest} modes are given (--modes)")
            });
            if model.tip_zeros.is_none() {
                model.notes.push(format!(
                    "with a payload that has rotary inertia or an offset, zeros are given for at most {MOST_DENSE} \
                     masses"
                ));
            }
            return Ok(());
        }
        if n > MOST_SHOWN {
            model.notes.push(format!(
                "matrices and polynomials of more than {MOST_SHOWN} masses are not printed; --json has them"
            ));
        }
        if let Damping::Modal { ratios } = beam.damping() {
            check_ratios(ratios, model);
        }
        self.step("matrices");
        model.matrices = Some(beam.matrices().map_err(|e| self.failed(e))?);
        self.linear(&beam.clone().into(), model)
    }

    /// A beam that is known by its modes has no matrices.
    fn modal(&self, beam: &ModalBeam, model: &mut Model) -> Result<(), Failure> {
        self.step("modes");
        model.modes = Some(beam.modes(usize::MAX));
        model.notes.push(
            "the beam is known by its modes only: it has no lengths and masses, points have numbers, and \
             mode shapes are angles"
                .to_owned(),
        );
        self.linear(&beam.clone().into(), model)
    }

    /// Adds state space and transfer functions.
    fn linear(&self, beam: &ArmBeam, model: &mut Model) -> Result<(), Failure> {
        if let Some((motor, coulomb)) = self.drive {
            let arm = Arm::new(beam.clone(), motor, coulomb).map_err(|e| self.failed(e))?;
            let space = arm.state_space();
            if let Some((omega, off)) = lost(&arm, &space) {
                model.warnings.push(format!(
                    "the state space is inaccurate, because the stiffnesses differ very much: its θ_m/i has a \
                     relative error of {} at {} rad/s; use the transfer functions instead",
                    shown(off, 2),
                    shown(omega, 3)
                ));
            }
            model.state_space = Some(space);
        }
        self.step("transfer functions");
        self.functions(beam, model);
        Ok(())
    }

    fn functions(&self, beam: &ArmBeam, model: &mut Model) {
        let listed = self.listed();
        if listed.len() < beam.len() {
            model.notes.push(format!(
                "for more than {MOST_LISTED} masses only the transfer functions and responses of the tip \
                 are given (--all gives every mass)"
            ));
        }
        let motor = self.drive.map(|(motor, _)| (motor, beam.motor_function(&motor)));
        let function = |from, to: String, roots| Function { from, to, roots, lowest: false };
        let name = |mass: usize| format!("theta_{}", mass + 1);
        let (mut angles, mut driven) = (Vec::new(), Vec::new());
        for mass in listed {
            self.bar.inc(1);
            let Some(angle) = beam.angle_function(mass) else { continue };
            if let Some((motor, from_current)) = &motor {
                driven.push(function(
                    "current",
                    name(mass),
                    angle_per_current(&angle, from_current, motor),
                ));
            }
            angles.push(function("motor", name(mass), angle));
        }
        angles.push(function("motor", "coupling_torque".to_owned(), beam.coupling_function()));
        if let Some((_, from_current)) = motor {
            angles.push(function("current", "motor".to_owned(), from_current));
        }
        model.functions = angles;
        model.functions.append(&mut driven);
        for f in model.functions.iter().filter(|f| f.roots.missing > 0) {
            model.warnings.push(format!(
                "{} roots of {}/{} were not found to ten digits: its polynomials are not given",
                f.roots.missing, f.to, f.from
            ));
        }
        let large = model.functions.iter().filter(|f| f.roots.missing == 0);
        let large = large.filter(|f| f.roots.transfer_function().is_none()).count();
        if large > 0 {
            model.notes.push(format!(
                "the polynomials of {large} transfer functions exceed the range of a double: use zeros, \
                 poles and gain"
            ));
        }
    }

    fn distributed(&self, model: &mut Model) {
        let Beam::Distributed(beam) = self.beam else { return };
        self.step("modes");
        model.modes = Some(beam.modes(self.args.modes, beam.position_m()));
        model.notes.push(
            "a beam with mass along it has no matrices, and infinitely many frequencies and zeros: the \
             lowest frequencies are given (--modes), and the zeros below the highest of them; \
             `truncated` in --json is a model of its first modes, in the form of the matrices"
                .to_owned(),
        );
        if !self.beam.is_undamped() {
            model.notes.push(
                "frequencies, zeros, poles and modes are without damping; responses are with damping"
                    .to_owned(),
            );
        }
        let poles: Vec<Complex64> = model
            .natural_frequencies_rad_s
            .iter()
            .flat_map(|w| [Complex64::new(0.0, *w), Complex64::new(0.0, -*w)])
            .collect();
        if let Some(found) = &model.tip_zeros {
            let zeros = found.z.iter().flat_map(|z| [z.sqrt(), -z.sqrt()]).collect();
            let roots = ZeroPoleGain { zeros, poles, gain: f64::NAN, missing: found.missing };
            let to = format!("theta_{}", beam.pieces().len());
            model.functions.push(Function { from: "motor", to, roots, lowest: true });
        }
        self.step("truncated model");
        if beam.pieces().len() <= MOST_LISTED {
            match beam.truncated(beam.position_m()) {
                Ok(truncated) => model.truncated = Some(truncated),
                Err(error) => model.notes.push(format!("no truncated model: {error}")),
            }
        } else {
            model.notes.push(format!(
                "no truncated model: it has one mode for each span, and is given for at most {MOST_LISTED} \
                 spans"
            ));
        }
    }

    /// Refuses frequencies at which a distributed beam bends in so many waves that a response takes seconds.
    fn check_reach(&self, omega_rad_s: &[f64]) -> Result<(), Failure> {
        let Beam::Distributed(beam) = self.beam else { return Ok(()) };
        let highest = omega_rad_s.iter().copied().fold(0.0, f64::max);
        let waves = beam.wave_radians(highest);
        if waves <= WAVES_MOST {
            return Ok(());
        }
        let reached = highest * (WAVES_MOST / waves).powi(2);
        Err(Failure::Model {
            arm: self.args.arm.clone(),
            reason: format!(
                "at {} rad/s the beam bends in {} waves; responses are computed only up to {} rad/s",
                shown(highest, 3),
                shown(waves / TAU, 3),
                shown(reached, 3)
            ),
            hint: "give a lower --omega: the model of a thin beam fails at much lower frequencies already",
        })
    }

    fn response(&self, omega_rad_s: &[f64], model: &mut Model) -> Responses {
        self.bar.set_message("responses");
        let masses = self.listed();
        let mut r = Responses {
            omega_rad_s: omega_rad_s.to_vec(),
            tips: vec![Vec::with_capacity(omega_rad_s.len()); masses.len()],
            coupling: Vec::with_capacity(omega_rad_s.len()),
            motor: self.drive.map(|_| Vec::with_capacity(omega_rad_s.len())),
            masses,
        };
        for omega in omega_rad_s {
            let s = Complex64::new(0.0, *omega);
            let beam = self.beam.response(s);
            for (list, mass) in r.tips.iter_mut().zip(&r.masses) {
                list.push(beam.angles[*mass]);
            }
            r.coupling.push(beam.coupling_nm_per_rad);
            if let (Some(list), Some((motor, _))) = (&mut r.motor, &self.drive) {
                list.push(motor_response(motor, s, beam.coupling_nm_per_rad));
            }
            self.bar.inc(1);
        }
        let all = r.tips.iter().flatten().chain(&r.coupling).chain(r.motor.iter().flatten());
        if !all.clone().all(|v| v.is_finite()) {
            model.warnings.push(
                "some responses are not finite: without damping there is no response at a pole"
                    .to_owned(),
            );
        }
        r
    }

    /// Checks the properties of Section 3 of the 1989 report, if the beam has point masses.
    fn properties(&self, model: &mut Model) -> Result<(), Failure> {
        match self.beam {
            Beam::Distributed(_) => model.notes.push(
                "--properties has no effect: Section 3 is about beams with point masses, and this beam has \
                 mass along it"
                    .to_owned(),
            ),
            Beam::Modal(_) => model.notes.push(
                "--properties has no effect: Section 3 is about beams with point masses, and this beam is \
                 known by its modes"
                    .to_owned(),
            ),
            Beam::Lumped(beam) if beam.len() > MOST_CHECKED => model.notes.push(format!(
                "--properties has no effect: the properties are checked for at most {MOST_CHECKED} masses"
            )),
            Beam::Lumped(beam) => {
                model.properties = Some(properties(beam).map_err(|e| self.failed(e))?);
            }
        }
        Ok(())
    }

    fn failed(&self, source: BeamError) -> Failure {
        beam_failure(&self.args.arm, source)
    }
}

/// Warns of possible mistakes in a list of damping ratios.
fn check_ratios(ratios: &[f64], model: &mut Model) {
    let modes = model.natural_frequencies_rad_s.len();
    if ratios.len() > modes {
        model.warnings.push(format!("{} damping ratios for {modes} modes", ratios.len()));
    }
    if let Some(ratio) = ratios.iter().find(|r| **r >= 1.0) {
        model.warnings.push(format!(
            "a damping ratio of {ratio}: such a mode does not oscillate; write percent as \"{ratio} %\""
        ));
    }
}

/// The frequency at which θ_m/i of the state space has the largest relative error, and this error; `None` if it is at
/// most [`KEPT`].
fn lost(arm: &Arm, space: &StateSpace) -> Option<(f64, f64)> {
    let frequencies = arm.beam().frequencies_rad_s(Base::Clamped, 3);
    let low = [0.001, 0.03, 0.3].map(|part| part * frequencies[0]);
    let between = frequencies.windows(2).map(|w| (w[0] * w[1]).sqrt());
    low.into_iter()
        .chain(between)
        .map(|omega| {
            let exact = arm.motor_response(omega);
            let found = space.response(omega).map(|g| g[(0, 0)]);
            (omega, found.map_or(f64::INFINITY, |g| (g - exact).norm() / exact.norm()))
        })
        .filter(|(_, off)| off.is_nan() || *off > KEPT)
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The response θ_m/i at s.
pub(crate) fn motor_response(motor: &Motor, s: Complex64, coupling: Complex64) -> Complex64 {
    motor.torque_constant_nm_per_a() / (motor.impedance(s) + coupling)
}
