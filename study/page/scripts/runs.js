/* The pages of two runs beside each other. */

const SIDES = ["left", "right"];

class Runs {
  /** pages: address of the page of each row, "" where there is none. */
  constructor(rows) {
    this.labels = rows.labels;
    this.pages = rows.pages;
    this.any = rows.pages.some((p) => p);
    this.rows = { left: -1, right: -1 };
    this.onOpen = () => {};
    this.box = document.getElementById("two");
    if (!this.box) return;
    this.box.hidden = true; // until a run is chosen; without scripts links open in it
    this.together = new Together(this);
    this.box.prepend(this.together.element);
    document.addEventListener("click", (event) => {
      const link = event.target.closest?.("a[data-row]");
      if (!link || event.ctrlKey || event.metaKey || event.button !== 0) return;
      if (!SIDES.includes(link.target)) return;
      event.preventDefault();
      this.open(+link.dataset.row, link.target);
      this.box.scrollIntoView({ block: "nearest" });
    });
  }

  frame(side) {
    return this.box.querySelector(`iframe[name=${side}]`);
  }

  open(row, side) {
    this.rows[side] = row;
    this.box.hidden = false;
    this.box.querySelector(`[data-side=${side}]`).textContent = this.labels[row];
    this.together.forget(side);
    this.frame(side).src = `${this.pages[row]}#the-flow`;
    this.onOpen();
  }
}
