//! What is not given is refused by a finding that names it.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::identify::Severity;
use lissom::prelude::*;
use lissom_testmodels::{RigidJoint, RigidLog, two_sines};

const TAU: f64 = std::f64::consts::TAU;

fn channels() -> Channels {
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Measured,
        torque_per_command: None,
        back_emf_viscous: 0.0,
        limit: None,
    };
    Channels { axis: Axis::Rotary, command, tips: vec![] }
}

fn campaign(log: RigidLog) -> Campaign {
    let time = TimeBase::uniform(0.0, log.time_s[1] - log.time_s[0]);
    let run = Run::new("log", time, log.measured, log.angle, vec![]).unwrap();
    Campaign::new(channels(), vec![run]).unwrap()
}

/// One stroke forward with a speed that varies.
fn stroke(time_s: f64) -> f64 {
    0.3 * time_s + 0.05 * (1.0 - (1.5 * time_s).cos()) + 0.02 * (1.0 - (6.0 * time_s).cos())
}

/// Every parameter that is refused, of the table, has a refusal or a warning about it.
#[track_caller]
fn explained(name: &str, found: &Found) {
    for parameter in found.parameters().iter().filter(|p| p.estimate.is_none()) {
        // A direction and the offset go with Coulomb friction.
        let of_coulomb =
            ["friction.coulomb", "friction.forward", "friction.backward", "friction.offset"];
        let friction = of_coulomb.iter().any(|key| parameter.key.starts_with(key));
        let by_direction = friction && !parameter.key.starts_with("friction.coulomb");
        let speaks = |f: &&Finding| {
            let of = |key: &&str| {
                parameter.key.starts_with(*key)
                    || friction && *key == "friction.coulomb"
                    || by_direction && *key == "friction.offset"
            };
            f.severity() >= Severity::Warning && f.affects().iter().any(of)
        };
        let codes: Vec<_> = found.findings().iter().map(Finding::code).collect();
        let told = found.findings().iter().any(|f| speaks(&f));
        assert!(told, "{name}: {} is refused without a word: {codes:?}\n{found}", parameter.key);
    }
}

#[test]
fn every_refused_parameter_has_a_finding() {
    let plain = RigidJoint::default();
    let loaded = RigidJoint { load: |q| 0.4 * (q + 0.3).sin(), ..plain };
    let constant = RigidJoint { load: |_| 0.5, ..plain };
    let slow = |t: f64| 0.02 * (0.05 * TAU * t).sin();
    let logs = [
        ("one stroke", plain.follow(4_000, stroke)),
        ("one stroke with gravity", loaded.follow(4_000, stroke)),
        ("one stroke against a load", constant.follow(4_000, stroke)),
        ("constant speed", plain.follow(4_000, |t| 0.5 * t)),
        ("hardly a motion", plain.follow(4_000, slow)),
        ("one sine", plain.follow(6_000, |t| 0.8 * (0.5 * TAU * t).sin())),
        ("two sines", plain.follow(6_000, two_sines)),
        ("two sines with gravity", loaded.follow(6_000, two_sines)),
    ];
    for (name, log) in logs {
        let campaign = campaign(log);
        for gravity in [false, true] {
            let campaign =
                if gravity { campaign.clone().with_gravity().unwrap() } else { campaign.clone() };
            for effort in [Effort::Quick, Effort::default()] {
                let name = format!("{name}, gravity {gravity}, {effort:?}");
                let found = Identify::new(&campaign).effort(effort).run().unwrap();
                explained(&name, &found);
            }
        }
    }
}
