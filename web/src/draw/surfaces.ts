// The scene's meshes as three.js draws them: shared vertices, one material per mesh with gloss or mirrors.

import * as THREE from "three";

import type { MeshEntry, Scene } from "../data/scene";
import type { Highlights } from "../light/highlights";
import type { LampLevel, LampPoints } from "../light/lamp_points";
import type { Lighting } from "../light/lighting";
import { type Model, modelOf } from "../materials/brdf";
import { type Kind, kindOf, lobeWidth, rgbOf } from "../materials/surface";
import { glossyFragment } from "./glossy_shader";
import * as shaders from "./shaders";

/** Meshes of one look are drawn together up to this many triangles. */
const CHUNK_TRIANGLES = 30000;
/** Levels of detail of a lamp: an angle between its points, as a share of the lobe, that is not seen. */
const POINT_SPACING = 0.35;
/** Of all lamps in a mesh's shader, and of one lamp while the view moves. */
const MOST_POINTS = 64;
const MOST_MOVING_POINTS = 4;

export interface Surface {
  entry: MeshEntry;
  kind: Kind;
  mesh: THREE.Mesh<THREE.BufferGeometry, THREE.RawShaderMaterial>;
  /** For pictures that stand still and that move; the same where there is no gloss. */
  fine: THREE.RawShaderMaterial;
  moving: THREE.RawShaderMaterial;
  slots: number[];
  /** All triangles, and fewer of them with the same shape; the same where there are few. */
  whole: THREE.BufferGeometry;
  coarse: THREE.BufferGeometry;
}

export class Surfaces {
  readonly opaque = new THREE.Scene();
  readonly all: Surface[] = [];
  readonly glossy: Surface[] = [];
  /** Mirrors, panes and glass. */
  readonly specular: Surface[] = [];
  private readonly glow: THREE.BufferAttribute;
  private readonly attributes: Record<string, THREE.BufferAttribute>;
  private readonly models = new Map<number, Model>();
  private readonly tables = new Map<number, THREE.DataTexture>();
  private readonly glossyRange: [number, number];
  /** Whether more than the glossy vertices has to be sent to the graphics card. */
  private allIsNew = true;

  constructor(
    readonly scene: Scene,
    private readonly lighting: Lighting,
    private readonly highlights: Highlights,
    private readonly lamps: LampPoints,
  ) {
    this.glow = new THREE.BufferAttribute(lighting.glow, 3).setUsage(THREE.DynamicDrawUsage);
    this.attributes = {
      position: new THREE.BufferAttribute(scene.positions, 3),
      normal: new THREE.BufferAttribute(scene.normals, 3, true),
      glow: this.glow,
    };
    for (let i = 0; 4 * i < highlights.width; ++i) {
      this.attributes[`slots${i}`] = new THREE.Float16BufferAttribute(highlights.attribute(i), 4);
    }
    this.addMeshes();
    this.glossyRange = this.rangeOfGlossyVertices();
  }

  /** After a change of factors or newer light: all vertices. */
  refreshLight() {
    this.glow.needsUpdate = true;
    this.allIsNew = true;
    for (const surface of this.all) this.setEmission(surface);
    for (const surface of this.glossy) this.setColours(surface);
  }

  /** Before a pass from this eye: what glossy surfaces reflect towards it. */
  lookFrom(eye: THREE.Vector3, finest: boolean) {
    if (this.glossy.length > 0) {
      this.lighting.lookFrom([eye.x, eye.y, eye.z]);
      if (!this.allIsNew) this.glow.addUpdateRange(this.glossyRange[0], this.glossyRange[1] - this.glossyRange[0]);
      this.glow.needsUpdate = true;
      this.allIsNew = false;
    }
    for (const surface of this.glossy) {
      surface.mesh.material = finest ? surface.fine : surface.moving;
      surface.mesh.material.uniforms.uEye?.value.copy(eye);
    }
    for (const { mesh } of this.specular) mesh.material.uniforms.uEye?.value.copy(eye);
  }

  showCoarse(isCoarse: boolean) {
    if (!this.scene.coarseTriangles) return;
    for (const { mesh, whole, coarse } of this.all) mesh.geometry = isCoarse ? coarse : whole;
  }

  /** A mesh of its own for further passes over the same triangles. */
  overlay(surface: Surface, material: THREE.RawShaderMaterial): Surface["mesh"] {
    return new THREE.Mesh(surface.mesh.geometry, material);
  }

