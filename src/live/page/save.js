// What can be taken away: recording, table, scenario, picture, animation. The server answers
// /save/NAME; a worker answers the message `save` with `saved`.

import { byId, make, mark, say, show } from "./dom.js";

// The server draws no longer animation.
const LONGEST_FILM = 60; // s
const PATIENCE = 120000; // ms for a worker's answer: it does the whole run again

// id, name of the save (null: made here), label, whether it needs the server
const ALL = [
  ["recording", "session.trajectory", "Recording"],
  ["csv", "session.csv", "Table (CSV)"],
  ["scenario", "session.ron", "Scenario"],
];
const PART = [
  ["gif", "session.gif", "Animation (GIF)"],
  ["mp4", "session.mp4", "Film (MP4)"],
  ["svg", "session.svg", "Film strip (SVG)"],
];

export function makeSave(state, stage, timeline, connection, told) {
  const waiting = new Map(); // name → what to do with the bytes

  state.on("saved", (message) => {
    const act = waiting.get(message.name);
    waiting.delete(message.name);
    act?.(message);
  });

  /** The bytes of a save, from wherever the session is. */
  async function bytes(name, stretch = null) {
    if (!connection().worker) {
      const address = new URL(`save/${name}`, location.href.split("#")[0]);
      if (stretch) address.search = new URLSearchParams({ from: stretch[0], to: stretch[1] });
      const answer = await fetch(address);
      if (!answer.ok)
        throw new Error((await answer.text()).slice(0, 300) || `${name}: the server says ${answer.status}`);
      return new Uint8Array(await answer.arrayBuffer());
    }
    return new Promise((good, bad) => {
      const timer = setTimeout(() => bad(new Error(`${name}: no answer`)), PATIENCE);
      waiting.set(name, ({ bytes, error }) => {
        clearTimeout(timer);
        if (error) bad(new Error(error));
        else good(typeof bytes === "string" ? new TextEncoder().encode(bytes) : new Uint8Array(bytes));
      });
      state.send({ do: "save", name });
    });
  }

  function hand(name, blob) {
    const address = URL.createObjectURL(blob);
    make("a", { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
  }

  /** What is drawn for long says so, and for how long already, until it is done or refused. */
  async function save(name, stretch) {
    const begun = performance.now();
    const seconds = () => Math.round((performance.now() - begun) / 1000);
    const done = stretch ? told.lasting(() => `Drawing ${name} … ${seconds()} s`, name) : () => {};
    try {
      hand(name, new Blob([await bytes(name, stretch ? timeline.visible() : null)]));
      done();
      if (stretch) told.note(true, `${name} is ready.`, name);
    } catch (error) {
      done();
      told.note(false, error.message, name);
    }
  }

  function picture() {
    stage.draw();
    stage.canvas.toBlob((blob) => {
      if (blob) hand("aplomb.png", blob);
    }, "image/png");
  }

  // A film of the stage as it is seen, made by the browser.
  let recorder = null;
  function film() {
    if (recorder) {
      recorder.stop();
      return;
    }
    const parts = [];
    recorder = new MediaRecorder(stage.canvas.captureStream(30), { mimeType: "video/webm" });
    recorder.ondataavailable = (event) => parts.push(event.data);
    recorder.onstop = () => {
      recorder = null;
      byId("save-webm").textContent = "Film (WebM)";
      hand("aplomb.webm", new Blob(parts, { type: "video/webm" }));
    };
    recorder.start();
    byId("save-webm").textContent = "Stop the film";
  }

  const button = (id, label, act) => make("button", { id: `save-${id}`, onclick: act }, label);
  byId("save-all").append(
    ...ALL.map(([id, name, label]) => button(id, label, () => save(name, false))),
    button("png", "Picture (PNG)", picture),
  );
  byId("save-part").append(...PART.map(([id, name, label]) => button(id, label, () => save(name, true))));
  if (typeof MediaRecorder === "function" && MediaRecorder.isTypeSupported("video/webm"))
    byId("save-part").append(button("webm", "Film (WebM)", film));

  state.on("hello", (hello) => {
    for (const [id] of PART) show(byId(`save-${id}`), hello.native);
    if (byId("save-webm")) show(byId("save-webm"), !hello.native);
    byId("save-part-title").textContent = hello.native ? "What the timeline shows" : "A film";
  });
  state.on("texts", () => {
    if (byId("panel-save").hidden) return;
    const [from, to] = timeline.visible().map((step) => step * state.hello.dt);
    const long = to - from > LONGEST_FILM ? `; these are ${(to - from).toFixed(0)} s` : "";
    const text = state.hello.native
      ? `From ${from.toFixed(2)} s to ${to.toFixed(2)} s. Zoom the timeline, with the wheel or two fingers, ` +
        `to choose. Animation and film: at most ${LONGEST_FILM} s${long}.`
      : "The film shows the stage from when you start it until you stop it.";
    say(byId("save-stretch"), text);
    mark(byId("save-stretch"), "data-long", state.hello.native && long !== "");
  });

  return { bytes };
}
