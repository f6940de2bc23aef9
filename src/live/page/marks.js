// What explains balance, drawn over the character: centre of mass, base of support, centre of
// pressure, capture point, contact forces, reference. Each has a toggle, and a symbol for the legend.

import { colour, mix } from "./look.js";

const METRES_PER_NEWTON = 0.0008;

/** Names of the toggles in the order of the legend, with what they mean. */
export const MARKS = [
  ["com", "Centre of mass"],
  ["support", "Base of support"],
  ["cop", "Centre of pressure"],
  ["capture", "Capture point"],
  ["touch", "Contact forces"],
  ["reference", "Reference of the centre of mass"],
  ["trail", "Trail of past poses"],
  ["metres", "Metres on the ground"],
  ["props", "Names of props"],
];

export function arrow(ctx, x, y, dx, dy, paint, width = 2.5) {
  const length = Math.hypot(dx, dy);
  if (length < 2) return;
  const [ux, uy] = [dx / length, dy / length];
  const head = Math.min(5 + width * 2, length * 0.6);
  ctx.strokeStyle = ctx.fillStyle = paint;
  ctx.lineWidth = width;
  ctx.lineCap = "round";
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(x + dx - ux * head, y + dy - uy * head);
  ctx.stroke();
  ctx.beginPath();
  ctx.moveTo(x + dx, y + dy);
  ctx.lineTo(x + dx - ux * head - uy * head * 0.45, y + dy - uy * head + ux * head * 0.45);
  ctx.lineTo(x + dx - ux * head + uy * head * 0.45, y + dy - uy * head - ux * head * 0.45);
  ctx.closePath();
  ctx.fill();
}

// Symbols at a point of the stage, used there and in the legend.
const symbol = {
  com(ctx, x, y) {
    const r = 8;
    ctx.fillStyle = colour("panel");
    ctx.strokeStyle = colour("com");
    ctx.lineWidth = 2;
    ctx.beginPath();
    ctx.arc(x, y, r, 0, 2 * Math.PI);
    ctx.fill();
    ctx.fillStyle = colour("com");
    for (const from of [0, Math.PI]) {
      ctx.beginPath();
      ctx.moveTo(x, y);
      ctx.arc(x, y, r, from, from + Math.PI / 2);
      ctx.fill();
    }
    ctx.beginPath();
    ctx.arc(x, y, r, 0, 2 * Math.PI);
    ctx.stroke();
  },
  cop(ctx, x, y) {
    ctx.fillStyle = colour("cop");
    ctx.beginPath();
    ctx.moveTo(x, y + 1);
    ctx.lineTo(x - 7, y + 14);
    ctx.lineTo(x + 7, y + 14);
    ctx.closePath();
    ctx.fill();
  },
  capture(ctx, x, y) {
    ctx.strokeStyle = colour("capture");
    ctx.lineWidth = 3;
    ctx.lineCap = "round";
    ctx.beginPath();
    ctx.moveTo(x - 6, y - 6);
    ctx.lineTo(x + 6, y + 6);
    ctx.moveTo(x - 6, y + 6);
    ctx.lineTo(x + 6, y - 6);
    ctx.stroke();
  },
  support(ctx, x, y, wide = 11) {
    ctx.strokeStyle = colour("support");
    ctx.lineWidth = 5;
    ctx.lineCap = "round";
    ctx.beginPath();
    ctx.moveTo(x - wide, y);
    ctx.lineTo(x + wide, y);
    ctx.stroke();
  },
  reference(ctx, x, y) {
    ctx.strokeStyle = colour("reference");
    ctx.lineWidth = 2.5;
    ctx.beginPath();
    ctx.arc(x, y, 5.5, 0, 2 * Math.PI);
    ctx.moveTo(x, y - 11);
    ctx.lineTo(x, y + 11);
    ctx.stroke();
  },
  touch: (ctx, x, y) => arrow(ctx, x, y + 8, 0, -17, colour("touch")),
  trail(ctx, x, y) {
    for (const [k, share] of [0.15, 0.3, 0.5].entries()) {
      ctx.fillStyle = mix(colour("panel"), colour("soft"), share);
      ctx.fillRect(x - 9 + 7 * k, y - 8, 5, 16);
    }
  },
  metres(ctx, x, y) {
    ctx.strokeStyle = colour("ground-text");
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    ctx.moveTo(x - 11, y);
    ctx.lineTo(x + 11, y);
    for (const at of [-8, 0, 8]) {
      ctx.moveTo(x + at, y);
      ctx.lineTo(x + at, y + 6);
    }
    ctx.stroke();
  },
  props(ctx, x, y) {
    ctx.fillStyle = colour("prop");
    ctx.fillRect(x - 7, y - 7, 14, 14);
  },
};

