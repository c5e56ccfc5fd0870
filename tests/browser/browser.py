"""Chromium without a window, for the tests of pages.

`open_browser()` starts Debian's Chromium through its driver; `Checks` counts what was looked at, so that a test that
looked at nothing fails. What a page writes to the console counts as an error, warnings too.
"""

import os
import shutil
import sys

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError:
    sys.exit("selenium is not there: scripts/setup installs it in target/venv")

INSTALL = "apt-get install chromium chromium-driver (scripts/setup does it)"


def program(*names):
    """The first of these programs that is there."""
    for name in names:
        path = shutil.which(name)
        if path:
            return path
    sys.exit(f"{names[0]} is not there, and pages cannot be tested without it: {INSTALL}")


def open_browser(width=1440, height=1000, dark=False):
    """A browser without a window, of this size in pixels, in light or dark colours."""
    options = webdriver.ChromeOptions()
    options.binary_location = program("chromium", "chromium-browser", "google-chrome")
    options.add_argument("--headless=new")
    options.add_argument("--disable-gpu")
    options.add_argument("--disable-dev-shm-usage")
    options.add_argument("--force-device-scale-factor=1")
    options.add_argument("--hide-scrollbars")
    if os.geteuid() == 0:
        # Chromium's sandbox refuses to run as root.
        options.add_argument("--no-sandbox")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(program("chromedriver")))
    resize(driver, width, height)
    feature = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [feature]})
    return driver


def resize(driver, width, height):
    """Makes the page this wide and high; a window of its own is never narrower than some 500 pixels."""
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)


def screenshot(driver, path):
    """Saves what the whole page looks like, from its top to its foot."""
    height = driver.execute_script("return document.documentElement.scrollHeight")
    width = driver.execute_script("return window.innerWidth")
    resize(driver, width, height)
    driver.save_screenshot(path)


class Checks:
    """What was looked at, and what of it was wrong."""

    def __init__(self):
        self.count = 0
        self.wrong = []

    def equal(self, found, wanted, what):
        """The page has what it should."""
        self.count += 1
        if found != wanted:
            self.wrong.append(f"{what}: found {found!r}, not {wanted!r}")

    def true(self, holds, what):
        """Something holds."""
        self.equal(bool(holds), True, what)

    def console(self, driver, what):
        """Nothing was written to the console since this was last asked."""
        messages = [f"{entry['level']} {entry['message']}" for entry in driver.get_log("browser")]
        self.equal(messages, [], f"{what}: console")

    def accessible(self, driver, what):
        """Landmarks, headings in order, names of controls, ids that differ, and contrast of text."""
        for problem in driver.execute_script(BASICS):
            self.wrong.append(f"{what}: {problem}")
        self.count += 1

    def finish(self):
        """Prints the verdict and ends the program."""
        for line in self.wrong:
            print(f"FAIL {line}")
        if self.count == 0:
            sys.exit("no check was made")
        print(f"{self.count} checks, {len(self.wrong)} failed")
        sys.exit(1 if self.wrong else 0)


# Runs in the page and returns what is wrong with it, in words.
BASICS = r"""
const problems = [];
const one = (selector) => {
  const count = document.querySelectorAll(selector).length;
  if (count !== 1) problems.push(`${count} elements ${selector}, not 1`);
};
["header", "nav", "main", "h1", "a.skip", "html[lang]", "title"].forEach(one);
let level = 0;
for (const heading of document.querySelectorAll("h1, h2, h3, h4, h5, h6")) {
  const next = Number(heading.tagName[1]);
  if (next > level + 1) problems.push(`heading "${heading.textContent}" of level ${next} below level ${level}`);
  level = next;
}
for (const control of document.querySelectorAll("input, select, textarea")) {
  if (control.type !== "hidden" && control.labels.length === 0 && !control.getAttribute("aria-label"))
    problems.push(`a control without a label: ${control.outerHTML.slice(0, 80)}`);
}
for (const button of document.querySelectorAll("button, a[href], [role=button]")) {
  if (!button.textContent.trim() && !button.getAttribute("aria-label"))
    problems.push(`a control without a name: ${button.outerHTML.slice(0, 80)}`);
}
const ids = Array.from(document.querySelectorAll("[id]"), (element) => element.id);
ids.filter((id, index) => ids.indexOf(id) !== index).forEach((id) => problems.push(`id ${id} twice`));
for (const link of document.querySelectorAll("a[href^='#']")) {
  const target = decodeURIComponent(link.getAttribute("href").slice(1));
  if (!document.getElementById(target)) problems.push(`a link to #${target}, which is not there`);
}
if (document.documentElement.scrollWidth > window.innerWidth)
  problems.push(`the page is ${document.documentElement.scrollWidth} pixels wide in a window of ${window.innerWidth}`);
const rgba = (text) => {
  const [r, g, b, a = 1] = (text.match(/[\d.]+/g) || [0, 0, 0, 0]).map(Number);
  return { r, g, b, a };
};
const light = ({ r, g, b }) => {
  const of = (value) => (value / 255 <= 0.04045 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4);
  return 0.2126 * of(r) + 0.7152 * of(g) + 0.0722 * of(b);
};
const ground = (element) => {
  for (let at = element; at; at = at.parentElement) {
    const colour = rgba(getComputedStyle(at).backgroundColor);
    if (colour.a === 1) return colour;
  }
  return { r: 255, g: 255, b: 255 };
};
const seen = new Set();
const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
while (walker.nextNode()) {
  const element = walker.currentNode.parentElement;
  if (!walker.currentNode.textContent.trim() || element.closest("svg, script, style, noscript")) continue;
  const style = getComputedStyle(element);
  if (style.visibility === "hidden" || style.display === "none") continue;
  const [a, b] = [light(rgba(style.color)), light(ground(element))];
  const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  const key = `${style.color} on ${element.tagName}.${element.className}`;
  if (contrast < 4.5 && !seen.has(key)) {
    seen.add(key);
    problems.push(`contrast ${contrast.toFixed(2)} of "${element.textContent.trim().slice(0, 40)}" (${key})`);
  }
}
return problems;
"""
