// One highlight: the answer, and every register on the way.
import { $, ask, bits, element, Line, rows, say, table } from "./ask.js";

const line = new Line();
let last = null;

const summary = (answer) => {
  const { intensity, x } = answer;
  const ulp = `${answer.error_ulp.text} ulp of ${intensity.format.name}`;
  const error = `${ulp}, ${answer.error_per_cent.text} % of full intensity`;
  rows($("answer"), [
    ["Intensity", `${intensity.decimal}  (${intensity.format.name}: ${intensity.bits}, ${intensity.hex})`, "intensity"],
    ["xⁿ", answer.reference.text, "reference"],
    ["Error", error, "error"],
    ["Region that answers", answer.region, "region"],
    ["Status", answer.status, "status"],
    ["Asked", `n = ${answer.n.text}, x = ${x.text}  (${x.format.name}: ${x.bits}, ${x.hex})`, "asked"],
  ]);
};

const row = (register) => {
  const { range } = register;
  const known = { exact: "", bound: " at most", format: " by its format" }[range.known];
  return element("tr", { class: register.computed ? undefined : "carried" },
    element("th", { scope: "row" }, register.name),
    element("td", {}, register.format.name),
    element("td", {}, bits(register.binary, register.format.fraction)),
    element("td", {}, element("code", {}, register.hex)),
    element("td", { class: "number" }, register.bits),
    element("td", { class: "number", title: register.decimal }, register.value),
    element("td", { class: "range", title: `${range.least} … ${range.greatest}` }, `${range.text}${known}`));
};

const ranks = () => {
  if (!last) return;
  const only = $("computed").checked;
  const heads = ["register", "format", "bits", "hex", "integer", "value", "range"];
  $("rank-list").replaceChildren(...last.ranks.map((rank, number) => {
    const shown = rank.registers.filter((register) => register.computed || !only);
    return element("div", { class: "table rank", tabindex: 0, role: "region", "aria-label": `Rank ${rank.name}` },
      table(`Rank ${number}: ${rank.name}`, heads, shown.map(row)));
  }));
};

$("computed").addEventListener("change", ranks);

// Asks about (n, x); `then` is told the answer.
export const highlight = (configuration, n, x, then) => line.run(async () => {
  try {
    last = await ask("/api/highlight", { configuration, n, x });
    say($("question-problem"), null);
    summary(last);
    ranks();
    then(last);
  } catch (error) {
    say($("question-problem"), error);
  }
});
