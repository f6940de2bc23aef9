// Small helpers for elements. Text only ever goes in as text, and only when it differs, so that a
// frame that changes nothing costs no layout.

export const byId = (id) => document.getElementById(id);

/** An element with attributes (`on…` listens, `data` is a map) and children (strings become text). */
export function make(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (name === "data") Object.assign(node.dataset, value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

/** An icon of the sheet in index.html. */
export function icon(name) {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  const use = document.createElementNS(space, "use");
  svg.setAttribute("aria-hidden", "true");
  use.setAttribute("href", `#i-${name}`);
  svg.append(use);
  return svg;
}

export function say(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

export function mark(node, name, value) {
  const text = String(value);
  if (node.getAttribute(name) !== text) node.setAttribute(name, text);
}

export function show(node, visible) {
  if (node.hidden === visible) node.hidden = !visible;
}

/** A length in percent for a bar or gauge, written only when it moves by what can be seen. */
export function place(node, property, percent) {
  const text = `${Math.round(percent * 2) / 2}%`;
  if (node.style.getPropertyValue(property) !== text) node.style.setProperty(property, text);
}

/** A number as short as it can be read. */
export function short(value, digits = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "no value";
  const size = Math.abs(value);
  const places =
    size >= 100 ? 0 : size >= 10 ? Math.min(1, digits) : size >= 1 ? Math.min(2, digits) : digits;
  return value.toFixed(places).replace("-", "−");
}

/** A number that stands still, without zeros at its end. */
export const plain = (value) => String(Number(value.toPrecision(4))).replace("-", "−");

/** Calls `act` at most once per `wait` ms; the last call is never lost. */
export function seldom(wait, act) {
  let timer = null;
  let last = 0;
  return (...values) => {
    clearTimeout(timer);
    const due = last + wait - performance.now();
    const now = () => {
      last = performance.now();
      act(...values);
    };
    if (due <= 0) now();
    else timer = setTimeout(now, due);
  };
}
