// Commands: a field that completes names and parameters with their ranges, a button for each command
// of the pool, and a form with a slider for each parameter. Text → message `command`.

import { byId, make, mark, show, plain, short } from "./dom.js";

export function makeCommands(state) {
  const field = byId("command");
  const list = byId("completions");
  let choices = [];
  let chosen = -1;
  const past = [];
  let recalled = -1;

  const known = () => state.body()?.controllers.flatMap((one) => one.commands ?? []) ?? [];

  function send(text) {
    const words = text.trim();
    if (!words) return;
    if (past[0] !== words) past.unshift(words);
    recalled = -1;
    state.send({ do: "command", character: state.character, text: words });
  }

  // Buttons: first what happens only on command, which is what somebody wants to ask for.
  function buttons() {
    const pool = state.body()?.controllers ?? [];
    const own = pool.flatMap((one) =>
      (one.commands ?? []).map((command) => ({ command, weight: one.weight })),
    );
    own.sort((a, b) => (a.weight > 0) - (b.weight > 0));
    const first = (own.find((one) => one.command.parameters.length > 0) ?? own[0])?.command;
    const example = first?.parameters.slice(0, 1).map((one) => ` ${one.name}=${plain(one.default)}`) ?? "";
    field.placeholder = first ? `Such as ${first.name}${example}` : "Nothing answers to a command";
    byId("commands").replaceChildren(
      ...own.map(({ command }) =>
        make(
          "button",
          {
            data: { command: command.name },
            title: hintOf(command),
            onclick: () => send(command.name),
          },
          command.name,
        ),
      ),
    );
  }
  state.on("hello", buttons);
  state.on("character", buttons);

  const rangeOf = (one) => `${plain(one.min)} to ${plain(one.max)}, else ${plain(one.default)}`;
  const hintOf = (command) =>
    ["Command", ...command.parameters.map((one) => `${one.name}: ${rangeOf(one)}`)].join("\n");

  /** What can stand where the cursor is: names for the first word, parameters after it. */
  function complete() {
    const text = field.value.slice(0, field.selectionStart ?? field.value.length);
    const words = text.split(/\s+/);
    const last = words[words.length - 1];
    if (words.length < 2) {
      return known()
        .filter((one) => one.name.startsWith(last))
        .map((one) => ({
          text: one.name + (one.parameters.length > 0 ? " " : ""),
          shown: one.name,
          note: one.parameters.map((p) => p.name).join(", "),
          last,
        }));
    }
    const command = known().find((one) => one.name === words[0]);
    const used = new Set(words.slice(1, -1).map((word) => word.split("=")[0]));
    return (command?.parameters ?? [])
      .filter(
        (one) => !used.has(one.name) && (one.name.startsWith(last) || last.startsWith(`${one.name}=`)),
      )
      .map((one) => ({
        text: last.includes("=") ? last : `${one.name}=${one.default}`,
        shown: `${one.name}=`,
        note: rangeOf(one),
        last,
        fixed: last.includes("="),
      }));
  }

  function suggest() {
    choices = document.activeElement === field ? complete() : [];
    chosen = -1;
    list.replaceChildren(
      ...choices.map((one, k) =>
        make(
          "li",
          {
            id: `completion-${k}`,
            role: "option",
            "aria-selected": "false",
            onpointerdown: (event) => {
              event.preventDefault();
              chosen = k;
              take();
            },
          },
          make("span", {}, one.shown),
          make("small", {}, one.note),
        ),
      ),
    );
    show(list, choices.length > 0);
    mark(field, "aria-expanded", choices.length > 0);
    field.removeAttribute("aria-activedescendant");
  }

  function choose(k) {
    chosen = (k + choices.length) % choices.length;
    [...list.children].forEach((item, i) => mark(item, "aria-selected", i === chosen));
    list.children[chosen].scrollIntoView({ block: "nearest" });
    mark(field, "aria-activedescendant", `completion-${chosen}`);
  }

  function take() {
    const one = choices[chosen] ?? choices[0];
    if (!one || one.fixed) return;
    const at = field.selectionStart ?? field.value.length;
    const before = field.value.slice(0, at - one.last.length);
    field.value = before + one.text + field.value.slice(at);
    const end = before.length + one.text.length;
    // A number is selected, ready to be typed over.
    const equals = one.text.indexOf("=");
    field.setSelectionRange(equals < 0 ? end : before.length + equals + 1, end);
    suggest();
  }

  function close() {
    show(list, false);
    mark(field, "aria-expanded", false);
    choices = [];
  }

  let asked = ""; // what was typed last, until it is clear what became of it

  function go() {
    asked = field.value.trim();
    send(field.value);
    field.value = "";
    close();
  }

  /** What was typed and refused stands in the field again, to be mended, unless something else does. */
  function giveBack() {
    if (asked && !field.value) {
      field.value = asked;
      field.select();
    }
    asked = "";
  }

  state.on("told", (message) => {
    const [name] = asked.split(/\s/);
    if (asked && message.ok !== true && String(message.text).includes(`'${name}`)) giveBack();
  });
  state.on("events", (events, from) => {
    const answer = events.slice(from).findLast((one) => one.kind === "command");
    if (!asked || !answer || String(answer.text).split(/[\s:]/)[0] !== asked.split(/\s/)[0]) return;
    if (answer.text.endsWith("not taken up")) giveBack();
    else asked = "";
  });

  field.addEventListener("input", suggest);
  field.addEventListener("focus", suggest);
  field.addEventListener("blur", close);
  byId("command-send").addEventListener("click", go);
  field.addEventListener("keydown", (event) => {
    const { key } = event;
    const end = field.selectionEnd === field.value.length;
    if (key === "Enter") {
      if (chosen >= 0 && !choices[chosen].fixed) take();
      else go();
    } else if (key === "Escape") {
      if (list.hidden) field.blur();
      else close();
    } else if (
      key === "Tab" &&
      !event.shiftKey &&
      choices.length > 0 &&
      field.value &&
      !choices[Math.max(chosen, 0)].fixed
    ) {
      take();
    } else if ((key === "ArrowDown" || key === "ArrowUp") && choices.length > 0 && field.value) {
      choose(chosen < 0 ? (key === "ArrowDown" ? 0 : -1) : chosen + (key === "ArrowDown" ? 1 : -1));
    } else if (key === "ArrowDown" && choices.length > 0) {
      choose(chosen + 1);
    } else if (key === "ArrowUp" && end && past.length > 0) {
      recalled = Math.min(recalled + 1, past.length - 1);
      field.value = past[recalled];
      close();
    } else {
      return;
    }
    event.preventDefault();
  });

  /** A command with a slider for each parameter, for the contract. */
  function form(command) {
    const values = new Map();
    const fields = command.parameters.map((one) => {
      const output = make("output", { class: "number" }, short(one.default));
      const input = make("input", {
        type: "range",
        min: one.min,
        max: one.max,
        step: "any",
        "aria-label": one.name,
        oninput: () => {
          values.set(one.name, Number(Number(input.value).toFixed(3)));
          output.textContent = short(Number(input.value));
        },
      });
      input.value = String(one.default);
      return make("label", { class: "slider" }, make("span", {}, one.name), input, output);
    });
    const text = () => [command.name, ...[...values].map(([name, value]) => `${name}=${value}`)].join(" ");
    return make(
      "div",
      { class: "command-form" },
      ...fields,
      make("button", { onclick: () => send(text()) }, `Command: ${command.name}`),
    );
  }

  return { send, form };
}
