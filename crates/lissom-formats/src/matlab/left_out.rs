//! What of MATLAB files is left out, and the MATLAB lines that convert it.

use crate::collected::LeftOut;

pub(super) const SPARSE: LeftOut = LeftOut {
    what: "sparse matrices",
    way_out: "in MATLAB: x = full(x); save(\"log.mat\", \"x\")",
};
pub(super) const FUNCTIONS: LeftOut =
    LeftOut { what: "functions", way_out: "save the values of the function in their place" };
pub(super) const TOO_DEEP: LeftOut =
    LeftOut { what: "structs nested too deep", way_out: "save the inner structs as variables" };
const TABLES: LeftOut = LeftOut {
    what: "MATLAB tables",
    way_out: "in MATLAB: s = table2struct(T, \"ToScalar\", true); save(\"log.mat\", \"s\")",
};
const TIMETABLES: LeftOut = LeftOut {
    what: "MATLAB timetables",
    way_out: "in MATLAB: s = table2struct(timetable2table(TT, \"ConvertRowTimes\", false), \
              \"ToScalar\", true); t = TT.Properties.RowTimes; s.t = seconds(t - t(1)); \
              save(\"log.mat\", \"s\")",
};
const TIME_SERIES: LeftOut = LeftOut {
    what: "MATLAB timeseries",
    way_out: "in MATLAB: s.t = ts.Time; s.y = ts.Data; save(\"log.mat\", \"s\")",
};
const DATASETS: LeftOut = LeftOut {
    what: "Simulink datasets and signals",
    way_out: "in MATLAB: s.t = out{1}.Values.Time; s.y = out{1}.Values.Data; \
              save(\"log.mat\", \"s\"), or log as \"Structure with time\"",
};
const DATES: LeftOut = LeftOut {
    what: "MATLAB dates and durations",
    way_out: "in MATLAB: t = seconds(t - t(1)); save(\"log.mat\", \"t\")",
};
const OBJECTS: LeftOut = LeftOut {
    what: "MATLAB objects",
    way_out: "in MATLAB: copy the numbers to a struct, s.y = x.PROPERTY; save(\"log.mat\", \"s\")",
};

/// What an object of a class is.
pub(super) fn object(class: &str) -> &'static LeftOut {
    match class {
        "table" => &TABLES,
        "timetable" => &TIMETABLES,
        "timeseries" => &TIME_SERIES,
        "datetime" | "duration" => &DATES,
        "function_handle" => &FUNCTIONS,
        class if class.starts_with("Simulink.") => &DATASETS,
        _ => &OBJECTS,
    }
}
