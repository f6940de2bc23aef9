// Looking around: wheel and pinch zoom, two fingers or shift or an empty place move the view.
// One finger or button on a body goes to the tool of pointer.js.

import { byId, mark } from "./dom.js";

const STILL = 5; // px: a touch that moves less moves nothing

export function makeGestures(stage, camera, pointer) {
  const { canvas } = stage;
  const down = new Map(); // pointers that are down: id → [x, y]
  let mode = null; // "tool", "pan" or "pinch"
  let rest = STILL; // px that it must still move before the view does

  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (event.button > 1) return;
    canvas.setPointerCapture(event.pointerId);
    if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
    down.set(event.pointerId, at(event));
    if (down.size === 2) {
      pointer.cancel();
      mode = "pinch";
    } else if (down.size === 1) {
      const looks = event.shiftKey || event.button === 1;
      mode = !looks && pointer.begin(event) ? "tool" : "pan";
      rest = STILL;
      if (mode === "pan") canvas.style.cursor = "grabbing";
    }
    event.preventDefault();
  });

  canvas.addEventListener("pointermove", (event) => {
    const old = down.get(event.pointerId);
    if (!old || mode === "tool") {
      pointer.move(event);
      return;
    }
    const now = at(event);
    if (mode === "pan") {
      rest -= Math.hypot(now[0] - old[0], now[1] - old[1]);
      if (rest > 0) return;
      camera.pan(now[0] - old[0], now[1] - old[1]);
    } else if (mode === "pinch" && down.size === 2) {
      camera.pan(0, 0);
      const [other] = [...down].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
      const [before, after] = [old, now].map((one) => Math.hypot(one[0] - other[0], one[1] - other[1]));
      camera.zoomAt((now[0] + other[0]) / 2, (now[1] + other[1]) / 2, after / Math.max(before, 1));
      // Half of one finger's way is what their middle moved.
      camera.pan((now[0] - old[0]) / 2, (now[1] - old[1]) / 2);
    }
    down.set(event.pointerId, now);
    changed();
  });

  function up(event) {
    if (!down.delete(event.pointerId)) return;
    if (mode === "tool") {
      if (event.type === "pointercancel") pointer.cancel();
      else pointer.end();
    }
    if (down.size === 0 || mode === "tool") mode = null;
    else mode = "pan";
    if (mode === null)
      canvas.style.cursor =
        pointer.tool === "pan" ? "grab" : pointer.tool === "drag" ? "default" : "crosshair";
  }
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());

  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      camera.zoomAt(...at(event), Math.exp(-event.deltaY * lines * 0.0015));
      changed();
    },
    { passive: false },
  );

  function changed() {
    mark(byId("follow"), "aria-pressed", camera.following);
    stage.touch();
  }

  byId("follow").addEventListener("click", follow);
  function follow() {
    camera.follow();
    changed();
  }
  return { follow };
}