  private addMeshes() {
    const plain: MeshEntry[] = [];
    for (const entry of this.scene.header.meshes) {
      if (entry.count === 0) continue;
      const kind = kindOf(this.scene.materialOf(entry));
      const isPlain = (kind === "diffuse" || kind === "black") && entry.light < 0;
      if (isPlain) plain.push(entry);
      else this.add([entry], kind);
    }
    let chunk: MeshEntry[] = [];
    let triangles = 0;
    for (const entry of plain) {
      if (chunk.length > 0 && triangles + entry.count > CHUNK_TRIANGLES) {
        this.add(chunk, "diffuse");
        [chunk, triangles] = [[], 0];
      }
      chunk.push(entry);
      triangles += entry.count;
    }
    if (chunk.length > 0) this.add(chunk, "diffuse");
  }

  private add(entries: MeshEntry[], kind: Kind) {
    const entry = entries[0]!;
    const slots = kind === "glossy" ? this.highlights.slots[this.scene.header.meshes.indexOf(entry)]! : [];
    const geometry = this.geometryOf(this.scene.triangles, entries.map(({ first, count }) => [first, count]));
    const lobe = lobeWidth(this.scene.materialOf(entry));
    const materialWith = (most: number) => {
      const levels = slots.map((light) => this.levelOf(light, geometry.boundingBox!, lobe, most));
      return this.materialOf(entry, kind, slots, levels);
    };
    const fine = materialWith(pointsPerLamp(slots.length));
    const moving = slots.length > 0 ? materialWith(MOST_MOVING_POINTS) : fine;
    const mesh = new THREE.Mesh(geometry, fine);
    const surface = { entry, kind, mesh, fine, moving, slots, whole: geometry, coarse: this.coarseOf(entries) ?? geometry };
    this.all.push(surface);
    if (kind === "glossy") this.glossy.push(surface);
    if (kind === "mirror" || kind === "pane" || kind === "glass") this.specular.push(surface);
    if (kind !== "pane" && kind !== "glass") this.opaque.add(surface.mesh);
    this.setEmission(surface);
    this.setColours(surface);
  }

  private coarseOf(entries: MeshEntry[]): THREE.BufferGeometry | null {
    const { coarseTriangles } = this.scene;
    return coarseTriangles && this.geometryOf(coarseTriangles, entries.map(({ coarse }) => coarse!));
  }

  /** `parts`: first and number of triangles. */
  private geometryOf(triangles: Uint32Array, parts: [number, number][]): THREE.BufferGeometry {
    const geometry = new THREE.BufferGeometry();
    for (const [name, attribute] of Object.entries(this.attributes)) geometry.setAttribute(name, attribute);
    const total = parts.reduce((sum, [, count]) => sum + count, 0);
    const index = new Uint32Array(3 * total);
    let at = 0;
    for (const [first, count] of parts) {
      index.set(triangles.subarray(3 * first, 3 * (first + count)), at);
      at += 3 * count;
    }
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
    geometry.boundingBox = boxOf(this.scene.positions, index);
    geometry.boundingSphere = geometry.boundingBox.getBoundingSphere(new THREE.Sphere());
    return geometry;
  }

  private materialOf(entry: MeshEntry, kind: Kind, slots: number[], levels: LampLevel[]): THREE.RawShaderMaterial {
    const material = this.scene.materialOf(entry);
    if (kind === "mirror") {
      return surfaceMaterial(shaders.MIRROR_FRAGMENT, { SHADED: 1, SLOTS: 0 }, {
        ...mirrorUniforms(),
        uReflectance: { value: rgbOf(material.reflectance) },
      });
    }
    if (kind !== "glossy" || slots.length === 0) return surfaceMaterial(shaders.DIFFUSE_FRAGMENT, { SLOTS: 0 }, {});
    return this.glossyMaterial(entry.material, slots, levels);
  }

