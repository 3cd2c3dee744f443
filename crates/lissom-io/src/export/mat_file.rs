//! A MATLAB file of version 5: a struct `lissom` with models and responses.

use super::export_model::ExportModel;

const DOUBLE: u32 = 9;
const INT8: u32 = 1;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const UINT16: u32 = 4;
const MATRIX: u32 = 14;
/// Length of the name of a field, with its zero.
const FIELD: usize = 32;

/// A value of MATLAB.
enum Value {
    /// Rows of a matrix.
    Matrix(Vec<Vec<f64>>),
    Text(String),
    Struct(Vec<(&'static str, Value)>),
}

/// The bytes of a `.mat` file (version 5, not compressed) with the struct `lissom`: `num`, `den` of the motor per command,
/// `a`, `b`, `c`, `d` of the state space, `outputs`, parameters of friction, and the measured responses under
/// `responses` (`omega`, `raw`, `corrected` as real and imaginary part).
pub fn mat_file(model: &ExportModel) -> Vec<u8> {
    let mut header = b"MATLAB 5.0 MAT-file, made by lissom".to_vec();
    header.resize(124, b' ');
    header.extend(0x0100_u16.to_le_bytes());
    header.extend(b"IM");
    header.extend(array("lissom", &content(model)));
    header
}

fn content(model: &ExportModel) -> Value {
    let row = |values: &[f64]| Value::Matrix(vec![values.to_vec()]);
    let scalar = |value: f64| Value::Matrix(vec![vec![value]]);
    let matrix = |m: &lissom_core::Matrix| {
        let row = |i: usize| (0..m.ncols()).map(|j| m[(i, j)]).collect();
        Value::Matrix((0..m.nrows()).map(row).collect())
    };
    let (g, s, arm) = (model.motor_function(), model.state_space(), &model.arm);
    let mut fields = vec![
        ("about", Value::Text(model.about().join("; "))),
        ("num", row(&g.num)),
        ("den", row(&g.den)),
        ("a", matrix(&s.a)),
        ("b", matrix(&s.b)),
        ("c", matrix(&s.c)),
        ("d", matrix(&s.d)),
        ("outputs", Value::Text(s.outputs.join(","))),
        ("torque_per_command", scalar(model.torque_per_command)),
        ("inertia", scalar(arm.inertia_kg_m2)),
        ("viscous", row(&arm.viscous_nm_s_per_rad)),
        ("coulomb", scalar(arm.coulomb_nm)),
        ("offset", scalar(arm.offset_nm)),
        ("command_lag", scalar(arm.command_lag_s)),
    ];
    if let Some(responses) = &model.responses {
        let known = |list: &[Option<f64>]| -> Vec<f64> {
            list.iter().map(|v| v.unwrap_or(f64::NAN)).collect()
        };
        let series = |s: &crate::result::SeriesEntry| {
            Value::Matrix(vec![known(&s.re), known(&s.im), known(&s.std)])
        };
        fields.push((
            "responses",
            Value::Struct(vec![
                ("omega", row(&responses.omega_rad_s)),
                ("raw", series(&responses.motor_raw)),
                ("corrected", series(&responses.motor_corrected)),
            ]),
        ));
    }
    Value::Struct(fields)
}

/// An element: tag, bytes, padding to eight bytes.
fn element(kind: u32, bytes: &[u8]) -> Vec<u8> {
    let length = u32::try_from(bytes.len()).unwrap_or(u32::MAX);
    let mut all = [kind.to_le_bytes(), length.to_le_bytes()].concat();
    all.extend(bytes);
    all.resize(all.len().next_multiple_of(8), 0);
    all
}

fn array(name: &str, value: &Value) -> Vec<u8> {
    let size = |n: usize| i32::try_from(n).unwrap_or(i32::MAX);
    let (class, [rows, columns]) = match value {
        Value::Matrix(m) => (6_u32, [m.len(), m.first().map_or(0, Vec::len)]),
        Value::Text(text) => (4, [1, text.encode_utf16().count()]),
        Value::Struct(_) => (2, [1, 1]),
    };
    let mut body = element(UINT32, &[class.to_le_bytes(), 0_u32.to_le_bytes()].concat());
    body.extend(element(INT32, &[size(rows).to_le_bytes(), size(columns).to_le_bytes()].concat()));
    body.extend(element(INT8, name.as_bytes()));
    match value {
        Value::Matrix(m) => {
            let cells = (0..columns).flat_map(|j| m.iter().map(move |row| row.get(j).copied()));
            let bytes = cells.flat_map(|v| v.unwrap_or(f64::NAN).to_le_bytes());
            body.extend(element(DOUBLE, &bytes.collect::<Vec<u8>>()));
        }
        Value::Text(text) => {
            let bytes = text.encode_utf16().flat_map(u16::to_le_bytes);
            body.extend(element(UINT16, &bytes.collect::<Vec<u8>>()));
        }
        Value::Struct(fields) => {
            // The length of names is a small element: four bytes in the tag.
            body.extend(
                [(4_u32 << 16 | INT32).to_le_bytes(), (FIELD as u32).to_le_bytes()].concat(),
            );
            let mut names = Vec::new();
            for (name, _) in fields {
                names.extend(name.as_bytes().iter().take(FIELD - 1));
                names.resize(names.len().next_multiple_of(FIELD), 0);
            }
            body.extend(element(INT8, &names));
            for (_, value) in fields {
                body.extend(array("", value));
            }
        }
    }
    element(MATRIX, &body)
}
