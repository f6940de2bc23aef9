// The pointer on the stage: five tools, one finger or the mouse. Drag pulls with a spring, push and
// throw are drawn as arrows. Pointer events → messages, and a drawing on top of the stage.
// Two fingers, shift and the wheel belong to gestures.js.

import { byId, mark, say, seldom, show } from "./dom.js";
import { bodyAt, pointOf } from "./hit.js";
import { IMPULSE_PER_METRE, drawSpring, drawPush, drawThrow } from "./arrows.js";

const SPEED_PER_METRE = 6; // m/s
const SECOND_FINGER = 90; // ms that a touch waits for a second finger before it pulls
const SMALLEST_PUSH = 1; // N·s
const MOST_PUSH = 1000; // N·s
const MOST_SPEED = 50; // m/s each way
const HINTS = {
  drag: "Press on a limb or a thing and pull: it follows by a spring.",
  push: "Press on a limb and draw an arrow: longer is harder.",
  ball: "Press anywhere and draw an arrow: longer flies faster.",
  crate: "Press in the air to drop one; draw an arrow to throw it.",
  pan: "Press anywhere and pull to move the view.",
};
const SIZES = { ball: "0.12", crate: "0.2" };

export function makePointer(state, stage, camera) {
  const { canvas } = stage;
  const pointer = { tool: "drag", choose, begin, move, end, cancel, busy: () => held !== null };
  let held = null;

  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const world = (event) => camera.toWorld(...at(event));
  const slop = (event) => (event.pointerType === "touch" ? 26 : 10) / camera.scale;
  const find = (event) => bodyAt(state, ...world(event), slop(event));

  const buttons = [...document.querySelectorAll("#tools [data-tool]")];
  for (const button of buttons) button.addEventListener("click", () => choose(button.dataset.tool));

  function choose(tool) {
    cancel();
    pointer.tool = tool;
    for (const button of buttons) mark(button, "aria-pressed", button.dataset.tool === tool);
    const throws = tool in SIZES;
    show(byId("tool-options"), throws || tool === "push");
    show(byId("throw-options"), throws);
    show(byId("push-options"), tool === "push");
    say(byId("tool-hint"), HINTS[tool]);
    cover();
    if (throws) {
      byId("throw-size").value = SIZES[tool];
      byId("throw-size-name").textContent = tool === "ball" ? "radius, m" : "half side, m";
    }
    canvas.style.cursor = tool === "pan" ? "grab" : tool === "drag" ? "default" : "crosshair";
    light(null);
  }

  /** What the options and the hint cover is no place for a head. */
  function cover() {
    const high = byId("stage").clientHeight;
    const below = [byId("tool-options"), byId("tool-hint")]
      .filter((one) => one.offsetHeight > 0 && one.offsetTop < high / 2)
      .map((one) => one.offsetTop + one.offsetHeight);
    camera.cover(Math.max(0, ...below) + 14);
  }
  new ResizeObserver(cover).observe(canvas);

  function light(found) {
    const old = stage.lit;
    if (old?.prop === found?.prop && old?.link === found?.link && old?.character === found?.character)
      return;
    stage.lit = found;
    stage.touch();
    if (pointer.tool === "drag") canvas.style.cursor = found ? "grab" : "default";
  }

  /** True if the tool has taken it; otherwise it moves the view. */
  function begin(event) {
    const { tool } = pointer;
    if (tool === "pan" || !state.frame) return false;
    const from = world(event);
    const found = find(event);
    if (found?.character !== undefined) state.choose(found.character);
    if (tool === "drag") {
      if (!found) return false;
      const wait = event.pointerType === "touch" ? SECOND_FINGER : 0;
      held = { tool, found, to: from, since: performance.now() + wait };
      setTimeout(pull, wait);
    } else if (tool === "push") {
      if (found?.character === undefined) return false;
      held = { tool, found, from, to: from };
    } else {
      // Not in the ground.
      held = { tool, from: [from[0], Math.max(from[1], wares().size)], to: from };
    }
    light(held.found ?? null);
    stage.touch();
    return true;
  }

  const pull = seldom(30, () => {
    if (held?.tool !== "drag" || performance.now() < held.since) return;
    const { found, to } = held;
    held.sent = true;
    const whose =
      found.prop === undefined ? { character: found.character, link: found.name } : { prop: found.prop };
    state.send({ do: "drag", ...whose, point: rounded(found.point), to: rounded(to) });
  });

  function move(event) {
    if (!held) {
      if (event.pointerType !== "touch")
        light(pointer.tool === "drag" || pointer.tool === "push" ? seen(find(event)) : null);
      return;
    }
    held.to = world(event);
    if (held.tool === "drag") pull();
    stage.touch();
  }

  const seen = (found) => (found && pointer.tool === "push" && found.prop !== undefined ? null : found);

  function end() {
    const done = held;
    held = null;
    stage.touch();
    light(null);
    if (!done) return;
    if (done.tool === "drag") {
      if (done.sent) state.send({ do: "release" });
    } else if (done.tool === "push") {
      const impulse = impulseOf(done);
      if (Math.hypot(...impulse) < SMALLEST_PUSH) return;
      state.send({ do: "push", character: done.found.character, link: done.found.name, impulse });
    } else {
      state.send({
        do: "throw",
        shape: done.tool,
        ...wares(),
        position: rounded(done.from),
        velocity: velocityOf(done),
      });
    }
  }

  /** Gives up what is being drawn; a drag is let go. */
  function cancel() {
    if (held?.tool === "drag" && held.sent) state.send({ do: "release" });
    held = null;
    light(null);
    stage.touch();
  }

  function wares() {
    const number = (id, least, most) => Math.min(most, Math.max(least, Number(byId(id).value) || least));
    return { mass: number("throw-mass", 0.1, 200), size: number("throw-size", 0.03, 1) };
  }

  function impulseOf({ from, to }) {
    const bound = (v) => Math.min(MOST_PUSH, Math.max(-MOST_PUSH, v));
    return from.map((v, k) => Math.round(bound((to[k] - v) * IMPULSE_PER_METRE) * 10) / 10);
  }

  const velocityOf = ({ from, to }) =>
    rounded(
      from.map((v, k) => {
        const moved = to[k] - v;
        return Math.abs(moved) * camera.scale < 4
          ? 0
          : Math.min(MOST_SPEED, Math.max(-MOST_SPEED, moved * SPEED_PER_METRE));
      }),
    );

  stage.overlay((ctx) => {
    if (held?.tool === "push") {
      const from = pointOf(state, held.found) ?? held.from;
      drawPush(ctx, camera, from, impulseOf(held), held.found.name);
    } else if (held && held.tool !== "drag") {
      drawThrow(ctx, camera, held.tool, wares(), held.from, held.to, velocityOf(held), gravity());
    }
    const drag = state.frame?.drag;
    if (held?.tool === "drag") {
      const now = pointOf(state, held.found) ?? held.to;
      drawSpring(ctx, camera, now, held.to, drag?.force ?? [0, 0]);
    } else if (drag) {
      drawSpring(ctx, camera, drag.at, drag.to, drag.force);
    }
  });

  function gravity() {
    return state.hello.scenario.parameters.find((one) => one.name === "gravity")?.value ?? 9.81;
  }

  state.on("hello", () => {
    held = null;
    stage.lit = null;
  });
  state.on("connected", (connected) => {
    if (!connected) held = null;
  });
  canvas.addEventListener("pointerleave", () => {
    if (!held) light(null);
  });
  choose("drag");
  return pointer;
}

const rounded = (values) => values.map((v) => Math.round(v * 1000) / 1000);
