/* The pages of two runs beside each other. */

const SIDES = ["left", "right"];

class Runs {
  /** rows.pages: address of the page of each row, or where it stands in this file; "" for none. */
  constructor(rows, embedded) {
    this.labels = rows.labels;
    this.pages = rows.pages;
    this.embedded = embedded;
    this.any = rows.pages.some((p) => p);
    this.rows = { left: -1, right: -1 };
    this.onOpen = () => {};
    this.box = document.getElementById("two");
    if (!this.box) return;
    this.box.hidden = true; // until a run is chosen; without scripts links open in it
    this.together = new Together(this);
    this.box.prepend(this.together.element);
    document.addEventListener("click", (event) => this.click(event));
  }

  click(event) {
    const link = event.target.closest?.("a[data-row]");
    if (!link || event.button !== 0) return;
    const row = +link.dataset.row,
      side = SIDES.find((s) => s === link.target),
      apart = !side || event.ctrlKey || event.metaKey;
    if (apart && !this.embedded) {
      link.href = this.address(row); // the browser opens it
      return;
    }
    event.preventDefault();
    if (apart) return void this.openApart(row);
    this.open(row, side);
    this.box.scrollIntoView({ block: "nearest" });
  }

  /** Of a page beside this file, which says of which row it is. */
  address(row, place = "") {
    return `${this.pages[row]}?${new URLSearchParams({ row: this.labels[row] })}${place}`;
  }

  frame(side) {
    return this.box.querySelector(`iframe[name=${side}]`);
  }

  async open(row, side) {
    const words = this.box.querySelector(`[data-side=${side}]`),
      frame = this.frame(side);
    this.rows[side] = row;
    this.box.hidden = false;
    words.textContent = this.labels[row];
    this.onOpen();
    const address = this.address(row, "#the-flow");
    if (!this.embedded && frame.getAttribute("src") === address) return; // it is there
    this.together.forget(side);
    if (!this.embedded) {
      frame.src = address;
      return;
    }
    try {
      const parts = await embeddedPage(this.pages[row]);
      if (this.rows[side] !== row) return; // another one was chosen meanwhile
      const arrived = () => {
        keepInside(frame.contentDocument);
        tellRow(frame.contentDocument, this.labels[row]);
        frame.contentDocument.getElementById("the-flow")?.scrollIntoView();
      };
      frame.addEventListener("load", arrived, { once: true });
      frame.srcdoc = parts.join("");
    } catch (error) {
      words.textContent = `${this.labels[row]}: ${error.message}`;
    }
  }

  async openApart(row) {
    const tab = window.open("", "_blank"); // at once: later it would be a window that nobody asked for
    if (!tab) return; // the browser says that it blocks windows
    const parts = await embeddedPage(this.pages[row]);
    tab.document.open();
    tab.document.write(parts.join(""));
    tab.document.close();
    keepInside(tab.document);
    tellRow(tab.document, this.labels[row]);
  }
}

/** A page from memory has the address of this file: its links to its own parts would load this. */
function keepInside(page) {
  page.addEventListener("click", (event) => {
    const link = event.target.closest?.('a[href^="#"]');
    if (!link) return;
    event.preventDefault();
    page.getElementById(link.getAttribute("href").slice(1))?.scrollIntoView();
  });
}
