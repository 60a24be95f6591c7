// The scene of a walk-through: what does not change while its light is refined.

import type { Container } from "./container";

export type Rgb = [number, number, number];
export type Vec3 = [number, number, number];

export interface MaterialEntry {
  name: string;
  type: string;
  colour: Rgb;
  reflection: string | null;
  thetas?: number;
  phis?: number;
  reflectance?: number | Rgb;
  diffuse?: number | Rgb;
  specular?: number | Rgb;
  exponent?: number;
  roughness?: number | [number, number];
  rotation?: number;
  ior?: number;
  internal_transmittance?: number | Rgb;
  facets?: { array: string; cells_per_log: number; average: number };
}

/** A share of light, tabulated evenly in log(1 + cosine / roughness), and its mean under light from everywhere. */
export interface CosineTable {
  values: Float32Array;
  average: number;
  cellsPerLog: number;
}

export interface LightEntry {
  name: string;
  type: string;
  group: number;
  colour: Rgb;
  flux_lm: number;
  points: [number, number];
}

export interface CameraEntry {
  name: string;
  position: Vec3;
  target: Vec3;
  up: Vec3;
  fov: number;
}

export interface SensorEntry {
  name: string;
  type: string;
  position: Vec3;
  normal?: Vec3;
  direction?: Vec3;
}

export interface MeshEntry {
  object: number;
  material: number;
  first: number;
  count: number;
  light: number;
  /** First and number of its coarse triangles, in scenes with many triangles. */
  coarse?: [number, number];
  luminance_cd_m2?: Rgb;
}

export interface SceneHeader {
  name: string;
  stilb: string;
  file: string;
  degree: number;
  bounds: { min: Vec3; max: Vec3 };
  /** sRGB at even steps of the scale, from the least to the most. */
  false_colours: Rgb[];
  materials: MaterialEntry[];
  objects: { name: string }[];
  groups: { name: string }[];
  lights: LightEntry[];
  cameras: CameraEntry[];
  sensors: SensorEntry[];
  meshes: MeshEntry[];
}

export interface LightHeader {
  version: number;
  steps: number;
  error: number;
  elapsed_s: number;
  done: boolean;
}

/** A light vertex that stands for none. */
export const NO_LIGHT_VERTEX = 0xffffffff;

export class Scene {
  readonly header: SceneHeader;
  readonly positions: Float32Array;
  readonly normals: Int16Array;
  readonly triangles: Uint32Array;
  /** For pictures that move; null where `triangles` are few. */
  readonly coarseTriangles: Uint32Array | null;
  /** Illuminance by each light at each vertex, as halves, light by light. */
  readonly direct: Uint16Array;
  readonly directError: Float32Array;
  readonly lightOf: Uint32Array;
  readonly lightWeights: Float32Array;
  readonly lightPositions: Float32Array;
  readonly lightNormals: Int16Array;
  readonly lightAxes: Int16Array;
  readonly lightMaterials: Uint16Array;
  readonly lightTerms: Uint32Array;
  readonly lightPoints: Float32Array;
  readonly reflections: (Float32Array | null)[];
  /** Of each material whose facets have one. */
  readonly facets: (CosineTable | null)[];
  /** The mesh of each vertex; a vertex belongs to one material. */
  readonly meshOfVertex: Uint32Array;

  constructor(container: Container<SceneHeader>) {
    this.header = container.header;
    this.positions = container.floats("positions");
    this.normals = container.signed16("normals");
    this.triangles = container.unsigned("triangles") as Uint32Array;
    this.coarseTriangles = container.has("coarse_triangles")
      ? (container.unsigned("coarse_triangles") as Uint32Array)
      : null;
    this.direct = container.halves("direct");
    this.directError = container.floats("direct_error");
    this.lightOf = container.unsigned("light_of") as Uint32Array;
    this.lightWeights = container.floats("light_weights");
    this.lightPositions = container.floats("light_positions");
    this.lightNormals = container.signed16("light_normals");
    this.lightAxes = container.signed16("light_axes");
    this.lightMaterials = container.unsigned("light_materials") as Uint16Array;
    this.lightTerms = container.unsigned("light_terms") as Uint32Array;
    this.lightPoints = container.floats("light_points");
    this.reflections = this.header.materials.map((material) =>
      material.reflection ? container.floats(material.reflection) : null,
    );
    this.facets = this.header.materials.map(({ facets }) =>
      facets
        ? { values: container.floats(facets.array), average: facets.average, cellsPerLog: facets.cells_per_log }
        : null,
    );
    this.meshOfVertex = this.findMeshes();
  }

  get vertexCount(): number {
    return this.positions.length / 3;
  }

  get lightVertexCount(): number {
    return this.lightPositions.length / 3;
  }

  materialOf(mesh: MeshEntry): MaterialEntry {
    return this.header.materials[mesh.material]!;
  }

  materialOfVertex(vertex: number): MaterialEntry {
    return this.materialOf(this.header.meshes[this.meshOfVertex[vertex]!]!);
  }

  /** The mesh that a triangle belongs to, or undefined. */
  meshOfTriangle(triangle: number): MeshEntry | undefined {
    return this.header.meshes.find(({ first, count }) => triangle >= first && triangle < first + count);
  }

  private findMeshes(): Uint32Array {
    const result = new Uint32Array(this.vertexCount);
    this.header.meshes.forEach((mesh, i) => {
      for (let k = 3 * mesh.first; k < 3 * (mesh.first + mesh.count); ++k) result[this.triangles[k]!] = i;
    });
    return result;
  }
}
