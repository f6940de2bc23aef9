// What the timeline draws: bands of the active controllers from the switches, and a symbol a kind of
// event. Events in → per character a list of `{from, to, name, place}` in steps; `to` null is open.

export function bandsOf(hello, events) {
  if (!hello) return [];
  const rows = hello.characters.map(() => []);
  for (const event of events) {
    const row = rows[event.character];
    if (event.kind !== "switch" || !row) continue;
    const last = row[row.length - 1];
    if (last) last.to = event.n;
    const place = hello.characters[event.character].controllers.findIndex((one) => one.name === event.to);
    row.push({ from: event.n, to: null, name: event.to, place: Math.max(place, 0) });
  }
  return rows;
}

const shape = (points) => (ctx, x, y) => {
  points.forEach(([dx, dy], k) => (k === 0 ? ctx.moveTo(x + dx, y + dy) : ctx.lineTo(x + dx, y + dy)));
  ctx.closePath();
  ctx.fill();
};
const cross = (ctx, x, y) => {
  ctx.moveTo(x - 4, y - 4);
  ctx.lineTo(x + 4, y + 4);
  ctx.moveTo(x + 4, y - 4);
  ctx.lineTo(x - 4, y + 4);
  ctx.stroke();
};
const disc = (ctx, x, y) => {
  ctx.arc(x, y, 4.5, 0, 2 * Math.PI);
  ctx.fill();
};
const ring = (ctx, x, y) => {
  ctx.arc(x, y, 4, 0, 2 * Math.PI);
  ctx.stroke();
};
const diamond = shape([
  [0, -6],
  [6, 0],
  [0, 6],
  [-6, 0],
]);
const right = shape([
  [-5, -5],
  [6, 0],
  [-5, 5],
]);
const left = shape([
  [5, -5],
  [-6, 0],
  [5, 5],
]);
const down = shape([
  [-6, -4],
  [6, -4],
  [0, 6],
]);
const up = shape([
  [-6, 5],
  [6, 5],
  [0, -5],
]);
const square = shape([
  [-4, -4],
  [4, -4],
  [4, 4],
  [-4, 4],
]);
const stroke = shape([
  [-1, -8],
  [1, -8],
  [1, 8],
  [-1, 8],
]);

const SYMBOLS = {
  push: { draw: right, colour: "com" },
  command: { draw: diamond, colour: "accent" },
  refused: { draw: cross, colour: "bad" },
  fell: { draw: down, colour: "bad" },
  stood: { draw: up, colour: "good" },
  thrown: { draw: disc, colour: "ball" },
  dragged: { draw: square, colour: "pull" },
  set: { draw: square, colour: "soft" },
  grasped: { draw: ring, colour: "good" },
  slipped: { draw: ring, colour: "warn" },
  broke: { draw: ring, colour: "bad" },
  reload: { draw: stroke, colour: "accent" },
  branch: { draw: stroke, colour: "soft" },
};

const LEFTWARD = { ...SYMBOLS.push, draw: left };

/** Symbol of an event, or null for one that is seen in the bands alone. A push's points its way. */
export function symbolOf({ kind, text }) {
  if (kind === "push" && / [-−]\d/.test(text ?? "")) return LEFTWARD;
  return Object.hasOwn(SYMBOLS, kind) ? SYMBOLS[kind] : null;
}
