"""Excel workbooks written by openpyxl."""

import datetime

import numpy as np
import openpyxl

import expected

DAYS = 2.0**-22
START = datetime.datetime(2026, 11, 27, 23, 59, 58, 500_000)


def number(value):
    if value is None:
        return np.nan
    return float(value)


def sheet(workbook, name, above, header, units, rows, first_column=1):
    page = workbook.create_sheet(name)
    row = 1
    for line in above + [header, units]:
        if line is None:
            continue
        for k, cell in enumerate(line):
            page.cell(row, first_column + k, cell)
        row += 1
    for values in rows:
        for k, value in enumerate(values):
            if value is not None:
                page.cell(row, first_column + k, value)
        row += 1
    return page


def write_all(folder, rng):
    count = 0
    for rows in (12, 400):
        t = [k * 0.002 for k in range(rows)]
        current, angle = rng.normal(size=rows), rng.normal(size=rows) * 1e-9
        on = [bool(v) for v in rng.integers(0, 2, rows)]
        gaps = [None if rng.random() < 0.3 else float(v) for v in rng.normal(size=rows)]
        gaps[0], gaps[-1] = 1.0, 2.0
        ints = [int(v) for v in rng.integers(-(2**40), 2**40, rows)]
        # Numbers of days in the format of a date; openpyxl writes 16 digits.
        dates = [float(f"{46353.75 + k * DAYS:.16g}") for k in range(rows)]
        times = [(START + datetime.timedelta(milliseconds=7 * k)).time() for k in range(rows)]
        names = ["t", "current, phase U", "angle [rad]", "on", "gaps", "count"]
        columns = [t, current, angle, on, gaps, ints]
        table = [list(row) for row in zip(*columns)]
        table = [[float(v) if isinstance(v, np.floating) else v for v in row] for row in table]
        for name, above, units, date in [
            ("header", [], None, None), ("preamble", [["a drive"], ["made by", "x"], []], None, None),
            ("units", [], ["s", "A", "rad", "-", "-", "1"], None), ("dates", [], None, dates), ("times", [], None, times),
            ("others", [], None, None),
        ]:
            workbook = openpyxl.Workbook()
            workbook.remove(workbook.active)
            note = None
            if name == "others":
                sheet(workbook, "summary", [], ["mean", "std"], None, [[1.0, 2.0], [3.0, 4.0]])
                note = "sheet log is read, with the longest block of numbers, and not summary"
            head = (["date"] if date else []) + names
            body = [[date[k]] + row for k, row in enumerate(table)] if date else table
            page = sheet(workbook, "log", above, head, units, body)
            if date is dates:
                for (cell,) in page.iter_rows(min_row=2, max_col=1):
                    cell.number_format = "yyyy-mm-dd hh:mm:ss.000"
            path = folder / f"{name}_{rows}.xlsx"
            workbook.save(path)
            found = []
            if date:
                since = [(d - date[0]) * 86400 for d in date] if date is dates else [k * 0.007 for k in range(rows)]
                found.append(expected.channel("date", [round(s, 6) for s in since], "s"))
            for k, (label, values) in enumerate(zip(names, columns)):
                unit = units[k] if units else ("rad" if label.endswith("[rad]") else None)
                found.append(expected.channel(label, [number(v) for v in values], unit))
            expected.write(path, found, note)
            count += 1
    return count
