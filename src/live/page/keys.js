// The keys, and the help that lists them. They rest while somebody types or a dialog is open.

import { byId, make } from "./dom.js";

const LEAST = 5; // N·s
const MOST = 300;
const BY = 5;

export function makeKeys(state, act) {
  const help = byId("help");
  const slider = byId("strength");

  const strength = (by) => {
    slider.value = String(Math.min(MOST, Math.max(LEAST, Number(slider.value) + by)));
    told();
    act.note(true, `Arrow keys push with ${slider.value} N·s`, "strength");
  };
  const told = () => {
    byId("strength-text").textContent = `${slider.value} N·s`;
  };
  // A note of another strength would be wrong now.
  slider.addEventListener("input", () => {
    told();
    act.forget("strength");
  });
  byId("push-left").addEventListener("click", () => push(-1));
  byId("push-right").addEventListener("click", () => push(1));

  function push(way) {
    const link = trunk();
    if (link)
      state.send({
        do: "push",
        character: state.character,
        link,
        impulse: [way * Number(slider.value), 0],
      });
  }

  /** The link whose angle is the trunk's pitch. */
  function trunk() {
    const body = state.body();
    return body?.links[body.trunk]?.name;
  }

  const table = [
    ["Space", [" "], "play or pause", act.toggle],
    [".", ["."], "one step on", act.step],
    [",", [","], "one step back", act.back],
    ["<, >", ["<"], "one second back, one second on", act.backSecond],
    [null, [">"], "", act.onSecond],
    ["[", ["["], "slower", act.slower],
    ["]", ["]"], "faster", act.faster],
    ["←", ["ArrowLeft"], "push the trunk to the left", () => push(-1)],
    ["→", ["ArrowRight"], "push the trunk to the right", () => push(1)],
    ["+", ["+", "="], "push harder", () => strength(BY)],
    ["−", ["-", "−"], "push more lightly", () => strength(-BY)],
    [
      "1 – 5",
      ["1", "2", "3", "4", "5"],
      "drag, push, ball, crate, pan",
      (key) => act.tool(Number(key) - 1),
    ],
    ["e", ["e"], "explain the last switch", act.explain],
    ["p, n", ["p"], "switch before, next switch", act.before],
    [null, ["n"], "", act.after],
    ["b", ["b"], "start here: forget what came after", act.branch],
    ["r", ["r"], "begin anew", act.reset],
    ["f", ["f"], "keep everything in view", act.follow],
    ["l", ["l"], "what is drawn", act.legend],
    ["/", ["/"], "type a command", () => byId("command").focus()],
    ["t", ["t"], "light or dark", act.theme],
    ["h or ?", ["h", "?"], "this help", open],
    ["Esc", ["Escape"], "give up what is being drawn, close", act.escape],
  ];
  const byKey = new Map(table.flatMap(([, keys, , does]) => keys.map((key) => [key, does])));

  for (const [shown, , meaning] of table) {
    if (shown)
      byId("keys-list").append(
        make("div", {}, make("dt", {}, make("kbd", {}, shown)), make("dd", {}, meaning)),
      );
  }

  function open() {
    help.showModal();
  }
  byId("help-open").addEventListener("click", open);
  byId("help-close").addEventListener("click", () => help.close());
  help.addEventListener("click", (event) => {
    if (event.target === help) help.close();
  });

  const typing = (node) =>
    node instanceof HTMLElement &&
    (node.isContentEditable || /^(INPUT|TEXTAREA|SELECT)$/.test(node.tagName));

  document.addEventListener("keydown", (event) => {
    if (help.open) {
      if (["h", "?"].includes(event.key)) help.close();
      return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || typing(event.target))
      return;
    const onButton =
      event.target instanceof HTMLElement && event.target.closest("button, a, [role=option]");
    if (onButton && (event.key === " " || event.key === "Enter")) return;
    const does = byKey.get(event.key.length === 1 ? event.key.toLowerCase() : event.key);
    if (!does) return;
    event.preventDefault();
    does(event.key);
  });

  // After a click the button lets go of the focus, so that space plays and pauses again.
  document.addEventListener("click", (event) => {
    const button = event.target instanceof Element ? event.target.closest("button") : null;
    if (button && event.detail > 0 && document.activeElement === button) button.blur();
  });
  return { open };
}
