//! Times of logs, in names and tables.

use chrono::{DateTime, NaiveDate, NaiveDateTime};

/// Forms of a date with time, without a zone: UTC.
const DATE_TIMES: [&str; 9] = [
    "%Y-%m-%dT%H:%M:%S%.f",
    "%Y-%m-%d %H:%M:%S%.f",
    "%Y-%m-%dT%H-%M-%S",
    "%Y-%m-%d_%H-%M-%S",
    "%Y-%m-%dT%H:%M",
    "%Y-%m-%d %H:%M",
    "%Y%m%dT%H%M%S",
    "%Y%m%d_%H%M%S",
    "%Y%m%d-%H%M%S",
];
/// Forms of a date.
const DATES: [&str; 2] = ["%Y-%m-%d", "%Y_%m_%d"];
/// Times of logs are from 1970 up to here, the year 2200: others are misread.
const LATEST_US: i64 = 7_258_118_400_000_000;

/// Reads a time, in microseconds since 1970 UTC: a date, a date with time (UTC if no zone is given), seconds or
/// milliseconds since 1970.
///
/// ```
/// use lissom_fleet::time_us;
/// assert_eq!(time_us("2026-11-27T08:15:00+01:00"), time_us("20261127T071500"));
/// assert_eq!(time_us("1795763700"), time_us("2026-11-27 07:15:00"));
/// assert_eq!(time_us("20261127071500"), time_us("2026-11-27 07:15:00"));
/// assert_eq!((time_us("0815"), time_us("27-11-26")), (None, None));
/// ```
pub fn time_us(text: &str) -> Option<i64> {
    read(text.trim()).filter(|time| (0..LATEST_US).contains(time))
}

fn read(text: &str) -> Option<i64> {
    // chrono takes years of any number of digits; those of logs have four.
    if text.len() < 8 || !text.bytes().take(4).all(|b| b.is_ascii_digit()) {
        return None;
    }
    let zoned = DateTime::parse_from_rfc3339(text);
    if let Ok(time) = zoned.or_else(|_| DateTime::parse_from_str(text, "%Y-%m-%dT%H:%M:%S%.f%z")) {
        return Some(time.timestamp_micros());
    }
    let basic = text.strip_suffix('Z').unwrap_or(text);
    for form in DATE_TIMES {
        if let Ok(time) = NaiveDateTime::parse_from_str(basic, form) {
            return Some(time.and_utc().timestamp_micros());
        }
    }
    for form in DATES {
        if let Ok(date) = NaiveDate::parse_from_str(basic, form) {
            return Some(midnight(date));
        }
    }
    digits(basic)
}

fn midnight(date: NaiveDate) -> i64 {
    date.and_time(chrono::NaiveTime::MIN).and_utc().timestamp_micros()
}

/// A time of digits alone: a date, with hours and minutes, and seconds; or a count of seconds or milliseconds since 1970,
/// which has ten or thirteen digits from 2001 to 2286.
fn digits(text: &str) -> Option<i64> {
    let whole = text.split_once('.').map_or(text, |(whole, _)| whole);
    if !whole.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let count =
        |per_second: f64| Some((1e6 / per_second * text.parse::<f64>().ok()?).round() as i64);
    match (whole.len(), whole == text) {
        (8, true) => {
            let date = NaiveDate::parse_from_str(text, "%Y%m%d").ok()?;
            Some(midnight(date))
        }
        (12 | 14, true) => {
            let seconds = format!("{text}{}", if text.len() == 12 { "00" } else { "" });
            let time = NaiveDateTime::parse_from_str(&seconds, "%Y%m%d%H%M%S").ok()?;
            Some(time.and_utc().timestamp_micros())
        }
        (10, _) => count(1.0),
        (13, _) => count(1e3),
        _ => None,
    }
}

/// The date of a time in microseconds since 1970, UTC, as in 2026-11-27.
pub fn date(time_us: i64) -> String {
    let time = DateTime::from_timestamp_micros(time_us);
    time.map_or_else(String::new, |time| time.format("%Y-%m-%d").to_string())
}

#[cfg(test)]
mod tests {
    use super::time_us;

    /// 2026-11-27T07:15:00Z, from `date -u -d 2026-11-27T07:15:00 +%s`.
    const SECONDS: i64 = 1_795_763_700;

    #[test]
    fn forms_of_a_time() {
        for text in [
            "2026-11-27T07:15:00Z",
            "2026-11-27T08:15:00+01:00",
            "2026-11-27 07:15:00",
            "2026-11-27T07:15",
            "2026-11-27 07:15",
            "2026-11-27T08:15:00+0100",
            "2026-11-27T07-15-00",
            "20261127T071500",
            "20261127T071500Z",
            "20261127_071500",
            "20261127071500",
            "202611270715",
            "1795763700",
            "1795763700000",
        ] {
            assert_eq!(time_us(text), Some(1_000_000 * SECONDS), "{text}");
        }
        assert_eq!(time_us("1795763700.25"), Some(1_000_000 * SECONDS + 250_000));
        let day = 1_000_000 * (SECONDS - 7 * 3600 - 15 * 60);
        assert_eq!(time_us("2026-11-27"), Some(day));
        assert_eq!(time_us("20261127"), Some(day));
    }

    #[test]
    fn what_is_no_time() {
        for text in [
            "",
            "0815",
            "run 3",
            "2026-13-01",
            "-1795763700",
            "nan",
            "1e300",
            "12345",
            "26-01-05",
            "05-01-26",
            "260105123000",
            "20261327071500",
            "5026-01-01",
            "99999999999999",
        ] {
            assert_eq!(time_us(text), None, "{text}");
        }
    }
}
