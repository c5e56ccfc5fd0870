"""The page of `blysk serve` in a browser: what it shows is what `blysk evaluate` prints.

    test_serve.py ADDRESS BLYSK [DIRECTORY]

ADDRESS is that of a running server, BLYSK the command; screenshots go to DIRECTORY, where one is given.
"""

import subprocess
import sys

from browser import Checks, open_browser, resize, screenshot
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select, WebDriverWait

ADDRESS, BLYSK = sys.argv[1], sys.argv[2]
PICTURES = sys.argv[3] if len(sys.argv) > 3 else None

checks = Checks()


def evaluate(*arguments):
    """What the command prints: its lines by their names, and the rows of the ranks."""
    command = [BLYSK, "evaluate", *arguments, "--ranks"]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    head, ranks = printed.split("\n\n")
    lines = dict(line.split(None, 1) for line in head.splitlines())
    return lines, [row.split() for row in ranks.splitlines()[1:]]


class Page:
    """The page, by the ids of its elements."""

    def __init__(self, driver):
        self.driver = driver

    def open(self, fragment):
        """A new page, once it has its first answers."""
        self.driver.get("about:blank")
        self.driver.get(ADDRESS + fragment)
        self.until(lambda: self.driver.execute_script("return document.documentElement.dataset.ready") == "true")

    def until(self, holds):
        """Waits for what a script brings about."""
        WebDriverWait(self.driver, 60).until(lambda _: holds())

    def __getitem__(self, name):
        return self.driver.find_element(By.ID, name)

    def text(self, name):
        return self.driver.execute_script("return document.getElementById(arguments[0]).textContent", name)

    def register_rows(self):
        """Name, format, hex, integer, value of every register that is shown."""
        return self.driver.execute_script(
            "return [...document.querySelectorAll('#rank-list tbody tr')].map((row) => {"
            "const cells = [...row.children].map((cell) => cell.textContent);"
            "return [cells[0], cells[1], cells[3], cells[4], cells[5]]; })"
        )

    def bits(self):
        """The bits of every register as they are shown, with the point and without the spaces."""
        script = "return [...document.querySelectorAll('#rank-list .bits')].map((code) => code.textContent)"
        return [bits.replace(" ", "") for bits in self.driver.execute_script(script)]


def values(page, what, *arguments):
    """The page shows what the command prints for the same question."""
    lines, ranks = evaluate(*arguments)
    squeezed = lambda text: " ".join(text.split())
    checks.equal(squeezed(page.text("intensity")), squeezed(lines["intensity"]), f"{what}: intensity")
    checks.equal(page.text("reference"), lines["x^n"].split()[0], f"{what}: x^n")
    checks.equal(page.text("error"), lines["error"], f"{what}: error")
    region, status = page.text("region"), page.text("status")
    checks.equal(f"{region} (status {status})", squeezed(lines["region"]), f"{what}: region")
    checks.equal(page.register_rows(), [row[1:] for row in ranks], f"{what}: registers")
    for row, bits in zip(ranks, page.bits()):
        word = int(bits.replace(".", ""), 2)
        checks.equal(word, int(row[3], 16), f"{what}: bits of {row[1]}")


def highlight(page):
    page.open("#preset=compact&n=64&x=0.99")
    values(page, "a link", "--preset", "compact", "--n", "64", "--x", "0.99")
    checks.equal(page.text("asked").split(" ")[2], "64,", "n of the link")
    page.open("#preset=paper&n=3&x_bits=2097152")
    values(page, "bits in a link", "--preset", "paper", "--n", "3", "--x-bits", "2097152")
    checks.equal(len(page.driver.find_elements(By.CSS_SELECTOR, "#plots canvas")), 2, "plots")
    page.driver.execute_script("document.getElementById('computed').click()")
    shown = len(page.register_rows())
    every = len(evaluate("--preset", "paper", "--n", "3", "--x", "0.25")[1])
    checks.true(0 < shown < every, "fewer registers are shown")


def keyboard(page):
    """One place of x for an arrow key, an exponent for another, and the way back."""
    page.open("#preset=compact&n=64&x_bits=8304722")
    asked = lambda text: page.until(lambda: text in page.text("asked"))
    page["x-slider"].send_keys(Keys.ARROW_RIGHT)
    asked("8304723")
    values(page, "one place more", "--preset", "compact", "--n", "64", "--x-bits", "8304723")
    page["n-slider"].send_keys(Keys.ARROW_LEFT)
    asked("n = 63,")
    values(page, "one exponent less", "--preset", "compact", "--n", "63", "--x-bits", "8304723")
    page["n"].send_keys(Keys.CONTROL, "a")
    page["n"].send_keys("16", Keys.TAB)
    asked("n = 16,")
    page.driver.back()
    asked("n = 63,")
    page.driver.forward()
    asked("n = 16,")
    checks.true("n=16" in page.driver.current_url, "the address holds the state")
    Select(page["preset"]).select_by_value("precise")
    page.until(lambda: "preset=precise" in page.driver.current_url)
    page.until(lambda: "UQ" in page.text("asked") and len(page.register_rows()) > 0)
    page.driver.back()
    page.until(lambda: page["preset"].get_property("value") == "compact")


