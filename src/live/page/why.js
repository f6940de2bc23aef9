// Why it switched: the last switch before this step, who bid what and what refused; and the list of
// all events, each of which leads to its step.

import { byId, make, say } from "./dom.js";
import { band } from "./look.js";
import { clause, eventText, reasonText } from "./words.js";

const MOST_EVENTS = 300;

export function makeWhy(state, drive, tabs, contract) {
  const list = byId("why-list");
  let shown; // the event that is on show

  const switches = () =>
    state.events.filter((one) => one.kind === "switch" && one.character === state.character);
  const lastBefore = (step) => switches().findLast((one) => one.n <= step) ?? null;

  /** Pauses at the last switch and shows it. */
  function explain() {
    if (!state.frame) return;
    tabs.open("why");
    go(lastBefore(state.frame.n));
  }

  function go(event) {
    if (!event) return;
    drive.pause();
    drive.seek(event.n);
  }

  byId("explain").addEventListener("click", explain);
  byId("why-before").addEventListener("click", () => before());
  byId("why-after").addEventListener("click", () => after());
  const before = () => state.frame && go(lastBefore(state.frame.n - 1));
  const after = () => state.frame && go(switches().find((one) => one.n > state.frame.n));

  state.on("hello", () => {
    shown = undefined;
  });
  state.on("events", () => {
    shown = undefined;
    fill();
  });
  state.on("character", () => {
    shown = undefined;
  });
  state.on("texts", update);

  function update() {
    if (byId("panel-why").hidden || !state.frame) return;
    const event = lastBefore(state.frame.n);
    byId("why-before").disabled = !lastBefore(state.frame.n - 1);
    byId("why-after").disabled = !switches().some((one) => one.n > state.frame.n);
    if (event === shown) return;
    shown = event;
    say(byId("why-title"), event ? title(event) : "No switch yet");
    say(
      byId("why-reason"),
      event ? `At ${event.t.toFixed(3)} s. ${reasonText(event)} ${detail(event)}`.trim() : "",
    );
    list.replaceChildren(...(event ? bidders(event) : []));
  }

  function title(event) {
    const who = state.hello.characters.length > 1 ? `${event.character + 1}: ` : "";
    return `${who}${event.from ? `${event.from} ` : ""}→ ${event.to}`;
  }

  /** What the text says beyond the names: in brackets, or all of it. */
  function detail(event) {
    const text = event.text ?? "";
    const inside = text.match(/\((?:failed|succeeded|command|start)(?:: )?(.*)\)$/s);
    const rest = inside ? inside[1] : text.includes("→") ? "" : text;
    return rest ? `It was: ${clause(rest)}.` : "";
  }

  function bidders(event) {
    const pool = state.body().controllers;
    const bids = event.bids ?? [];
    const most = Math.max(1, ...bids.map((one) => one[1]));
    const offers = bids.filter((one) => one[2] === null).sort((a, b) => b[1] - a[1]);
    const waits = bids.filter((one) => one[2] !== null && /only on command/.test(one[2]));
    const refusals = bids.filter((one) => one[2] !== null && !waits.includes(one));
    const row = ([name, amount, refusal]) => {
      const dot = make("span", { class: "dot" });
      dot.style.background = band(
        Math.max(
          0,
          pool.findIndex((one) => one.name === name),
        ),
      );
      const fill = make("i", {});
      fill.style.width = `${(100 * amount) / most}%`;
      return make(
        "li",
        { data: { name, state: name === event.to ? "active" : refusal === null ? "bids" : "refuses" } },
        dot,
        make("button", { class: "name", title: "Its contract", onclick: () => look(name) }, name),
        refusal === null ? make("span", { class: "bid" }, fill) : null,
        make("span", { class: "soft" }, refusal === null ? `bids ${amount}` : clause(refusal)),
      );
    };
    return [
      ...offers.map(row),
      ...refusals.map(row),
      waits.length > 0
        ? make(
            "li",
            { class: "soft", data: { state: "waits" } },
            `Only on command: ${waits.map((one) => one[0]).join(", ")}`,
          )
        : null,
    ].filter(Boolean);
  }

  /** Opens the contract of a bidder. */
  function look(name) {
    tabs.open("mind");
    contract.show(name);
  }

  function fill() {
    if (byId("panel-why").hidden) return;
    const events = state.events.filter((one) => one.kind !== "released");
    const from = Math.max(0, events.length - MOST_EVENTS);
    byId("events-list").replaceChildren(
      ...events.slice(from).map((event, k) =>
        make(
          "li",
          {},
          make(
            "button",
            {
              data: { place: from + k, kind: event.kind },
              onclick: () => {
                drive.pause();
                drive.seek(event.n);
              },
            },
            make("span", { class: "number soft" }, event.t.toFixed(3)),
            make("span", {}, eventText(event)),
          ),
        ),
      ),
    );
  }

  return {
    explain,
    before,
    after,
    refresh: () => {
      shown = undefined;
      fill();
      update();
    },
  };
}
