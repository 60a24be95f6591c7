// The light of a scene under the chosen factors: illuminances and luminances of vertices.

import type { Container } from "../data/container";
import { floatFromHalf } from "../data/half";
import { type LightHeader, NO_LIGHT_VERTEX, type Rgb, type Scene } from "../data/scene";
import { flatReflectance, kindOf } from "../materials/surface";
import type { Highlights } from "./highlights";
import { luminance } from "./luminance";
import { ReflectedLight } from "./reflection";

const INV_PI = 1 / Math.PI;
const SQRT_PI = Math.sqrt(Math.PI);

/** Light that was reflected before: values, and half-widths of their 95 % intervals. */
export interface StoredLight {
  illuminance: number;
  error: number;
  luminance: number;
  luminanceError: number;
}

export class Lighting {
  /** By group. */
  readonly factors: Rgb[];
  /** Direct illuminance of vertices, rgb [lx]. */
  readonly direct: Float32Array;
  /** Luminance of vertices without highlights and emission, rgb [cd/m2]: what a drawing interpolates. */
  readonly glow: Float32Array;
  header: LightHeader | null = null;

  /** All groups together: rgb of each term. */
  private readonly terms: Float32Array;
  private groupTerms: Uint16Array | null = null;
  private relativeError: Float32Array;
  /** Of light vertices, towards the eye [cd/m2]. */
  private readonly reflected: Float32Array;
  /** Luminance of glossy vertices by lights without a highlight. */
  private readonly rest: Float32Array;
  private readonly reflection: ReflectedLight;
  private readonly glossyVertices: number[] = [];
  private eye: readonly number[] = [0, 0, 0];

  constructor(
    readonly scene: Scene,
    private readonly highlights: Highlights,
  ) {
    const { vertexCount, lightVertexCount, header } = scene;
    this.factors = header.groups.map(() => [1, 1, 1]);
    this.direct = new Float32Array(3 * vertexCount);
    this.glow = new Float32Array(3 * vertexCount);
    this.rest = new Float32Array(3 * vertexCount);
    this.reflected = new Float32Array(3 * lightVertexCount);
    this.relativeError = new Float32Array(lightVertexCount);
    this.terms = new Float32Array(3 * (scene.lightTerms[lightVertexCount] ?? 0));
    this.reflection = new ReflectedLight(scene);
    for (let vertex = 0; vertex < vertexCount; ++vertex) {
      if (kindOf(scene.materialOfVertex(vertex)) === "glossy") this.glossyVertices.push(vertex);
    }
    this.refreshDirect();
  }

  /** Whether any luminance changes with the eye besides highlights. */
  get dependsOnEye(): boolean {
    return this.reflection.glossy.length > 0;
  }

  /** Takes newer light; the factors stay. */
  receive(container: Container<LightHeader>) {
    const groupTerms = container.halves("terms");
    if (groupTerms.length !== this.terms.length * this.factors.length) {
      throw new Error("the light belongs to another scene: reload the page");
    }
    this.groupTerms = groupTerms;
    this.relativeError = container.floats("terms_error");
    this.header = container.header;
    this.refreshReflected();
  }

  /** Changes the factor of a group, or of the group that a light shines in alone. */
  set(name: string, factor: number | readonly number[]) {
    const values = Array.isArray(factor) ? factor : [factor, factor, factor];
    if (values.length !== 3 || !values.every((value) => Number.isFinite(value) && value >= 0)) {
      throw new Error(`the factor of ${name} must be a number, or three, not below 0`);
    }
    this.factors[this.groupOf(name)] = [...values] as Rgb;
    this.refreshDirect();
    this.refreshReflected();
  }

  /** The colour and factor of a light, and of its emission. */
  factorOf(light: number): Rgb {
    return this.factors[this.scene.header.lights[light]!.group]!;
  }

  colourOf(light: number): Rgb {
    const { colour } = this.scene.header.lights[light]!;
    const factor = this.factorOf(light);
    return [colour[0] * factor[0], colour[1] * factor[1], colour[2] * factor[2]];
  }

  /** Updates `glow` of glossy vertices for another eye. */
  lookFrom(eye: readonly number[]) {
    this.eye = [...eye];
    this.reflection.towards(eye, this.terms, this.reflected);
    for (const vertex of this.glossyVertices) {
      for (let b = 0; b < 3; ++b) this.glow[3 * vertex + b] = this.rest[3 * vertex + b]!;
      this.addReflected(vertex);
    }
  }

  /** Interpolated stored light at a vertex: illuminance, luminance towards the last eye, and errors. */
  storedAt(vertex: number): StoredLight {
    const { lightOf, lightWeights, lightTerms } = this.scene;
    const sum = { illuminance: 0, error: 0, luminance: 0, luminanceError: 0 };
    for (let k = 3 * vertex; k < 3 * vertex + 3; ++k) {
      const lightVertex = lightOf[k]!;
      if (lightVertex === NO_LIGHT_VERTEX) continue;
      const weight = lightWeights[k]!;
      const illuminance = SQRT_PI * luminanceAt(this.terms, lightTerms[lightVertex]!);
      sum.illuminance += weight * illuminance;
      const relativeError = this.relativeError[lightVertex]!;
      sum.error += weight * illuminance * relativeError;
      sum.luminance += weight * luminanceAt(this.reflected, lightVertex);
      sum.luminanceError += weight * relativeError * this.inQuadrature(lightVertex);
    }
    return sum;
  }

