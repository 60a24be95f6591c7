// Planes of mirrors and panes, and the camera behind one.

import * as THREE from "three";

/** The plane of a mesh, with the normal towards its front; null where it is curved. */
export function planeOf(geometry: THREE.BufferGeometry): THREE.Plane | null {
  const index = geometry.index!.array;
  const positions = geometry.attributes.position!;
  const [a, b, c, point] = [0, 1, 2, 3].map(() => new THREE.Vector3());
  const at = (vertex: number, result: THREE.Vector3) => result.fromBufferAttribute(positions, vertex);
  const plane = new THREE.Plane();
  let area = 0;
  const sum = new THREE.Vector3();
  for (let k = 0; k < index.length; k += 3) {
    at(index[k]!, a!);
    at(index[k + 1]!, b!).sub(a!);
    at(index[k + 2]!, c!).sub(a!);
    const cross = b!.cross(c!);
    area += cross.length();
    sum.add(cross);
  }
  if (!(area > 0) || sum.length() < 0.9999 * area) return null;
  plane.setFromNormalAndCoplanarPoint(sum.normalize(), at(index[0]!, point!));
  const tolerance = 1e-3 * geometry.boundingSphere!.radius + 1e-4;
  for (const vertex of index) {
    if (Math.abs(plane.distanceToPoint(at(vertex, point!))) > tolerance) return null;
  }
  return plane;
}

/** Places `result` where `camera` appears in the mirror; what lies behind the plane is clipped. */
export function mirrorCamera(camera: THREE.PerspectiveCamera, plane: THREE.Plane, result: THREE.PerspectiveCamera) {
  const eye = camera.position;
  const forward = new THREE.Vector3(0, 0, -1).applyQuaternion(camera.quaternion);
  const up = new THREE.Vector3(0, 1, 0).applyQuaternion(camera.quaternion);
  result.position.copy(eye).addScaledVector(plane.normal, -2 * plane.distanceToPoint(eye));
  result.up.copy(up.reflect(plane.normal));
  result.lookAt(result.position.clone().add(forward.reflect(plane.normal)));
  result.updateMatrixWorld(true);
  result.projectionMatrix.copy(camera.projectionMatrix);
  clipAt(plane, result);
  result.projectionMatrixInverse.copy(result.projectionMatrix).invert();
}

/** Moves the near plane of a projection into another plane [Lengyel 2005, Oblique view frustum depth projection]. */
function clipAt(plane: THREE.Plane, camera: THREE.PerspectiveCamera) {
  const local = plane.clone().applyMatrix4(camera.matrixWorldInverse);
  const clip = new THREE.Vector4(local.normal.x, local.normal.y, local.normal.z, local.constant);
  const m = camera.projectionMatrix.elements;
  const corner = new THREE.Vector4(
    (Math.sign(clip.x) + m[8]!) / m[0]!, (Math.sign(clip.y) + m[9]!) / m[5]!, -1, (1 + m[10]!) / m[14]!);
  clip.multiplyScalar(2 / clip.dot(corner));
  m[2] = clip.x;
  m[6] = clip.y;
  m[10] = clip.z + 1;
  m[14] = clip.w;
}

/** The part of a camera's picture, in 0 to 1 from its lower left, that a box covers; null where none. */
export function pictureOf(box: THREE.Box3, camera: THREE.PerspectiveCamera, matrix: THREE.Matrix4): THREE.Box2 | null {
  const frustum = new THREE.Frustum().setFromProjectionMatrix(matrix);
  if (!frustum.intersectsBox(box)) return null;
  const result = new THREE.Box2();
  const whole = new THREE.Box2(new THREE.Vector2(0, 0), new THREE.Vector2(1, 1));
  const corner = new THREE.Vector3();
  for (let i = 0; i < 8; ++i) {
    corner.set(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z);
    if (corner.clone().applyMatrix4(camera.matrixWorldInverse).z > -1e-3) return whole;
    corner.applyMatrix4(matrix);
    result.expandByPoint(new THREE.Vector2(0.5 + 0.5 * corner.x, 0.5 + 0.5 * corner.y));
  }
  return result.intersect(whole);
}
