// The legend of the stage: each mark with its symbol, its meaning and its toggle. What is chosen
// stays chosen in this browser.

import { byId, make, mark, show } from "./dom.js";
import { MARKS, sample } from "./marks.js";

const AT_FIRST = {
  com: true,
  support: true,
  cop: true,
  capture: true,
  touch: true,
  reference: true,
  trail: true,
  metres: true,
  props: false,
};
const KEPT = "aplomb.marks";

/** The toggles; the stage reads them each time it draws. */
export function toggles() {
  return { ...AT_FIRST, ...kept() };
}

function kept() {
  try {
    const found = JSON.parse(localStorage.getItem(KEPT) ?? "{}");
    return Object.fromEntries(
      Object.keys(AT_FIRST)
        .filter((name) => typeof found[name] === "boolean")
        .map((name) => [name, found[name]]),
    );
  } catch {
    return {};
  }
}

export function makeLegend(on, stage) {
  const box = byId("legend");
  const button = byId("legend-open");
  const samples = new Map();
  for (const [name, meaning] of MARKS) {
    const canvas = make("canvas", { "aria-hidden": "true" });
    const input = make("input", {
      type: "checkbox",
      data: { mark: name },
      onchange: () => set(name, input.checked),
    });
    input.checked = on[name];
    samples.set(name, canvas);
    box.append(make("label", {}, input, canvas, meaning));
  }

  function set(name, value) {
    on[name] = value;
    try {
      localStorage.setItem(KEPT, JSON.stringify(on));
    } catch {
      // A browser that keeps nothing still shows it.
    }
    stage.touch();
  }

  function open(visible = box.hidden) {
    show(box, visible);
    mark(button, "aria-expanded", visible);
    if (visible) paint();
  }
  button.addEventListener("click", () => open());
  document.addEventListener("pointerdown", (event) => {
    if (!box.hidden && !box.contains(event.target) && !button.contains(event.target)) open(false);
  });

  function paint() {
    for (const [name, canvas] of samples) sample(canvas, name);
  }
  return { open, paint, close: () => open(false) };
}
