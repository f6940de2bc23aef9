// Play, pause, step, speed, "start here"; the time, the real-time factor, what is active.

import { byId, make, say, mark, show } from "./dom.js";
import { band } from "./look.js";
import { posture } from "./words.js";

const MOST_STEPS = 1000; // that the session does at once
const SPEEDS = [0.05, 0.1, 0.25, 0.5, 1, 2, 4];

export function makeDrive(state) {
  const select = byId("speed");
  const chips = [];
  for (const factor of SPEEDS) select.append(make("option", { value: factor }, `${factor}×`));
  select.value = "1";

  const second = () => Math.round(1 / state.hello.dt); // steps

  const drive = {
    toggle: () => state.send({ do: state.frame?.paused ? "play" : "pause" }),
    pause: () => state.send({ do: "pause" }),
    step: (steps = 1) => state.send({ do: "step", steps }),
    back: (steps = 1) => {
      if (state.frame) drive.seek(Math.max(state.frame.first, state.frame.n - steps));
    },
    backSecond: () => drive.back(second()),
    /** What was run already is shown again; else it is run. */
    onSecond() {
      if (!state.frame) return;
      const { n, end } = state.frame;
      if (n < end) drive.seek(Math.min(n + second(), end));
      else drive.step(Math.min(second(), MOST_STEPS));
    },
    seek: (step) => state.send({ do: "seek", step }),
    reset: () => state.send({ do: "reset" }),
    branch() {
      if (state.frame?.past) state.send({ do: "branch" });
    },
    /** `by` −1 slower, 1 faster. */
    faster(by) {
      const now = state.frame?.speed ?? 1;
      const next =
        by > 0 ? SPEEDS.find((one) => one > now + 1e-6) : SPEEDS.findLast((one) => one < now - 1e-6);
      if (next !== undefined) state.send({ do: "speed", factor: next });
    },
  };

  byId("play").addEventListener("click", drive.toggle);
  byId("back").addEventListener("click", () => drive.back());
  byId("back-second").addEventListener("click", drive.backSecond);
  byId("on-second").addEventListener("click", drive.onSecond);
  byId("step").addEventListener("click", () => drive.step());
  byId("reset").addEventListener("click", drive.reset);
  byId("start-here").addEventListener("click", drive.branch);
  select.addEventListener("change", () => state.send({ do: "speed", factor: Number(select.value) }));

  state.on("hello", (hello) => {
    const names = hello.characters.map((one) => one.name).join(" and ");
    say(byId("scene-name"), `${hello.scenario.name} · ${names}`);
    mark(byId("scene-name"), "title", `${hello.scenario.name} · ${names}`);
    document.title = `${hello.scenario.name} – Aplomb`;
    chips.length = 0;
    byId("now").replaceChildren(
      ...hello.characters.map((_, k) => {
        const dot = make("i", { class: "dot" });
        const text = make("b", {});
        const chip = make("span", { data: { character: k } }, dot, text);
        chips.push({ chip, dot, text });
        if (hello.characters.length > 1) {
          mark(chip, "title", "Panels and keys are about this one");
          chip.addEventListener("click", () => state.choose(k));
        }
        return chip;
      }),
    );
    chosen();
  });
  state.on("character", chosen);

  /** Which of several characters the panels are about. */
  function chosen() {
    chips.forEach(({ chip }, k) => mark(chip, "data-chosen", chips.length > 1 && k === state.character));
  }

  /** "balance · standing"; with the character's number if there are several. */
  function doing(one, k) {
    const name = state.hello.characters[k].controllers[one.active]?.name ?? "nobody";
    return `${chips.length > 1 ? `${k + 1}: ` : ""}${name} · ${posture(one.posture)}`;
  }

  state.on("texts", (frame) => {
    mark(byId("play"), "data-paused", frame.paused);
    mark(byId("play"), "aria-label", frame.paused ? "Play" : "Pause");
    mark(byId("play-icon"), "href", frame.paused ? "#i-play" : "#i-pause");
    say(byId("time"), `${frame.t.toFixed(frame.paused ? 3 : 2)} s`);
    say(byId("step-number"), frame.past ? `step ${frame.n} of ${frame.end}` : `step ${frame.n}`);
    byId("start-here").disabled = !frame.past;
    byId("back").disabled = byId("back-second").disabled = frame.n <= frame.first;
    if (document.activeElement !== select) speed(frame.speed);
    show(byId("rate-label"), !frame.paused);
    say(byId("rate"), frame.paused ? "paused" : `${frame.rtf.toFixed(2)}×`);
    say(byId("dropped"), `${frame.dropped} dropped`);
    mark(byId("dropped"), "data-some", frame.dropped > 0);
    frame.c.forEach((one, k) => {
      const colour = band(one.active);
      if (chips[k].dot.dataset.colour !== colour)
        chips[k].dot.style.background = chips[k].dot.dataset.colour = colour;
      say(chips[k].text, doing(one, k));
    });
    mark(byId("stage"), "aria-label", `The scene from the side. ${frame.c.map(doing).join("; ")}`);
  });

  function speed(factor) {
    const text = String(factor);
    if (select.value === text) return;
    if (![...select.options].some((one) => one.value === text))
      select.append(make("option", { value: text }, `${text}×`));
    select.value = text;
  }

  state.on("connected", (connected) => {
    say(byId("banner"), connected ? "" : "Connection lost, trying again …");
    show(byId("banner"), !connected);
    document.body.dataset.connected = connected;
  });
  return drive;
}
