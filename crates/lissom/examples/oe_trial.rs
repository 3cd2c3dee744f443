//! Trial.
use lissom::identify::*;
use lissom::record::*;
use lissom::replay::*;
use lissom::rig::*;
use lissom_testmodels::*;
fn main() {
    let bits: u32 = std::env::args().nth(1).map_or(12, |s| s.parse().unwrap());
    let amp: f64 = std::env::args().nth(2).map_or(0.5, |s| s.parse().unwrap());
    let wrong: f64 = std::env::args().nth(3).map_or(0.0, |s| s.parse().unwrap());
    let rig = report_rig((bits > 0).then_some(bits));
    let omegas = [1.0, 3.0, 2.0, 6.0, 4.0, 12.0, 15.0, 20.0];
    let runs: Vec<Run> = omegas.iter().enumerate().map(|(i, &w)| {
        let e = Experiment::sine(w, amp, 20.0).unwrap().settling(Settle::Wait { wait_s: 20.0 });
        rig.run(&format!("{w}"), &e, i as u64).unwrap().run
    }).collect();
    let truth = ModalArm::of_arm(&report_arm()).unwrap();
    let command = Command { quantity: CommandQuantity::Current, hold: Hold::Sampled, torque_per_command: Some(report_arm().motor.torque_constant_nm_per_a), back_emf_viscous: 0.0, limit: None };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![Tip { name: "tip".into(), quantity: TipQuantity::Angle, calibrated: true }] };
    let campaign = Campaign::new(channels, runs).unwrap();
    let t = std::time::Instant::now();
    let motor = motor_regression(&campaign, &[]);
    let beam = beam_regression(&campaign);
    println!("regression {:?}", t.elapsed());
    let mut start = motor.as_ref().and_then(|m| start_of_regressions(&campaign, m, beam.as_ref(), BeamDamping::Grounded)).unwrap_or(truth.clone());
    let free = free_parameters(&campaign, &start, BeamDamping::Grounded);
    let show = |name: &str, arm: &ModalArm| {
        print!("{name:10}");
        for p in &free { print!(" {:?} {:+.3}%", p, 100.0 * (p.of(arm) / p.of(&truth) - 1.0)); }
        println!();
    };
    show("start", &start);
    if wrong > 0.0 {
        for (i, p) in free.iter().enumerate() { let v = p.of(&truth) * if i % 2 == 0 { wrong } else { 1.0 / wrong }; p.set(&mut start, v); }
        show("wrong", &start);
    }
    let t = std::time::Instant::now();
    let nofree: Vec<Parameter> = if std::env::var("NOFREE").is_ok() { vec![] } else { free.clone() }; let oe = output_error(&campaign, &start, &nofree, std::env::args().nth(4).map_or(0.5, |s| s.parse().unwrap()), &vec![Blocks { samples: 50.0, period: None }; 8]).unwrap();
    println!("output error {:?}", t.elapsed());
    for s in &oe.stages {
        println!("L {:.2} n {} stop {:?} noise {:?} steps {} taken {}", s.window_s, s.windows, s.stop, s.noise, s.iterations.len(), s.iterations.iter().filter(|i| i.taken).count());
        println!("   {:?}", s.iterations.iter().map(|i| i.cost).collect::<Vec<_>>());
    }
    show("oe", &oe.arm);
    let windows = oe.parameters.iter().enumerate().map(|(i, p)| (p, oe.covariance[(i, i)].sqrt(), oe.white[(i, i)].sqrt()));
    for (p, c, w) in windows {
        let t = p.of(&truth);
        println!("{p:?} rel std coloured {:.4}% white {:.4}% error {:.2} sigma", 100.0 * c / t.abs(), 100.0 * w / t.abs(), (p.of(&oe.arm) - t) / c);
    }
}