  private inQuadrature(lightVertex: number): number {
    const isGlossy = this.scene.reflections[this.scene.lightMaterials[lightVertex]!];
    return isGlossy ? this.reflection.inQuadrature(lightVertex, this.eye, this.terms) : luminanceAt(this.reflected, lightVertex);
  }

  /** Direct illuminance of a vertex with all lights at their full flux [lx]. */
  directAtFactorOne(vertex: number): number {
    const { direct, vertexCount, header } = this.scene;
    return header.lights.reduce((sum, _, light) => sum + floatFromHalf[direct[light * vertexCount + vertex]!]!, 0);
  }

  private groupOf(name: string): number {
    const { groups, lights } = this.scene.header;
    const group = groups.findIndex((entry) => entry.name === name);
    if (group >= 0) return group;
    const light = lights.find((entry) => entry.name === name);
    if (!light) throw new Error(`there is no light or group "${name}"`);
    if (lights.filter((entry) => entry.group === light.group).length > 1) {
      const whole = groups[light.group]!.name;
      throw new Error(`light "${name}" is solved together with others: set its group "${whole}"`);
    }
    return light.group;
  }

  private refreshDirect() {
    const { header, vertexCount, direct } = this.scene;
    this.direct.fill(0);
    header.lights.forEach((_, light) => {
      const [r, g, b] = this.colourOf(light);
      const first = light * vertexCount;
      for (let i = 0; i < vertexCount; ++i) {
        const lux = floatFromHalf[direct[first + i]!]!;
        if (lux === 0) continue;
        this.direct[3 * i]! += r * lux;
        this.direct[3 * i + 1]! += g * lux;
        this.direct[3 * i + 2]! += b * lux;
      }
    });
    this.refreshRest();
  }

  /** What lights beyond a mesh's slots add to its glossy vertices. */
  private refreshRest() {
    const { scene, highlights } = this;
    const { direct, vertexCount, meshOfVertex } = scene;
    this.rest.fill(0);
    if (scene.header.lights.length === 0) return;
    const colours = scene.header.lights.map((_, light) => this.colourOf(light));
    for (const vertex of this.glossyVertices) {
      const slots = highlights.slots[meshOfVertex[vertex]!]!;
      if (slots.length === colours.length) continue;
      const reflectance = flatReflectance(scene.materialOfVertex(vertex));
      colours.forEach((colour, light) => {
        if (slots.includes(light)) return;
        const lux = floatFromHalf[direct[light * vertexCount + vertex]!]!;
        for (let b = 0; b < 3; ++b) this.rest[3 * vertex + b]! += reflectance[b]! * INV_PI * colour[b]! * lux;
      });
    }
  }

  private refreshReflected() {
    this.sumGroups();
    this.reflectDiffusely();
    const { scene } = this;
    for (let vertex = 0; vertex < scene.vertexCount; ++vertex) {
      const material = scene.materialOfVertex(vertex);
      if (kindOf(material) !== "diffuse") continue;
      const reflectance = flatReflectance(material);
      for (let b = 0; b < 3; ++b) {
        this.glow[3 * vertex + b] = reflectance[b]! * INV_PI * this.direct[3 * vertex + b]!;
      }
      this.addReflected(vertex);
    }
  }

  private sumGroups() {
    this.terms.fill(0);
    if (!this.groupTerms) return;
    const length = this.terms.length;
    this.factors.forEach((factor, group) => {
      const first = group * length;
      for (let k = 0; k < length; ++k) {
        this.terms[k]! += factor[k % 3]! * floatFromHalf[this.groupTerms![first + k]!]!;
      }
    });
  }

  private reflectDiffusely() {
    const { lightVertexCount, lightTerms, lightMaterials, header } = this.scene;
    const reflectances = header.materials.map(flatReflectance);
    for (let i = 0; i < lightVertexCount; ++i) {
      const reflectance = reflectances[lightMaterials[i]!]!;
      const term = 3 * lightTerms[i]!;
      for (let b = 0; b < 3; ++b) this.reflected[3 * i + b] = (reflectance[b]! / SQRT_PI) * this.terms[term + b]!;
    }
  }

  private addReflected(vertex: number) {
    const { lightOf, lightWeights } = this.scene;
    for (let k = 3 * vertex; k < 3 * vertex + 3; ++k) {
      const lightVertex = lightOf[k]!;
      if (lightVertex === NO_LIGHT_VERTEX) continue;
      const weight = lightWeights[k]!;
      for (let b = 0; b < 3; ++b) this.glow[3 * vertex + b]! += weight * this.reflected[3 * lightVertex + b]!;
    }
  }
}

function luminanceAt(rgb: Float32Array, index: number): number {
  return luminance(rgb, 3 * index);
}
