// The state of the page: configuration, n and x. It stands in the address, so that a link shows the same.
import { $, ask, begin, element, Line, rows, saveRtl, say } from "./ask.js";
import { curve } from "./curve.js";
import { highlight } from "./highlight.js";
import * as widths from "./widths.js";
import * as clock from "./clock.js";

const OWN = "";
const line = new Line();
let start = null;
let hardware = null;
let configuration = null;
let answered = null;
let x = { real: "0.99" };

const fragment = () => {
  const { preset, text } = configuration;
  const state = new URLSearchParams(preset ? { preset } : { text });
  state.set("n", $("n").value.trim());
  state.set(x.bits === undefined ? "x" : "x_bits", x.bits ?? x.real);
  return `#${state}`;
};

// What an address says; nothing where it is a place of the page.
const read = () => {
  const state = new URLSearchParams(location.hash.slice(1));
  return ["preset", "text", "n", "x", "x_bits"].some((name) => state.has(name)) ? state : null;
};

const remember = (again) => {
  const hash = fragment();
  if (hash !== location.hash) history[again ? "pushState" : "replaceState"](null, "", hash);
};

const question = () => ({ n: $("n").value.trim(), x });

const shownAnswer = (answer) => {
  answered = answer;
  const address = hardware.exponents.indexOf(answer.n.value);
  if (address >= 0) $("n-slider").value = address;
  $("n-slider").setAttribute("aria-valuetext", answer.n.text);
  $("x-slider").value = answer.x.bits;
  $("x-slider").setAttribute("aria-valuetext", answer.x.decimal);
  if (x.bits !== undefined) $("x").value = answer.x.text;
};

// What was answered is remembered: a number that is none leaves no way back to it.
const asked = (again) => highlight(configuration, question().n, x, (answer) => {
  remember(again);
  shownAnswer(answer);
  curve(configuration, hardware, question().n, answer);
});

const figures = () => {
  const of = hardware.figures;
  const peak = ({ per_cent, n, x: at }) => `${per_cent.text} % (n = ${n.text}, x = ${at.text})`;
  rows($("hardware"), [
    ["Exponents", hardware.stated_exponents],
    ["x, intensity", `${hardware.input.name}, ${hardware.output.name}`],
    ["Greatest error for xⁿ ≥ Q", peak(of.epicentre)],
    ["Greatest error on [0, 1]", peak(of.everywhere)],
    ["Proved bound of the roundings", `${of.proved_ulp.text} ulp, of a budget of ${of.budget_ulp.text}`],
    ["Latency", `${of.latency} cycles`],
    ["ROM", `${of.rom_bits} bits`],
    ["Multipliers", `${of.multiplier_bits} partial-product bits`],
  ]);
  $("description").textContent = hardware.description;
};

const loaded = () => {
  $("preset").value = configuration.preset ?? OWN;
  $("text").value = hardware.text;
  $("n-slider").max = hardware.exponents.length - 1;
  $("x-slider").max = hardware.greatest_x;
  figures();
  widths.offer(hardware);
};

// Another configuration; what is wrong with it is said where it was written.
const use = (wanted, again = true) => line.run(async () => {
  const place = wanted.preset ? $("problem") : $("text-problem");
  try {
    $("main").setAttribute("aria-busy", "true");
    const found = await ask("/api/hardware", { configuration: wanted });
    [hardware, configuration] = [found, wanted];
    say($("problem"), null);
    say($("text-problem"), null);
    loaded();
    await clock.open(configuration);
    await asked(again);
  } catch (error) {
    say(place, error);
    if (error.line) mark(error.line, error.column);
    if (!wanted.preset) $("paste").open = true;
  } finally {
    $("main").removeAttribute("aria-busy");
  }
});

// Puts the cursor where the error of a pasted text stands.
const mark = (row, column) => {
  const lines = $("text").value.split("\n");
  const before = lines.slice(0, row - 1).reduce((sum, text) => sum + text.length + 1, 0);
  $("text").focus();
  $("text").setSelectionRange(before + Math.max(0, column - 1), before + column);
};

const follow = () => {
  const state = read();
  if (!state) return null;
  if (state.has("n")) $("n").value = state.get("n");
  if (state.has("x")) x = { real: state.get("x") };
  if (state.has("x_bits")) x = { bits: state.get("x_bits") };
  $("x").value = x.real ?? $("x").value;
  if (state.has("text")) return { text: state.get("text") };
  return state.has("preset") ? { preset: state.get("preset") } : start.configuration;
};

const same = (one, other) => one && other && one.preset === other.preset && one.text === other.text;

const listen = () => {
  $("preset").addEventListener("change", () => {
    if ($("preset").value !== OWN) use({ preset: $("preset").value });
    else $("paste").open = true;
  });
  $("own").addEventListener("submit", (event) => {
    event.preventDefault();
    use({ text: $("text").value });
  });
  $("question").addEventListener("submit", (event) => event.preventDefault());
  $("n").addEventListener("change", () => asked(true));
  $("n-slider").addEventListener("input", () => {
    $("n").value = hardware.exponents[$("n-slider").value];
    asked(false);
  });
  $("x").addEventListener("change", () => {
    x = { real: $("x").value.trim() };
    asked(true);
  });
  $("x-slider").addEventListener("input", () => {
    x = { bits: $("x-slider").value };
    asked(false);
  });
  document.querySelectorAll("input[name=span]").forEach((radio) => radio.addEventListener("change", () => {
    if (answered) curve(configuration, hardware, question().n, answered);
  }));
  $("rtl").addEventListener("click", () => {
    saveRtl(configuration, hardware.name).then(() => say($("problem"), null), (error) => say($("problem"), error));
  });
  window.addEventListener("popstate", () => {
    const wanted = follow();
    if (wanted) same(wanted, configuration) ? asked(false) : use(wanted, false);
  });
  widths.listen(() => ({ configuration, hardware, use: (text) => { $("text").value = text; use({ text }); } }));
  clock.listen(question, () => configuration);
};

start = await begin();
$("preset").append(...start.presets.map(({ name }) => element("option", { value: name }, name)),
  element("option", { value: OWN }, "a configuration of your own"));
const wanted = follow() ?? start.configuration;
$("text").value = wanted.text ?? "";
listen();
await use(wanted, false);
document.documentElement.dataset.ready = "true";
