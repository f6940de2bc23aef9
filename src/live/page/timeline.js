// The timeline: the active controllers as coloured bands, what happened as marks above them. Click or
// drag seeks, the wheel or two fingers zoom; then buttons show all again or follow the newest step.
// Events + frame → canvas, `seek`.

import { byId, mark, seldom, show } from "./dom.js";
import { colour, band, clear } from "./look.js";
import { bandsOf, symbolOf } from "./bands.js";
import { makeSpan } from "./span.js";
import { eventText } from "./words.js";

const MARKS_HIGH = 20;
const AXIS_HIGH = 15;
const EACH = 16; // px more for each further character
const HIGH = 56;

export function makeTimeline(state) {
  const canvas = byId("timeline");
  const tip = byId("tip");
  const ctx = canvas.getContext("2d");
  let size = [100, 56];
  let ratio = 1;
  let held = null; // step under the finger while it seeks
  let hover = null; // px
  const fingers = new Map(); // id → px
  let bands = [];
  let drawn = "";

  const dt = () => state.hello?.dt ?? 0.001;
  const end = () => state.frame?.end ?? 0;
  const first = () => state.frame?.first ?? 0;

  const span = makeSpan(
    () => ({ first: first(), end: end(), dt: dt() }),
    () => size[0],
  );
  const { toX, toStep, bounded } = span;

  new ResizeObserver(() => {
    ratio = Math.max(devicePixelRatio, 1);
    size = [canvas.clientWidth, canvas.clientHeight];
    canvas.width = Math.round(size[0] * ratio);
    canvas.height = Math.round(size[1] * ratio);
    draw();
  }).observe(canvas);

  state.on("hello", (hello) => {
    span.all();
    held = null;
    const more = hello.characters.length - 1;
    canvas.style.height = more > 0 ? `${HIGH + EACH * more}px` : "";
  });
  state.on("events", (events) => {
    bands = bandsOf(state.hello, events);
    draw();
  });
  state.on("frame", () => {
    // The playhead moves by less than a pixel in most frames: then nothing is drawn.
    const seen = `${Math.round(toX(state.frame.n) * 2)} ${Math.round(toX(end()) * 2)} ${span.now()} ${first()}`;
    if (seen !== drawn) draw(seen);
  });
  state.on("texts", (frame) => {
    mark(canvas, "aria-valuemax", frame.end);
    mark(canvas, "aria-valuenow", frame.n);
    mark(canvas, "aria-valuetext", `${frame.t.toFixed(2)} s`);
  });

  function draw(seen = "") {
    drawn = seen;
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, ...size);
    if (!state.hello) return;
    axis();
    const each = (size[1] - MARKS_HIGH - AXIS_HIGH) / Math.max(bands.length, 1);
    bands.forEach((row, k) => {
      for (const one of row) bar(one, MARKS_HIGH + each * k, each - (bands.length > 1 ? 1 : 0));
    });
    for (const event of state.events) happening(event);
    head();
    show(byId("timeline-whole"), !span.isAll());
    show(byId("timeline-now"), !span.isAll());
    mark(byId("timeline-now"), "aria-pressed", span.follows());
    if (hover !== null) hint();
  }

  byId("timeline-whole").addEventListener("click", whole);
  byId("timeline-now").addEventListener("click", () => {
    span.follow();
    draw();
  });
  function whole() {
    span.all();
    draw();
  }

  function bar({ from, to, name, place }, top, high) {
    const left = Math.max(toX(from), -2);
    const right = Math.min(toX(to ?? end()), size[0] + 2);
    if (right <= 0 || left >= size[0] || right - left < 0.05) return;
    ctx.fillStyle = band(place);
    ctx.fillRect(left, top, Math.max(right - left, 1), high);
    ctx.fillStyle = colour("panel");
    ctx.fillRect(left, top, 1, high);
    if (high < 12) return;
    ctx.font = "11px system-ui, sans-serif";
    const wide = ctx.measureText(name).width;
    if (right - Math.max(left, 0) < wide + 12) return;
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    ctx.fillStyle = colour("panel");
    ctx.fillText(name, Math.max(left, 0) + 6, top + high / 2 + 0.5);
  }

  function happening(event) {
    const symbol = symbolOf(event);
    const x = toX(event.n);
    if (!symbol || x < -8 || x > size[0] + 8) return;
    ctx.fillStyle = ctx.strokeStyle = colour(symbol.colour);
    ctx.lineWidth = 1;
    ctx.fillRect(x - 0.5, MARKS_HIGH - 4, 1, size[1] - MARKS_HIGH - AXIS_HIGH + 4);
    ctx.lineWidth = 2;
    ctx.beginPath();
    // Whole, also at the ends.
    symbol.draw(ctx, Math.min(Math.max(x, 7), size[0] - 7), 9);
  }

  function axis() {
    const [a, b] = span.now();
    const length = (b - a) * dt();
    const wanted = (length / size[0]) * 70;
    const every =
      [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800, 3600].find(
        (one) => one >= wanted,
      ) ?? 7200;
    ctx.fillStyle = colour("soft");
    ctx.font = "10.5px system-ui, sans-serif";
    ctx.textBaseline = "alphabetic";
    for (let k = Math.ceil((a * dt()) / every); k * every <= b * dt(); k++) {
      const x = toX((k * every) / dt());
      ctx.textAlign = x < 12 ? "left" : x > size[0] - 16 ? "right" : "center";
      ctx.fillText(
        `${Number((k * every).toFixed(3))}${k === 0 ? " s" : ""}`,
        Math.min(Math.max(x, 4), size[0] - 4),
        size[1] - 3.5,
      );
    }
  }

  function head() {
    const last = toX(end());
    const x = toX(held ?? state.frame?.n ?? 0);
    if (state.frame?.past || held !== null) {
      ctx.fillStyle = clear(colour("raised"), 0.55);
      ctx.fillRect(x, 0, Math.max(last - x, 0), size[1] - AXIS_HIGH);
    }
    ctx.fillStyle = colour("text");
    ctx.fillRect(x - 1, 0, 2, size[1] - AXIS_HIGH + 3);
    ctx.beginPath();
    ctx.moveTo(x - 6, 0);
    ctx.lineTo(x + 6, 0);
    ctx.lineTo(x, 8);
    ctx.fill();
  }

  // What is under the pointer, in words.
  function tell(x) {
    let near = null;
    for (const event of state.events) {
      const gap = Math.abs(toX(event.n) - x);
      if (gap > 9 || (event.kind !== "switch" && !symbolOf(event))) continue;
      if (!near || gap < near.gap || (gap === near.gap && event.kind !== "switch")) near = { gap, event };
    }
    const step = toStep(x);
    if (near) return `${near.event.t.toFixed(3)} s: ${eventText(near.event)}`;
    const names = bands
      .map((row) => row.find((one) => one.from <= step && step < (one.to ?? end() + 1))?.name)
      .filter(Boolean);
    return step > end() || names.length === 0 ? null : `${(step * dt()).toFixed(2)} s: ${names.join(", ")}`;
  }

  function hint() {
    const text = hover === null || !state.hello ? null : tell(hover);
    show(tip, text !== null);
    if (text === null) return;
    tip.textContent = text;
    // On the stage, above what can be clicked.
    tip.style.bottom = `${canvas.getBoundingClientRect().bottom - byId("drive").getBoundingClientRect().top + 8}px`;
    const wide = tip.offsetWidth;
    tip.style.left = `${Math.min(Math.max(hover - wide / 2, 0), Math.max(size[0] - wide, 0))}px`;
  }

  const seek = seldom(50, (step) => state.send({ do: "seek", step }));

  const place = (event) => event.clientX - canvas.getBoundingClientRect().left;

  function pinch(id) {
    const [other] = [...fingers].filter(([one]) => one !== id).map(([, x]) => x);
    const [before, now] = [fingers.get(id), hover];
    fingers.set(id, now);
    const factor = Math.abs(before - other) / Math.max(Math.abs(now - other), 4);
    span.zoom((before + other) / 2, factor, (now + other) / 2);
    draw();
  }

  function track(event) {
    hover = place(event);
    if (fingers.size === 2 && fingers.has(event.pointerId)) {
      pinch(event.pointerId);
      return;
    }
    if (held !== null) {
      held = bounded(toStep(hover));
      seek(held);
      draw();
    }
    hint();
  }
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !state.frame) return;
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, place(event));
    held = fingers.size === 1 ? 0 : null;
    track(event);
  });
  canvas.addEventListener("pointermove", track);
  for (const kind of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(kind, (event) => {
      held = null;
      fingers.delete(event.pointerId);
      if (event.pointerType === "touch") hover = null;
      hint();
    });
  }
  canvas.addEventListener("pointerleave", () => {
    hover = null;
    hint();
  });
  canvas.addEventListener("dblclick", whole);
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      span.zoom(place(event), Math.exp(event.deltaY * 0.0015));
      draw();
    },
    { passive: false },
  );
  canvas.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: -100, ArrowRight: 100, PageDown: -1000, PageUp: 1000 }[event.key];
    const to =
      event.key === "Home" ? first() : event.key === "End" ? end() : by ? state.frame.n + by : null;
    if (to === null || !state.frame) return;
    event.preventDefault();
    event.stopPropagation();
    seek(bounded(to));
  });

  return {
    draw: () => draw(),
    /** The steps that it shows. */
    visible: () => span.now().map(bounded),
    toX: (step) => canvas.getBoundingClientRect().left + toX(step),
  };
}