def widths(page):
    page.open("#preset=compact&n=64&x=0.99")
    Select(page["register"]).select_by_value("t1")
    before = page["format"].get_property("value")
    page["fewer"].click()
    page.until(lambda: page.driver.find_elements(By.ID, "alter-verdict"))
    head = page.driver.find_element(By.CSS_SELECTOR, "#altered thead").text
    checks.true(before in head and page["format"].get_property("value") in head, "both formats stand over the table")
    checks.true(page.driver.find_elements(By.CSS_SELECTOR, "#altered tr.changed"), "something changed")
    checks.equal(len(page.driver.find_elements(By.CSS_SELECTOR, "#altered button")), 2, "what can be done with it")
    page.driver.find_element(By.CSS_SELECTOR, "#altered button").click()
    page.until(lambda: "text=" in page.driver.current_url)
    checks.true(page["text"].get_property("value").find('"t1"') > 0, "the altered configuration is the page's")


def clock(page):
    """Driven by the keyboard: the pipeline fills, stalls, and gives its result."""
    page.open("#preset=compact&n=64&x=0.99")
    states = lambda: [state.text for state in page.driver.find_elements(By.CSS_SELECTOR, "#pipeline .state")]
    after = lambda edges: page.until(lambda: page.text("clock-answer").startswith(f"After {edges} clock edges"))
    checks.true(set(states()) == {"empty"}, "an empty pipeline")
    page["out-ready"].send_keys(Keys.SPACE)
    page["tick"].send_keys(Keys.ENTER)
    after(1)
    checks.equal(states()[:2], ["moves on", "empty"], "a request has entered")
    page["ticks"].send_keys(Keys.ENTER)
    after(9)
    checks.equal(set(states()), {"waits"}, "all ranks are full and wait")
    lines, _ = evaluate("--preset", "compact", "--n", "64", "--x", "0.99")
    bits = lines["intensity"].split(": ")[1].split(",")[0]
    checks.true(f"intensity {bits}." in page.text("clock-answer"), "the result is that of the question")
    page["in-valid"].send_keys(Keys.SPACE)
    page["out-ready"].send_keys(Keys.SPACE)
    page["tick"].send_keys(Keys.ENTER)
    after(10)
    checks.equal(states()[0], "empty", "the first rank is left")
    columns = page.driver.find_elements(By.CSS_SELECTOR, "#wave .cycle")
    checks.equal(len(columns), 10, "a column of the waveform for each edge")
    cells = page.driver.execute_script("return document.querySelectorAll('#wave-table tbody tr')[0].children.length")
    checks.equal(cells, 11, "and of the table that says the same")
    page["begin"].click()
    page.until(lambda: "no clock edge yet" in page.text("clock-answer"))


def refused(page):
    """What is wrong is said where it was written; the console shows the refusals, and nothing else."""
    page.open("#preset=compact&n=300&x=0.99")
    checks.true(page.text("status") != "-", "an exponent without a word has a flag")
    page.driver.execute_script("document.getElementById('paste').open = true")
    field = page["text"]
    field.clear()
    field.send_keys('{"name": 3}')
    page.driver.find_element(By.CSS_SELECTOR, "#own button").click()
    page.until(lambda: page["text-problem"].is_displayed())
    checks.true("line 1 column 10" in page.text("text-problem"), page.text("text-problem"))
    checks.equal(page["preset"].get_property("value"), "compact", "the configuration before stays")
    page["x"].clear()
    page["x"].send_keys("7", Keys.TAB)
    page.until(lambda: page["question-problem"].is_displayed())
    checks.true("UQ1.23" in page.text("question-problem"), page.text("question-problem"))
    messages = [entry["message"] for entry in page.driver.get_log("browser")]
    unexpected = [message for message in messages if "status of 422" not in message]
    checks.equal(unexpected, [], "refusals: console")


def looks(page, dark):
    for width in (1440, 390):
        resize(page.driver, width, 1000)
        page.open("#preset=compact&n=64&x=0.99")
        page["ticks"].click()
        page.until(lambda: page.text("clock-answer").startswith("After 8 clock edges"))
        what = f"{width} pixels, {'dark' if dark else 'light'}"
        checks.accessible(page.driver, what)
        checks.console(page.driver, what)
        if PICTURES:
            screenshot(page.driver, f"{PICTURES}/serve-{width}-{'dark' if dark else 'light'}.png")


for dark in (False, True):
    driver = open_browser(dark=dark)
    try:
        page = Page(driver)
        if not dark:
            for part in (highlight, keyboard, widths, clock):
                part(page)
                checks.console(driver, part.__name__)
            refused(page)
        looks(page, dark)
    finally:
        driver.quit()
checks.finish()
