/* Pages of runs that are in this file (study/page/embedded.cpp): unpacked when they are opened. */

/** The text of an element; of a large file the end may still be on its way. */
async function storedText(id) {
  if (document.readyState === "loading")
    await new Promise((done) => document.addEventListener("DOMContentLoaded", done, { once: true }));
  const element = document.getElementById(id);
  if (!element) throw new Error("This file is cut off, and the run is not in it: copy it again.");
  return element;
}

const unpacked = async (text) => new TextDecoder().decode(await inflate(text));

/** The parts of a page, in their order. */
async function embeddedPage(id) {
  const element = await storedText(id);
  const [words, arrays] = element.textContent.split(".");
  const own = (await unpacked(words)).split("\0");
  const { style, script } = element.dataset;
  const parts = own;
  if (own.length > 1) {
    const [a, b, c, d] = own;
    const shared = await Promise.all(
      [style, script].map(async (name) => unpacked((await storedText(name)).textContent)),
    );
    parts.splice(0, own.length, a, shared[0], b, arrays, c, shared[1], d);
  }
  return parts;
}
