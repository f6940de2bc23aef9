// Which link or prop lies under a point of the world. Frame + point → what, and where in its frame.

/** `{character, link, name, point}` or `{prop, place, point}` or null; a finger may miss by `slop`, m. */
export function bodyAt(state, x, y, slop) {
  const { hello, frame, props } = state;
  if (!hello || !frame) return null;
  let best = null;
  let least = slop;
  // Inside several it is the one drawn last; otherwise the nearest.
  const take = (gap, layer, found) => {
    const rank = gap <= 0 ? -1 - layer : gap;
    if (rank > least) return;
    least = rank;
    best = found;
  };
  frame.c.forEach((one, character) => {
    const { links, figure } = hello.characters[character];
    links.forEach((link, k) => {
      const point = local(x, y, one.l, k);
      const gap = toLine(point, link.grab) - link.radius;
      take(gap, 1 + figure.findLastIndex((part) => part.link === k), {
        character,
        link: k,
        name: link.name,
        point,
      });
    });
  });
  props.forEach((prop, k) => {
    if (3 * k + 2 >= frame.p.length) return;
    const point = local(x, y, frame.p, k);
    const gap = (prop.outline ? toOutline(point, prop.outline) : Math.hypot(...point)) - prop.radius;
    take(gap, 0, { prop: prop.name, place: k, point });
  });
  return best;
}

/** Where a point of a found body is now. */
export function pointOf(state, found) {
  const { frame } = state;
  if (!frame) return null;
  const places = found.prop !== undefined ? frame.p : frame.c[found.character]?.l;
  const k = found.prop !== undefined ? found.place : found.link;
  if (!places || 3 * k + 2 >= places.length) return null;
  const [x, y, angle] = places.slice(3 * k, 3 * k + 3);
  const [c, n] = [Math.cos(angle), Math.sin(angle)];
  return [x + c * found.point[0] - n * found.point[1], y + n * found.point[0] + c * found.point[1]];
}

function local(x, y, places, k) {
  const [dx, dy] = [x - places[3 * k], y - places[3 * k + 1]];
  const angle = places[3 * k + 2];
  const [c, n] = [Math.cos(angle), Math.sin(angle)];
  return [c * dx + n * dy, -n * dx + c * dy];
}

function toLine([x, y], [[ax, ay], [bx, by]]) {
  const [dx, dy] = [bx - ax, by - ay];
  const size = dx * dx + dy * dy;
  const t = size > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / size)) : 0;
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

/** Distance to a polygon, negative inside. */
function toOutline(point, outline) {
  let least = Infinity;
  let inside = false;
  outline.forEach((a, k) => {
    const b = outline[(k + 1) % outline.length];
    least = Math.min(least, toLine(point, [a, b]));
    const crosses = a[1] > point[1] !== b[1] > point[1];
    if (crosses && point[0] < ((b[0] - a[0]) * (point[1] - a[1])) / (b[1] - a[1]) + a[0]) inside = !inside;
  });
  return inside ? -least : least;
}
