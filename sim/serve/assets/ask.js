// Questions to the server, and elements of the page.

export const $ = (id) => document.getElementById(id);

// An element with attributes and children; texts become text, never markup.
export const element = (name, attributes = {}, ...children) => {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === true) made.setAttribute(key, "");
    else if (value !== false && value !== undefined) made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
};

export class Refused extends Error {
  constructor({ message, line, column }) {
    super(message);
    Object.assign(this, { line, column });
  }
}

const send = async (path, question) => {
  let answer;
  try {
    answer = await fetch(path, {
      method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(question),
    });
  } catch {
    throw new Refused({ message: "The server does not answer: was blysk serve stopped?" });
  }
  if (answer.ok) return answer;
  throw new Refused((await answer.json()).error);
};

export const ask = async (path, question) => (await send(path, question)).json();

export const begin = async () => (await fetch("/api/begin")).json();

// Saves the RTL of a configuration as a file.
export const saveRtl = async (configuration, name) => {
  const blob = await (await send("/api/rtl", { configuration })).blob();
  const address = URL.createObjectURL(blob);
  element("a", { href: address, download: `${name}-rtl.zip` }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
};

// Says what is wrong at a place of the page, or nothing.
export const say = (place, error) => {
  place.hidden = !error;
  place.textContent = error ? error.message : "";
  if (error && !(error instanceof Refused)) throw error;
};

// Answers of one kind: while one is under way only the last question waits, as a slider asks many.
export class Line {
  #busy = false;
  #next = null;

  async run(work) {
    this.#next = work;
    if (this.#busy) return;
    this.#busy = true;
    while (this.#next) {
      const next = this.#next;
      this.#next = null;
      await next();
    }
    this.#busy = false;
  }
}

export const rows = (list, pairs) =>
  list.replaceChildren(...pairs.map(([name, value, id]) =>
    element("div", {}, element("dt", {}, name), element("dd", { id }, value))));

export const table = (caption, heads, body) =>
  element("table", {}, element("caption", {}, caption),
    element("thead", {}, element("tr", {}, ...heads.map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, ...body));

// The bits of a word in groups of four from the point, which stands before the last `fraction` of them, or further
// left; `counted` says how many places from the point a bit stands.
const grouped = (bits, counted) =>
  [...bits].map((bit, at) => (at > 0 && counted(at) % 4 === 0 ? ` ${bit}` : bit)).join("");

export const bits = (binary, fraction) => {
  const code = element("code", { class: "bits" });
  const whole = binary.slice(0, Math.max(0, binary.length - fraction));
  const behind = binary.slice(whole.length);
  code.append(grouped(whole, (at) => whole.length - at));
  if (fraction > 0) {
    code.append(element("b", { class: "point" }, "."));
    const missing = "0".repeat(fraction - behind.length);
    const title = "places that the word does not have";
    if (missing) code.append(element("i", { class: "quiet", title }, grouped(missing, (at) => at)));
    code.append(grouped(behind, (at) => missing.length + at));
  }
  return code;
};
