//! Tables that can be read, and those that cannot.

use std::f64::consts::TAU;
use std::path::PathBuf;

use num_complex::Complex64;

use super::*;
use crate::units::Dimension;

fn read(files: &[(&str, &str)]) -> Result<FrequencyResponses, ResponseError> {
    let folder = tempfile::tempdir().unwrap();
    let paths: Vec<PathBuf> = files
        .iter()
        .map(|(name, text)| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            path
        })
        .collect();
    read_responses(&paths)
}

fn close(a: Complex64, b: Complex64) -> bool {
    (a - b).norm() < 1e-12 * b.norm()
}

#[test]
fn names_say_what_the_columns_are() {
    let found = read(&[(
        "all.csv",
        "omega_rad_s,tip_re,tip_im,tip_std,motor_re [mrad/A],motor_im [mrad/A],coherence\n1,2,3,0.1,5,6,1\n2,3,4,0.2,7,8,1\n",
    )])
    .unwrap();
    assert_eq!(found.omega_rad_s, [1.0, 2.0]);
    assert_eq!((found.points.len(), found.points[0].name.as_str()), (1, "tip"));
    assert_eq!(found.points[0].response[1], Complex64::new(3.0, 4.0));
    assert_eq!(found.points[0].std.as_deref(), Some(&[0.1, 0.2][..]));
    let motor = found.motor.unwrap();
    assert!(close(motor.response[0], Complex64::new(5e-3, 6e-3)));
    assert_eq!(motor.dimension, Some(Dimension::new(0, 0, 0, -1)));
}

#[test]
fn files_decibels_degrees_and_hertz() {
    for header in
        ["f [Hz];dB;deg", "Frequency (Hz);mag_db;phase_deg", "freq_hz;gain [dB];phase [°]"]
    {
        let table = format!("# measured\n{header}\n0,5;20;90\n1,5;0;-180\n");
        let found = read(&[("tip.csv", &table), ("elbow.csv", &table)]).unwrap();
        assert!((found.omega_rad_s[0] - 0.5 * TAU).abs() < 1e-15, "{header}");
        let names: Vec<&str> = found.points.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(names, ["tip", "elbow"]);
        assert!((found.points[0].response[0] - Complex64::new(0.0, 10.0)).norm() < 1e-14);
    }
    let found = read(&[("x.txt", "w[rad/s]\tmag\tphase[rad]\n1\t2\t0\n")]).unwrap();
    assert_eq!(found.points[0].response, [Complex64::new(2.0, 0.0)]);
    let found = read(&[("x.csv", "omega_rad_per_s,tip mag,tip phase_rad\n1,2,0\n")]).unwrap();
    assert_eq!(found.points[0].name, "tip");
}

/// A table that an instrument writes, of a response that is 10 at 90°.
fn export(header: &str, row: impl Fn(f64) -> String) -> String {
    let rows: Vec<String> = (1..30).map(|k| row(f64::from(k))).collect();
    format!("{header}\n{}\n", rows.join("\n"))
}

#[test]
fn exports_of_instruments_are_read() {
    let semicolons = |f: f64| format!("{f},5;20,0;90,0");
    let commas = |f: f64| format!("{f}.5,20,90");
    for text in [
        export("Analyzer 3\nStart: 1 Hz\n\nFrequency (Hz);Gain (dB);Phase (deg)", semicolons),
        export("Frequency (Hz);Trace 1: Gain: Magnitude (dB);Trace 1: Gain: Phase (°)", semicolons),
        export("Sample,Frequency in Hz,Gain in dB,Phase in °", |f| format!("{f},{}", commas(f))),
        export("Phase [deg],|G| [dB],f [Hz]", |f| format!("90,20,{f}.5")),
        export("f [Hz],|G| [dB],phi [°],coherence", |f| format!("{},0.9", commas(f))),
        export("#Frequenz [Hz]\tBetrag [dB]\tPhase [°]", |f| format!("{f}.5\t20\t90")),
    ] {
        let found = read(&[("tip.csv", &text)]).unwrap_or_else(|error| panic!("{text}\n{error}"));
        assert!((found.omega_rad_s[0] - 1.5 * TAU).abs() < 1e-12, "{text}");
        assert!((found.points[0].response[0] - Complex64::new(0.0, 10.0)).norm() < 1e-12, "{text}");
    }
    let text = export("f [Hz],Gain (dB),Phase [°]", commas);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    let wide: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let latin: Vec<u8> = text.chars().map(|c| u8::try_from(c).unwrap()).collect();
    for bytes in [wide, latin] {
        std::fs::write(&path, bytes).unwrap();
        assert_eq!(read_responses(&[&path]).unwrap().omega_rad_s.len(), 29);
    }
}

