// What the pointer tools draw on the stage: the spring of a drag with its force, the arrow of a push
// in N·s, the path of what is thrown. All in CSS pixels.

import { colour, clear } from "./look.js";
import { arrow } from "./marks.js";

/** What a metre of arrow pushes with, N·s. */
export const IMPULSE_PER_METRE = 120;

// How long the arrow of a drag's force is, px, and px a newton.
const SHORTEST_FORCE = 34;
const LONGEST_FORCE = 130;
const FORCE_PX = 0.12;

/** A label that stays on the stage, beside or above a point so that a finger doesn't cover it. */
function label(ctx, camera, x, y, text, paint) {
  ctx.font = "600 14px system-ui, sans-serif";
  const wide = ctx.measureText(text).width + 18;
  const left = Math.min(Math.max(x - wide / 2, 6), camera.width - wide - 6);
  const top = Math.min(Math.max(y - 46, 66), camera.height - 34);
  ctx.fillStyle = colour("panel");
  ctx.strokeStyle = paint;
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  ctx.roundRect(left, top, wide, 27, 8);
  ctx.fill();
  ctx.stroke();
  ctx.fillStyle = colour("text");
  ctx.textAlign = "left";
  ctx.textBaseline = "middle";
  ctx.fillText(text, left + 9, top + 14);
}

export function drawSpring(ctx, camera, from, to, force) {
  const [x, y] = camera.toScreen(...from);
  const [tx, ty] = camera.toScreen(...to);
  const paint = colour("pull");
  const length = Math.hypot(tx - x, ty - y);
  ctx.strokeStyle = paint;
  ctx.lineWidth = 2;
  ctx.lineJoin = "round";
  ctx.beginPath();
  ctx.moveTo(x, y);
  if (length > 24) {
    const [ux, uy] = [(tx - x) / length, (ty - y) / length];
    const turns = 14;
    for (let k = 1; k < turns; k++) {
      const along = 6 + (length - 12) * (k / turns);
      const aside = k % 2 === 0 ? 5 : -5;
      ctx.lineTo(x + ux * along - uy * aside, y + uy * along + ux * aside);
    }
  }
  ctx.lineTo(tx, ty);
  ctx.stroke();
  ctx.fillStyle = paint;
  for (const [px, py, r] of [
    [x, y, 4],
    [tx, ty, 6],
  ]) {
    ctx.beginPath();
    ctx.arc(px, py, r, 0, 2 * Math.PI);
    ctx.fill();
  }
  // The force as an arrow of its own, long enough for its direction; its number beside it, not on it.
  const size = Math.hypot(...force);
  const [ux, uy] = size >= 1 ? [force[0] / size, -force[1] / size] : [0, 0];
  const long = Math.min(SHORTEST_FORCE + size * FORCE_PX, LONGEST_FORCE);
  for (const [tone, width] of [
    [colour("panel"), 8],
    [paint, 5],
  ])
    arrow(ctx, x, y, ux * long, uy * long, tone, width);
  const side = ux < 0 ? -1 : 1;
  label(ctx, camera, tx + side * uy * 62, ty + 30 - side * ux * 40, `${Math.round(size)} N`, paint);
}

export function drawPush(ctx, camera, from, impulse, link) {
  const [x, y] = camera.toScreen(...from);
  const per = camera.scale / IMPULSE_PER_METRE;
  const [dx, dy] = [impulse[0] * per, -impulse[1] * per];
  const paint = colour("com");
  ctx.fillStyle = paint;
  ctx.beginPath();
  ctx.arc(x, y, 4, 0, 2 * Math.PI);
  ctx.fill();
  arrow(ctx, x, y, dx, dy, paint, 5);
  label(ctx, camera, x + dx, y + dy, `${link} ${Math.round(Math.hypot(...impulse))} N·s`, paint);
}

/** The thing, its velocity as an arrow and the path it would take as dots. */
export function drawThrow(ctx, camera, shape, { mass, size }, from, to, velocity, gravity) {
  const [x, y] = camera.toScreen(...from);
  const paint = colour(shape === "ball" ? "ball" : "prop");
  const r = size * camera.scale;
  ctx.fillStyle = clear(paint, 0.6);
  ctx.strokeStyle = paint;
  ctx.lineWidth = 2;
  ctx.beginPath();
  if (shape === "ball") ctx.arc(x, y, r, 0, 2 * Math.PI);
  else ctx.rect(x - r, y - r, 2 * r, 2 * r);
  ctx.fill();
  ctx.stroke();
  ctx.fillStyle = colour("soft");
  for (let k = 1; k < 40; k++) {
    const t = 0.05 * k;
    const [wx, wy] = [from[0] + velocity[0] * t, from[1] + velocity[1] * t - (gravity * t * t) / 2];
    if (wy < size) break;
    ctx.beginPath();
    ctx.arc(...camera.toScreen(wx, wy), 2, 0, 2 * Math.PI);
    ctx.fill();
  }
  const [tx, ty] = camera.toScreen(...to);
  arrow(ctx, x, y, tx - x, ty - y, colour("pull"), 3);
  const speed = Math.hypot(...velocity);
  label(
    ctx,
    camera,
    tx,
    ty,
    speed > 0 ? `${mass} kg, ${speed.toFixed(1)} m/s` : `${mass} kg, let go here`,
    paint,
  );
}
