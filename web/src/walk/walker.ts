// Walking: a capsule that slides along walls, with the eye 1.6 m above the floor.

import * as THREE from "three";

import type { Space } from "./space";
import { EYE_HEIGHT, type View } from "./view";

const SPEED = 1.4;
const FAST = 2.5;
const RADIUS = 0.2;
/** Lower things are stepped on. */
const STEP = 0.4;
/** Above the eye. */
const CROWN = 0.1;
/** Shorter than the radius, so that no thin wall is jumped over. */
const LONGEST_MOVE = 0.1;
/** The floor is searched so far below the feet; deeper, the eye keeps its height. */
const DEPTH = 3;
/** Of the eye's height towards that above the floor, by second. */
const SETTLING = 8;
const KEY_TURN = 1.6;

/** What keys and pads ask for: -1 to 1 each. */
export interface Motion {
  forward: number;
  right: number;
  turn: number;
  lift: number;
  fast: boolean;
}

export class Walker {
  constructor(
    private readonly space: Space,
    private readonly view: View,
  ) {}

  /** Moves the view for some seconds; returns whether anything changed. */
  step(motion: Motion, seconds: number): boolean {
    const before = this.view.position.clone();
    if (motion.turn !== 0) this.view.turn(-motion.turn * KEY_TURN * seconds, 0);
    const forward = this.view.levelDirection();
    const right = new THREE.Vector3(forward.y, -forward.x, 0);
    const direction = forward.multiplyScalar(motion.forward).addScaledVector(right, motion.right);
    if (direction.length() > 1) direction.normalize();
    const distance = direction.length() * SPEED * (motion.fast ? FAST : 1) * seconds;
    if (distance > 0) this.slide(direction.normalize(), distance);
    this.settle(seconds);
    this.view.target.copy(this.view.position).addScaledVector(this.view.direction(), 3);
    return motion.turn !== 0 || before.distanceToSquared(this.view.position) > 1e-10;
  }

  /** The eye's height above the floor below it; null where there is none. */
  heightAboveFloor(): number | null {
    const { position } = this.view;
    const down = new THREE.Vector3(0, 0, -1);
    const hit = this.space.cast(position, down, THREE.DoubleSide);
    return hit && hit.distance < EYE_HEIGHT + DEPTH ? hit.distance : null;
  }

  private slide(direction: THREE.Vector3, distance: number) {
    const { position } = this.view;
    const steps = Math.ceil(distance / LONGEST_MOVE);
    for (let i = 0; i < steps; ++i) {
      const start = position.clone();
      position.addScaledVector(direction, distance / steps);
      this.leaveWalls();
      if (this.hasCrossed(start, position)) {
        position.copy(start);
        return;
      }
    }
  }

  /** Twice: out of one wall may be into another. */
  private leaveWalls() {
    const { position } = this.view;
    const feet = position.z - EYE_HEIGHT + STEP + RADIUS;
    for (let i = 0; i < 2; ++i) {
      const axis = new THREE.Line3(
        new THREE.Vector3(position.x, position.y, Math.min(feet, position.z)),
        new THREE.Vector3(position.x, position.y, position.z + CROWN - RADIUS / 2));
      const push = this.space.pushOut(axis, RADIUS);
      position.x += push.x;
      position.y += push.y;
    }
  }

  /** Whether a wall lies between two places of the eye or of the waist. */
  private hasCrossed(from: THREE.Vector3, to: THREE.Vector3): boolean {
    const apart = to.clone().sub(from);
    const distance = apart.length();
    if (distance < 1e-9) return false;
    return [0, -0.7].some((height) => {
      const origin = from.clone().setZ(from.z + height);
      const hit = this.space.cast(origin, apart, THREE.DoubleSide);
      return hit !== null && hit.distance < distance;
    });
  }

  private settle(seconds: number) {
    const height = this.heightAboveFloor();
    if (height === null) return;
    const wanted = this.view.position.z + EYE_HEIGHT - height;
    const share = 1 - Math.exp(-SETTLING * seconds);
    const change = wanted - this.view.position.z;
    this.view.position.z = Math.abs(change) < 1e-3 ? wanted : this.view.position.z + change * share;
  }
}