#[test]
fn errors_name_file_row_and_column() {
    let fails = |files: &[(&str, &str)], end: &str| {
        let error = read(files).unwrap_err();
        let said = error.to_string();
        assert!(said.ends_with(end), "{said}\nnot\n{end}");
        assert!(!said.contains('\n') && error.hint().is_some());
    };
    let one = |text: &str, end: &str| fails(&[("a.csv", text)], end);
    one("", "a.csv: there is no header with the names of the columns");
    one("1,2,3\n", "a.csv: there is no header with the names of the columns");
    one("tip_re,tip_im\n1,2\n", "no column is a frequency; the columns are tip_re, tip_im");
    one("omega,re,im\n1,2,3\n", "column omega: the header gives no unit");
    one(
        "omega_furlong,re,im\n1,2,3\n",
        "column omega_furlong: \"furlong\" is not a valid unit for this column",
    );
    one("f_hz,mag,phase\n1,2,3\n", "column phase: the header gives no unit");
    one(
        "f_hz,re [zorg],im\n1,2,3\n",
        "column re [zorg]: \"zorg\" is not a valid unit for this column",
    );
    one("f_hz,omega_rad_s,re,im\n", "columns f_hz and omega_rad_s are both frequencies");
    one(
        "f_hz,coherence\n1,2\n",
        "no column is part of a response; the columns are f_hz, coherence",
    );
    one("f_hz,tip_re\n1,2\n", "tip has the real part but no imaginary part");
    one("f_hz,tip_db,tip_re\n1,2,3\n", "tip has the real part but no imaginary part");
    one("f_hz,re,im,re\n1,2,3,4\n", "a has its real part twice");
    one("f_hz,re,im\n", "a.csv: the table has no rows of numbers");
    one("f_hz,re,im\n1,2,x\n", "row 2, column im: \"x\" is not a finite number");
    one("f_hz,re,im\n1,2,inf\n", "row 2, column im: \"inf\" is not a finite number");
    one("f_hz,re,im\n1,2\n", "row 2, column im: the cell is missing");
    one("f_hz,re,im\n1,2,3\n\n0,2,3\n", "row 4, column f_hz: 0 must be greater than zero");
    one("f_hz,re,im\n1,2,3,4\n", "row 2, column 4: \"4\" is beyond the 3 columns of the header");
    one("f_hz,re,im\n1,0,0\n", "row 2: the response of a is zero");
    one("f_hz,db,deg\n1,9999,0\n", "row 2, column db: the response is too large for a number");
    one("f_hz,mag,deg\n1,-1,0\n", "row 2, column mag: -1 must be greater than zero");
    one("f_hz,re,im,std\n1,2,3,0\n", "row 2, column std: 0 must be greater than zero");
    one("f_hz,re,im\n2,2,3\n1,2,3\n", "row 3, column f_hz: 1 comes after 2");
    one(
        "f_hz,motor_re,motor_im\n1,2,3\n",
        "there is only the response of the motor, and none of a point",
    );
    one(
        "f_hz,tip_re [rad/A],tip_im [rad/A]\n1,2,3\n",
        "the response of a point must be an angle, velocity or acceleration per angle",
    );
    let b = ("b.csv", "f_hz,re,im\n1,2,3\n2,2,3\n");
    fails(&[b, ("c.csv", "f_hz,re,im\n1,2,3\n")], "all responses must share their frequencies");
    fails(
        &[b, ("c.csv", "f_hz,re,im\n1,2,3\n3,2,3\n")],
        "all responses must share their frequencies",
    );
    let twice = "f_hz,b_re,b_im\n1,2,3\n2,2,3\n";
    let error = read(&[b, ("c.csv", twice)]).unwrap_err().to_string();
    assert!(error.contains("there is already a response b"), "{error}");
    assert!(
        read(&[("a.bin", "\u{0}\u{1}")]).unwrap_err().to_string().contains("is not a text file")
    );
    let nothing: [&str; 0] = [];
    assert!(read_responses(&nothing).is_err() && read_responses(&["/nowhere.csv"]).is_err());
    assert!(read_responses(&[std::env::temp_dir()]).is_err());
}

#[test]
fn hints_fit_what_is_wrong() {
    let hint = |text: &str| read(&[("a.csv", text)]).unwrap_err().hint().unwrap();
    assert!(hint("f_hz,re,im\n0,2,3\n").contains("zero or less"));
    assert!(hint("f_hz,re,im,std\n1,2,3,0\n").contains("leave out the column"));
    assert!(hint("f_hz,mag,deg\n1,-3,0\n").contains("tip_db"));
    assert!(hint("f_hz,re,im\n0,5,1,2\n").contains("semicolons"));
    // An empty cell at the end of rows is none too many.
    assert!(read(&[("a.csv", "f_hz,re,im\n1,2,3,\n")]).is_ok());
    let said = read(&[("a.csv", "f_hz,re,im,std\n1,2,3,.1\n2,2,3,1e-300\n3,2,3,.1\n")]);
    let said = said.unwrap_err().to_string();
    assert!(
        said.ends_with(
            "row 3, column std: the standard error is 1e-300, but the others are about 1.0e-1"
        ),
        "{said}"
    );
}

#[test]
fn other_encodings_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    let wide: Vec<u8> = "f_hz,re,im\n1,2,3\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let marked: Vec<u8> = [0xFF, 0xFE].into_iter().chain(wide.iter().copied()).collect();
    let turned: Vec<u8> = wide.chunks(2).flat_map(|pair| [pair[1], pair[0]]).collect();
    for (bytes, encoding) in [
        (wide, "UTF-16"),
        (marked, "UTF-16"),
        (turned, "UTF-16"),
        (b"f_hz,mag,phase [\xB0]\n1,2,3\n".to_vec(), "WINDOWS-1252"),
    ] {
        std::fs::write(&path, bytes).unwrap();
        let error = read_responses(&[&path]).unwrap_err();
        assert!(
            error.to_string().contains(encoding) && error.to_string().contains("UTF-8"),
            "{error}"
        );
        assert!(error.hint().unwrap().contains("iconv"));
    }
}
