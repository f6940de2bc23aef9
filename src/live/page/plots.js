// Three plots that scroll with the run: balance along the ground, a joint's torque within its limit,
// any feature by name (message `watch`). Frames in → uPlot, drawn ten times a second while in view.

import { byId, make, plain } from "./dom.js";
import { colour, clear } from "./look.js";
import { Trace } from "./trace.js";
import { unwrap } from "./words.js";

const SPAN = 8; // s that a plot shows
const EVERY = 100; // ms
const MOST = 4; // features
const PAINTS = ["accent", "com", "support", "capture"];
// Columns of the trace.
const FEATURES = 6;
const TORQUES = FEATURES + MOST;

export function makePlots(state, tabs) {
  const trace = new Trace(SPAN + 1);
  const joint = byId("joint");
  const feature = byId("feature");
  let plots = [];
  let wantedJoint = "";
  let watched = "";
  let stale = true;
  let drawnAt = 0;

  const jointPlace = () =>
    Math.max(0, state.body()?.joints.findIndex((one) => one.name === joint.value) ?? 0);
  const known = () => (state.hello?.features ?? []).map(unwrap);

  state.on("hello", (hello) => {
    trace.clear();
    byId("features").replaceChildren(
      ...known().map((one) => make("option", { value: one.name }, one.meaning ?? "")),
    );
    fill();
    watched = "";
    watch();
    stale = true;
  });
  state.on("character", () => {
    trace.clear();
    fill();
  });
  state.on("connected", () => {
    watched = "";
    watch();
  });
  state.on("frame", (frame) => {
    const one = frame.c[state.character];
    trace.add(frame.t, [
      one.com[0],
      one.cop,
      one.capture,
      one.support?.[0] ?? null,
      one.support?.[1] ?? null,
      one.reference,
      ...PAINTS.map((_, k) => frame.watch?.[k] ?? null),
      ...one.torque,
    ]);
  });
  state.on("texts", () => {
    if (byId("panel-plots").hidden || performance.now() - drawnAt < EVERY) return;
    drawnAt = performance.now();
    draw();
  });

  function fill() {
    const names = state.body().joints.map((one) => one.name);
    joint.replaceChildren(
      ...names.map((name) => make("option", { value: name }, name.replaceAll("_", " "))),
    );
    joint.value = names.includes(wantedJoint)
      ? wantedJoint
      : (names.find((name) => /knee|ankle/.test(name)) ?? names[0] ?? "");
  }
  joint.addEventListener("change", () => {
    wantedJoint = joint.value;
    stale = true;
    draw();
  });
  feature.addEventListener("change", watch);
  feature.addEventListener("input", watch);

  /** Asks for the features that the session knows by these names. */
  function watch() {
    const words = feature.value.split(/[\s,]+/).filter(Boolean);
    const names = words.filter((word) => known().some((one) => one.name === word)).slice(0, MOST);
    feature.setAttribute("aria-invalid", String(names.length < words.length));
    if (names.length === 0 || names.join() === watched || !state.connected) return;
    watched = names.join();
    PAINTS.forEach((_, k) => trace.forget(FEATURES + k));
    byId("feature-key").replaceChildren(
      ...names.map((name, k) => make("span", { data: { colour: PAINTS[k] } }, name)),
    );
    stale = true;
    state.send({ do: "watch", features: names });
  }

  const line = (label, name, more = {}) => ({
    label,
    stroke: colour(name),
    width: 1.8,
    spanGaps: false,
    points: { show: false },
    ...more,
  });

  function plot(id, series, options = {}) {
    const box = byId(id);
    const axis = {
      stroke: colour("soft"),
      grid: { stroke: clear(colour("soft"), 0.18), width: 1 },
      ticks: { show: false },
      font: "11px system-ui, sans-serif",
    };
    return new window.uPlot(
      {
        width: Math.max(box.clientWidth, 120),
        height: Math.max(box.clientHeight, 80),
        cursor: { drag: { x: false, y: false }, points: { size: 6 } },
        legend: { show: false },
        padding: [8, 10, 0, 0],
        scales: {
          x: { time: false, range: () => [trace.now - SPAN, Math.max(trace.now, trace.now - SPAN + 1)] },
          y: options.y ?? {},
        },
        axes: [
          { ...axis, size: 26, space: 60, values: (_, ticks) => ticks.map((v) => (v < 0 ? "" : `${v} s`)) },
          { ...axis, size: 46, space: 26, values: (_, ticks) => ticks.map(plain) },
        ],
        series: [{ label: "t", value: (_, v) => (v === null ? "–" : `${v.toFixed(2)} s`) }, ...series],
        bands: options.bands,
      },
      null,
      box,
    );
  }

  function build() {
    for (const one of plots) one.destroy();
    plots = [];
    stale = false;
    if (!window.uPlot || !state.hello) return;
    const [least, greatest] = state.body().joints[jointPlace()]?.torque ?? [-1, 1];
    const edge = { width: 1, dash: [5, 4] };
    plots = [
      plot(
        "plot-balance",
        [
          line("centre of mass", "com"),
          line("centre of pressure", "cop"),
          line("capture point", "capture"),
          line("reference", "reference", { width: 1.2 }),
          line("rear", "support", { width: 1 }),
          line("front", "support", { width: 1 }),
        ],
        { bands: [{ series: [6, 5], fill: clear(colour("support"), 0.14) }] },
      ),
      plot(
        "plot-torque",
        [line("torque, N·m", "accent"), line("limit", "bad", edge), line("", "bad", edge)],
        { y: { range: [1.08 * least, 1.08 * greatest] } },
      ),
      plot(
        "plot-feature",
        watched.split(",").map((name, k) => line(name, PAINTS[k])),
      ),
    ];
  }

  function draw() {
    if (byId("panel-plots").hidden || !state.frame) return;
    if (stale || plots.length === 0) build();
    if (plots.length === 0) return;
    const [least, greatest] = state.body().joints[jointPlace()]?.torque ?? [-1, 1];
    const { t } = trace;
    plots[0].setData([t, ...[0, 1, 2, 5, 3, 4].map((k) => trace.of(k))]);
    plots[1].setData([t, trace.of(TORQUES + jointPlace()), t.map(() => greatest), t.map(() => least)]);
    plots[2].setData([t, ...watched.split(",").map((_, k) => trace.of(FEATURES + k))]);
  }

  tabs.on("plots", () => {
    stale = true;
    draw();
  });
  addEventListener("resize", () => {
    stale = true;
    draw();
  });
  return {
    restyle: () => {
      stale = true;
      draw();
    },
  };
}
