/* The table of the study: its rows, their columns, and which rows are repeats of one another. */

const MOST_KINDS = 10; // values by which points are coloured one by one; of more, none is told apart

class Rows {
  /** data: the JSON that study/page/explorer_data.cpp writes. */
  constructor(data) {
    this.labels = data.labels;
    this.pages = data.pages;
    this.count = data.labels.length;
    this.columns = data.columns.map((c) => ({ ...c, numbers: this.numbersOf(c) }));
    this.groups = [];
    data.groups.forEach((g, row) => (this.groups[g] ||= []).push(row));
    this.repeated = this.groups.some((rows) => rows.length > 1);
  }

  numbersOf(column) {
    if (column.words) return null;
    if ("same" in column) return new Array(this.count).fill(column.same);
    return column.values.map((v) => v ?? NaN);
  }

  find(name) {
    return this.columns.find((c) => c.name === name) || null;
  }
  /** Columns that can be an axis. */
  get measured() {
    return this.columns.filter((c) => c.numbers);
  }
  /** Columns that can be a colour. */
  get colouring() {
    return this.columns.filter((c) => c.numbers || c.words.length <= MOST_KINDS);
  }

  /** What rows have in a column: a number, NaN if none; of words the place of the word. */
  value(column, row) {
    return column.numbers ? column.numbers[row] : (column.values[row] ?? NaN);
  }

  /** Mean and deviation of some rows, which is NaN where there is only one. */
  mean(column, rows) {
    const v = rows.map((row) => this.value(column, row)).filter(isFinite);
    if (!v.length) return { mean: NaN, deviation: NaN };
    if (!column.numbers) return { mean: v[0], deviation: NaN };
    const mean = v.reduce((a, b) => a + b, 0) / v.length;
    const squares = v.reduce((a, b) => a + (b - mean) ** 2, 0);
    return { mean, deviation: v.length > 1 ? Math.sqrt(squares / (v.length - 1)) : NaN };
  }

  /** One point per row, or per group of repeats, and the rows that have no value of x or of y. */
  points(x, y, colour, together) {
    const points = [],
      missing = [];
    for (const group of together ? this.groups : this.labels.map((_, row) => [row])) {
      const rows = group.filter((r) => isFinite(this.value(x, r)) && isFinite(this.value(y, r)));
      missing.push(...group.filter((r) => !rows.includes(r)));
      if (!rows.length) continue;
      const [at, up] = [this.mean(x, rows), this.mean(y, rows)];
      points.push({
        rows,
        label: this.labels[rows[0]],
        x: at.mean,
        y: up.mean,
        aside: at.deviation,
        above: up.deviation,
        value: colour ? this.mean(colour, rows).mean : NaN,
      });
    }
    return { points, missing: missing.sort((a, b) => a - b) };
  }

  /** The row of a point whose run has a page; -1 if there is none. */
  rowWithPage(point) {
    return point.rows.find((row) => this.pages[row]) ?? -1;
  }
}

/** "runout [m]". */
const titleOf = (column) => column.label + (column.unit ? ` [${column.unit}]` : "");

/** A value in words, with its unit. */
function told(column, value) {
  if (!isFinite(value)) return "no value";
  if (column.words) return column.words[value];
  return short(value) + (column.unit ? `\u202f${column.unit}` : "");
}

/** Four digits of a number, and no power of ten where it can be read without. */
function short(value) {
  const size = Math.abs(value);
  const text =
    size !== 0 && (size < 1e-3 || size >= 1e7)
      ? value.toExponential(2)
      : size >= 1000
        ? value.toFixed(0)
        : String(+value.toPrecision(4));
  return text.replace("-", "\u2212");
}
