//! Drives whose torque has a term beyond the line, on motions in closed form and with drawn numbers: a ripple by turns of the
//! motor behind a gear, and friction that grows with the motor's torque.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::identify::findings::rows;
use lissom::identify::{Effort, Estimate, Finding, Identified, MissingKind, Options, identify};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};

const TAU: f64 = std::f64::consts::TAU;
const SEEDS: std::ops::Range<u32> = 0..4;

/// A sequence of uniform numbers between 0 and 1.
struct Draw(u32);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(self.0 >> 8) / f64::from(1 << 24)
    }

    /// A number within a factor.
    fn about(&mut self, value: f64, factor: f64) -> f64 {
        value * factor.powf(2.0 * self.next() - 1.0)
    }
}

struct Drive {
    inertia: f64,
    viscous: f64,
    coulomb: f64,
    /// Frequency \[Hz\], amplitude \[rad\] and phase of each sine of the motion.
    sines: Vec<[f64; 3]>,
}

/// Position, speed, acceleration.
type State = [f64; 3];

impl Drive {
    fn drawn(seed: u32) -> (Self, Draw) {
        let mut draw = Draw(seed.wrapping_mul(2_654_435_761).wrapping_add(17));
        draw.next();
        let sines = [0.13, 0.31, 0.47, 0.83]
            .map(|f| [draw.about(f, 1.1), draw.about(0.35, 1.2), TAU * draw.next()]);
        let drive = Self {
            inertia: draw.about(0.12, 1.4),
            viscous: draw.about(0.25, 1.4),
            coulomb: draw.about(0.4, 1.3),
            sines: sines.to_vec(),
        };
        (drive, draw)
    }

    /// 30 s; `torque` of the line's torque and the state, with noise of 1 % of Coulomb friction.
    fn log(&self, mut draw: Draw, torque: impl Fn(f64, State) -> f64) -> Campaign {
        const SAMPLE_S: f64 = 2e-3;
        let at = |k: u32| -> State {
            let t = SAMPLE_S * f64::from(k);
            self.sines.iter().fold([0.0; 3], |[q, v, a], [f, size, phase]| {
                let w = TAU * f;
                let (sin, cos) = (w * t + phase).sin_cos();
                [q + size * sin, v + size * w * cos, a - size * w * w * sin]
            })
        };
        let states: Vec<State> = (0..15_000).map(at).collect();
        let command = states.iter().map(|&[q, v, a]| {
            let line = self.inertia * a + self.viscous * v + self.coulomb * v.signum();
            let noise = 12.0_f64.sqrt() * (draw.next() - 0.5);
            torque(line, [q, v, a]) + 0.01 * self.coulomb * noise
        });
        let command = command.collect();
        let step = TAU / f64::from(1 << 19);
        let angle = states.iter().map(|[q, ..]| (q / step).round() * step).collect();
        let run =
            Run::new("log", TimeBase::uniform(0.0, SAMPLE_S), command, angle, vec![]).unwrap();
        let channels = Channels {
            axis: Axis::Rotary,
            command: Command {
                quantity: CommandQuantity::Current,
                hold: Hold::Measured,
                torque_per_command: None,
                back_emf_viscous: 0.0,
                limit: None,
            },
            tips: vec![],
        };
        Campaign::new(channels, vec![run]).unwrap()
    }

    #[track_caller]
    fn is_found(&self, found: &Identified) {
        let near = |name: &str, found: Option<Estimate>, truth: f64, share: f64| {
            let found = found.unwrap_or_else(|| panic!("{name} is refused")).value;
            assert!((found / truth - 1.0).abs() < share, "{name}: {found}, in truth {truth}");
        };
        near("Coulomb friction", found.friction.coulomb, self.coulomb, 0.03);
        near("viscous friction", found.friction.viscous, self.viscous, 0.05);
        near("inertia", found.inertia, self.inertia, 0.05);
    }
}

fn quick(campaign: &Campaign) -> Identified {
    let options = Options { effort: Effort::Quick, ..Options::default() };
    identify(campaign, &options, |_| ()).unwrap()
}

#[test]
fn a_ripple_by_turns_of_the_motor_behind_a_gear() {
    for seed in SEEDS {
        for by_friction in [true, false] {
            let (drive, mut draw) = Drive::drawn(seed);
            let per_angle = [30.0, 50.0, 80.0, 100.0][seed as usize % 4];
            let size = drive.coulomb * (0.08 + 0.22 * draw.next());
            let campaign = drive.log(draw, |line, [q, v, _]| {
                let side = if by_friction { v.signum() } else { 1.0 };
                line + side * size * (per_angle * q + 0.7).sin()
            });
            let found = quick(&campaign);
            drive.is_found(&found);
            let law = found.friction.law.unwrap();
            let (own, other) = if by_friction {
                (&law.ripples, &law.torque_ripples)
            } else {
                (&law.torque_ripples, &law.ripples)
            };
            assert!(own.len() == 1 && other.is_empty(), "{seed} {by_friction}: {law:?}");
            let k = own[0].per_angle.value / per_angle;
            let a = own[0].torque.value / size;
            assert!(
                (k - 1.0).abs() < 0.02 && (a - 1.0).abs() < 0.15,
                "{seed} {by_friction}: {k} {a}"
            );
        }
    }
}

/// Not in any model yet: no law of speed stands for it, and the finding names it.
#[test]
fn friction_that_grows_with_the_motor_s_torque() {
    for seed in SEEDS {
        let (drive, mut draw) = Drive::drawn(seed + 100);
        let share = 0.05 + 0.15 * draw.next();
        // u = line + s·μ·|u|.
        let campaign =
            drive.log(draw, |line, [_, v, _]| line / (1.0 - share * v.signum() * line.signum()));
        let found = quick(&campaign);
        if let Some(law) = &found.friction.law {
            let by_speed =
                law.near_rest.is_some() || law.root.is_some() || law.viscous_by_direction.is_some();
            assert!(!by_speed, "{seed}: {law:?}");
        }
        let with_torque = |row: &rows::MissingTerm| row.term.kind == MissingKind::WithTorque;
        let named = found.findings.iter().any(|f| f.get().is_some_and(with_torque));
        assert!(
            named,
            "{seed}: {:?}",
            found.findings.iter().map(Finding::code).collect::<Vec<_>>()
        );
    }
}
