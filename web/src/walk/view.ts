// Where the eye is and where it looks.

import * as THREE from "three";

import type { Vec3 } from "../data/scene";

/** The eye of someone who stands. */
export const EYE_HEIGHT = 1.6;
/** So far from straight up or down that left and right stay defined. */
const MOST_PITCH = Math.PI / 2 - 0.01;

export class View {
  readonly position = new THREE.Vector3();
  /** Degrees across. */
  fov = 70;
  yaw = 0;
  pitch = 0;
  /** The point that an orbit turns about. */
  readonly target = new THREE.Vector3();
  /** The upward direction of a scene's camera, until the view turns. */
  private up: THREE.Vector3 | null = null;

  place(position: Vec3, target: Vec3, fov?: number, up?: Vec3) {
    const [from, to] = [new THREE.Vector3(...position), new THREE.Vector3(...target)];
    const direction = to.clone().sub(from);
    if (!(direction.length() > 0)) throw new Error("a camera's position and target must differ");
    if (fov !== undefined && !(fov > 0 && fov < 180)) throw new Error("a camera's fov must lie between 0 and 180 degrees");
    this.position.copy(from);
    this.target.copy(to);
    direction.normalize();
    if (Math.hypot(direction.x, direction.y) > 1e-6) this.yaw = Math.atan2(direction.y, direction.x);
    else if (up) this.yaw = Math.atan2(up[1], up[0]);
    this.pitch = Math.asin(Math.min(Math.max(direction.z, -1), 1));
    if (fov !== undefined) this.fov = fov;
    const isSteep = Math.abs(this.pitch) > MOST_PITCH;
    const upward = up ? new THREE.Vector3(...up) : new THREE.Vector3(0, 0, 1);
    const isTilted = upward.x !== 0 || upward.y !== 0;
    this.up = isSteep && !isTilted ? this.levelDirection() : isTilted ? upward : null;
  }

  turn(yaw: number, pitch: number) {
    this.up = null;
    this.yaw += yaw;
    this.pitch = Math.min(Math.max(this.pitch + pitch, -MOST_PITCH), MOST_PITCH);
  }

  /** Turns the eye about the target and changes its distance. */
  orbit(yaw: number, pitch: number, zoom: number) {
    const distance = Math.max(this.position.distanceTo(this.target) * zoom, 0.1);
    this.turn(yaw, pitch);
    this.position.copy(this.target).addScaledVector(this.direction(), -distance);
  }

  /** Looks at the target from where the eye is. */
  faceTarget() {
    this.place(this.position.toArray() as Vec3, this.target.toArray() as Vec3);
  }

  direction(): THREE.Vector3 {
    const level = Math.cos(this.pitch);
    return new THREE.Vector3(level * Math.cos(this.yaw), level * Math.sin(this.yaw), Math.sin(this.pitch));
  }

  levelDirection(): THREE.Vector3 {
    return new THREE.Vector3(Math.cos(this.yaw), Math.sin(this.yaw), 0);
  }

  applyTo(camera: THREE.PerspectiveCamera, aspect: number) {
    camera.position.copy(this.position);
    camera.up.copy(this.up ?? new THREE.Vector3(0, 0, 1));
    camera.lookAt(this.position.clone().add(this.direction()));
    const half = Math.tan((this.fov * Math.PI) / 360);
    camera.fov = (360 / Math.PI) * Math.atan(half / aspect);
    camera.aspect = aspect;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld(true);
  }
}
