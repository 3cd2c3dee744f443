//! Modes of the beam and its tips.

use lissom_text::significant;

use crate::finding::Severity::{Info, Refusal, Warning};
use crate::finding::result_key as key;
use crate::finding::{counted, findings};
use crate::identify::estimate::Estimate;
use crate::identify::findings::number_text::with_error;
use crate::identify::findings::units::EstimateUnits;

findings! {
    /// No mode explains the tips' responses. The split of inertia between motor and beam rests on what moves the tips.
    "modes-not-found" ModesNotFound {}
        Refusal, [key::MODES, key::COUPLING, key::INERTIA],
        "no mode explains the responses of the tips to the motor: modes are not given",
        "use six or more frequencies near the beam's resonance, or a sweep";

    /// The motor's response looks flexible, and no tip is measured.
    "hidden-mode" FlexibleWithoutTip { omega_rad_s: f64 }
        Warning, [key::INERTIA, key::VISCOUS, key::COULOMB],
        format!("the motor's response shows a flexible mode near {} rad/s (motor clamped), but no tip is measured: the estimates \
            are rough", significant(*omega_rad_s, 3)),
        "measure a tip";

    /// A tip measures acceleration or has an unknown scale. If no tip is measured as an angle, the inertia is that of
    /// motor and beam together.
    "tip-without-angle" TipWithoutAngle { tip: String, acceleration: bool, inertia_with_beam: bool }
        if *inertia_with_beam { Warning } else { Info },
        if *inertia_with_beam { &[key::COUPLING, key::INERTIA][..] } else { &[key::COUPLING] },
        format!("the sensor \"{tip}\" {}: slip phases give modes from it, but no coupling, which is given only where another \
            method has one{}", if *acceleration { "measures acceleration" } else { "has an unknown scale" },
            if *inertia_with_beam { ". The inertia is approximately that of motor and beam together" } else { "" }),
        "measure the angle or the deflection of the tip if you need the coupling";

    /// The responses show more modes than there are tips.
    "more-modes-than-tips" MoreModesThanTips { modes: usize, tips: usize }
        Warning, [key::COUPLING, key::INERTIA],
        format!("the responses show {}, but only {} measured: the tips do not give the whole coupling torque. The inertia \
            includes that of the missing modes and is too large, and the coupling is too small",
            counted(*modes, "mode", "modes"), counted(*tips, "tip is", "tips are")),
        "measure as many points as there are modes in the band";

    /// The damping ratio of a mode, counted from 1, comes out negative.
    "negative-estimate" NegativeDamping { mode: usize, ratio: Estimate }
        Refusal, [key::MODES],
        format!("the damping ratio of mode {mode} would be {}, but a beam cannot gain energy: the ratio is not given",
            with_error(*ratio)),
        "add runs near the frequency of the mode, where damping acts most";

    /// The coupling is too uncertain, and friction and inertia come from the equation without it. The residual torque is
    /// given with the coupling, and without it.
    "rigid-equation" RigidEquation { coupling: Estimate, units: EstimateUnits, residual_shares: [f64; 2] }
        Refusal, [key::COUPLING],
        format!("the coupling to the beam would be {} {}, which is too uncertain: it is not given. Friction and inertia come \
            from the equation without it, whose residual is {} % of the torque ({} % with the coupling). The inertia is that of \
            motor and load together", with_error(*coupling), units.stiffness(),
            significant(100.0 * residual_shares[1], 3), significant(100.0 * residual_shares[0], 3)),
        "add runs near the beam's resonance, where the coupling acts most; check the sign and scale of the tip";

    /// The coupling of the only tip is negative.
    "reversed-sign" CouplingSign {}
        Refusal, [key::COUPLING, key::MODES],
        "the coupling is negative, as if the beam pushed the motor away: the sign of the tip seems to be reversed",
        "give the tip a negative scale in the campaign";
}
