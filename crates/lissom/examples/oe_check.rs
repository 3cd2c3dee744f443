//! Trial.
use lissom::record::*;
use lissom::replay::*;
use lissom::rig::*;
use lissom_testmodels::*;
fn main() {
    let rig = report_rig(None);
    let truth = ModalArm::of_arm(&report_arm()).unwrap();
    println!("{truth:?}");
    let e = Experiment::sine(3.0, 0.5, 20.0).unwrap().settling(Settle::Wait { wait_s: 20.0 });
    let run = rig.run("a", &e, 0).unwrap().run;
    let command = Command { quantity: CommandQuantity::Current, hold: Hold::Sampled, torque_per_command: Some(report_arm().motor.torque_constant_nm_per_a), back_emf_viscous: 0.0, limit: None };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![Tip { name: "tip".into(), quantity: TipQuantity::Angle, calibrated: true }] };
    let campaign = Campaign::new(channels, vec![run]).unwrap();
    let w = Window { run: 0, samples: 0..=6000, start: vec![0.0; 4], zeros: vec![0.0] };
    let p = predict(&truth, &campaign, &w).unwrap();
    let free = [Parameter::Inertia, Parameter::Viscous, Parameter::Coulomb, Parameter::Offset, Parameter::Frequency(0), Parameter::Stiffness(0), Parameter::DampingGrounded(0)];
    for from in [300usize, 301, 302, 600] {
        let r = &campaign.runs[0];
        let v = |x: &[f64]| (x[from + 3] - x[from - 3]) / (6.0 * 0.003);
        let mut w = Window { run: 0, samples: from..=from + 160, start: vec![r.motor()[from], v(r.motor()), r.tips()[0][from], v(&r.tips()[0])], zeros: vec![0.0] };
        for _ in 0..6 {
        let s = sums(&truth, &free, &campaign, &[w.clone()], Sampling { sigma: &[1e-4, 1e-4], block: 50 });
        println!("cost {} {:?}", s[0].cost(), w);
        let z = s[0].gram.view((7, 7), (5, 5)).into_owned();
        let g = s[0].gram.column(12).rows(7, 5).into_owned();
        let d = z.try_inverse().unwrap() * g;
        for i in 0..4 { w.start[i] += d[i]; } w.zeros[0] += d[4];
        }
    }
    let oe = lissom::identify::output_error(&campaign, &truth, &[], 0.5, &[1e-4, 1e-4]).unwrap();
    for s in &oe.stages { println!("{:?}", s); }
    let run = &campaign.runs[0];
    for k in (0..6000).step_by(300) { println!("{k} {} {} {} | {} {}", run.command()[k], run.motor()[k], p.channels[0][k] - run.motor()[k], run.tips()[0][k], p.channels[1][k] - run.tips()[0][k]); }
}
#[allow(dead_code)]
pub fn more() {}
