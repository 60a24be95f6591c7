// Which lights make highlights on which mesh, and the points that stand for each light.

import { floatFromHalf } from "../data/half";
import type { MeshEntry, Scene } from "../data/scene";
import { kindOf } from "../materials/surface";

/** Lights whose highlights one mesh draws, the strongest first; all others reflect without a highlight. */
export const MOST_SLOTS = 16;

export class Highlights {
  /** Lights by mesh, the strongest first; empty for meshes without gloss. */
  readonly slots: number[][];
  /** The most lights of any mesh, a multiple of 4 for the attributes. */
  readonly width: number;

  constructor(private readonly scene: Scene) {
    this.slots = scene.header.meshes.map((mesh) => this.strongest(mesh));
    const most = Math.max(0, ...this.slots.map((lights) => lights.length));
    this.width = Math.ceil(most / 4) * 4;
  }

  /** Illuminances of each vertex by the lights of its mesh's slots 4 i to 4 i + 3, as halves. */
  attribute(i: number): Uint16Array {
    const { vertexCount, meshOfVertex, direct } = this.scene;
    const result = new Uint16Array(4 * vertexCount);
    for (let vertex = 0; vertex < vertexCount; ++vertex) {
      const lights = this.slots[meshOfVertex[vertex]!]!;
      for (let k = 0; k < 4 && 4 * i + k < lights.length; ++k) {
        result[4 * vertex + k] = direct[lights[4 * i + k]! * vertexCount + vertex]!;
      }
    }
    return result;
  }

  private strongest(mesh: MeshEntry): number[] {
    const { scene } = this;
    if (kindOf(scene.materialOf(mesh)) !== "glossy") return [];
    const sums = scene.header.lights.map((_, light) => ({ light, sum: this.total(mesh, light) }));
    const lit = sums.filter(({ sum }) => sum > 0).sort((a, b) => b.sum - a.sum);
    return lit.slice(0, MOST_SLOTS).map(({ light }) => light);
  }

  private total(mesh: MeshEntry, light: number): number {
    const { triangles, direct, vertexCount, header } = this.scene;
    if (header.lights[light]!.points[1] === 0) return 0;
    let sum = 0;
    for (let k = 3 * mesh.first; k < 3 * (mesh.first + mesh.count); ++k) {
      sum += floatFromHalf[direct[light * vertexCount + triangles[k]!]!]!;
    }
    return sum;
  }
}
