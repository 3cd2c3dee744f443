//! Time stamps as dates and times of day.

/// A date with a time of day, or a time of day alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stamp {
    /// Seconds from 1970 to the beginning of the day.
    date_s: Option<f64>,
    /// Seconds since midnight, in UTC if there is a zone.
    of_day_s: f64,
}

impl Stamp {
    /// Reads a stamp. Dates are `YYYY-MM-DD`, `DD.MM.YYYY`, and `MM/DD/YYYY`, or `DD/MM/YYYY` if `MM` would exceed 12.
    pub(crate) fn of(cell: &str) -> Option<Self> {
        let cell = cell.trim();
        if !cell.as_bytes().first()?.is_ascii_digit() || !cell.contains(':') {
            return None;
        }
        match cell.split_once(['T', ' ']).filter(|(date, _)| !date.contains(':')) {
            Some((date, time)) => {
                let date_s = days(date)? * DAY_S;
                Some(Self { date_s: Some(date_s), of_day_s: of_zone(time.trim())? })
            }
            None => Some(Self { date_s: None, of_day_s: of_half_day(cell)? }),
        }
    }

    /// Seconds since another stamp; a difference of a few days has more decimals than two times since 1970.
    pub(crate) fn since_s(self, first: Self) -> f64 {
        let days_s = self.date_s.unwrap_or(0.0) - first.date_s.unwrap_or(0.0);
        days_s + (self.of_day_s - first.of_day_s)
    }

    pub(crate) fn has_date(self) -> bool {
        self.date_s.is_some()
    }
}

/// Seconds of a day.
pub(crate) const DAY_S: f64 = 86_400.0;
/// Half a day in seconds.
pub(crate) const HALF_DAY_S: f64 = 43_200.0;

/// A time of day with or without a zone, in seconds of UTC.
fn of_zone(time: &str) -> Option<f64> {
    if let Some(utc) = time.strip_suffix('Z') {
        return of_day(utc);
    }
    let Some(at) = time.rfind(['+', '-']) else { return of_half_day(time) };
    let sign = if time.as_bytes()[at] == b'-' { -1.0 } else { 1.0 };
    let zone = &time[at + 1..];
    let (hours, minutes) = match zone.split_once(':') {
        Some(parts) => parts,
        None if zone.len() == 4 => zone.split_at_checked(2)?,
        None => (zone, "0"),
    };
    let number = |text: &str| text.parse::<u8>().ok().map(f64::from);
    let east = 3600.0 * number(hours)? + 60.0 * number(minutes)?;
    Some(of_day(&time[..at])? - sign * east)
}

/// A time of day, or of half a day with `AM` or `PM`.
fn of_half_day(time: &str) -> Option<f64> {
    let ending = |end: &str| {
        let (time, last) = time.split_at_checked(time.len().checked_sub(2)?)?;
        last.eq_ignore_ascii_case(end).then(|| of_day(time.trim_end()))
    };
    // 12:30 AM is half an hour after midnight.
    match (ending("AM"), ending("PM")) {
        (Some(time), _) => Some(time? % HALF_DAY_S),
        (_, Some(time)) => Some(time? % HALF_DAY_S + HALF_DAY_S),
        _ => of_day(time),
    }
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

/// Days since 1970-01-01 of a date in the Gregorian calendar.
///
/// # Source
/// `[Hinnant, "chrono-Compatible Low-Level Date Algorithms", days_from_civil]`
fn days(date: &str) -> Option<f64> {
    let mut parts = date.split(['-', '/', '.']);
    let [first, second, third] = [parts.next()?, parts.next()?, parts.next()?];
    if parts.next().is_some() || date.contains('+') {
        return None;
    }
    let number = |text: &str| text.parse::<i64>().ok();
    let [a, b, c] = [number(first)?, number(second)?, number(third)?];
    let (year, month, day) = match (first.len(), third.len()) {
        (4, _) => (a, b, c),
        (_, 4) if date.contains('/') && a <= 12 => (c, a, b),
        (_, 4) => (c, b, a),
        _ => return None,
    };
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
    use super::Stamp;

    fn seconds(cell: &str) -> Option<f64> {
        Stamp::of(cell).map(|stamp| stamp.date_s.unwrap_or(0.0) + stamp.of_day_s)
    }

    #[test]
    fn stamps() {
        assert_eq!(seconds("00:01:02.5"), Some(62.5));
        assert_eq!(seconds("1970-01-02T00:00:01Z"), Some(86_401.0));
        // `date -d 2024-02-29T12:00:00+01:00 +%s`
        assert_eq!(seconds("2024-02-29 12:00:00+01:00"), Some(1_709_204_400.0));
        assert_eq!(seconds("2024-02-29T12:00:00-0130"), Some(1_709_213_400.0));
        // `date -d 2024-06-11T10:00:00.5Z +%s`
        for date in ["11.06.2024", "06/11/2024", "6/11/2024", "2024/06/11", "2024-06-11"] {
            assert_eq!(seconds(&format!("{date} 10:00:00,500")), Some(1_718_100_000.5), "{date}");
        }
        assert_eq!(seconds("25/06/2024 00:00:00"), seconds("25.06.2024 00:00:00"));
        assert_eq!(seconds("12:00:01 am"), Some(1.0));
        assert_eq!(seconds("6/11/2024 10:00:00 PM"), seconds("2024-06-11 22:00:00"));
        for other in [
            "",
            "12",
            "1.5",
            "a:b:c",
            "2024-13-01T00:00:00",
            "12:61:00",
            "12:00:99",
            "1:2:3:4",
            "6/11 10:00:00",
            "1.2.3 10:00:00",
            // The second byte is inside a character.
            "2024-06-11 11:59:59+P\u{192}M",
            "2024-06-11 11:59:59+inf",
        ] {
            assert_eq!(seconds(other), None, "{other}");
        }
    }
}
