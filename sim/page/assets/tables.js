"use strict";
// Tables: a button in each heading sorts the rows, a field above a long table hides those that do not match.
(() => {
  const SEARCHED_FROM = 6;
  const words = new Intl.Collator("en", { numeric: true, sensitivity: "base" });
  const NUMBER = /^([+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?)(?: ?[%\w./]+)?$/i;

  // A number with or without its unit; null for anything else.
  const number = (text) => {
    const found = NUMBER.exec(text.replace(/\u2212/g, "-"));
    return found ? Number(found[1]) : null;
  };

  const compare = (a, b) => {
    if (a.number !== null && b.number !== null) return a.number - b.number;
    return words.compare(a.text, b.text);
  };

  const sort = (table, column, heading) => {
    const body = table.tBodies[0];
    const down = heading.getAttribute("aria-sort") === "ascending";
    for (const other of heading.parentNode.cells) other.removeAttribute("aria-sort");
    heading.setAttribute("aria-sort", down ? "descending" : "ascending");
    const keyed = Array.from(body.rows, (row) => {
      const text = row.cells[column].textContent.trim();
      return { row, text, number: number(text) };
    });
    // What has no value stands at the end in both directions.
    keyed.sort((a, b) => (a.text === "") - (b.text === "") || (down ? compare(b, a) : compare(a, b)));
    body.append(...keyed.map((entry) => entry.row));
  };

  const sortable = (table) => {
    const headings = table.tHead.rows[0].cells;
    Array.from(headings).forEach((heading, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.title = "Sort by this column";
      button.append(...heading.childNodes);
      heading.append(button);
      button.addEventListener("click", () => sort(table, column, heading));
    });
  };

  const searchable = (box, table) => {
    const rows = Array.from(table.tBodies[0].rows, (row) => ({ row, text: row.textContent.toLowerCase() }));
    const line = document.createElement("p");
    line.className = "search";
    const label = document.createElement("label");
    label.textContent = "Search the rows: ";
    const field = document.createElement("input");
    field.type = "search";
    label.append(field);
    const count = document.createElement("output");
    const filter = () => {
      const wanted = field.value.toLowerCase().split(/\s+/).filter(Boolean);
      let shown = 0;
      for (const { row, text } of rows) {
        row.hidden = !wanted.every((word) => text.includes(word));
        shown += row.hidden ? 0 : 1;
      }
      count.textContent = `${shown} of ${rows.length} rows`;
    };
    field.addEventListener("input", filter);
    filter();
    line.append(label, count);
    box.before(line);
  };

  const upgrade = (box) => {
    const table = box.querySelector("table");
    if (table.tBodies[0].rows.length < 2) return;
    sortable(table);
    if (table.tBodies[0].rows.length >= SEARCHED_FROM) searchable(box, table);
  };

  window.blysk = { ...window.blysk, upgradeTable: upgrade };
  document.querySelectorAll("div.table").forEach(upgrade);
})();
