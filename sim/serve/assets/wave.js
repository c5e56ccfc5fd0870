// Ports and ranks over clock cycles: as a drawing, and as a table.
import { element, table } from "./ask.js";

const SVG = "http://www.w3.org/2000/svg";
const WIDE = 56, HIGH = 26, NAMES = 96, MOST = 64;

const drawn = (name, attributes, text) => {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
};

const signals = (ranks) => [
  ...["reset", "in_valid", "in_ready"].map((name) => ({ name, level: (cycle) => cycle[name] })),
  ...["address", "x"].map((name) => ({ name, word: (cycle) => String(cycle[name]), known: (cycle) => cycle.in_valid })),
  ...["out_valid", "out_ready"].map((name) => ({ name, level: (cycle) => cycle[name] })),
  { name: "intensity", word: (cycle) => cycle.intensity, known: (cycle) => cycle.out_valid },
  ...ranks.map((rank, place) => ({ name: rank.name, level: (cycle) => cycle.valid[place], rank: true })),
];

const line = (signal, cycles, top) => {
  const [high, low] = [top + 5, top + HIGH - 5];
  const path = cycles.map((cycle, place) => {
    const y = signal.level(cycle) ? high : low;
    return `${place === 0 ? "M" : "L"}${place * WIDE} ${y}H${(place + 1) * WIDE}`;
  });
  return [drawn("path", { d: path.join(""), class: signal.rank ? "level rank-level" : "level" })];
};

const bus = (signal, cycles, top) => cycles.flatMap((cycle, place) => {
  const x = place * WIDE;
  const idle = signal.known(cycle) ? "" : " idle";
  const shape = { x: x + 1.5, y: top + 4, width: WIDE - 3, height: HIGH - 8, rx: 3, class: `word${idle}` };
  const text = signal.word(cycle);
  const shown = text.length > 7 ? `…${text.slice(-6)}` : text;
  const label = drawn("text", { x: x + WIDE / 2, y: top + HIGH / 2 + 4, class: "bits-text" }, shown);
  return signal.known(cycle) ? [drawn("rect", shape), label] : [drawn("rect", shape)];
});

export const wave = (place, seen, ranks) => {
  const cycles = seen.slice(-MOST);
  const rows = signals(ranks);
  const [width, height] = [Math.max(cycles.length, 1) * WIDE + 8, (rows.length + 1) * HIGH];
  const words = cycles.length === 0 ? "no clock edge yet" : `cycles ${cycles[0].cycle} to ${cycles.at(-1).cycle}`;
  const size = { width, height, viewBox: `0 0 ${width} ${height}` };
  const picture = drawn("svg", { ...size, role: "img", "aria-label": `Waveform: ${words}` });
  // The names stay where they are while the cycles are scrolled.
  const beside = { width: NAMES, height, viewBox: `0 0 ${NAMES} ${height}` };
  const names = drawn("svg", { ...beside, class: "names", "aria-hidden": true });
  cycles.forEach((cycle, at) => {
    const x = (at + 1) * WIDE;
    picture.append(drawn("path", { d: `M${x} ${HIGH - 4}V${height}`, class: "edge" }),
      drawn("text", { x: x - WIDE / 2, y: 16, class: "cycle" }, String(cycle.cycle)));
  });
  rows.forEach((signal, at) => {
    const top = (at + 1) * HIGH;
    names.append(drawn("text", { x: 4, y: top + HIGH / 2 + 4 }, signal.name));
    picture.append(...(signal.level ? line : bus)(signal, cycles, top));
  });
  place.replaceChildren(names, picture);
  place.scrollLeft = place.scrollWidth;
};

const shown = (signal, cycle) => (signal.level ? String(Number(signal.level(cycle))) : signal.word(cycle));

export const waveTable = (place, seen, ranks) => {
  const cycles = seen.slice(-MOST);
  const rows = signals(ranks).map((signal) => element("tr", {}, element("th", { scope: "row" }, signal.name),
    ...cycles.map((cycle) => element("td", { class: "number" }, shown(signal, cycle)))));
  const heads = ["cycle", ...cycles.map(({ cycle }) => String(cycle))];
  place.replaceChildren(table("A row for each port and rank, a column for each clock cycle", heads, rows));
};
