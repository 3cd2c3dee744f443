//! scratch
use lissom::record::*;
use lissom::rig::SteppedSine;
use lissom::identify::*;
fn main() {
    let rig = lissom_testmodels::report_rig(Some(12));
    let base: [f64; 9] = [1.0, 1.3, 1.7, 3.1, 3.9, 5.1, 7.8, 9.3, 10.0];
    let mut ws: Vec<f64> = base.iter().copied().chain(base.iter().map(|b| 3.0 * b)).collect();
    ws.sort_by(f64::total_cmp);
    ws.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    let mut runs = vec![];
    for a in [0.5, 1.0] {
        for &w in &ws {
            runs.push(rig.stepped_sine("x", &SteppedSine { omega_rad_s: w, amplitude_rad: a, settle_s: 170.0, record_s: 12f64.max(63.0 / w) }).unwrap());
        }
    }
    let k = rig.arm.motor.torque_constant_nm_per_a;
    let ch = Channels { axis: Axis::Rotary, command: Command { quantity: CommandQuantity::Current, hold: Hold::Sampled, torque_per_command: Some(k), back_emf_viscous: 0.0, limit: None }, tips: vec![Tip { name: "tip".into(), quantity: TipQuantity::Angle, calibrated: true }] };
    let c = Campaign::new(ch, runs).unwrap();
    let t0 = std::time::Instant::now();
    let m = motor_regression(&c, None).unwrap();
    println!("{:?}", t0.elapsed());
    let show = |n: &str, e: Option<Estimate>, t: f64| { let e = e.unwrap(); println!("{n} {:.6} err {:.3}% std {:.3}%", e.value, (e.value / t - 1.0) * 100.0, e.std / t * 100.0) };
    show("J", m.inertia, rig.arm.motor.inertia_kg_m2);
    show("V", m.viscous, rig.arm.motor.viscous_nm_s_per_rad);
    show("CF", m.coulomb, rig.arm.coulomb.forward);
    show("kap", m.coupling[0], rig.arm.beam().h_motor());
    println!("{:?} {:?} L={}", m.offset, m.viscous_by_direction, m.window_s);
    for c in &m.candidates { println!("{c:?}"); }
    let b = beam_regression(&c).unwrap();
    show("w", Some(b.modes[0].natural_frequency_rad_s), rig.arm.beam().natural_frequencies_rad_s()[0]);
    println!("{:?}", b.modes[0].damping_ratio);
    println!("true zeta {}", 0.03 / rig.arm.beam().natural_frequencies_rad_s()[0]);
    for c in &b.candidates[0] { println!("{c:?}"); }
    println!("{:?}", t0.elapsed());
}
