/* Inverse of report/page_arrays.cpp: bytes of the page to named tables of numbers. */

/** One array: `at` is the offset of its byte planes. */
function unpackArray(bytes, at, { bits, rows, columns, lowest, step }) {
  const size = rows * columns,
    wide = bits === 16;
  const unset = wide ? 0xffff : 0xff;
  const values = new Float32Array(size);
  let before = new Uint16Array(columns),
    row = new Uint16Array(columns);
  for (let r = 0, i = 0; r < rows; ++r) {
    let left = 0,
      leftBefore = 0;
    for (let c = 0; c < columns; ++c, ++i) {
      const z = wide ? bytes[at + i] | (bytes[at + size + i] << 8) : bytes[at + i];
      const difference = (z >>> 1) ^ -(z & 1);
      left = (before[c] + left - leftBefore + difference) & unset;
      leftBefore = before[c];
      row[c] = left;
      values[i] = left === unset ? NaN : lowest + left * step;
    }
    [before, row] = [row, before];
  }
  return { rows, columns, values };
}

/** All arrays by name; what is not there is null. */
function unpack(bytes, index) {
  const arrays = new Map();
  let at = 0;
  for (const entry of index) {
    arrays.set(entry.name, unpackArray(bytes, at, entry));
    at += entry.rows * entry.columns * (entry.bits / 8);
  }
  if (at !== bytes.length) throw new Error("The numbers of this page are cut off: copy it again.");
  return (name) => arrays.get(name) || null;
}
