// Draws the packed figures of a page by plotly.js as they come into view; the static pictures stay where it cannot.
const CONFIG = { displaylogo: false, responsive: true, modeBarButtonsToRemove: ["lasso2d", "select2d"] };
const views = [];
let library = null, unit = "MPa", chosen = false;

async function loadLibrary() {
  const script = document.createElement("script");
  script.textContent = await unpacked(document.getElementById("plotly"));
  document.head.append(script);
}

async function draw({ told, plot, at }) {
  const figure = structuredClone(told.figure);
  applyChoices(figure, told, at);
  toPressure(figure, unit);
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

// Until the reader chooses, a page with a figure in bar, as benches read them, has every figure in bar.
function offerUnits(text) {
  if (!chosen && unit !== "bar" && text.includes(inTitle("bar"))) showIn("bar");
  if (!text.includes(inTitle("MPa")) || document.querySelector(".units")) return;
  const options = Object.keys(PER_MPA).map((one) => new Option(one, one, false, one === unit));
  const select = element("select", { name: "pressure unit" }, ...options);
  select.addEventListener("input", () => { chosen = true; showIn(select.value); });
  (document.querySelector("nav") ?? document.querySelector("h1")).after(
    element("p", { className: "units" }, element("label", {}, "Pressure in the figures in ", select)));
}

function showIn(asked) {
  unit = asked;
  const select = document.querySelector(".units select");
  if (select) select.value = unit;
  views.forEach(draw);
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
