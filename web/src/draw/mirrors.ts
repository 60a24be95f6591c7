// What mirrors, panes and glass show: planes a pass from behind them, curved ones a cube probe.

import * as THREE from "three";

import type { MaterialEntry } from "../data/scene";
import { rgbOf } from "../materials/surface";
import { mirrorCamera, pictureOf, planeOf } from "./planes";
import * as shaders from "./shaders";
import { mirrorUniforms, type Surface, surfaceMaterial, type Surfaces } from "./surfaces";

/** Planes with a pass of their own in one frame, the nearest first; others show a probe. */
const MOST_PASSES = 3;
const MOST_PROBES = 4;
const PROBE_SIZE = 256;

interface Probe {
  position: THREE.Vector3;
  target: THREE.WebGLCubeRenderTarget;
  stale: boolean;
}

interface SpecularSurface {
  surface: Surface;
  plane: THREE.Plane | null;
  /** Of the surface itself (mirrors) and of the passes over it (panes, glass). */
  uniforms: Record<string, THREE.IUniform>[];
  probe: Probe;
  target: THREE.WebGLRenderTarget | null;
}

export class Mirrors {
  /** Passes over the opaque picture: transmittances, then reflections. */
  readonly transmitted = new THREE.Scene();
  readonly reflected = new THREE.Scene();
  private readonly members: SpecularSurface[] = [];
  private readonly probes: Probe[] = [];
  private readonly camera = new THREE.PerspectiveCamera();

  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    private readonly surfaces: Surfaces,
    private readonly floatType: THREE.TextureDataType,
  ) {
    this.camera.matrixAutoUpdate = true;
    for (const surface of surfaces.specular) this.add(surface);
  }

  get exist(): boolean {
    return this.members.length > 0;
  }

  /** After a change of light. */
  invalidate() {
    for (const probe of this.probes) probe.stale = true;
  }

  get hasStaleProbe(): boolean {
    return this.probes.some(({ stale }) => stale);
  }

  /** Draws the oldest stale probe, or all of them. */
  refreshProbes(all: boolean) {
    for (const probe of this.probes) {
      if (!probe.stale) continue;
      this.drawProbe(probe);
      if (!all) return;
    }
  }

  /** Draws what the planes of this picture mirror. */
  refreshPlanes(camera: THREE.PerspectiveCamera, width: number, height: number, finest: boolean) {
    const visible = this.visiblePlanes(camera);
    for (const member of this.members) this.show(member, false);
    const chosen = visible.slice(0, MOST_PASSES);
    for (const member of chosen) this.drawPlane(member, camera, width, height, finest);
    for (const member of chosen) this.show(member, true);
  }

  /** Multiplies and adds what panes and glass do to the opaque picture in the current target. */
  drawOver(camera: THREE.PerspectiveCamera) {
    if (this.transmitted.children.length === 0) return;
    for (const { uniforms } of this.members) for (const set of uniforms) set.uEye!.value.copy(camera.position);
    this.renderer.render(this.transmitted, camera);
    this.renderer.render(this.reflected, camera);
  }

  private add(surface: Surface) {
    const plane = surface.kind === "glass" ? null : planeOf(surface.mesh.geometry);
    const probe = this.probeFor(surface, plane !== null);
    const uniforms: Record<string, THREE.IUniform>[] = [];
    if (surface.kind === "mirror") uniforms.push(surface.mesh.material.uniforms);
    else uniforms.push(...this.addOverlays(surface));
    const member = { surface, plane, uniforms, probe, target: null };
    this.members.push(member);
    const { min, max } = this.surfaces.scene.header.bounds;
    for (const set of uniforms) {
      set.uProbe!.value = probe.target.texture;
      set.uProbePosition!.value.copy(probe.position);
      set.uLow!.value.fromArray(min);
      set.uHigh!.value.fromArray(max);
    }
  }

  private addOverlays(surface: Surface): Record<string, THREE.IUniform>[] {
    const entry = this.surfaces.scene.materialOf(surface.entry);
    const isBody = surface.kind === "glass";
    const through = surfaceMaterial(shaders.TRANSMITTED_FRAGMENT, { SHADED: 1, SLOTS: 0 }, paneUniforms(entry));
    blend(through, THREE.ZeroFactor, THREE.SrcColorFactor);
    const defines: Record<string, number> = isBody ? { SHADED: 1, SLOTS: 0, BODY: 1 } : { SHADED: 1, SLOTS: 0 };
    const over = surfaceMaterial(shaders.REFLECTED_FRAGMENT, defines, paneUniforms(entry));
    blend(over, THREE.OneFactor, THREE.OneFactor);
    this.transmitted.add(this.surfaces.overlay(surface, through));
    this.reflected.add(this.surfaces.overlay(surface, over));
    return [through.uniforms, over.uniforms];
  }

  private visiblePlanes(camera: THREE.PerspectiveCamera): SpecularSurface[] {
    const matrix = pictureMatrix(camera);
    const distance = ({ surface }: SpecularSurface) => surface.mesh.geometry.boundingSphere!.distanceToPoint(camera.position);
    return this.members
      .filter(({ surface, plane }) => {
        if (!plane || plane.distanceToPoint(camera.position) <= 1e-4) return false;
        return pictureOf(surface.mesh.geometry.boundingBox!, camera, matrix) !== null;
      })
      .sort((a, b) => distance(a) - distance(b));
  }

  private drawPlane(
    member: SpecularSurface, camera: THREE.PerspectiveCamera, width: number, height: number, finest: boolean,
  ) {
    const { plane, surface, uniforms } = member;
    mirrorCamera(camera, plane!, this.camera);
    const matrix = pictureMatrix(this.camera);
    const area = pictureOf(surface.mesh.geometry.boundingBox!, this.camera, matrix) ?? new THREE.Box2();
    const target = this.targetOf(member, width, height);
    target.scissorTest = true;
    const low = [Math.floor(area.min.x * width) - 1, Math.floor(area.min.y * height) - 1];
    const high = [Math.ceil(area.max.x * width) + 1, Math.ceil(area.max.y * height) + 1];
    target.scissor.set(low[0]!, low[1]!, high[0]! - low[0]!, high[1]! - low[1]!);
    surface.mesh.visible = false;
    this.surfaces.lookFrom(this.camera.position, finest);
    this.renderer.setRenderTarget(target);
    this.renderer.clear();
    this.renderer.render(this.surfaces.opaque, this.camera);
    surface.mesh.visible = true;
    for (const set of uniforms) {
      set.uMirrorMatrix!.value.copy(matrix);
      set.uMirrored!.value = target.texture;
    }
  }

  private show({ uniforms }: SpecularSurface, planar: boolean) {
    for (const set of uniforms) set.uPlanar!.value = planar;
  }

  private targetOf(member: SpecularSurface, width: number, height: number): THREE.WebGLRenderTarget {
    member.target ??= new THREE.WebGLRenderTarget(width, height, {
      type: this.floatType,
      minFilter: THREE.LinearFilter,
      magFilter: THREE.LinearFilter,
      generateMipmaps: false,
    });
    if (member.target.width !== width || member.target.height !== height) member.target.setSize(width, height);
    return member.target;
  }

  /** Curved bodies have probes of their own, in their middle; planes share one in the middle of the scene. */
  private probeFor(surface: Surface, planar: boolean): Probe {
    const { min, max } = this.surfaces.scene.header.bounds;
    const middle = new THREE.Vector3().fromArray(min).add(new THREE.Vector3().fromArray(max)).multiplyScalar(0.5);
    const position = planar ? middle : surface.mesh.geometry.boundingBox!.getCenter(new THREE.Vector3());
    const near = this.probes.find((probe) => probe.position.distanceTo(position) < 0.05);
    if (near) return near;
    if (this.probes.length >= MOST_PROBES) return this.nearestProbe(position);
    const target = new THREE.WebGLCubeRenderTarget(PROBE_SIZE, {
      type: THREE.HalfFloatType,
      minFilter: THREE.LinearFilter,
      magFilter: THREE.LinearFilter,
      generateMipmaps: false,
    });
    const probe = { position, target, stale: true };
    this.probes.push(probe);
    return probe;
  }

  private nearestProbe(position: THREE.Vector3): Probe {
    return this.probes.reduce((best, probe) =>
      probe.position.distanceTo(position) < best.position.distanceTo(position) ? probe : best);
  }

  private drawProbe(probe: Probe) {
    // A probe cannot show itself while it is drawn, so its own surfaces and all other mirrors are left out.
    for (const { surface } of this.members) surface.mesh.visible = false;
    this.surfaces.lookFrom(probe.position, false);
    const camera = new THREE.PerspectiveCamera(90, 1, 0.02, 1000);
    FACES.forEach(([x, y, z, ux, uy, uz], face) => {
      camera.position.copy(probe.position);
      camera.up.set(ux, uy, uz);
      camera.lookAt(probe.position.x + x, probe.position.y + y, probe.position.z + z);
      camera.updateMatrixWorld(true);
      this.renderer.setRenderTarget(probe.target, face);
      this.renderer.clear();
      this.renderer.render(this.surfaces.opaque, camera);
    });
    for (const { surface } of this.members) surface.mesh.visible = true;
    probe.stale = false;
  }
}

/** Direction and up of each face, as OpenGL lays out cube maps. */
const FACES = [
  [1, 0, 0, 0, -1, 0],
  [-1, 0, 0, 0, -1, 0],
  [0, 1, 0, 0, 0, 1],
  [0, -1, 0, 0, 0, -1],
  [0, 0, 1, 0, -1, 0],
  [0, 0, -1, 0, -1, 0],
] as const;

export function pictureMatrix(camera: THREE.PerspectiveCamera): THREE.Matrix4 {
  return new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
}

function paneUniforms(material: MaterialEntry): Record<string, THREE.IUniform> {
  return {
    ...mirrorUniforms(),
    uIor: { value: material.ior ?? (material.type === "glass" ? 1.5 : 1.52) },
    uInternal: { value: rgbOf(material.internal_transmittance, 1) },
  };
}

function blend(material: THREE.RawShaderMaterial, source: THREE.BlendingSrcFactor, destination: THREE.BlendingDstFactor) {
  material.transparent = true;
  material.depthWrite = false;
  material.blending = THREE.CustomBlending;
  material.blendSrc = source;
  material.blendDst = destination;
}
