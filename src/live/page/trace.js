// Values over the last seconds of the run. A seek back takes away what is not before it; a gap in
// time is shown as a gap.

const GAP = 0.5; // s

export class Trace {
  constructor(span) {
    this.span = span;
    this.clear();
  }

  clear() {
    this.now = 0;
    this.t = [];
    this.rows = [];
  }

  add(t, values) {
    while (this.t.length > 0 && this.t[this.t.length - 1] >= t) {
      this.t.pop();
      this.rows.pop();
    }
    const last = this.t[this.t.length - 1];
    if (last !== undefined && t - last > GAP) {
      this.t.push(last + 1e-4);
      this.rows.push(values.map(() => null));
    }
    this.t.push(t);
    this.rows.push(values);
    this.now = t;
    let old = 0;
    while (this.t[old] < t - this.span) old += 1;
    // In portions, so that not every frame moves the whole list.
    if (old > 120) {
      this.t.splice(0, old);
      this.rows.splice(0, old);
    }
  }

  /** The values of one column. */
  of(column) {
    return this.rows.map((row) => row[column] ?? null);
  }

  /** Empties one column: from now on it means something else. */
  forget(column) {
    for (const row of this.rows) row[column] = null;
  }
}
