// Clauses and events in plain words, and how far a value is from its bound.

import { short } from "./dom.js";

/** `posture standing|crouching` → "posture is standing or crouching"; `x in 0..1` → "x from 0 to 1". */
export function clause(text) {
  const one = text.match(/^posture (\S+)$/);
  if (one) return `posture is ${posture(one[1].split("|").join(" or "))}`;
  return text
    .replace(/^\((.*)\)$/s, "$1")
    .replace(/not (\S+) ≥/g, "$1 <")
    .replace(/not (\S+) ≤/g, "$1 >")
    .replace(/posture ([\w|]+)/g, (_, list) => `posture ${posture(list.split("|").join(" or "))}`)
    .replace(/ in (-?[\d.]+)\.\.(-?[\d.]+)/g, " from $1 to $2")
    .replace(/(^|[ (])-(?=[\d.])/g, "$1−");
}

/** A posture's name in plain words. */
export const posture = (name) => name.replaceAll("_", " ");

/** Whether a clause is about the posture alone. */
export const isPosture = (node) => /^(not )?posture \S+$/.test(node.text);

const parts = (node) => node.all ?? node.any ?? (node.not ? [node.not] : []);

/** "not x ≥ a" as the leaf "x < a"; null if a condition cannot be turned round so. */
export function turned(node) {
  const [min, max] = bounds(node);
  if (!isLeaf(node) || node.learned || (min === null) === (max === null)) return null;
  return { ...node, text: clause(`not ${node.text}`), min: max, max: min };
}

/** The nodes of a condition in pre-order: place 0 is the root. */
export function nodesOf(root) {
  return root ? [root, ...parts(root).flatMap(nodesOf)] : [];
}

/** Name of the feature that a clause, or what it negates, is about. */
export const featureOf = (node) => node.feature ?? node.not?.feature ?? null;

export const isLeaf = (node) => parts(node).length === 0;

const bounds = (node) => (node.learned ? [0, null] : [node.min ?? null, node.max ?? null]);

/** How far a value is inside its bounds (positive) or beyond them (negative); null without either. */
export function slack(node, value) {
  const [min, max] = bounds(node);
  if (value === null || value === undefined || (min === null && max === null)) return null;
  return Math.min(min === null ? Infinity : value - min, max === null ? Infinity : max - value);
}

/** Place on a gauge in percent: the bound at 60, what holds to the right of it. */
export function onGauge(node, value) {
  const gap = slack(node, value);
  if (gap === null) return null;
  const [min, max] = bounds(node);
  const size = min !== null && max !== null ? (max - min) / 2 : Math.max(Math.abs(min ?? max), 0.2) / 2;
  const share = Math.abs(gap) / (Math.abs(gap) + Math.max(size, 1e-6));
  return gap < 0 ? 60 - 56 * share : 60 + 38 * share;
}

/** "is 0.88, 0.07 too low". */
export function missed(node, value) {
  if (value === null || value === undefined) return "";
  if (node.learned) return `score ${short(value, 2)}`;
  const [min, max] = bounds(node);
  if (min !== null && value < min) return `is ${short(value, 2)}, ${short(min - value, 2)} too low`;
  if (max !== null && value > max) return `is ${short(value, 2)}, ${short(value - max, 2)} too high`;
  return `is ${short(value, 2)}`;
}

const KINDS = {
  push: "push",
  command: "command",
  refused: "refused",
  grasped: "grasped",
  slipped: "slipped",
  broke: "broke",
  fell: "fell",
  stood: "stood",
  thrown: "thrown",
  set: "set",
  dragged: "dragged",
  released: "let go",
  reload: "files read anew",
  branch: "went on from here",
};

export function eventText(event) {
  if (event.kind === "switch") {
    const text = event.text ?? "";
    return text.includes("→")
      ? text
      : `${event.from ? `${event.from} → ` : "→ "}${event.to}${text ? `: ${text}` : ""}`;
  }
  const refused = event.kind === "refused" && (event.text ?? "").match(/^by (\w+): (.*)$/s);
  if (refused) return `${refused[1]} refuses: ${clause(refused[2])}`;
  const kind = KINDS[event.kind] ?? event.kind;
  const text = (event.text ?? "").replace(/ -(?=\d)/g, " −");
  return text ? `${kind}: ${text}` : kind;
}

const REASONS = {
  failed: "The one before had failed what it expects.",
  succeeded: "The one before had done its task.",
  command: "A command asked for it.",
  start: "The run began.",
};

export const reasonText = (event) => REASONS[event.reason] ?? "";

export const unwrap = (feature) => (typeof feature === "string" ? { name: feature } : feature);
