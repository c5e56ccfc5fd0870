"use strict";
// Plots: uPlot draws the page's own points; the nearest one to the pointer is told, and arrow keys go from one to the next.
(() => {
  const HEIGHT = 380;
  const colours = () => {
    const style = getComputedStyle(document.documentElement);
    const of = (name) => style.getPropertyValue(name).trim();
    return { ink: of("--ink"), quiet: of("--quiet"), grid: of("--grid"), paper: of("--paper") };
  };
  // Black curves are drawn in the ink of the page, so that they can be seen in the dark.
  const drawn = (colour) => (colour === "#000000" ? colours().ink : colour === "#555555" ? colours().quiet : colour);
  const dashes = (text) => (text ? text.split(" ").map(Number) : undefined);
  const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";
  const shown = (value) => {
    if (value === null) return "";
    const size = Math.abs(value);
    const sign = value < 0 ? "−" : "";
    if (size === 0 || (size >= 1e-3 && size < 1e6)) return sign + String(Number(size.toPrecision(7)));
    const [digits, power] = size.toExponential(5).split("e");
    const raised = power.replace("+", "").replace("-", "⁻").replace(/\d/g, (digit) => RAISED[digit]);
    return `${sign}${Number(digits) === 1 ? "" : `${Number(digits)}·`}10${raised}`;
  };

  // Every point that can be told, in the order of the arrow keys.
  const points = (figure) => {
    const [xs, ...ys] = figure.columns;
    const curves = figure.curves.map((curve, index) => ({
      name: curve.name,
      series: index + 1,
      list: xs.flatMap((x, row) => (ys[index][row] === null ? [] : [{ x, y: ys[index][row] }])),
    }));
    const named = figure.spots.map((spot) => ({ x: spot.at[0], y: spot.at[1], told: spot.told || spot.label }));
    return [...(named.length ? [{ name: "", series: null, list: named }] : []), ...curves.filter((c) => c.name !== "")];
  };

  const words = (figure, curve, point) =>
    point.told || `${curve.name}: ${figure.x.label} = ${shown(point.x)}, ${figure.y.label} = ${shown(point.y)}`;

  // The ticks of a logarithmic axis: powers of ten, with 2 and 5 times these where there are few. The library's own
  // come to no end where the least value is not round.
  const logarithmic = (low, high) => {
    const digits = high / low > 2000 ? [1] : [1, 2, 5];
    const ticks = [];
    for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power += 1) {
      for (const digit of digits) ticks.push(Number(`${digit}e${power}`));
    }
    return ticks.filter((tick) => tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9));
  };

  const axis = (scaled, size) => ({
    ...(scaled.log ? { splits: (_plot, _axis, low, high) => logarithmic(low, high), filter: (_plot, splits) => splits } : {}),
    label: scaled.label, labelGap: 0, labelSize: 22, size, font: "12px system-ui", labelFont: "13px system-ui",
    stroke: () => colours().ink, grid: { stroke: () => colours().grid, width: 1 },
    ticks: { stroke: () => colours().grid, width: 1 },
    values: (_, splits) => splits.map(shown),
  });

  const scale = (scaled) => ({
    time: false, distr: scaled.log ? 3 : 1, log: 10, ...(scaled.range ? { range: () => scaled.range } : {}),
  });

  const SHAPES = {
    circle: (path, x, y, r) => path.arc(x, y, r, 0, 2 * Math.PI),
    square: (path, x, y, r) => path.rect(x - r, y - r, 2 * r, 2 * r),
    diamond: (path, x, y, r) => [[0, -1.3], [1.3, 0], [0, 1.3], [-1.3, 0]].forEach(([dx, dy]) => path.lineTo(x + r * dx, y + r * dy)),
    triangle: (path, x, y, r) => [[0, -1.2], [1.2, 1], [-1.2, 1]].forEach(([dx, dy]) => path.lineTo(x + r * dx, y + r * dy)),
  };

  // Named points over the curves; a name is left out where it would cover another.
  const spots = (figure) => (plot) => {
    const { ctx } = plot;
    const ratio = devicePixelRatio;
    const taken = [];
    ctx.save();
    ctx.font = `${11 * ratio}px system-ui`;
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";
    for (const spot of figure.spots) {
      const [x, y] = [plot.valToPos(spot.at[0], "x", true), plot.valToPos(spot.at[1], "y", true)];
      const path = new Path2D();
      SHAPES[spot.shape](path, x, y, 4.5 * ratio);
      path.closePath();
      ctx.fillStyle = spot.filled ? drawn(spot.colour) : colours().paper;
      ctx.strokeStyle = spot.marked ? colours().ink : drawn(spot.colour);
      ctx.lineWidth = 1.6 * ratio;
      ctx.fill(path);
      ctx.stroke(path);
      taken.push([x - 6 * ratio, y - 6 * ratio, x + 6 * ratio, y + 6 * ratio]);
    }
    ctx.fillStyle = colours().ink;
    for (const spot of figure.spots) {
      const [x, y] = [plot.valToPos(spot.at[0], "x", true), plot.valToPos(spot.at[1], "y", true)];
      const width = ctx.measureText(spot.label).width;
      const { left, width: across } = plot.bbox;
      const places = [[x + 8 * ratio, y + 4 * ratio], [x - 8 * ratio - width, y + 4 * ratio], [x - width / 2, y - 9 * ratio]];
      for (const [at, base] of places) {
        const box = [at, base - 10 * ratio, at + width, base + 2 * ratio];
        const covers = (other) => box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3];
        if (spot.label === "" || box[0] < left || box[2] > left + across || taken.some(covers)) continue;
        ctx.fillText(spot.label, at, base);
        taken.push(box);
        break;
      }
    }
    ctx.restore();
  };

  const ring = (plot, place) => {
    if (!place) return;
    const { ctx } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.arc(plot.valToPos(place.x, "x", true), plot.valToPos(place.y, "y", true), 8 * devicePixelRatio, 0, 2 * Math.PI);
    ctx.strokeStyle = colours().ink;
    ctx.lineWidth = 2 * devicePixelRatio;
    ctx.stroke();
    ctx.restore();
  };

  const SIGNS = { circle: "M10 6a4 4 0 1 0 8 0a4 4 0 1 0-8 0", square: "M10 2h8v8h-8z", diamond: "M14 1l5 5l-5 5l-5-5z",
    triangle: "M14 1l5 9h-10z" };

  const legend = (figure, plot) => {
    const list = document.createElement("ul");
    list.className = "legend";
    const sample = (inner) => `<svg viewBox="0 0 28 12" aria-hidden="true">${inner}</svg>`;
    figure.curves.forEach((curve, index) => {
      if (curve.name === "") return;
      const button = document.createElement("button");
      button.type = "button";
      button.title = "Show or hide this curve";
      button.setAttribute("aria-pressed", "true");
      const stroke = curve.colour === "#000000" ? "currentColor" : curve.colour;
      button.innerHTML = curve.points
        ? sample(`<circle cx="14" cy="6" r="4" fill="${stroke}"/>`)
        : sample(`<path d="M0 6H28" stroke="${stroke}" stroke-width="2.2" stroke-dasharray="${curve.dashes || ""}"/>`);
      button.append(curve.name);
      button.addEventListener("click", () => {
        const show = button.getAttribute("aria-pressed") === "false";
        button.setAttribute("aria-pressed", String(show));
        plot.setSeries(index + 1, { show });
      });
      const item = document.createElement("li");
      item.append(button);
      list.append(item);
    });
    const kinds = new Map(figure.spots.map((spot) => [spot.kind, spot]));
    for (const [kind, spot] of kinds) {
      const item = document.createElement("li");
      item.innerHTML = sample(`<path d="${SIGNS[spot.shape]}" fill="${spot.colour}"/>`);
      item.append(kind);
      list.append(item);
    }
    return list;
  };

  const draw = (holder) => {
    const figure = JSON.parse(holder.querySelector("script").textContent);
    const caption = holder.querySelector("figcaption");
    const box = document.createElement("div");
    box.className = "drawing";
    box.tabIndex = 0;
    box.setAttribute("role", "application");
    box.setAttribute("aria-roledescription", "plot");
    box.setAttribute("aria-label", `${caption.textContent}. Left and right arrows go from point to point, up and down from curve to curve.`);
    const told = document.createElement("output");
    told.className = "told";
    told.textContent = "Point at the plot, or focus it and use the arrow keys: the value is told here.";
    holder.append(box, told);

    const lists = points(figure);
    let place = null;
    let at = { curve: 0, point: -1 };
    const visible = (curve) => curve.series === null || plot.series[curve.series].show;
    const tell = (curve, point) => {
      place = lists[curve].list[point];
      at = { curve, point };
      told.textContent = words(figure, lists[curve], place);
      plot.redraw(false, false);
    };
    const nearest = (left, top) => {
      let best = { distance: 30 ** 2 };
      lists.forEach((curve, index) => {
        if (!visible(curve)) return;
        curve.list.forEach((point, row) => {
          const [dx, dy] = [plot.valToPos(point.x, "x") - left, plot.valToPos(point.y, "y") - top];
          const distance = dx * dx + dy * dy;
          if (distance < best.distance) best = { distance, index, row };
        });
      });
      if (best.index !== undefined && (best.index !== at.curve || best.row !== at.point)) tell(best.index, best.row);
    };
    const step = (event) => {
      const sideways = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      const across = { ArrowUp: -1, ArrowDown: 1 }[event.key];
      if (!sideways && !across) return;
      event.preventDefault();
      if (sideways) {
        const last = lists[at.curve].list.length - 1;
        tell(at.curve, Math.max(0, Math.min(last, at.point + sideways)));
      } else {
        const curve = (at.curve + across + lists.length) % lists.length;
        const x = place ? place.x : -Infinity;
        const found = lists[curve].list.findIndex((point) => point.x >= x);
        tell(curve, found < 0 ? lists[curve].list.length - 1 : found);
      }
    };

    const series = figure.curves.map((curve) => ({
      label: curve.name, stroke: () => drawn(curve.colour), width: curve.width, dash: dashes(curve.dashes), spanGaps: true,
      points: { show: curve.points || curve.dots, size: 7, fill: () => drawn(curve.colour) },
      ...(curve.points ? { paths: () => null } : {}),
    }));
    const size = () => ({ width: Math.max(280, holder.clientWidth), height: HEIGHT });
    const plot = new uPlot({
      ...size(),
      scales: { x: scale(figure.x), y: scale(figure.y) },
      axes: [axis(figure.x, 34), axis(figure.y, 62)],
      series: [{}, ...series],
      legend: { show: false },
      cursor: { points: { show: false }, drag: { x: false, y: false }, y: true },
      hooks: {
        draw: [spots(figure), (plot) => ring(plot, place)],
        setCursor: [(plot) => plot.cursor.left >= 0 && nearest(plot.cursor.left, plot.cursor.top)],
      },
    }, figure.columns, box);
    told.before(legend(figure, plot));
    box.addEventListener("keydown", step);
    new ResizeObserver(() => {
      const wanted = size();
      if (wanted.width !== plot.width) plot.setSize(wanted);
    }).observe(holder);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => plot.redraw(false, true));
    return plot;
  };

  window.blysk = { ...window.blysk, drawPlot: draw };
  document.querySelectorAll("figure.plot").forEach(draw);
})();
