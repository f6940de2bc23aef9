// The stage: a loop that draws the newest frame when something has changed. Sky and ground with
// metres, ghosts, props, characters, marks, and on top what the pointer draws.

import { byId } from "./dom.js";
import { colour, refresh } from "./look.js";
import { boxOf, reach } from "./camera.js";
import { pathsOf, figure, ghost, shadows, prop } from "./body.js";
import { marks, ways } from "./marks.js";

const TRAIL_EVERY = 0.12; // s of the run
const TRAIL_LENGTH = 8;
const PATH_FOR = 1.5; // s

export function makeStage(state, camera, on) {
  const canvas = byId("stage");
  const ctx = canvas.getContext("2d");
  const view = { camera, ratio: 1 };
  const overlays = [];
  let layers = [];
  let trail = [];
  let path = [];
  let stale = true;
  let before = performance.now();

  const stage = {
    canvas,
    /** Asks for a new picture. */
    touch: () => {
      stale = true;
    },
    /** `draw(ctx, view)` comes last, in CSS pixels. */
    overlay: (draw) => overlays.push(draw),
    /** What the pointer is over: `{character, link}`, `{prop}` or null. */
    lit: null,
    draw,
  };

  function resize() {
    view.ratio = Math.min(Math.max(devicePixelRatio, 1), 2.5);
    const { width, height } = canvas.getBoundingClientRect();
    canvas.width = Math.round(width * view.ratio);
    canvas.height = Math.round(height * view.ratio);
    camera.resize(width, height);
    draw();
  }
  new ResizeObserver(resize).observe(canvas);

  state.on("hello", (hello) => {
    layers = pathsOf(hello);
    trail = [];
    path = [];
    camera.jump();
    stale = true;
  });
  state.on("props", stage.touch);
  state.on("connected", stage.touch);
  state.on("frame", (frame) => {
    remember(frame);
    stale = true;
  });

  /** Keeps poses of the last second or so; a seek makes those that are not before it go. */
  function remember(frame) {
    trail = trail.filter((old) => old.t < frame.t && old.t > frame.t - TRAIL_EVERY * (TRAIL_LENGTH + 1));
    path = path.filter((old) => old.t < frame.t && old.t > frame.t - PATH_FOR);
    path.push({ t: frame.t, c: frame.c.map(({ com, reference }) => ({ com, reference })) });
    const last = trail[trail.length - 1];
    if (!last || frame.t - last.t >= TRAIL_EVERY)
      trail.push({ t: frame.t, poses: frame.c.map((one) => one.l) });
    if (trail.length > TRAIL_LENGTH) trail.shift();
  }

  function loop(now) {
    const dt = (now - before) / 1000;
    before = now;
    if (camera.update(dt, boxOf(state))) stale = true;
    // Between a hello and its first frame the old picture stays.
    if (stale && (state.frame || !state.hello)) draw();
    requestAnimationFrame(loop);
  }

  function draw() {
    stale = false;
    ctx.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    world();
    const { hello, frame, props } = state;
    if (!hello || !frame) return;
    if (on.trail) {
      for (const old of trail) {
        const age = Math.min(1, (frame.t - old.t) / (TRAIL_EVERY * (TRAIL_LENGTH + 1)));
        old.poses.forEach((poses, k) => ghost(ctx, view, layers[k], poses, age));
      }
    }
    frame.c.forEach((one, k) => shadows(ctx, view, hello.characters[k], one.l));
    props.forEach((what, k) => {
      const at = frame.p.slice(3 * k, 3 * k + 3);
      if (at.length === 3) prop(ctx, view, what, ...at, stage.lit?.prop === what.name);
    });
    for (let k = frame.c.length - 1; k >= 0; k--) {
      const lit = stage.lit?.character === k ? stage.lit.link : -1;
      figure(ctx, view, layers[k], frame.c[k].l, k, lit);
    }
    frame.c.forEach((one, k) => {
      ways(
        ctx,
        view,
        path.map((old) => old.c[k]),
        on,
      );
      marks(ctx, view, one, on);
    });
    ctx.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    if (on.props) names(frame, props);
    for (const overlay of overlays) overlay(ctx, view);
  }

  function world() {
    const { width, height } = camera;
    const low = camera.toScreen(0, 0)[1];
    const sky = ctx.createLinearGradient(0, 0, 0, Math.max(low, 1));
    sky.addColorStop(0, colour("sky-high"));
    sky.addColorStop(1, colour("sky-low"));
    ctx.fillStyle = sky;
    ctx.fillRect(0, 0, width, height);
    if (low >= height) return;
    const earth = ctx.createLinearGradient(0, low, 0, Math.max(height, low + 1));
    earth.addColorStop(0, colour("ground"));
    earth.addColorStop(1, colour("ground-deep"));
    ctx.fillStyle = earth;
    ctx.fillRect(0, low, width, height - low);
    ctx.fillStyle = colour("ground-edge");
    ctx.fillRect(0, low - 0.5, width, 1.5);
    if (on.metres) metres(low);
  }

  function metres(low) {
    const [left] = camera.toWorld(0, 0);
    const [right] = camera.toWorld(camera.width, 0);
    const wide = right - left;
    const every = wide > 40 ? 10 : wide > 14 ? 2 : wide > 2.5 ? 1 : 0.2;
    ctx.fillStyle = colour("ground-text");
    ctx.font = "11px system-ui, sans-serif";
    ctx.textAlign = "center";
    ctx.textBaseline = "top";
    const part = every / 5;
    for (let k = Math.ceil(left / part); k * part <= right; k++) {
      const [x] = camera.toScreen(k * part, 0);
      const whole = k % 5 === 0;
      ctx.fillRect(x - 0.5, low + 1, 1, whole ? 9 : 4);
      if (whole) {
        const text = every < 1 ? (k * part).toFixed(1) : String(Math.round(k * part));
        ctx.fillText(`${text.replace("-", "−")} m`, x, low + 20);
      }
    }
  }

  function names(frame, props) {
    ctx.fillStyle = colour("soft");
    ctx.font = "12px system-ui, sans-serif";
    ctx.textAlign = "center";
    ctx.textBaseline = "bottom";
    props.forEach((what, k) => {
      if (3 * k + 2 >= frame.p.length) return;
      const high = reach(what);
      const [x, y] = camera.toScreen(frame.p[3 * k], frame.p[3 * k + 1] + high);
      ctx.fillText(what.name, x, y - 3);
    });
  }

  refresh();
  requestAnimationFrame(loop);
  return stage;
}
