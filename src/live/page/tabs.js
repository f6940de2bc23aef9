// The panels at the side, one at a time. On a phone a touch of the open tab folds them away.

import { byId, mark, show } from "./dom.js";

const NAMES = ["mind", "why", "plots", "scene", "save"];

export function makeTabs() {
  const listeners = new Map();
  const tabs = { now: "mind", open, on: (name, act) => listeners.set(name, act) };
  const side = byId("side");
  const narrow = matchMedia("(max-width: 860px)");

  NAMES.forEach((name, k) => {
    const tab = byId(`tab-${name}`);
    tab.addEventListener("click", () => {
      if (narrow.matches && tabs.now === name && side.dataset.open === "true") fold(false);
      else open(name);
    });
    tab.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      const next = NAMES[(k + by + NAMES.length) % NAMES.length];
      open(next);
      byId(`tab-${next}`).focus();
    });
  });

  function fold(to) {
    side.dataset.open = String(to);
    for (const name of NAMES) show(byId(`panel-${name}`), to && name === tabs.now);
  }

  function open(name) {
    tabs.now = name;
    fold(true);
    for (const one of NAMES) {
      mark(byId(`tab-${one}`), "aria-selected", one === name);
      mark(byId(`tab-${one}`), "tabindex", one === name ? 0 : -1);
    }
    listeners.get(name)?.();
  }

  open("mind");
  return tabs;
}
