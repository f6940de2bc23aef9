// The stretch of the run that the timeline shows, in steps: all of it, rounded up so that it does not
// change with each step; or what somebody has zoomed to.

const LENGTHS = [
  10, 15, 20, 30, 45, 60, 90, 120, 180, 240, 300, 450, 600, 900, 1200, 1800, 2700, 3600, 7200, 36000,
]; // s
const LEAST = 50; // steps
const AHEAD = 0.9; // where the newest step stands while it is followed

/** `run()` gives `{first, end, dt}`; `width()` the pixels. */
export function makeSpan(run, width) {
  let chosen = null;
  let follows = false; // the newest step stays in what was chosen

  const span = {
    all: () => {
      chosen = null;
      follows = false;
    },
    isAll: () => chosen === null,
    follows: () => follows,
    /** What was chosen moves with the newest step. */
    follow: () => {
      follows = chosen !== null;
    },
    now() {
      const { first, end, dt } = run();
      if (follows) {
        const length = chosen[1] - chosen[0];
        const from = Math.max(first, end - AHEAD * length);
        return [from, from + length];
      }
      if (chosen) return chosen;
      const length = (end - first) * dt;
      return [first, first + (LENGTHS.find((one) => one >= length) ?? length) / dt];
    },
    toX(step) {
      const [a, b] = span.now();
      return ((step - a) / (b - a)) * width();
    },
    toStep(x) {
      const [a, b] = span.now();
      return a + (x / width()) * (b - a);
    },
    /** A step that has been run. */
    bounded(step) {
      const { first, end } = run();
      return Math.round(Math.min(end, Math.max(first, step)));
    },
    /** `factor` above 1 shows more; the step under `x` goes to `to`. */
    zoom(x, factor, to = x) {
      const { first, end, dt } = run();
      const [a, b] = span.now();
      const length = (b - a) * factor;
      if (length >= Math.max(end - first, LENGTHS[0] / dt) * 1.2) span.all();
      else if (length > LEAST) {
        // Two fingers that move it choose the place, too.
        if (to !== x) follows = false;
        const from = Math.max(first, span.toStep(x) - (to / width()) * length);
        chosen = [from, from + length];
      }
    },
  };
  return span;
}
