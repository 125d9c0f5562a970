// Draws the packed figures of a page by plotly.js as they come into view; the static pictures stay where it cannot.
"use strict";
(() => {
  const INK = "#1c2328", MPA = "[MPa]", BAR = "[bar]", BAR_PER_MPA = 10;
  const CONFIG = { displaylogo: false, responsive: true, modeBarButtonsToRemove: ["lasso2d", "select2d"] };
  const DIGIT = [];
  [..."0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%,()*+-;.=:?@^_`{|}~"].forEach((letter, n) => {
    DIGIT[letter.charCodeAt(0)] = n;
  });
  const views = [];
  let library = null, inBar = false;

  // A script element holds a text by `packed` of packing.py.
  async function unpacked(script) {
    const text = script.textContent, bytes = new DataView(new ArrayBuffer((text.length - 1) / 5 * 4));
    for (let k = 1; k < text.length; k += 5) {
      let word = 0;
      for (let j = k; j < k + 5; j += 1) word = word * 85 + DIGIT[text.charCodeAt(j)];
      bytes.setUint32((k - 1) / 5 * 4, word);
    }
    const stream = new Blob([bytes.buffer.slice(0, bytes.byteLength - Number(text[0]))]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).text();
  }

  async function loadLibrary() {
    const script = document.createElement("script");
    script.textContent = await unpacked(document.getElementById("plotly"));
    document.head.append(script);
  }

  // What the choices select: rows of tables (a list of rows is joined), and bodies moved as rigid ones.
  function applyChoices(figure, told, at) {
    const row = (pick) => pick.rows[pick.by.reduce((n, k) => n * told.controls[k].options.length + at[k], 0)];
    for (const pick of told.picks) {
      const table = told.tables[pick.table], chosen = row(pick);
      const end = pick.path.slice(0, -1).reduce((part, key) => part[key], figure);
      end[pick.path.at(-1)] = Array.isArray(chosen) ? chosen.flatMap((one) => table[one]) : table[chosen];
    }
    for (const move of told.moves) {
      const frames = row(move).map((one) => told.tables[move.table][one]);
      ["x", "y", "z"].forEach((letter, k) => {
        figure.data[move.trace][letter] = frames.flatMap((frame) => move.points.map((point) =>
          frame[k][0] * point[0] + frame[k][1] * point[1] + frame[k][2] * point[2] + frame[k][3]));
      });
    }
    if (told.grid) applySlice(figure, told.grid, at);
  }

  // A slice of numbers over several axes: controls are quantity, pair of axes, and the level of each axis.
  function applySlice(figure, grid, at) {
    const { axes } = grid, quantity = grid.quantities[at[0]], [across, up] = grid.pairs[at[1]];
    const stride = axes.map((_, k) => axes.slice(k + 1).reduce((n, axis) => n * axis.levels.length, 1));
    const start = axes.reduce((n, _, k) => (k === across || k === up ? n : n + at[2 + k] * stride[k]), 0);
    const rows = axes[up].levels.map((_, j) =>
      axes[across].levels.map((_, i) => quantity.values[start + j * stride[up] + i * stride[across]]));
    const whole = rows.every((line) => line.every((value) => value !== null));
    const dot = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0);
    const [field, points] = figure.data;
    field.x = whole ? axes[across].fine : axes[across].levels;
    field.y = whole ? axes[up].fine : axes[up].levels;
    field.z = whole ? axes[up].weights.map((w) => axes[across].weights.map((v) => dot(w, rows.map((line) => dot(v, line)))))
      : rows;
    points.x = rows.flatMap(() => axes[across].levels);
    points.y = axes[up].levels.flatMap((level) => axes[across].levels.map(() => level));
    points.text = rows.flat().map((value) => (value === null ? "no result" : String(value)));
    field.colorbar.title.text = quantity.title;
    figure.layout.xaxis.title.text = axes[across].title;
    figure.layout.yaxis.title.text = axes[up].title;
    const names = [axes[across].title, axes[up].title].map((title, k) => `<br>${title}: %{${"xy"[k]}:.5~g}`).join("");
    field.hovertemplate = `${quantity.title}: %{z:.5~g}${names}<extra>interpolated</extra>`;
    points.hovertemplate = `${quantity.title}: %{text}${names}<extra>solved</extra>`;
    return [across, up];
  }

  const times = (value) => Array.isArray(value) ? value.map(times) : typeof value === "number" ? value * BAR_PER_MPA : value;
  function scale(part, keys) {
    for (const key of keys) if (part[key] !== undefined) part[key] = times(part[key]);
  }
  function renamed(part) {
    if (!part?.title?.text?.includes(MPA)) return false;
    part.title.text = part.title.text.replaceAll(MPA, BAR);
    return true;
  }

  // Every axis and colour bar whose title names MPa is in bar afterwards, with all that is drawn on it.
  function toBar({ data, layout }) {
    const pressures = new Set(), flat = Object.keys(layout).filter((name) => /^[xy]axis/.test(name));
    for (const name of flat) if (renamed(layout[name])) pressures.add(name.replace("axis", ""));
    for (const name of flat) if (pressures.has(layout[name].matches)) pressures.add(name.replace("axis", ""));
    for (const name of flat) {
      const axis = layout[name];
      if (pressures.has(name.replace("axis", ""))) {
        if (axis.range) axis.range = axis.range.map((end) => axis.type === "log" ? end + 1 : times(end));
        scale(axis, ["tickvals"]);
      }
    }
    for (const letter of ["x", "y"]) for (const mark of [...(layout.shapes ?? []), ...(layout.annotations ?? [])]) {
      if (pressures.has(mark[`${letter}ref`])) scale(mark, [letter, `${letter}0`, `${letter}1`]);
    }
    const inSpace = renamed(layout.scene?.zaxis);
    if (inSpace && layout.scene.zaxis.range) scale(layout.scene.zaxis, ["range"]);
    for (const trace of data) {
      const on = ["x", "y"].filter((letter) => pressures.has(trace[`${letter}axis`] ?? letter));
      if (inSpace && trace.type === "mesh3d") on.push("z");
      for (const letter of on) {
        scale(trace, [letter]);
        if (trace[`error_${letter}`]) scale(trace[`error_${letter}`], ["array", "arrayminus"]);
        if (letter === (trace.orientation === "h" ? "x" : "y")) scale(trace, ["base"]);
      }
      const coloured = [trace, trace.marker].filter((part) => part && renamed(part.colorbar));
      for (const part of coloured) {
        scale(part, ["intensity", "text", "color", "cmin", "cmax", "zmin", "zmax", ...(part.type === "mesh3d" ? [] : ["z"])]);
      }
      if (on.length + coloured.length) trace.hovertemplate = trace.hovertemplate?.replaceAll(MPA, BAR);
    }
  }

  // Text, lines and ink in the colours of the page, which follow the reader's light or dark.
  function toTheme({ data, layout }) {
    const style = getComputedStyle(document.documentElement);
    const [text, line, ground] = ["--text", "--line", "--ground"].map((name) => style.getPropertyValue(name).trim());
    layout.font = { color: text, family: "system-ui, sans-serif", size: 12 };
    layout.paper_bgcolor = layout.plot_bgcolor = "rgba(0,0,0,0)";
    layout.hoverlabel = { bgcolor: ground, bordercolor: line, font: { color: text } };
    const axes = Object.keys(layout).filter((name) => /^[xy]axis/.test(name)).map((name) => layout[name]);
    if (layout.scene) axes.push(...["xaxis", "yaxis", "zaxis"].map((name) => layout.scene[name] ??= {}));
    for (const axis of axes) Object.assign(axis, { gridcolor: line, zerolinecolor: line, linecolor: line });
    for (const part of data.flatMap((trace) => [trace.line, trace.marker, trace.textfont])) {
      if (part?.color === INK) part.color = text;
    }
    for (const shape of layout.shapes ?? []) if (shape.line?.color === INK) shape.line.color = text;
  }

  async function draw({ told, plot, at }) {
    const figure = structuredClone(told.figure);
    applyChoices(figure, told, at);
    if (inBar) toBar(figure);
    toTheme(figure);
    await Plotly.react(plot, figure.data, figure.layout, CONFIG);
    plot.dataset.draws = Number(plot.dataset.draws ?? 0) + 1;
  }

  function element(kind, properties, ...children) {
    const made = Object.assign(document.createElement(kind), properties);
    made.append(...children);
    return made;
  }

  function controlOf(view, control, k) {
    const shown = element("output", { textContent: control.options[view.at[k]] });
    const input = control.slider
      ? element("input", { type: "range", min: 0, max: control.options.length - 1, value: view.at[k] })
      : element("select", {}, ...control.options.map((text, n) => new Option(text, n, false, n === view.at[k])));
    input.name = control.name;
    input.addEventListener("input", () => {
      view.at[k] = Number(input.value);
      shown.textContent = control.options[view.at[k]];
      draw(view).then(() => hideUsed(view));
    });
    const label = element("label", {}, `${control.name} `, input);
    if (control.slider) label.append(" ", shown);
    label.hidden = control.options.length < 2;
    return label;
  }

  // The level of an axis that a map is drawn over is no choice.
  function hideUsed({ told, at, labels }) {
    if (!told.grid) return;
    const pair = told.grid.pairs[at[1]];
    told.grid.axes.forEach((axis, k) => { labels[2 + k].hidden = pair.includes(k) || axis.levels.length < 2; });
  }

  function offerUnits(text) {
    if (!text.includes(MPA) || document.querySelector(".units")) return;
    const select = element("select", { name: "pressure unit" }, new Option("MPa", "MPa"), new Option("bar", "bar"));
    select.addEventListener("input", () => { inBar = select.value === "bar"; views.forEach(draw); });
    (document.querySelector("nav") ?? document.querySelector("h1")).after(
      element("p", { className: "units" }, element("label", {}, "Pressure in the figures in ", select)));
  }

  async function open(holder) {
    const text = await unpacked(holder.querySelector(".touch"));
    const told = { controls: [], picks: [], moves: [], copies: [], ...JSON.parse(text) };
    for (const { trace, count, points } of told.copies) for (const key of "ijk") {
      const one = told.figure.data[trace][key];
      told.figure.data[trace][key] = Array.from({ length: count }, (_, n) => one.map((corner) => corner + n * points)).flat();
    }
    if (told.figure.layout.scene && !document.createElement("canvas").getContext("webgl")) return;
    await (library ??= loadLibrary());
    const view = { told, plot: element("div", { className: "plot" }), at: told.controls.map((one) => one.first) };
    view.labels = told.controls.map((control, k) => controlOf(view, control, k));
    holder.prepend(element("div", { className: "choices" }, ...view.labels), view.plot);
    holder.classList.add("touched");
    offerUnits(text);
    views.push(view);
    hideUsed(view);
    await draw(view);
  }

  if (!window.DecompressionStream || !window.IntersectionObserver) return;
  const seen = new IntersectionObserver((entries) => {
    for (const { target } of entries.filter((entry) => entry.isIntersecting)) { seen.unobserve(target); open(target); }
  }, { rootMargin: "300px" });
  document.querySelectorAll("figure:has(> .touch)").forEach((holder) => seen.observe(holder));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => views.forEach(draw));
})();
