#!/usr/bin/env python3
"""Looks at the pages that `tests/tests/html.rs` had made: tests/browser/pages.py DIRECTORY

What a page shows is held against the CSV and Markdown that the same command wrote beside it. Every page is opened wide
in light colours and narrow in dark ones; then tables are sorted and searched, and plots and diagrams asked, as a reader
would.
"""

import csv
import json
import math
import pathlib
import sys

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser import Checks, open_browser

PLACE = pathlib.Path(sys.argv[1]).resolve()
# A page shows 7 digits of a real; the CSV beside it has all.
CLOSE = 1e-6


def text(driver, selector):
    """The words of the first element of this selector."""
    return driver.find_element(By.CSS_SELECTOR, selector).get_attribute("textContent").strip()


def table(driver, section):
    """The first table below a heading, as its rows of cells; the first row has the columns."""
    return driver.execute_script(
        "const table = document.querySelector(`section[aria-labelledby='${arguments[0]}'] table`);"
        "return Array.from(table.rows).filter((row) => !row.hidden)"
        ".map((row) => Array.from(row.cells, (cell) => cell.textContent.trim()));",
        section,
    )


def same(shown, wanted):
    """Whether a cell of a page says what a cell of a CSV says."""
    try:
        return math.isclose(float(shown), float(wanted), rel_tol=CLOSE, abs_tol=1e-300)
    except ValueError:
        return shown == wanted


