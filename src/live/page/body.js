// Draws characters and props: their outlines in their tones, edges, contact shadows, and the
// ghosts of poses that are past. Frame + hello → canvas.

import { colour, mix, tone, clear } from "./look.js";
import { reach } from "./camera.js";

/** Outlines and lines as paths, in layers from back to front, once a hello. */
export function pathsOf(hello) {
  return hello.characters.map((character) => {
    const layers = [];
    character.figure.forEach((part, k) => {
      const number = part.layer ?? k;
      if (layers[layers.length - 1]?.number !== number) layers.push({ number, parts: [] });
      layers[layers.length - 1].parts.push({
        ...part,
        path: outline(part.outline),
        lines: strokes(part.lines ?? []),
      });
    });
    return layers;
  });
}

function strokes(lines) {
  const path = new Path2D();
  for (const line of lines) line.forEach(([x, y], k) => (k === 0 ? path.moveTo(x, y) : path.lineTo(x, y)));
  return path;
}

function outline(points) {
  const path = new Path2D();
  points.forEach(([x, y], k) => (k === 0 ? path.moveTo(x, y) : path.lineTo(x, y)));
  path.closePath();
  return path;
}

/** Sets the canvas to the frame of a body at (x, y) turned by `angle`. */
function into(ctx, view, x, y, angle) {
  const { camera, ratio } = view;
  const s = camera.scale * ratio;
  const [px, py] = camera.toScreen(x, y);
  const c = Math.cos(angle) * s;
  const n = Math.sin(angle) * s;
  ctx.setTransform(c, -n, -n, -c, px * ratio, py * ratio);
}

/** Parts of a layer have one edge around them all: edges first, then what is within. */
export function figure(ctx, view, layers, poses, place, lit) {
  const thin = 1 / view.camera.scale;
  const to = ({ link }) => into(ctx, view, poses[3 * link], poses[3 * link + 1], poses[3 * link + 2]);
  ctx.lineJoin = ctx.lineCap = "round";
  for (const { parts } of layers) {
    ctx.lineWidth = 2.6 * thin;
    for (const part of parts) {
      to(part);
      ctx.strokeStyle = tone(part.tone, part.far, place).edge;
      ctx.stroke(part.path);
    }
    ctx.lineWidth = 1.1 * thin;
    for (const part of parts) {
      to(part);
      const { fill, edge } = tone(part.tone, part.far, place);
      ctx.fillStyle = fill;
      ctx.fill(part.path);
      ctx.strokeStyle = edge;
      ctx.stroke(part.lines);
    }
  }
  ctx.strokeStyle = colour("pull");
  ctx.lineWidth = 2.5 * thin;
  for (const part of layers.flatMap((layer) => layer.parts)) {
    if (part.link !== lit) continue;
    to(part);
    ctx.stroke(part.path);
  }
}

/** A past pose in one colour, `age` 0 (now) to 1 (about to vanish). */
export function ghost(ctx, view, layers, poses, age) {
  const sky = colour("sky-low");
  ctx.fillStyle = mix(mix(sky, colour("soft"), 0.26), sky, age);
  for (const { link, path } of layers.flatMap((layer) => layer.parts)) {
    into(ctx, view, poses[3 * link], poses[3 * link + 1], poses[3 * link + 2]);
    ctx.fill(path);
  }
}

/** Soft shadows on the ground, darker where a link is near it. */
export function shadows(ctx, view, character, poses) {
  character.links.forEach((link, i) => {
    const [x, y, angle] = poses.slice(3 * i, 3 * i + 3);
    const [c, n] = [Math.cos(angle), Math.sin(angle)];
    const ends = link.grab.map(([lx, ly]) => [x + c * lx - n * ly, y + n * lx + c * ly]);
    const low = Math.min(ends[0][1], ends[1][1]) - link.radius;
    const half = Math.abs(ends[0][0] - ends[1][0]) / 2 + link.radius;
    shadow(ctx, view, (ends[0][0] + ends[1][0]) / 2, half, low);
  });
}

function shadow(ctx, view, x, half, low) {
  const strength = 0.3 * Math.exp(-Math.max(low, 0) * 3.2);
  if (strength < 0.012) return;
  const { camera, ratio } = view;
  const [px, py] = camera.toScreen(x, 0);
  const wide = half * (1 + Math.max(low, 0) * 0.4) * camera.scale * 1.25;
  const flat = Math.max(3, 0.035 * camera.scale);
  ctx.setTransform(wide * ratio, 0, 0, flat * ratio, px * ratio, (py + flat * 0.35) * ratio);
  const soft = ctx.createRadialGradient(0, 0, 0, 0, 0, 1);
  const dark = colour("shadow");
  soft.addColorStop(0, clear(dark, strength));
  soft.addColorStop(0.55, clear(dark, strength * 0.7));
  soft.addColorStop(1, clear(dark, 0));
  ctx.fillStyle = soft;
  ctx.beginPath();
  ctx.arc(0, 0, 1, 0, 2 * Math.PI);
  ctx.fill();
}

/** A ball has a radius alone; an outline's radius rounds it. */
export function prop(ctx, view, what, x, y, angle, lit) {
  const { outline, radius } = what;
  const far = reach(what);
  shadow(ctx, view, x, far, y - far);
  into(ctx, view, x, y, angle);
  const fill = colour(outline ? "prop" : "ball");
  const edge = lit ? colour("pull") : mix(fill, colour("shadow"), 0.4);
  const line = (lit ? 3 : 1.3) / view.camera.scale;
  ctx.lineJoin = ctx.lineCap = "round";
  ctx.beginPath();
  if (outline) outline.forEach(([a, b], k) => (k === 0 ? ctx.moveTo(a, b) : ctx.lineTo(a, b)));
  else ctx.arc(0, 0, radius, 0, 2 * Math.PI);
  ctx.closePath();
  ctx.fillStyle = fill;
  ctx.strokeStyle = edge;
  ctx.lineWidth = line + (outline ? 2 * radius : 0);
  ctx.fill();
  ctx.stroke();
  if (outline && radius > 0) {
    ctx.strokeStyle = fill;
    ctx.lineWidth = 2 * radius - line;
    ctx.stroke();
    ctx.strokeStyle = edge;
  }
  // A line that shows how it turns.
  ctx.lineWidth = line;
  ctx.beginPath();
  ctx.moveTo(0, 0);
  if (outline) ctx.lineTo(...outline[0]);
  else ctx.lineTo(radius, 0);
  ctx.globalAlpha = 0.45;
  ctx.stroke();
  ctx.globalAlpha = 1;
}
