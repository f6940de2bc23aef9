// Where the stage looks: world (m, y up) ⇄ stage (CSS pixels, y down). It follows characters and
// props smoothly, until somebody pans; zooming is a factor on top of what it chooses itself.

const MARGIN = { left: 30, right: 30, bottom: 74, low: 52 }; // px; `low` is the bottom of a low stage
const ROOF = 66; // px
const LOW_STAGE = 300; // px
const WIDEST = 14; // m that it shows at most by itself
const NEAR = 5; // m from a character within which a prop is kept in view
const RATE = 5; // 1/s, of following
const HASTE = 16; // 1/s, when something is about to leave the view

export function makeCamera() {
  const camera = {
    x: 0,
    y: 0.9,
    scale: 220,
    width: 300,
    height: 300,
    following: true,
    zoom: 1,
    /** px at the top that are covered. */
    roof: ROOF,
    resize(width, height) {
      camera.width = width;
      camera.height = height;
      settled = false;
    },
    toScreen: (x, y) => [
      (x - camera.x) * camera.scale + camera.width / 2,
      camera.height / 2 - (y - camera.y) * camera.scale,
    ],
    toWorld: (px, py) => [
      (px - camera.width / 2) / camera.scale + camera.x,
      (camera.height / 2 - py) / camera.scale + camera.y,
    ],
    follow() {
      camera.following = true;
      camera.zoom = 1;
    },
    /** Moves by pixels; from then on it stays. */
    pan(dx, dy) {
      camera.following = false;
      camera.x -= dx / camera.scale;
      camera.y += dy / camera.scale;
    },
    /** Nearer (factor above 1) or farther, about a point of the stage. */
    zoomAt(px, py, factor) {
      if (camera.following) {
        camera.zoom = Math.min(8, Math.max(0.25, camera.zoom * factor));
        return;
      }
      const [x, y] = camera.toWorld(px, py);
      camera.scale = Math.min(2500, Math.max(15, camera.scale * factor));
      const [nx, ny] = camera.toWorld(px, py);
      camera.x += x - nx;
      camera.y += y - ny;
    },
    /** Something reaches down to here from the top of the stage. */
    cover(px) {
      camera.roof = Math.max(ROOF, px);
    },
    jump() {
      settled = false;
    },
    update,
  };
  let settled = false;

  /** One picture on, `dt` s later; `box` is what has to be seen. True while it moves. */
  function update(dt, box) {
    if (!camera.following || !box) return false;
    const goal = aim(box);
    const share = settled ? 1 - Math.exp(-(leaves(box) ? HASTE : RATE) * Math.min(dt, 0.1)) : 1;
    settled = true;
    const before = [camera.x, camera.y, camera.scale];
    camera.scale *= (goal.scale / camera.scale) ** share;
    camera.x += (goal.x - camera.x) * share;
    camera.y += (goal.y - camera.y) * share;
    const moved =
      Math.hypot(camera.x - before[0], camera.y - before[1]) * camera.scale +
      Math.abs(camera.scale - before[2]);
    return moved > 0.05;
  }

  const bottom = () => (camera.height < LOW_STAGE ? MARGIN.low : MARGIN.bottom);

  function leaves(box) {
    if (camera.zoom > 1) return false;
    const [left] = camera.toScreen(box.left, 0);
    const [right, top] = camera.toScreen(box.right, box.high);
    return left < MARGIN.left || right > camera.width - MARGIN.right || top < 0;
  }

  function aim(box) {
    const room = [camera.width - MARGIN.left - MARGIN.right, camera.height - camera.roof - bottom()].map(
      (v) => Math.max(v, 60),
    );
    const high = Math.max(box.high, 1.9) + 0.1;
    const low = Math.min(box.low, 0);
    const wide = Math.max(box.right - box.left + 0.7, 1.2);
    const fitting = Math.min(room[1] / (high - low), room[0] / Math.min(wide, WIDEST));
    const scale = Math.max(fitting, camera.width / (WIDEST + 2)) * camera.zoom;
    // The ground stays near the lower edge, unless zoomed in on the character.
    const middle = camera.zoom > 1 ? box.middle[1] : null;
    const grounded = low + (camera.height / 2 - bottom()) / scale;
    return {
      x: wide > WIDEST || camera.zoom > 1.2 ? box.middle[0] : (box.left + box.right) / 2,
      y: middle === null ? grounded : Math.max(Math.min(middle, grounded), low - 0.2),
      scale,
    };
  }

  return camera;
}

/** The box of all links and of the props near them; `middle` is the mean centre of mass. */
export function boxOf(state) {
  const { hello, frame, props } = state;
  if (!hello || !frame) return null;
  const box = { left: Infinity, right: -Infinity, low: 0, high: 0, middle: [0, 0] };
  const take = (x, y, r) => {
    box.left = Math.min(box.left, x - r);
    box.right = Math.max(box.right, x + r);
    box.low = Math.min(box.low, y - r);
    box.high = Math.max(box.high, y + r);
  };
  frame.c.forEach((one, k) => {
    hello.characters[k].links.forEach((link, i) => {
      take(one.l[3 * i], one.l[3 * i + 1], link.radius);
    });
    box.middle[0] += one.com[0] / frame.c.length;
    box.middle[1] += one.com[1] / frame.c.length;
  });
  const { left, right } = box;
  props.forEach((prop, i) => {
    if (3 * i + 2 >= frame.p.length) return;
    const [x, y] = [frame.p[3 * i], frame.p[3 * i + 1]];
    if (x < left - NEAR || x > right + NEAR || y > 8) return;
    take(x, y, reach(prop));
  });
  return box;
}

/** Radius of the circle about a prop's origin that holds it. */
export function reach(prop) {
  return prop.radius + Math.max(0, ...(prop.outline ?? []).map(([x, y]) => Math.hypot(x, y)));
}
