//! Regression in slip phases: quality of the fit, and effects that the motor's equation does not contain.

use std::f64::consts::TAU;

use lissom_text::significant;

use crate::finding::Severity::{Info, Refusal, Warning};
use crate::finding::result_key as key;
use crate::finding::{counted, findings};
use crate::identify::estimate::Estimate;
use crate::identify::findings::number_text::with_error;
use crate::identify::findings::regression_words::{
    DIGITS, looks_like, moved_by, moved_by_hold, moved_keys, possible, without_mode,
};
use crate::identify::findings::units::EstimateUnits;
use crate::identify::methods::friction_law::{self, LagShape, MissingKind, MovingTerm};
use crate::identify::methods::regression::{self, GravityPartner, OtherHold};
use crate::record::Hold;

findings! {
    /// The regression gives no estimates; the share is `None` if there are too few slip phases.
    "regression-refused" RegressionRefused { residual_share: Option<f64>, explained: bool, by_least_squares: bool }
        Refusal, key::JOINT,
        format!("{}: the regression gives no estimates{}", match residual_share {
            Some(share) => format!("{:.0} % of the windowed torque is not explained by the motor's equation", 100.0 * share),
            None => "too few slip phases are long enough for a window".to_owned(),
        }, if *by_least_squares {
            ". Those of ordinary least squares may be wrong by many of their standard errors, which count only noise"
        } else {
            ""
        }),
        if *explained {
            "first add the missing term that another finding reports"
        } else {
            "use longer moves in both directions at a measured current, with more samples in each; measure the tip of a \
                flexible beam; check columns, units and signs"
        };

    /// There are too few strokes to show how friction varies from one stroke to the next. The estimates come from a
    /// method whose standard errors include a variation by this share of Coulomb friction, or none.
    "few-phases" FewPhases { phases: usize, variation: Option<f64> }
        if variation.is_some() { Info } else { Warning }, key::JOINT,
        format!("{} cannot show how friction varies from one stroke to the next: standard errors include {}",
            counted(*phases, "stroke", "strokes"), match variation {
                None => "only the variation within a stroke, and may be too small".to_owned(),
                Some(share) => format!("a usual variation of {:.0} % of Coulomb friction", 100.0 * share),
            }),
        "log four strokes or more in each direction";

    /// Gravity can hardly be separated from another term.
    "gravity-unseparated" GravityUnseparated { with: GravityPartner, correlation: f64 }
        Warning, match with {
            GravityPartner::Inertia => &[key::INERTIA, key::GRAVITY][..],
            GravityPartner::Offset => &[key::COULOMB, key::OFFSET, key::GRAVITY],
        },
        format!("these runs hardly separate gravity from {} (correlation {correlation:.2}): both are uncertain", match with {
            GravityPartner::Inertia => "inertia",
            GravityPartner::Offset => "a constant load",
        }),
        match with {
            GravityPartner::Inertia => "move over a larger angle, or at other frequencies: the torque of inertia grows with \
                the square of the frequency, that of gravity does not",
            GravityPartner::Offset => "move over a longer arc: over a short one gravity is nearly constant",
        };

    /// The load's known m·g·l and the given torque constant contradict each other.
    "torque-constant" TorqueConstant { by_gravity: Estimate, given: f64, units: EstimateUnits }
        Warning, key::JOINT,
        format!("the known m·g·l of the load gives a torque constant of {} N·m per {}, but the campaign gives {}: all estimates \
            in N·m use the value of the campaign", with_error(*by_gravity), units.command(), significant(*given, DIGITS)),
        "check both values, and gear_ratio; if you leave out torque_constant, the load gives it";

    /// The regression does not explain a large part of the torque.
    "unexplained-torque" UnexplainedTorque { residual_share: f64 }
        Warning, key::JOINT,
        format!("{:.0} % of the windowed torque is not explained by the motor's equation: errors of the estimates may be larger \
            than their standard errors", 100.0 * residual_share),
        "check units and signs; look for a delay, a load, other friction, or a flexible mode without a tip";

    /// The inertia may be too small, because the residual torque may accelerate the motor.
    "inertia-short" InertiaShort { short_by: f64 }
        Warning, [key::INERTIA],
        format!("inertia is up to {:.0} % too small if the residual torque is friction that wanders, because it then \
            accelerates the motor as the command does", 100.0 * short_by),
        "accelerate more: faster and larger moves, under control of position or speed";

    /// All runs are a sine of one frequency.
    "one-sine" OneSine {}
        Warning, [key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES],
        "all runs are a sine of one frequency: only the harmonics due to friction separate motor and beam, and systematic \
            errors repeat in every period. Errors of the estimates may be larger than their standard errors",
        "use the output-error method, or add a run at another frequency";

    /// The motor's equation lacks a term.
    "missing-term" MissingTerm { term: friction_law::MissingTerm, units: EstimateUnits }
        Warning, match term.kind {
            // A load may be most of the torque: it moves all.
            MissingKind::Gravity => vec![key::COULOMB, key::OFFSET, key::VISCOUS, key::INERTIA],
            kind => {
                let beam = if kind == MissingKind::BeamDamping { &[key::MODES][..] } else { &[] };
                [&moved_keys(&term.moves), &[key::OFFSET, key::GRAVITY, key::COUPLING][..], beam].concat()
            }
        },
        format!("it looks as if {} (blocks that were left out are predicted better by {:.0} standard errors; with this term the \
            residual torque is {:.2} times as large). The model has no such term: {}",
            looks_like(term, *units), term.standard_errors, term.residual_ratio, moved_by(term)),
        match term.kind {
            MissingKind::Gravity => "add [load] gravity = true to the campaign",
            MissingKind::Position => "look for gravity, a spring, cogging, a wrong scale of a tip, or a position loop between \
                the logged command and the motor",
            MissingKind::BeamDamping => "use the output-error method: it identifies damping within the beam",
            MissingKind::CommandBySign => "the cause may be an amplifier that is stronger in one direction, or a current \
                sensor with two gains: log the current itself, and calibrate it in both directions",
            MissingKind::WithTorque => "a gear's friction may grow with the torque that it carries: compare results only at \
                similar loads",
            MissingKind::OverTravel => "the estimates are means over the travel: identify parts of it separately, or look for a \
                bent or worn part",
            MissingKind::CoulombDrift => "the joint may have warmed up, worn or been lubricated: warm it up first, or identify \
                the runs separately",
            MissingKind::ViscousDrift => "the joint may have warmed up: warm it up first, or identify the runs separately",
        };

    /// A term that is not known to be absent would change estimates by many of their standard errors.
    "possible-term" PossibleTerm { term: MovingTerm }
        Info, moved_keys(&term.moves),
        {
            let (name, changes) = possible(term);
            format!("these logs hardly tell {name} from the rest: the model does not contain it, and if it were there, estimates \
                would change ({changes}). Their standard errors count this")
        },
        "log motion that separates the two: other speeds, other accelerations, both directions, more of the travel";

    /// The motor's motion shows a flexible mode, which the estimates of slip phases account for.
    "hidden-mode" HiddenMode { mode: regression::HiddenMode }
        Info, moved_keys(&mode.moves),
        format!("no tip whose angle is known is measured, but the motor's motion shows a flexible mode at {} Hz (motor clamped) \
            with a damping ratio of {}. {} % of the inertia is on the motor's side of the spring. The estimates account for the \
            mode, and the inertia given is the total. {}", significant(mode.omega_rad_s.value / TAU, DIGITS),
            significant(mode.damping_ratio.value, 2), significant(100.0 * mode.inertia_share.value, 2), without_mode(mode)),
        "to see how the flexible part moves, measure the angle behind it as a tip";

    /// Friction, or a load, changes from one slip phase to the next, by this share of Coulomb friction (rms).
    "friction-varies" FrictionVaries { by: f64 }
        Info, [key::COULOMB, key::VISCOUS],
        format!("friction, or a load, changes from one slip phase to the next by {} % of Coulomb friction (rms). The estimates \
            are means over the logs, and their standard errors include this variation", significant(100.0 * by, 2)),
        "nothing to do for the estimates; a simulation with constant friction departs from the log by this amount. Warm up the \
            joint, or log for longer, to see whether friction settles";

    /// The angle lags behind the command.
    "angle-lag" AngleLag { lag: friction_law::AngleLag }
        Warning, key::JOINT,
        format!("the {} by {} of {} ms ({:.2} samples): with this lag the residual torque is {:.2} times as large. The \
            estimates account for it",
            if lag.time_s < 0.0 {
                "command is logged late and lags behind the angle"
            } else {
                "angle lags behind the command"
            },
            match lag.shape {
                LagShape::Filter => "a first-order filter",
                LagShape::Delay => "a delay",
                LagShape::Either => "a filter or a delay",
            },
            significant(1e3 * lag.time_s.abs(), 2), lag.samples.abs(), lag.residual_ratio),
        if lag.is_half_a_sample() {
            "half a sample is the difference between a held and a measured command: check `hold`"
        } else if lag.time_s < 0.0 {
            "log the current before it is filtered; near reversals friction may differ from the estimates by more than their \
                standard errors"
        } else {
            "log the angle before the drive filters it; near reversals friction may differ from the estimates by more than \
                their standard errors"
        };

    /// A tip is read later than the motor, if viscous friction is not negative.
    "tip-lag" TipReadLate { tip: String, lag_s: Estimate }
        Warning, [key::VISCOUS, key::TIP_RESPONSES],
        format!("tip {tip} is read {} ms later than the motor, if nothing but load and spring moves it; with its readings as \
            they are logged viscous friction is negative. The estimates account for it, the measured frequency responses do not",
            with_error(lag_s.scaled(1e3))),
        "check for a delay of the bus, camera or filter of this tip. If there is none, the load is damped against the frame, and \
            viscous friction is that of both sides";

    /// It is not known whether the command is held between its samples, and estimates depend on it.
    "hold-assumed" HoldAssumed { other: OtherHold, units: EstimateUnits }
        Warning, moved_by_hold(other, *units).into_iter().map(|(key, _)| key).collect::<Vec<_>>(),
        {
            let changes: Vec<String> = moved_by_hold(other, *units).into_iter().map(|(_, change)| change).collect();
            let (taken, if_it_is) = match other.taken {
                Hold::Measured => ("measured by a sensor", "held"),
                Hold::Sampled => ("held", "measured by a sensor"),
            };
            format!("it is not known whether the command is held between its samples; it is taken as {taken}. If it is \
                {if_it_is}, the regression gives other estimates: {}", changes.join(", "))
        },
        "say how the command was logged: hold = \"sampled\" for a value that the controller sets and holds, hold = \"measured\" \
            for that of a sensor";
}
