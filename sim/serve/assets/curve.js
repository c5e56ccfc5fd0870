// The curve of one exponent: hardware and xⁿ, and the error between them, with the present x marked.
import { $, ask, element, Line, say } from "./ask.js";

const line = new Line();

const HARDWARE = "#0072b2", REFERENCE = "#000000";
const REGIONS = { polynomial: "#0072b2", tail: "#d55e00", zero: "#009e73" };

const figure = (title, subtitle, data) => {
  const holder = element("figure", { class: "plot" },
    element("figcaption", {}, title, element("span", { class: "quiet" }, ` ${subtitle}`)),
    element("script", { type: "application/json" }, JSON.stringify(data)));
  return holder;
};

const dark = matchMedia("(prefers-color-scheme: dark)");

const spot = (x, y, told) => ({
  at: [x, y], label: "", told, shape: "diamond", filled: true, marked: true, kind: "the present x",
  colour: dark.matches ? "#e69f00" : "#a3231f",
});

const shown = (curve, answer, configuration) => {
  const x = answer.x.value;
  const where = `${configuration.name}, n = ${answer.n.text}`;
  const regions = Object.keys(REGIONS).filter((region) => curve.region.includes(region));
  const part = (region) => curve.error_ulp.map((error, place) => (curve.region[place] === region ? error : null));
  return [
    figure("Highlight", where, {
      x: { label: "x = cos γ", log: false }, y: { label: "intensity", log: false },
      columns: [curve.x, curve.reference, curve.intensity],
      curves: [
        { name: "xⁿ", colour: REFERENCE, width: 1.5, dashes: "6 4", points: false },
        { name: "hardware", colour: HARDWARE, width: 2, dashes: "", points: false },
      ],
      spots: [spot(x, answer.intensity.value, `x = ${answer.x.decimal}: intensity ${answer.intensity.decimal}`)],
    }),
    figure("Error: hardware less xⁿ", `${where}, in ulp of ${answer.intensity.format.name}`, {
      x: { label: "x = cos γ", log: false }, y: { label: "error, ulp", log: false },
      columns: [curve.x, ...regions.map(part)],
      curves: regions.map((region) => (
        { name: `${region} answers`, colour: REGIONS[region], width: 1.6, dashes: "", points: false })),
      spots: [spot(x, answer.error_ulp.value, `x = ${answer.x.decimal}: error ${answer.error_ulp.text} ulp`)],
    }),
  ];
};

export const curve = (configuration, hardware, n, answer) => line.run(async () => {
  const span = document.querySelector("input[name=span]:checked").value;
  try {
    const points = await ask("/api/curve", { configuration, n, span });
    const figures = shown(points, answer, hardware);
    $("plots").replaceChildren(...figures);
    figures.forEach((holder) => window.blysk.drawPlot(holder));
  } catch (error) {
    say($("question-problem"), error);
  }
});