def rows_of(path):
    """The rows of a CSV, its columns first."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


def equal_tables(checks, shown, wanted, what):
    """A table of a page has the rows of a CSV."""
    checks.equal((len(shown), shown[0]), (len(wanted), wanted[0]), f"{what}: rows and columns")
    for row, (left, right) in enumerate(zip(shown[1:], wanted[1:])):
        for column, name in enumerate(wanted[0]):
            found, kept = left[column], right[column]
            checks.true(same(found, kept), f"{what}: {name} of row {row}: {found}, {kept}")


def sorted_and_searched(checks, driver, section, column):
    """A click on a heading sorts the rows, a second one turns them round; a word typed above hides the others."""
    rows = table(driver, section)
    at = rows[0].index(column)
    wanted = sorted((row[at] for row in rows[1:]), key=float)
    place = f"section[aria-labelledby='{section}']"
    for direction, expected in (("ascending", wanted), ("descending", wanted[::-1])):
        heading = driver.find_elements(By.CSS_SELECTOR, f"{place} thead th")[at]
        heading.find_element(By.TAG_NAME, "button").send_keys(Keys.ENTER)
        checks.equal(heading.get_attribute("aria-sort"), direction, f"{section}: aria-sort")
        checks.equal([row[at] for row in table(driver, section)[1:]], expected, f"{section}: {direction} by {column}")
    field = driver.find_element(By.CSS_SELECTOR, f"{place} input[type=search]")
    word = wanted[0]
    field.send_keys(word)
    found = table(driver, section)[1:]
    expected = [row for row in rows[1:] if any(word in cell for cell in row)]
    checks.equal(len(found), len(expected), f"{section}: rows with {word}")
    count = f"{len(expected)} of {len(rows) - 1} rows"
    checks.equal(text(driver, f"{place} .search output"), count, f"{section}: count")
    field.clear()
    field.send_keys(" ", Keys.BACKSPACE)
    checks.equal(len(table(driver, section)), len(rows), f"{section}: all rows again")


def asked_plot(checks, driver, what):
    """Arrow keys and the pointer make a plot tell a point. Returns its data, and what it told after two arrow keys."""
    data = json.loads(text(driver, "figure.plot script"))
    drawing = driver.find_element(By.CSS_SELECTOR, "figure.plot .drawing")
    before = text(driver, "figure.plot .told")
    drawing.send_keys(Keys.ARROW_RIGHT)
    first = text(driver, "figure.plot .told")
    checks.true(first != before and ("=" in first or ":" in first), f"{what}: an arrow key tells a point: {first}")
    drawing.send_keys(Keys.ARROW_RIGHT)
    second = text(driver, "figure.plot .told")
    checks.true(second != first, f"{what}: the next arrow key tells the next point")
    canvas = driver.find_element(By.CSS_SELECTOR, "figure.plot canvas")
    checks.true(canvas.size["width"] > 200, f"{what}: the plot is drawn")
    pointed = pointed_at(driver, second)
    checks.true(pointed != second and ("=" in pointed or ":" in pointed), f"{what}: the pointer tells one: {pointed}")
    return data, second


def pointed_at(driver, told):
    """What the first plot tells, once the pointer has gone over it and met a point that was not told yet."""
    area = driver.find_element(By.CSS_SELECTOR, "figure.plot .u-over")
    width, height = area.size["width"], area.size["height"]
    for row in range(1, 10):
        for column in range(1, 20):
            across, down = round((column / 20 - 0.5) * width), round((row / 10 - 0.5) * height)
            ActionChains(driver, duration=0).move_to_element_with_offset(area, across, down).perform()
            now = text(driver, "figure.plot .told")
            if now != told:
                return now
    return told


def document(checks, driver):
    """A click on a wire, and Enter on a box, show what the table of registers says."""
    markdown = (PLACE / "document/small.md").read_text(encoding="utf-8")
    rows = [line.strip("| ").split(" | ") for line in markdown.splitlines() if line.startswith("| `t1` |")]
    wanted = next(row for row in rows if len(row) > 5)
    driver.find_element(By.CSS_SELECTOR, "[data-register='t1'] text").click()
    shown = text(driver, ".details")
    for value in (wanted[2], wanted[4], wanted[8]):
        checks.true(value.strip() in shown, f"document: {value} of t1 in {shown}")
    box = driver.find_element(By.CSS_SELECTOR, "[data-register='t2']")
    box.send_keys(Keys.ENTER)
    checks.true("Register t2" in text(driver, ".details"), "document: Enter on t2")
    sorted_and_searched(checks, driver, "registers", "width")
    pictures = driver.find_elements(By.CSS_SELECTOR, ".picture svg")
    checks.equal(len(pictures), markdown.count(".svg)"), "document: pictures")


def report(checks, driver):
    """The rows are those of error_vs_n.csv, and the first plot has them."""
    wanted = rows_of(PLACE / "report/error_vs_n.csv")
    equal_tables(checks, table(driver, "every-exponent"), wanted, "report")
    sorted_and_searched(checks, driver, "every-exponent", "total_abs")
    data, told = asked_plot(checks, driver, "report")
    at = wanted[0].index("total_abs")
    drawn = [y for y in data["columns"][1] if y is not None]
    checks.equal(len(drawn), len(wanted) - 1, "report: points of the first curve")
    for found, row in zip(drawn, wanted[1:]):
        checks.true(abs(found - 100 * float(row[at])) <= 1e-8, f"report: {found} % is {row[at]}")
    checks.true(told.startswith("total, absolute: exponent n = 2"), f"report: told {told}")


def pareto(checks, driver):
    """Every contender of pareto.csv stands in the table, with its greatest error."""
    columns, *wanted = rows_of(PLACE / "pareto/pareto.csv")
    shown = {row[0]: row for row in table(driver, "greatest-and-rms-errors")[1:]}
    checks.equal(len(shown), len(wanted), "pareto: contenders")
    for row in wanted:
        found, error = shown[row[0]][4], row[columns.index("whole_worst")]
        checks.true(math.isclose(float(found), float(error), rel_tol=1e-3), f"pareto: {row[0]}: {found}, {error}")
    asked_plot(checks, driver, "pareto")


def certify(checks, driver):
    """The bounds are those that the command printed as CSV."""
    equal_tables(checks, table(driver, "every-bound"), rows_of(PLACE / "certify.csv"), "certify")
    data, _ = asked_plot(checks, driver, "certify")
    checks.equal(len(data["curves"]), 1, "certify: a curve for the method")


PAGES = {
    "document/small.html": document,
    "report/report.html": report,
    "pareto/pareto.html": pareto,
    "certify.html": certify,
}


def main():
    """Opens every page, and ends with the verdict."""
    checks = Checks()
    for width, dark in ((1440, False), (390, True)):
        driver = open_browser(width=width, dark=dark)
        for name, looked_at in PAGES.items():
            driver.get((PLACE / name).as_uri())
            what = f"{name} at {width}{' in the dark' if dark else ''}"
            checks.accessible(driver, what)
            asked = driver.execute_script("return performance.getEntriesByType('resource').map((entry) => entry.name)")
            checks.equal([address for address in asked if not address.startswith("data:")], [], f"{what}: requests")
            checks.true(text(driver, ".verdict .words"), f"{what}: a verdict")
            if not dark:
                looked_at(checks, driver)
            checks.console(driver, what)
        driver.quit()
    checks.finish()


if __name__ == "__main__":
    main()
