// The mind: one row for each controller of the pool, in the pool's order. Its bid as a bar; what
// refuses, with value and distance to the bound; which one is active. Controllers that wait for
// their command form a group at the end, folded away. Rows keep their height and their place.

import { byId, make, say, mark, show, place } from "./dom.js";
import { band } from "./look.js";
import { clause, featureOf, isPosture, missed, nodesOf, onGauge, posture } from "./words.js";

const ON_COMMAND = -1;
const SPECIAL = { [-1]: "only on command", [-2]: "has just failed", [-3]: "declines" };

export function makeMind(state, contract) {
  const box = byId("mind");
  const choice = byId("character-choice");
  const select = byId("mind-character");
  let rows = [];
  let group = null;
  let built = -1;
  let open = false;

  select.addEventListener("change", () => state.choose(Number(select.value)));
  state.on("hello", (hello) => {
    select.replaceChildren(
      ...hello.characters.map((one, k) => make("option", { value: k }, `${k + 1}: ${one.name}`)),
    );
    show(choice, hello.characters.length > 1);
    built = -1;
  });
  state.on("character", () => {
    built = -1;
  });
  state.on("texts", update);

  function build(now) {
    built = state.character;
    select.value = String(built);
    const character = state.body();
    rows = character.controllers.map((controller, k) => rowOf(controller, k));
    const waits = now.bids.map((bid) => bid[1] === ON_COMMAND);
    const main = rows.filter((_, k) => !waits[k]);
    const rest = rows.filter((_, k) => waits[k]);
    box.replaceChildren(make("ul", {}, ...main.map((row) => row.item)));
    group = null;
    if (rest.length > 0) folded(rest);
    paint();
    contract.light();
  }

  function folded(rest) {
    const count = make("span", {});
    const button = make(
      "button",
      { class: "group", "aria-expanded": open, onclick: () => fold(!open) },
      make("span", { class: "chevron", "aria-hidden": "true" }),
      count,
    );
    const list = make("ul", { class: "waiting" }, ...rest.map((row) => row.item));
    group = { button, count, list, rest };
    box.append(button, list);
    fold(open);
  }

  function fold(to) {
    open = to;
    if (!group) return;
    mark(group.button, "aria-expanded", open);
    group.list.classList.toggle("folded", !open);
  }

  function rowOf(controller, k) {
    const name = make("span", { class: "name" }, controller.name);
    const fill = make("i", {});
    const bar = make("span", { class: "bid", "aria-hidden": "true" }, fill);
    const amount = make("span", { class: "amount number" });
    const why = make("span", { class: "why" });
    const dot = make("i", {});
    const gauge = make("span", { class: "gauge", "aria-hidden": "true" }, dot);
    const miss = make("span", { class: "miss number" });
    const button = make(
      "button",
      {
        class: "controller",
        data: { controller: controller.name, state: "refuses" },
        onclick: () => contract.toggle(k),
      },
      make("span", { class: "dot", data: { band: k } }),
      name,
      controller.learned ? make("span", { class: "tag" }, "learned") : null,
      bar,
      gauge,
      amount,
      make("span", { class: "second" }, why, miss),
    );
    return {
      item: make("li", {}, button),
      button,
      bar,
      fill,
      amount,
      why,
      gauge,
      dot,
      miss,
      nodes: nodesOf(controller.precondition),
      seen: "",
    };
  }

  function update() {
    const now = state.now();
    if (built !== state.character || rows.length !== now.bids.length) build(now);
    const most = Math.max(
      1,
      ...state.body().controllers.map((one) => one.weight),
      ...now.bids.map((bid) => bid[0]),
    );
    let waiting = 0;
    now.bids.forEach((bid, k) => {
      const row = rows[k];
      if (bid[1] === ON_COMMAND && now.active !== k) waiting += 1;
      const seen = `${bid} ${now.active === k} ${most} ${now.posture}`;
      if (seen !== row.seen) {
        row.seen = seen;
        fillIn(row, bid, now.active === k, most, now.posture);
      }
    });
    if (group) say(group.count, waiting === 1 ? "1 waits for its command" : `${waiting} wait for their command`);
    contract.update(now);
  }

  function fillIn(row, [suitability, node, value], active, most, pose) {
    const kind = active ? "active" : node === null ? "bids" : node === ON_COMMAND ? "waits" : "refuses";
    mark(row.button, "data-state", kind);
    if (active) mark(row.button, "aria-current", "true");
    else row.button.removeAttribute("aria-current");
    place(row.fill, "width", (100 * suitability) / most);
    say(row.amount, suitability > 0 ? String(Number(suitability.toFixed(1))) : "–");
    const refused = node !== null && node >= 0 ? row.nodes[node] : null;
    const at = refused ? onGauge(refused, value) : null;
    show(row.gauge, at !== null);
    show(row.bar, at === null);
    if (at !== null) place(row.dot, "left", at);
    const miss = refused ? (isPosture(refused) ? `is ${posture(pose)}` : missed(refused, value)) : "";
    // The one in control says nothing of what it needs: the feature is named here.
    const feature = active && miss ? `${isPosture(refused) ? "posture" : (featureOf(refused) ?? "")} ` : "";
    say(row.miss, `${feature}${miss}`.trim());
    const why = active
      ? "in control"
      : refused
        ? lacking(refused)
        : node === null
          ? "bids"
          : (SPECIAL[node] ?? "refuses");
    say(row.why, why);
    mark(row.button, "title", refused ? `${why}; ${feature}${miss || "it does not hold"}` : why);
  }

  /** Colours of the dots; anew after a change of theme. */
  function paint() {
    for (const dot of box.querySelectorAll("[data-band]"))
      dot.style.background = band(Number(dot.dataset.band));
  }

  return { paint };
}

function lacking(node) {
  if (node.learned) return "outside what it has learned";
  return `needs ${clause(node.text).replace(/^posture is /, "posture ")}`;
}
