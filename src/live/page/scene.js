// The scene: scenario, character and repertoire from what is shipped; parameters as sliders; a file
// chosen or dropped on the page. Choices → messages `load`, `set`, `open`.

import { byId, make, say, show, short, seldom } from "./dom.js";

/** Bytes of text that an `open` may hold. */
export const MOST_TEXT = 511 * 1024;

export function makeScene(state, told) {
  const lists = { scenario: "scenarios", character: "characters", repertoire: "repertoires" };
  const own = {
    scenario: "standing on level ground",
    character: "the scenario's own",
    repertoire: "the character's own",
  };
  let known = "";
  let rows = [];

  state.on("hello", (hello) => {
    const shipped = JSON.stringify(hello.shipped);
    if (shipped !== known) {
      known = shipped;
      for (const [id, list] of Object.entries(lists)) {
        byId(id).replaceChildren(
          make("option", { value: "" }, own[id]),
          ...hello.shipped[list].map((name) => make("option", { value: name }, name)),
        );
      }
    }
    const { name } = hello.scenario;
    if (hello.shipped.scenarios.includes(name)) byId("scenario").value = name;
    parameters(hello.scenario.parameters);
  });

  byId("load").addEventListener("click", () => {
    const chosen = (id) => byId(id).value || null;
    state.send({
      do: "load",
      scenario: chosen("scenario"),
      character: chosen("character"),
      repertoire: chosen("repertoire"),
    });
  });

  /** Sliders; those that are being moved stay, so that an answer doesn't take them from the hand. */
  function parameters(list) {
    const names = list.map((one) => one.name).join(" ");
    if (names === rows.map((row) => row.name).join(" ")) {
      list.forEach((one, k) => rows[k].set(one.value));
      return;
    }
    rows = list.map(parameter);
    const none = make("p", { class: "soft" }, "This scenario has none.");
    byId("parameters").replaceChildren(...(rows.length > 0 ? rows.map((row) => row.box) : [none]));
  }

  function parameter({ name, value, min, max, restarts }) {
    const output = make("output", { class: "number" });
    const send = () => state.send({ do: "set", name, value: Number(Number(input.value).toPrecision(5)) });
    const soon = seldom(80, send);
    const input = make("input", {
      type: "range",
      min,
      max,
      step: "any",
      "aria-label": name,
      oninput: () => {
        say(output, short(Number(input.value), 2));
        if (!restarts) soon();
      },
      onchange: () => {
        if (restarts) send();
      },
    });
    const set = (to) => {
      if (document.activeElement !== input || restarts) input.value = String(to);
      say(output, short(Number(input.value), 2));
    };
    set(value);
    const box = make(
      "label",
      { class: "parameter", data: { parameter: name } },
      make(
        "span",
        {},
        name.replaceAll("_", " "),
        restarts ? make("small", { class: "soft" }, "  begins the run anew") : null,
      ),
      output,
      input,
    );
    return { name, box, set };
  }

  async function take(file) {
    if (!file) return;
    if (file.size > MOST_TEXT) {
      told.note(false, `${file.name} has more than 500 kB; it is not a scenario, character or repertoire.`);
      return;
    }
    open(file.name, await file.text());
  }

  function open(name, text) {
    state.send({ do: "open", name, text });
  }

  byId("open-file").addEventListener("click", () => byId("file").click());
  byId("file").addEventListener("change", () => {
    take(byId("file").files[0]);
    byId("file").value = "";
  });

  const carries = (event) => event.dataTransfer?.types.includes("Files");
  addEventListener("dragover", (event) => {
    if (!carries(event)) return;
    event.preventDefault();
    show(byId("drop-here"), true);
  });
  addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) show(byId("drop-here"), false);
  });
  addEventListener("drop", (event) => {
    show(byId("drop-here"), false);
    if (!carries(event)) return;
    event.preventDefault();
    for (const file of event.dataTransfer.files) take(file);
  });

  return { open };
}
