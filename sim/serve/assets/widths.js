// What another width would do: bound, error and hardware beside the present ones.
import { $, ask, element, Line, saveRtl, say, table } from "./ask.js";

const line = new Line();
let registers = [];

const chosen = () => registers.find((register) => register.name === $("register").value);

const present = () => {
  const register = chosen();
  if (!register) return;
  $("format").value = register.format.name;
  $("fewer").disabled = !register.fewer;
  $("more").disabled = !register.more;
};

// The registers of a configuration.
export const offer = (hardware) => {
  registers = hardware.registers;
  const share = (name) => hardware.figures.shares.find(({ register }) => register === name);
  $("register").replaceChildren(...registers.map(({ name, format }) => {
    const part = share(name);
    const told = part ? `, ${part.ulp.text} ulp of the bound` : "";
    return element("option", { value: name }, `${name}  ${format.name}${told}`);
  }));
  $("altered").replaceChildren();
  say($("alter-problem"), null);
  present();
};

const peak = ({ per_cent, n, x }) => `${per_cent.text} % at n = ${n.text}, x = ${x.text}`;

const compared = ({ before, after }) => {
  const lines = [
    ["Proved bound of coefficients and data path, ulp", (of) => of.proved_ulp.text],
    ["The same, measured, ulp", (of) => of.measured_ulp.text],
    ["Error budget of the configuration, ulp", (of) => of.budget_ulp.text],
    ["Greatest error for xⁿ ≥ Q", (of) => peak(of.epicentre)],
    ["Greatest error on [0, 1]", (of) => peak(of.everywhere)],
    ["Samples measured", (of) => of.samples],
    ["Partial-product bits of all multipliers", (of) => of.multiplier_bits],
    ["ROM bits", (of) => of.rom_bits],
    ["Bits of the registers in this list", (of) => of.register_bits],
    ["Latency, cycles", (of) => of.latency],
  ];
  return lines.map(([name, of]) => {
    const [now, then] = [String(of(before)), String(of(after))];
    return element("tr", { class: now === then ? undefined : "changed" },
      element("th", { scope: "row" }, name), element("td", {}, now), element("td", {}, then));
  });
};

const result = (altered, name, use) => {
  const budget = altered.before.budget_ulp.text;
  const above = `what is proved is above the error budget of ${budget} ulp`;
  const verdict = altered.within_budget ? "the error budget holds" : above;
  const words = `${altered.register} in ${altered.format_after}: ${verdict}.`;
  const take = element("button", { type: "button", class: "action" }, "Use this configuration");
  const save = element("button", { type: "button", class: "action" }, "Its RTL as a zip");
  take.addEventListener("click", () => use(altered.text));
  save.addEventListener("click", () => {
    saveRtl({ text: altered.text }, name).catch((error) => say($("alter-problem"), error));
  });
  const { register, format_before: now, format_after: then } = altered;
  const heads = ["", `now: ${register} ${now}`, `then: ${register} ${then}`];
  return [
    element("p", { class: `verdict ${altered.within_budget ? "good" : "bad"}`, id: "alter-verdict" }, words),
    element("div", { class: "table", tabindex: 0, role: "region", "aria-label": "Now and then" },
      table("What changes", heads, compared(altered))),
    element("p", { class: "fields" }, take, save),
  ];
};

const measure = (state) => line.run(async () => {
  $("altered").replaceChildren(element("p", { class: "quiet" }, "Measuring …"));
  try {
    const question = { configuration: state.configuration, register: $("register").value, format: $("format").value };
    const altered = await ask("/api/alter", question);
    say($("alter-problem"), null);
    $("altered").replaceChildren(...result(altered, state.hardware.name, state.use));
  } catch (error) {
    $("altered").replaceChildren();
    say($("alter-problem"), error);
  }
});

// Begins to listen; `state` gives configuration, hardware, and how another configuration is used.
export const listen = (state) => {
  $("register").addEventListener("change", present);
  const step = (which) => () => {
    $("format").value = chosen()[which];
    measure(state());
  };
  $("fewer").addEventListener("click", step("fewer"));
  $("more").addEventListener("click", step("more"));
  $("alter").addEventListener("submit", (event) => {
    event.preventDefault();
    measure(state());
  });
};
