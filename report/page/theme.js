/* Light, dark or as the system says; light on paper. */

function themeButton(redraw) {
  const root = document.documentElement,
    names = ["auto", "light", "dark"];
  let stored = null;
  try {
    stored = localStorage.getItem("flowslide-theme");
  } catch {
    /* files may not store */
  }
  let at = Math.max(0, names.indexOf(stored));
  const button = make("button", { type: "button", onclick: () => set((at + 1) % 3) });
  const set = (next) => {
    at = next;
    if (at) root.dataset.theme = names[at];
    else delete root.dataset.theme;
    button.textContent = `theme: ${names[at]}`;
    try {
      localStorage.setItem("flowslide-theme", names[at]);
    } catch {
      /* as above */
    }
    redraw();
  };
  set(at);
  return button;
}

/** Paper is white whatever the screen is. */
function printLight(redraw) {
  const root = document.documentElement;
  let before;
  window.addEventListener("beforeprint", () => {
    before = root.dataset.theme;
    root.dataset.theme = "light";
    redraw();
  });
  window.addEventListener("afterprint", () => {
    if (before) root.dataset.theme = before;
    else delete root.dataset.theme;
    redraw();
  });
}
