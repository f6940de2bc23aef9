// The contract of one controller as sentences: where it takes over, when it has succeeded, what it
// expects, after how long it gives up. Each clause is green or red as the frame says (`inspect`).

import { byId, make, icon, say, mark, show, place, plain, short } from "./dom.js";
import { clause, isLeaf, isPosture, onGauge, posture, slack, turned } from "./words.js";

const PARTS = [
  ["pre", "precondition", "Takes over where", "Takes over from any state."],
  ["post", "postcondition", "Has succeeded when", "Never says by itself that it is done."],
  ["expected", "expected", "Expects", "Expects nothing in particular."],
];

export function makeContract(state, command) {
  const box = byId("contract");
  let shown = null; // place in the pool
  let wanted = null; // name, so that it stays open over a new hello
  let lines = { pre: [], post: [], expected: [] };
  let heads = {};
  let patience = null;

  state.on("hello", () => settle());
  state.on("character", () => settle());
  state.on("connected", (connected) => {
    if (connected && shown !== null) ask();
  });

  /** After a new hello or another character: the same controller if the pool has it. */
  function settle() {
    const place = state.body()?.controllers.findIndex((one) => one.name === wanted) ?? -1;
    if (place < 0) close();
    else open(place);
  }

  function ask() {
    state.send({ do: "inspect", character: state.character, controller: shown });
  }

  function toggle(place) {
    if (place === shown) close();
    else open(place);
  }

  function close() {
    const was = shown;
    shown = wanted = null;
    show(box, false);
    box.replaceChildren();
    if (was !== null) ask();
    light();
  }

  function light() {
    for (const row of document.querySelectorAll("#mind [data-controller]")) {
      mark(row, "aria-expanded", row.dataset.controller === wanted);
    }
  }

  function open(place) {
    const controller = state.body().controllers[place];
    shown = place;
    wanted = controller.name;
    box.dataset.controller = controller.name;
    lines = { pre: [], post: [], expected: [] };
    heads = {};
    const title = make("h2", {}, controller.name);
    const about = [
      controller.role,
      `weight ${plain(controller.weight)}`,
      controller.learned ? "learned boundary" : null,
    ];
    box.replaceChildren(
      make(
        "div",
        { class: "row" },
        title,
        make("span", { class: "soft" }, about.filter(Boolean).join(" · ")),
        make("span", { class: "spring" }),
        make(
          "button",
          { class: "icon plain", "aria-label": "Close the contract", onclick: close },
          icon("close"),
        ),
      ),
      ...PARTS.map(([part, key, heading, none]) => section(part, controller[key], heading, none)),
      patienceOf(controller),
      ...(controller.commands ?? []).map((one) => command.form(one)),
    );
    show(box, true);
    box.scrollTop = 0;
    ask();
    light();
  }

  function section(part, root, heading, none) {
    const plain = !root || ["always", "never"].includes(root.text);
    if (plain) {
      if (root) lines[part].push({ node: root });
      const never = root?.text === "never" && part !== "post";
      return make(
        "p",
        { class: "sentence" },
        never
          ? `${heading}: never.`
          : root?.text === "always" && part === "post"
            ? "Has succeeded at once."
            : none,
      );
    }
    const state = make("span", { class: "sign", "aria-hidden": "true" });
    heads[part] = state;
    const list = make("ul", {});
    if (root.all) {
      lines[part].push({ node: root, sign: state });
      for (const child of root.all) list.append(item(part, child));
    } else {
      list.append(item(part, root));
    }
    return make("div", { class: "part" }, make("h3", {}, state, heading), list);
  }

  /** A clause and what is under it; filled in pre-order, so that its place is its number. */
  function item(part, node) {
    const sign = make("span", { class: "sign", "aria-hidden": "true" });
    const line = { node, sign };
    const li = make("li", { data: { part, node: lines[part].length } });
    line.item = li;
    lines[part].push(line);
    if (isLeaf(node)) {
      leaf(line, node);
      return li;
    }
    const other = node.not ? turned(node.not) : null;
    if (other) {
      // One line for both: the sign of the outer, the value of the inner.
      leaf(line, other);
      lines[part].push({ node: other, value: line.value, gauge: line.gauge, dot: line.dot });
      line.value = null;
      return li;
    }
    const children = node.all ?? node.any ?? [node.not];
    li.append(
      make(
        "span",
        { class: "leaf" },
        sign,
        make("span", { class: "text soft" }, node.all ? "all of" : node.any ? "one of" : "not"),
      ),
      make("ul", {}, ...children.map((child) => item(part, child))),
    );
    return li;
  }

  function leaf(line, node) {
    line.value = make("span", { class: "value number" });
    line.dot = make("i", {});
    line.gauge = make("span", { class: "gauge", "aria-hidden": "true" }, line.dot);
    line.gauge.hidden = slack(node, 0) === null;
    const text = make("span", { class: "text" }, node.learned ? "learned boundary" : clause(node.text));
    line.item.append(make("span", { class: "leaf" }, line.sign, text, line.value, line.gauge));
  }

  function patienceOf(controller) {
    patience = null;
    if (controller.patience === null || controller.patience === undefined)
      return make("p", { class: "sentence" }, "Never gives up for want of time.");
    const sofar = make("span", { class: "number" });
    patience = { sofar, limit: controller.patience };
    const still = Number.isFinite(controller.stalls) ? ` (${plain(controller.stalls)} s if still)` : "";
    return make("p", { class: "sentence" }, `Gives up after ${plain(controller.patience)} s${still}`, sofar);
  }

  function update() {
    if (shown === null) return;
    const told = state.frame?.inspect;
    const fresh = told && told.controller === shown && told.character === state.character ? told : null;
    for (const [part] of PARTS) {
      const states = fresh?.[part] ?? [];
      lines[part].forEach((line, k) => fillIn(line, states[k] ?? null, fresh));
      if (heads[part] && !lines[part][0].node.all) sign(heads[part], states[0] ?? null);
    }
    if (patience)
      say(
        patience.sofar,
        Number.isFinite(fresh?.elapsed) ? `; ${fresh.elapsed.toFixed(1)} s so far.` : ".",
      );
  }

  function sign(node, now) {
    mark(node, "data-holds", now === null ? "unknown" : now[0] === 1);
    say(node, now === null ? "·" : now[0] === 1 ? "✓" : "✗");
  }

  function fillIn(line, now, fresh) {
    if (line.sign) sign(line.sign, now);
    if (line.item) mark(line.item, "data-holds", now === null ? "unknown" : now[0] === 1);
    if (!line.value) return;
    const value = now?.[1] ?? null;
    say(line.value, now === null ? "" : found(line.node, value, fresh));
    const at = onGauge(line.node, value);
    if (at !== null) place(line.dot, "left", at);
    line.dot.hidden = at === null;
  }

  /** What a clause has found, in words: a value, a score, the posture; nothing of other clauses. */
  function found(node, value, fresh) {
    if (isPosture(node)) return `is ${posture(state.now().posture)}`;
    if (value === null) return node.feature ? "no value" : "";
    if (!node.learned) return short(value);
    const chance = Number.isFinite(fresh?.probability)
      ? `, probability ${Math.round(100 * fresh.probability)} %`
      : "";
    return `score ${short(value)}${chance}`;
  }

  /** Opens the contract of a controller by its name. */
  function find(name) {
    const k = state.body()?.controllers.findIndex((one) => one.name === name) ?? -1;
    if (k >= 0 && k !== shown) open(k);
  }

  return { toggle, show: find, close, update, light };
}
