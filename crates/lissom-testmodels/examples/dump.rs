//! scratch
use lissom::rig::SteppedSine;
use std::io::Write;
fn main() {
    let a: Vec<f64> = std::env::args().skip(1).map(|s| s.parse().unwrap()).collect();
    let rig = lissom_testmodels::report_rig(if a[4] > 0.0 { Some(a[4] as u32) } else { None });
    let run = rig
        .stepped_sine(
            "x",
            &SteppedSine { omega_rad_s: a[0], amplitude_rad: a[1], settle_s: a[2], record_s: a[3] },
        )
        .unwrap();
    let mut o = std::io::BufWriter::new(std::io::stdout().lock());
    for k in 0..run.len() {
        writeln!(
            o,
            "{},{},{},{}",
            run.time().start_s + k as f64 * run.sample_time_s(),
            run.command()[k],
            run.motor()[k],
            run.tips()[0][k]
        )
        .unwrap();
    }
}
