//! Time stamps as dates and times of day.

/// A stamp in seconds: of ISO 8601 since 1970, of `h:m:s` since midnight.
pub(crate) fn seconds(cell: &str) -> Option<f64> {
    let cell = cell.trim();
    if !cell.as_bytes().first()?.is_ascii_digit() || !cell.contains(':') {
        return None;
    }
    match cell.split_once(['T', ' ']) {
        Some((date, time)) => Some(days(date)? * 86_400.0 + of_zone(time.trim())?),
        None => of_day(cell),
    }
}

/// A time of day with or without a zone, in seconds of UTC.
fn of_zone(time: &str) -> Option<f64> {
    if let Some(utc) = time.strip_suffix('Z') {
        return of_day(utc);
    }
    let Some(at) = time.rfind(['+', '-']) else { return of_day(time) };
    let sign = if time.as_bytes()[at] == b'-' { -1.0 } else { 1.0 };
    let zone = &time[at + 1..];
    let (hours, minutes) = match zone.split_once(':') {
        Some(parts) => parts,
        None if zone.len() == 4 => zone.split_at(2),
        None => (zone, "0"),
    };
    let east = 3600.0 * hours.parse::<f64>().ok()? + 60.0 * minutes.parse::<f64>().ok()?;
    Some(of_day(&time[..at])? - sign * east)
}

fn of_day(time: &str) -> Option<f64> {
    let mut parts = time.split(':');
    let (hours, minutes, seconds) = (parts.next()?, parts.next()?, parts.next()?);
    if parts.next().is_some() {
        return None;
    }
    let whole = |text: &str, most: u32| text.parse::<u32>().ok().filter(|n| *n <= most);
    let seconds: f64 = seconds.replace(',', ".").parse().ok()?;
    (0.0..61.0).contains(&seconds).then_some(())?;
    // A recording may last longer than a day.
    Some(
        f64::from(whole(hours, 99_999)?) * 3600.0 + f64::from(whole(minutes, 59)?) * 60.0 + seconds,
    )
}

/// Days since 1970-01-01 of a date `YYYY-MM-DD` in the Gregorian calendar.
///
/// # Source
/// `[Hinnant, "chrono-Compatible Low-Level Date Algorithms", days_from_civil]`
fn days(date: &str) -> Option<f64> {
    let mut parts = date.split(['-', '/']);
    let (year, month, day) = (parts.next()?, parts.next()?, parts.next()?);
    if parts.next().is_some() || year.len() != 4 {
        return None;
    }
    let (year, month, day): (i64, i64, i64) =
        (year.parse().ok()?, month.parse().ok()?, day.parse().ok()?);
    if !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    let year = year - i64::from(month <= 2);
    let era = year.div_euclid(400);
    let of_era = year - era * 400;
    let of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    let days = era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719_468;
    Some(days as f64)
}

#[cfg(test)]
mod tests {
    use super::seconds;

    #[test]
    fn stamps() {
        assert_eq!(seconds("00:01:02.5"), Some(62.5));
        assert_eq!(seconds("1970-01-02T00:00:01Z"), Some(86_401.0));
        // `date -d 2024-02-29T12:00:00+01:00 +%s`
        assert_eq!(seconds("2024-02-29 12:00:00+01:00"), Some(1_709_204_400.0));
        assert_eq!(seconds("2024-02-29T12:00:00-0130"), Some(1_709_213_400.0));
        for other in
            ["", "12", "1.5", "a:b:c", "2024-13-01T00:00:00", "12:61:00", "12:00:99", "1:2:3:4"]
        {
            assert_eq!(seconds(other), None, "{other}");
        }
    }
}
