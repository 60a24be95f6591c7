// The scene's geometry for picking and walking: a bounding volume hierarchy over all triangles.

import * as THREE from "three";
import { CENTER, type ExtendedTriangle, MeshBVH } from "three-mesh-bvh";

import type { Scene } from "../data/scene";

export interface Hit {
  triangle: number;
  distance: number;
  point: THREE.Vector3;
  /** Of the triangle, towards its front. */
  normal: THREE.Vector3;
  /** Corners and their weights at the point. */
  vertices: [number, number, number];
  weights: [number, number, number];
}

export class Space {
  readonly bounds: THREE.Box3;
  private readonly bvh: MeshBVH;
  private readonly scene: Scene;

  constructor(scene: Scene) {
    this.scene = scene;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(scene.positions, 3));
    geometry.setIndex(new THREE.BufferAttribute(scene.triangles, 1));
    // Indirect: the triangles keep their order, by which meshes are found.
    this.bvh = new MeshBVH(geometry, { strategy: CENTER, indirect: true });
    const { min, max } = scene.header.bounds;
    this.bounds = new THREE.Box3(new THREE.Vector3(...min), new THREE.Vector3(...max));
  }

  get diagonal(): number {
    return this.bounds.getSize(new THREE.Vector3()).length();
  }

  /** The first triangle that a ray meets on the front, or on any side. */
  cast(origin: THREE.Vector3, direction: THREE.Vector3, side: THREE.Side = THREE.FrontSide, near = 0): Hit | null {
    const ray = new THREE.Ray(origin, direction.clone().normalize());
    const hit = this.bvh.raycastFirst(ray, side, near, Infinity);
    if (!hit || hit.faceIndex === undefined || hit.faceIndex === null) return null;
    return this.hitAt(hit.faceIndex, hit.point, hit.distance);
  }

  /** Moves a capsule out of all triangles; returns by how much. The segment is its axis. */
  pushOut(segment: THREE.Line3, radius: number): THREE.Vector3 {
    const start = segment.start.clone();
    const box = new THREE.Box3().setFromPoints([segment.start, segment.end]).expandByScalar(radius);
    const onTriangle = new THREE.Vector3();
    const onAxis = new THREE.Vector3();
    this.bvh.shapecast({
      intersectsBounds: (bounds) => bounds.intersectsBox(box),
      intersectsTriangle: (triangle: ExtendedTriangle) => {
        const distance = triangle.closestPointToSegment(segment, onTriangle, onAxis);
        if (distance < radius && distance > 1e-6) {
          const push = onAxis.sub(onTriangle).multiplyScalar((radius - distance) / distance);
          segment.start.add(push);
          segment.end.add(push);
        }
        return false;
      },
    });
    return segment.start.clone().sub(start);
  }

  private hitAt(triangle: number, point: THREE.Vector3, distance: number): Hit {
    const { triangles, positions } = this.scene;
    const vertices = [0, 1, 2].map((k) => triangles[3 * triangle + k]!) as [number, number, number];
    const [a, b, c] = vertices.map((vertex) => new THREE.Vector3().fromArray(positions, 3 * vertex));
    const weights = THREE.Triangle.getBarycoord(point, a!, b!, c!, new THREE.Vector3()) ?? new THREE.Vector3(1, 0, 0);
    const normal = THREE.Triangle.getNormal(a!, b!, c!, new THREE.Vector3());
    return { triangle, distance, point: point.clone(), normal, vertices, weights: [weights.x, weights.y, weights.z] };
  }
}
