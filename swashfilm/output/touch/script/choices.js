// A figure by the choices of its reader.
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
