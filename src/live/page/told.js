// What the session tells the person: answers over the stage, and errors of watched files, which stay
// until the file is mended or somebody closes them. An error with line and column stays too.

import { byId, make, icon, say, show } from "./dom.js";
import { eventText } from "./words.js";

const MOST = 3;
const GOOD_FOR = 5000; // ms
const BAD_FOR = 14000; // ms

export function makeTold(state) {
  const box = byId("told");
  const files = byId("files");
  let lastRefusal = "";

  function put(ok, text, key, stays) {
    const words = make("span", {}, text);
    const item = make(
      "div",
      { class: "told", data: { ok, key, stays } },
      words,
      make(
        "button",
        { class: "icon plain", "aria-label": "Close", onclick: () => item.remove() },
        icon("close"),
      ),
    );
    forget(key);
    box.append(item);
    const passing = [...box.children].filter((one) => one.dataset.stays !== "work");
    for (const old of passing.slice(0, Math.max(0, passing.length - MOST))) old.remove();
    return { item, words };
  }

  /** Takes away the note with this key. */
  function forget(key) {
    for (const old of [...box.children]) if (old.dataset.key === key) old.remove();
  }

  /** `key`: a later note with the same one replaces it. */
  function note(ok, text, key = text) {
    const place = /:\d+:\d+/.test(text);
    const { item } = put(ok, text, key, !ok && place ? "mistake" : "");
    if (ok || !place) setTimeout(() => item.remove(), ok ? GOOD_FOR : BAD_FOR);
  }

  /** A note on work that takes its time, told anew each second; it stays until what this returns is called. */
  function lasting(text, key) {
    const { item, words } = put(true, text(), key, "work");
    const timer = setInterval(() => say(words, text()), 1000);
    return () => {
      clearInterval(timer);
      item.remove();
    };
  }

  /** What was wrong in a file is mended once a file has been read well. */
  function mended() {
    for (const item of [...box.children]) if (item.dataset.stays === "mistake") item.remove();
  }

  state.on("told", (message) => {
    if (message.ok) mended();
    note(message.ok === true, String(message.text));
  });
  state.on("files", (message) => {
    show(files, message.ok !== true);
    files.replaceChildren();
    if (message.ok === true) {
      note(true, String(message.text));
      return;
    }
    files.append(
      make("span", {}, String(message.text)),
      make(
        "button",
        { class: "icon plain", "aria-label": "Close", onclick: () => show(files, false) },
        icon("close"),
      ),
    );
  });
  state.on("events", (events, from) => {
    if (from === 0) return;
    for (const event of events.slice(from)) {
      const text = String(event.text ?? "");
      if (event.kind !== "refused" || `${event.n} ${text}` === lastRefusal) continue;
      lastRefusal = `${event.n} ${text}`;
      const words = eventText(event);
      note(false, words, words.split(":")[0]);
    }
  });
  return {
    note,
    lasting,
    forget,
    clear() {
      for (const item of [...box.children]) if (item.dataset.stays !== "work") item.remove();
    },
  };
}
