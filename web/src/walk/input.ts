// Keys of the page, and mouse and touch on the canvas, as turns and motions of the view.

import type { Motion } from "./walker";

const LOOK_SPEED = 0.0042;
/** A press that moves less is a click. */
const CLICK_DISTANCE = 5;
const CLICK_TIME = 500;

const KEYS: Record<string, [keyof Omit<Motion, "fast">, number]> = {
  KeyW: ["forward", 1],
  ArrowUp: ["forward", 1],
  KeyS: ["forward", -1],
  ArrowDown: ["forward", -1],
  KeyA: ["right", -1],
  KeyD: ["right", 1],
  ArrowLeft: ["turn", -1],
  ArrowRight: ["turn", 1],
};

export interface InputEvents {
  look(dx: number, dy: number): void;
  pan(dx: number, dy: number): void;
  zoom(factor: number): void;
  click(x: number, y: number): void;
  hover(x: number, y: number): void;
  leave(): void;
  /** A key that moves went down: motion begins. */
  wake(): void;
}

interface Press {
  x: number;
  y: number;
  startX: number;
  startY: number;
  time: number;
  button: number;
}

export class Input {
  private readonly keys = new Set<string>();
  private readonly presses = new Map<number, Press>();
  private isFast = false;
  /** From the pad on touch screens. */
  pad = { forward: 0, right: 0 };
  /** Two fingers walk by the way they were moved. */
  private fingers = { forward: 0, right: 0 };

  constructor(
    private readonly canvas: HTMLElement,
    private readonly events: InputEvents,
  ) {
    // Of the whole page: one walks before the first click on the picture, and after one on a button.
    document.addEventListener("keydown", (event) => this.keyDown(event));
    document.addEventListener("keyup", (event) => this.keyUp(event));
    window.addEventListener("blur", () => this.keys.clear());
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event, true));
    canvas.addEventListener("pointercancel", (event) => this.up(event, false));
    // A finger that is lifted leaves, too, and what it tapped stays of interest.
    canvas.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && events.leave());
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  motion(): Motion {
    const motion = { forward: 0, right: 0, turn: 0, lift: 0, fast: this.isFast };
    for (const key of this.keys) {
      const [axis, sign] = KEYS[key]!;
      motion[axis] += sign;
    }
    motion.forward += this.pad.forward + this.fingers.forward;
    motion.right += this.pad.right + this.fingers.right;
    for (const axis of ["forward", "right", "turn"] as const) motion[axis] = Math.min(Math.max(motion[axis], -1), 1);
    return motion;
  }

  private keyDown(event: KeyboardEvent) {
    this.isFast = event.shiftKey;
    if (!(event.code in KEYS) || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.code.startsWith("Arrow") ? this.takesArrows(event.target) : isTyped(event.target)) return;
    event.preventDefault();
    this.keys.add(event.code);
    this.events.wake();
  }

  /** Controls have uses of their own for the arrows. */
  private takesArrows(target: EventTarget | null) {
    return target !== this.canvas && target !== document.body;
  }

  private keyUp(event: KeyboardEvent) {
    this.isFast = event.shiftKey;
    this.keys.delete(event.code);
  }

  private down(event: PointerEvent) {
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    const [x, y] = placeOf(event);
    this.presses.set(event.pointerId, { x, y, startX: x, startY: y, time: event.timeStamp, button: event.button });
  }

  private move(event: PointerEvent) {
    const [x, y] = placeOf(event);
    const press = this.presses.get(event.pointerId);
    if (!press) {
      this.events.hover(x, y);
      return;
    }
    const [dx, dy] = [x - press.x, y - press.y];
    press.x = x;
    press.y = y;
    if (this.presses.size > 1) this.walkByFingers();
    else if (press.button === 2 || event.shiftKey) this.events.pan(dx, dy);
    else this.events.look(dx * LOOK_SPEED, dy * LOOK_SPEED);
  }

  private walkByFingers() {
    const all = [...this.presses.values()];
    const mean = (of: (press: Press) => number) => all.reduce((sum, press) => sum + of(press), 0) / all.length;
    this.fingers.forward = mean((press) => press.startY - press.y) / 80;
    this.fingers.right = mean((press) => press.x - press.startX) / 80;
    this.events.wake();
  }

  private up(event: PointerEvent, counts: boolean) {
    const press = this.presses.get(event.pointerId);
    this.presses.delete(event.pointerId);
    const wasAlone = this.presses.size === 0 && this.fingers.forward === 0 && this.fingers.right === 0;
    if (this.presses.size < 2) this.fingers = { forward: 0, right: 0 };
    if (!press || !counts || !wasAlone) return;
    const moved = Math.hypot(press.x - press.startX, press.y - press.startY);
    const isClick = moved < CLICK_DISTANCE && event.timeStamp - press.time < CLICK_TIME && press.button === 0;
    if (isClick) this.events.click(press.x, press.y);
  }

  private wheel(event: WheelEvent) {
    event.preventDefault();
    this.events.zoom(Math.exp(Math.min(Math.max(event.deltaY, -240), 240) * 0.0012));
  }
}

/** Whether an element takes letters and digits itself. */
export function isTyped(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return target.type === "number";
  return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}

function placeOf(event: PointerEvent): [number, number] {
  return [event.offsetX, event.offsetY];
}
