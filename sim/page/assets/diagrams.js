"use strict";
// Diagrams: an element with data-register shows what the table of registers says of the registers it names.
(() => {
  const source = document.querySelector("section[aria-labelledby=registers] table");
  if (!source) return;
  const names = Array.from(source.tHead.rows[0].cells, (cell) => cell.textContent);

  const facts = (register) => {
    const rows = Array.from(source.tBodies[0].rows).filter((row) => row.cells[0].textContent === register);
    return rows.map((row) => {
      const list = document.createElement("dl");
      Array.from(row.cells).forEach((cell, column) => {
        if (column === 0 || cell.textContent === "") return;
        const name = document.createElement("dt");
        name.textContent = names[column];
        const value = document.createElement("dd");
        value.append(...cell.cloneNode(true).childNodes);
        list.append(name, value);
      });
      return list;
    });
  };

  const show = (panel, picture, element) => {
    for (const other of picture.querySelectorAll(".chosen")) other.classList.remove("chosen");
    element.classList.add("chosen");
    panel.replaceChildren();
    for (const register of element.dataset.register.split(" ")) {
      const lists = facts(register);
      if (lists.length === 0) continue;
      const heading = document.createElement("h3");
      heading.textContent = `Register ${register}`;
      panel.append(heading, ...lists);
    }
  };

  for (const picture of document.querySelectorAll(".picture")) {
    const elements = picture.querySelectorAll("[data-register]");
    if (elements.length === 0) continue;
    const panel = document.createElement("div");
    panel.className = "details";
    panel.setAttribute("aria-live", "polite");
    panel.textContent = "Click on a box or a wire, or move to it by Tab and press Enter: its registers are shown here.";
    picture.after(panel);
    // Its parts are reached one by one, so it is no longer a picture to those who listen.
    picture.querySelector("svg").setAttribute("role", "group");
    for (const element of elements) {
      element.setAttribute("tabindex", "0");
      element.setAttribute("role", "button");
      element.setAttribute("aria-label", `Registers ${element.dataset.register}`);
      element.addEventListener("click", () => show(panel, picture, element));
      element.addEventListener("keydown", (event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        show(panel, picture, element);
      });
    }
  }
})();
