// Fingers, mouse, wheel and keys on the picture.

const TAP = 6; // pixels that a finger may move while it taps

/**
 * @param act  turn(dx, dy) and move(dx, dy) by parts of the picture's height, zoom(factor, x, y) about a point in those
 * units from the middle, pick(x, y) in pixels, and key(name, shift), which returns whether it took the key
 * @param flat  whether one finger moves the picture instead of turning it
 */
export function listen(canvas, flat, act) {
  const fingers = new Map();
  let travelled = 0;
  const middle = () => {
    const at = [...fingers.values()];
    return [at.reduce((sum, p) => sum + p.x, 0) / at.length, at.reduce((sum, p) => sum + p.y, 0) / at.length];
  };
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  const height = () => canvas.clientHeight || 1;
  const fromMiddle = (x, y) => {
    const box = canvas.getBoundingClientRect();
    return [(x - box.left - box.width / 2) / height(), -(y - box.top - box.height / 2) / height()];
  };

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    if (fingers.size === 0) travelled = 0;
    else travelled = Infinity; // two fingers pick nothing
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", (event) => {
    const finger = fingers.get(event.pointerId);
    if (!finger) return;
    const before = middle();
    const apart = fingers.size === 2 ? spread() : 0;
    travelled += Math.hypot(event.clientX - finger.x, event.clientY - finger.y);
    [finger.x, finger.y] = [event.clientX, event.clientY];
    const after = middle();
    const dx = (after[0] - before[0]) / height();
    const dy = -(after[1] - before[1]) / height();
    if (fingers.size === 2) {
      act.move(dx, dy);
      act.zoom(apart / Math.max(spread(), 1), ...fromMiddle(...after));
    } else if (flat || event.shiftKey || event.buttons & 6) act.move(dx, dy);
    else act.turn(dx, dy);
  });
  const lift = (event, taps) => {
    if (!fingers.delete(event.pointerId)) return;
    const box = canvas.getBoundingClientRect();
    if (taps && fingers.size === 0 && travelled < TAP && event.button === 0)
      act.pick(event.clientX - box.left, event.clientY - box.top);
  };
  canvas.addEventListener("pointerup", (event) => lift(event, true));
  canvas.addEventListener("pointercancel", (event) => lift(event, false));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 30 : event.deltaMode === 2 ? 300 : 1;
      act.zoom(Math.exp(0.0015 * event.deltaY * lines), ...fromMiddle(event.clientX, event.clientY));
    },
    { passive: false },
  );
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (act.key(event.key, event.shiftKey)) event.preventDefault();
  });
}

/** What the keys do: [keys, words for the help]. */
export const KEYS = [
  ["arrows", "turn (flat: move); with Shift move"],
  ["+ −", "nearer, farther"],
  ["0", "everything, as at the start"],
  ["Enter", "the cell in the middle"],
  ["n p", "next, previous seed"],
  ["x y z v", "slice along an axis, or the view"],
  ["[ ]", "move the slice"],
  ["Esc", "choose nothing"],
];
