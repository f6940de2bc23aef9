// Light or dark: what the system prefers, until the button says otherwise; kept in this browser.

import { byId } from "./dom.js";
import { refresh, isDark } from "./look.js";

const KEPT = "aplomb.theme";

/** `changed()` is called after the colours have changed. */
export function makeTheme(changed) {
  const root = document.documentElement;
  try {
    const found = localStorage.getItem(KEPT);
    if (found === "light" || found === "dark") root.dataset.theme = found;
  } catch {
    // Nothing is kept here.
  }

  function apply() {
    refresh();
    changed();
  }

  function toggle() {
    const theme = isDark() ? "light" : "dark";
    root.dataset.theme = theme;
    try {
      localStorage.setItem(KEPT, theme);
    } catch {
      // It holds until the page is closed.
    }
    apply();
  }

  byId("theme").addEventListener("click", toggle);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", apply);
  apply();
  return { toggle };
}
