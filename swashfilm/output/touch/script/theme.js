// A figure in the colours of the page.
const INK = "#1c2328";

// Text, lines and ink in the colours of the page, which follow the reader's light or dark.
function toTheme({ data, layout }) {
  const style = getComputedStyle(document.documentElement);
  const [text, line, ground] = ["--text", "--line", "--ground"].map((name) => style.getPropertyValue(name).trim());
  layout.font = { color: text, family: "system-ui, sans-serif", size: 12 };
  layout.paper_bgcolor = layout.plot_bgcolor = "rgba(0,0,0,0)";
  layout.modebar = { bgcolor: ground, color: line, activecolor: text }; // by default half black on no ground
  layout.hoverlabel = { bgcolor: ground, bordercolor: line, font: { color: text } };
  const axes = Object.keys(layout).filter((name) => /^[xy]axis/.test(name)).map((name) => layout[name]);
  if (layout.scene) axes.push(...["xaxis", "yaxis", "zaxis"].map((name) => layout.scene[name] ??= {}));
  for (const axis of axes) Object.assign(axis, { gridcolor: line, zerolinecolor: line, linecolor: line });
  for (const part of data.flatMap((trace) => [trace.line, trace.marker, trace.textfont])) {
    if (part?.color === INK) part.color = text;
  }
  for (const shape of layout.shapes ?? []) if (shape.line?.color === INK) shape.line.color = text;
}
