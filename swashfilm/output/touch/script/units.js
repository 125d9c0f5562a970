// Pressures of a figure in one of two units.
const PER_MPA = { MPa: 1, bar: 10 };
const inTitle = (unit) => `[${unit}]`;

// Every axis and colour bar whose title names the other unit is in this one afterwards, with all that is drawn on it.
function toPressure({ data, layout }, unit) {
  const other = Object.keys(PER_MPA).find((one) => one !== unit), factor = PER_MPA[unit] / PER_MPA[other];
  const [from, to] = [inTitle(other), inTitle(unit)];
  const times = (value) => Array.isArray(value) ? value.map(times) : typeof value === "number" ? value * factor : value;
  const scale = (part, keys) => {
    for (const key of keys) if (part[key] !== undefined) part[key] = times(part[key]);
  };
  const renamed = (part) => {
    if (!part?.title?.text?.includes(from)) return false;
    part.title.text = part.title.text.replaceAll(from, to);
    return true;
  };
  const pressures = new Set(), flat = Object.keys(layout).filter((name) => /^[xy]axis/.test(name));
  for (const name of flat) if (renamed(layout[name])) pressures.add(name.replace("axis", ""));
  for (const name of flat) if (pressures.has(layout[name].matches)) pressures.add(name.replace("axis", ""));
  for (const name of flat) {
    const axis = layout[name];
    if (pressures.has(name.replace("axis", ""))) {
      if (axis.range) axis.range = axis.range.map((end) => axis.type === "log" ? end + Math.log10(factor) : times(end));
      for (const key of ["tickvals", "ticktext"]) delete axis[key]; // texts of the other unit
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
    if (on.length + coloured.length) trace.hovertemplate = trace.hovertemplate?.replaceAll(from, to);
  }
}
