// The clocked pipeline, driven by hand.
import { $, ask, element, Line, Refused, say } from "./ask.js";
import { wave, waveTable } from "./wave.js";

const line = new Line();
let pipeline = null;
let seen = [];

const state = (rank) => (rank.stalled ? "waits" : rank.valid ? "moves on" : "empty");

const box = (rank) => {
  const registers = rank.registers.map((register) => element("tr", {},
    element("th", { scope: "row" }, register.name),
    element("td", { class: "number" }, rank.loaded ? register.hex : "unknown")));
  return element("li", { class: rank.stalled ? "stalled" : rank.valid ? "valid" : "empty" },
    element("b", {}, rank.name), element("span", { class: "state" }, state(rank)),
    element("details", {}, element("summary", {}, "registers"),
      element("table", {}, element("tbody", {}, ...registers))));
};

const show = (ranks) => {
  const open = [...$("pipeline").querySelectorAll("details")].map((details) => details.open);
  $("pipeline").replaceChildren(...ranks.map(box));
  $("pipeline").querySelectorAll("details").forEach((details, place) => (details.open = open[place] ?? false));
  wave($("wave"), seen, ranks);
  waveTable($("wave-table"), seen, ranks);
};

const words = ({ now, ranks }) => {
  const held = ranks.filter((rank) => rank.valid).length;
  const output = now.out_valid ? `a result is shown, intensity ${now.intensity}` : "no result is shown";
  return `After ${seen.length} clock edges ${held} of ${ranks.length} ranks hold a request; ` +
    `in_ready is ${now.in_ready ? "high" : "low"}, ${output}.`;
};

const drive = (question, cycles) => line.run(async () => {
  try {
    if (!pipeline) throw new Refused({ message: "There is no pipeline yet." });
    const answer = await ask("/api/clock", {
      session: pipeline, ...question(), cycles,
      reset: $("reset").checked, in_valid: $("in-valid").checked, out_ready: $("out-ready").checked,
    });
    seen.push(...answer.cycles);
    say($("clock-problem"), null);
    $("clock-answer").textContent = words(answer);
    show(answer.ranks);
  } catch (error) {
    say($("clock-problem"), error);
  }
});

// An empty pipeline of a configuration.
export const open = async (configuration) => {
  try {
    const opened = await ask("/api/clock/open", { configuration });
    pipeline = opened.session;
    seen = [];
    $("clock-answer").textContent = `An empty pipeline of ${opened.ranks.length} ranks: no clock edge yet.`;
    say($("clock-problem"), null);
    show(opened.ranks);
  } catch (error) {
    say($("clock-problem"), error);
  }
};

// Begins to listen; `question` gives n and x, `configuration` that of the page.
export const listen = (question, configuration) => {
  for (const port of ["reset", "in-valid", "out-ready"]) $(port).addEventListener("change", () => drive(question, 0));
  $("tick").addEventListener("click", () => drive(question, 1));
  $("ticks").addEventListener("click", () => drive(question, 8));
  $("begin").addEventListener("click", () => open(configuration()));
};