  private glossyMaterial(index: number, slots: number[], levels: LampLevel[]): THREE.RawShaderMaterial {
    const model = this.models.get(index) ?? modelOf(this.scene.header.materials[index]!, this.scene.facets[index]!);
    this.models.set(index, model);
    const points = levels.flatMap((level) => this.lamps.pointsOf(level));
    const uniforms: Record<string, THREE.IUniform> = {
      uEye: { value: new THREE.Vector3() },
      uLamps: { value: new Float32Array(points.flatMap(({ position, weight }) => [...position, weight])) },
      uFronts: { value: new Float32Array(points.flatMap(({ normal }) => normal)) },
      uColours: { value: new Float32Array(3 * slots.length) },
      uMiddles: { value: new Float32Array(slots.flatMap((light) => this.lamps.lamps[light]!.middle)) },
    };
    for (const [name, value] of Object.entries(model.parameters)) uniforms[name] = { value };
    if (model.table) uniforms.uTable = { value: this.tableOf(index, model.table.values) };
    const fragment = glossyFragment(model, levels.map(({ count }) => count));
    return surfaceMaterial(fragment, { SHADED: 1, SLOTS: slots.length }, uniforms);
  }

  private tableOf(index: number, values: Float32Array): THREE.DataTexture {
    const texture = this.tables.get(index) ?? tableTexture(values);
    this.tables.set(index, texture);
    return texture;
  }

  private setEmission({ entry, fine, moving }: Surface) {
    if (entry.light < 0) return;
    const factor = this.lighting.factorOf(entry.light);
    const emission = (entry.luminance_cd_m2 ?? [0, 0, 0]).map((value, b) => value * factor[b]!);
    for (const { uniforms } of [fine, moving]) if (uniforms.uEmission) uniforms.uEmission.value = emission;
  }

  private setColours({ fine, moving, slots }: Surface) {
    for (const { uniforms } of [fine, moving]) {
      slots.forEach((light, i) => uniforms.uColours!.value.set(this.lighting.colourOf(light), 3 * i));
    }
  }

  /** So many points of a lamp that the gaps between them are not seen in the lobe of a mesh. */
  private levelOf(light: number, box: THREE.Box3, lobe: number, most: number): LampLevel {
    const { levels, middle, radius } = this.lamps.lamps[light]!;
    const apart = box.distanceToPoint(new THREE.Vector3(...middle));
    const seen = radius / Math.max(apart, 0.5 * radius, 1e-3);
    const possible = levels.filter(({ count }) => count <= most);
    return possible.find(({ count }) => seen / Math.sqrt(count) < POINT_SPACING * lobe) ?? possible.at(-1)!;
  }

  private rangeOfGlossyVertices(): [number, number] {
    let [low, high] = [Infinity, 0];
    for (const { entry } of this.glossy) {
      for (let k = 3 * entry.first; k < 3 * (entry.first + entry.count); ++k) {
        const vertex = this.scene.triangles[k]!;
        low = Math.min(low, vertex);
        high = Math.max(high, vertex + 1);
      }
    }
    return [3 * Math.min(low, high), 3 * high];
  }
}

export function surfaceMaterial(
  fragmentShader: string,
  defines: Record<string, number>,
  uniforms: Record<string, THREE.IUniform>,
): THREE.RawShaderMaterial {
  return new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: shaders.SURFACE_VERTEX,
    fragmentShader,
    defines,
    uniforms: { uEmission: { value: [0, 0, 0] }, ...uniforms },
    side: THREE.FrontSide,
    toneMapped: false,
  });
}

export function mirrorUniforms(): Record<string, THREE.IUniform> {
  return {
    uEye: { value: new THREE.Vector3() },
    uPlanar: { value: false },
    uMirrorMatrix: { value: new THREE.Matrix4() },
    uMirrored: { value: null },
    uProbe: { value: null },
    uProbePosition: { value: new THREE.Vector3() },
    uLow: { value: new THREE.Vector3() },
    uHigh: { value: new THREE.Vector3() },
  };
}

function boxOf(positions: Float32Array, index: Uint32Array): THREE.Box3 {
  const box = new THREE.Box3();
  const point = new THREE.Vector3();
  for (const vertex of index) box.expandByPoint(point.fromArray(positions, 3 * vertex));
  return box;
}

/** Within the uniforms that every WebGL2 has. */
function pointsPerLamp(slots: number): number {
  return [64, 16, 4, 1].find((count) => count * slots <= MOST_POINTS) ?? 1;
}

function tableTexture(values: Float32Array): THREE.DataTexture {
  return dataTexture(values, values.length, 1, THREE.RedFormat);
}

function dataTexture(
  values: Float32Array, width: number, height: number, format: THREE.PixelFormat,
): THREE.DataTexture {
  const texture = new THREE.DataTexture(values as Float32Array<ArrayBuffer>, width, height, format, THREE.FloatType);
  texture.needsUpdate = true;
  return texture;
}
