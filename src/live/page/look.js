// Colours for the canvases, read from the CSS variables of theme.css: so a theme is told once.
// Also mixes them, and gives each controller of a pool a colour of its own.

const probe = document.createElement("span");
let known = new Map();
let dark = false;

/** Reads everything anew after the theme has changed. */
export function refresh() {
  if (!probe.isConnected) {
    probe.className = "unseen";
    probe.setAttribute("aria-hidden", "true");
    document.body.append(probe);
  }
  known = new Map();
  const [r, g, b] = parts(colour("page"));
  dark = r + g + b < 384;
}

export const isDark = () => dark;

/** The variable `--name`, as `rgb(r, g, b)`. */
export function colour(name) {
  let found = known.get(name);
  if (found === undefined) {
    probe.style.color = "";
    probe.style.color = `var(--${name})`;
    found = getComputedStyle(probe).color;
    known.set(name, found);
  }
  return found;
}

function parts(text) {
  return (text.match(/[\d.]+/g) ?? ["0", "0", "0"]).slice(0, 3).map(Number);
}

const written = (values) => `rgb(${values.map((v) => Math.round(v)).join(", ")})`;

/** `share` of the way from one colour to another. */
export function mix(from, to, share) {
  const a = parts(from);
  const b = parts(to);
  return written(a.map((v, k) => v + (b[k] - v) * share));
}

export function clear(text, alpha) {
  return `rgba(${parts(text).join(", ")}, ${alpha})`;
}

function dull(text, share) {
  const rgb = parts(text);
  const grey = 0.3 * rgb[0] + 0.59 * rgb[1] + 0.11 * rgb[2];
  return written(rgb.map((v) => v + (grey - v) * share));
}

const TONES = new Set(["skin", "hair", "shirt", "trousers", "shoe", "fur", "mane", "belt"]);
const SECOND = new Set(["shirt", "trousers", "hair", "fur", "mane", "belt"]);

/** Fill and edge of a tone: of the far side darker and duller; of a second character another. */
export function tone(name, far, character) {
  const key = `tone ${name} ${far} ${character > 0}`;
  let found = known.get(key);
  if (found === undefined) {
    const base = TONES.has(name) ? name : "skin";
    let fill = colour(character > 0 && SECOND.has(base) ? `${base}-2` : base);
    if (far) fill = mix(dull(fill, 0.35), colour("shadow"), dark ? 0.42 : 0.26);
    found = { fill, edge: mix(fill, colour("shadow"), dark ? 0.5 : 0.4) };
    known.set(key, found);
  }
  return found;
}

/** Colour of the controller at `place` in its pool: neighbours lie far apart on the circle. */
export function band(place) {
  const hue = (212 + place * 137.5) % 360;
  return dark ? `hsl(${hue} 48% 62%)` : `hsl(${hue} 52% 48%)`;
}