/** The symbol of a toggle in the middle of a small canvas. */
export function sample(canvas, name) {
  const ratio = Math.max(devicePixelRatio, 1);
  canvas.width = 26 * ratio;
  canvas.height = 20 * ratio;
  const ctx = canvas.getContext("2d");
  ctx.scale(ratio, ratio);
  symbol[name](ctx, 13, name === "cop" ? 3 : 10);
}

function dashed(ctx, x, y, to, paint) {
  ctx.strokeStyle = paint;
  ctx.lineWidth = 1.5;
  ctx.setLineDash([3, 5]);
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(x, to);
  ctx.stroke();
  ctx.setLineDash([]);
}

/** Where centre of mass and reference have been in the last second or so. */
export function ways(ctx, view, path, on) {
  const { camera, ratio } = view;
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.lineWidth = 1.5;
  ctx.lineJoin = "round";
  const way = (name, place) => {
    ctx.strokeStyle = colour(name);
    ctx.globalAlpha = 0.6;
    ctx.beginPath();
    let pen = false;
    for (const old of path) {
      const at = place(old);
      if (at) ctx[pen ? "lineTo" : "moveTo"](...camera.toScreen(...at));
      pen = at !== null;
    }
    ctx.stroke();
    ctx.globalAlpha = 1;
  };
  if (on.com) way("com", (old) => old.com);
  if (on.reference)
    way("reference", (old) => (old.reference === null ? null : [old.reference, old.com[1]]));
}

/** A symbol on the stage: smaller where the character is small. */
function put(ctx, view, name, x, y, ...more) {
  const size = Math.min(1, Math.max(0.5, view.camera.scale / 130));
  ctx.save();
  ctx.translate(x, y);
  ctx.scale(size, size);
  symbol[name](ctx, 0, 0, ...more.map((v) => v / size));
  ctx.restore();
}

/** Marks of one character of a frame; `on` tells which toggles are set. */
export function marks(ctx, view, one, on) {
  const { camera, ratio } = view;
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  const ground = one.ground ?? 0;
  const low = camera.toScreen(0, ground)[1];
  const [cx, cy] = camera.toScreen(...one.com);
  if (on.support && one.support) {
    const [rear, front] = one.support.map((x) => camera.toScreen(x, ground)[0]);
    put(ctx, view, "support", (rear + front) / 2, low + 2, Math.max((front - rear) / 2, 1));
  }
  if (on.reference && one.reference !== null) {
    const [x] = camera.toScreen(one.reference, 0);
    dashed(ctx, x, cy, low, colour("reference"));
    put(ctx, view, "reference", x, cy);
  }
  if (on.com) {
    dashed(ctx, cx, cy, low, colour("com"));
    arrow(ctx, cx, cy, one.v[0] * camera.scale * 0.25, -one.v[1] * camera.scale * 0.25, colour("com"));
    put(ctx, view, "com", cx, cy);
  }
  if (on.touch) {
    const size = METRES_PER_NEWTON * camera.scale;
    for (const [x, y, fx, fy] of one.touch) {
      arrow(ctx, ...camera.toScreen(x, y), fx * size, -fy * size, colour("touch"));
    }
  }
  if (on.cop && one.cop !== null) put(ctx, view, "cop", camera.toScreen(one.cop, 0)[0], low + 3);
  if (on.capture && Number.isFinite(one.capture))
    put(ctx, view, "capture", camera.toScreen(one.capture, 0)[0], low);
}
