// Scenes for tests, lit by formulas: unshadowed lights and a constant indirect light.
import { packContainer } from "./container.mjs";
import { facetTable } from "./facets.mjs";

export const DEGREE = 6;
export const TERMS = ((DEGREE + 1) * (DEGREE + 2)) / 2;
const THETAS = 33;
const NONE = 0xffffffff;
const GLOSSY = ["phong", "rough", "ward", "plastic"];

const sub = (a, b) => a.map((x, i) => x - b[i]);
const add = (a, b) => a.map((x, i) => x + b[i]);
const scaled = (a, s) => a.map((x) => x * s);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => scaled(a, 1 / Math.sqrt(dot(a, a)));
export const vec = { sub, add, scaled, dot, cross, unit };

/** The x axis of a material's frame (Frame::of_surface). */
export function axisOf(normal) {
  const level = Math.hypot(normal[0], normal[1]);
  return level > 1e-5 ? [-normal[1] / level, normal[0] / level, 0] : unit(sub([1, 0, 0], scaled(normal, normal[0])));
}

/** The table of a made-up material: F_0 = albedo / sqrt(pi), F_(1,1) = tilt sin(theta). */
export function tableValue(k, theta, { albedo, tilt }) {
  if (k === 0) return albedo / Math.sqrt(Math.PI);
  return k === 2 ? tilt * Math.sin(theta) : 0;
}

export class SyntheticScene {
  header = {
    name: "Synthetic room", stilb: "0.1.0", file: "synthetic.toml", degree: DEGREE, bounds: null,
    false_colours: Array.from({ length: 257 }, (_, i) => Array(3).fill(Math.min(i, 255))),
    materials: [], objects: [], groups: [], lights: [], cameras: [], sensors: [], meshes: [],
  };
  positions = [];
  normals = [];
  triangles = [];
  coarseTriangles = null;
  lightPoints = [];
  vertexMaterials = [];
  /** Indirect light of all surfaces: illuminance [lx], and the terms (1, 1) and (1, -1). */
  indirect = { illuminance: 60, cosine: 0, sine: 0 };

  material(entry) {
    const rgb = (value) => (Array.isArray(value) ? value : [value, value, value]);
    const lobe = rgb(entry.specular ?? 0);
    const colour = rgb(entry.reflectance ?? entry.diffuse ?? 0.5).map((share, b) => share + lobe[b]);
    this.header.materials.push({ colour, reflection: null, ...entry });
    return this.header.materials.length - 1;
  }

  object(name) {
    this.header.objects.push({ name });
    return this.header.objects.length - 1;
  }

  /** A light of some points, each {position, normal, weight}; intensity [cd] towards the normal, or to all sides. */
  light(name, intensity, points, colour = [1, 1, 1]) {
    const first = this.lightPoints.length;
    this.lightPoints.push(...points);
    this.header.groups.push({ name });
    this.header.lights.push({
      name, type: points.length > 1 ? "area" : "point", group: this.header.groups.length - 1, colour,
      flux_lm: intensity * 4 * Math.PI, points: [first, points.length], intensity,
    });
    return this.header.lights.length - 1;
  }

  /** The front of a rectangle, u x v, in n x m cells. */
  quad(object, material, corner, u, v, n = 8, m = n, more = {}) {
    const normal = unit(cross(u, v));
    const first = this.positions.length;
    for (let j = 0; j <= m; ++j) {
      for (let i = 0; i <= n; ++i) {
        this.positions.push(add(corner, add(scaled(u, i / n), scaled(v, j / m))));
        this.normals.push(normal);
        this.vertexMaterials.push(material);
      }
    }
    const mesh = { object, material, first: this.triangles.length, count: 2 * n * m, light: -1, ...more };
    for (let j = 0; j < m; ++j) {
      for (let i = 0; i < n; ++i) {
        const a = first + j * (n + 1) + i;
        const c = a + n + 1;
        this.triangles.push([a, a + 1, c + 1], [a, c + 1, c]);
      }
    }
    this.header.meshes.push(mesh);
  }

  /** All six sides, seen from outside, or from inside of a room. */
  box(object, material, low, high, n = 4, inside = false) {
    const [x, y, z] = sub(high, low);
    const faces = [
      [low, [0, y, 0], [x, 0, 0]], [[low[0], low[1], high[2]], [x, 0, 0], [0, y, 0]],
      [low, [x, 0, 0], [0, 0, z]], [[low[0], high[1], low[2]], [0, 0, z], [x, 0, 0]],
      [low, [0, 0, z], [0, y, 0]], [[high[0], low[1], low[2]], [0, y, 0], [0, 0, z]],
    ];
    for (const [corner, u, v] of faces) {
      if (inside) this.quad(object, material, corner, v, u, n);
      else this.quad(object, material, corner, u, v, n);
    }
  }

  /** A box whose six sides are one mesh, which no plane contains. */
  body(object, material, low, high) {
    const first = this.triangles.length;
    const meshes = this.header.meshes.length;
    this.box(object, material, low, high, 2);
    this.header.meshes.length = meshes;
    this.header.meshes.push({ object, material, first, count: this.triangles.length - first, light: -1 });
  }

  /** For pictures that move, every n-th triangle of each mesh: full of holes, but few. */
  thin(n) {
    this.coarseTriangles = [];
    for (const mesh of this.header.meshes) {
      const own = this.triangles.slice(mesh.first, mesh.first + mesh.count).filter((_, i) => i % n === 0);
      mesh.coarse = [this.coarseTriangles.length, own.length];
      this.coarseTriangles.push(...own);
    }
  }

  illuminance(light, position, normal) {
    const { points: [first, count], intensity } = this.header.lights[light];
    return this.lightPoints.slice(first, first + count).reduce((sum, point) => {
      const apart = sub(point.position, position);
      const distance = Math.sqrt(dot(apart, apart));
      const cosine = Math.max(dot(normal, apart) / distance, 0);
      const front = dot(point.normal, point.normal) > 0 ? Math.max(-dot(point.normal, apart) / distance, 0) : 1;
      return sum + (point.weight * intensity * cosine * front) / distance ** 2;
    }, 0);
  }

  sceneData() {
    const { header, positions, normals } = this;
    const all = [0, 1, 2].map((i) => positions.map((p) => p[i]));
    const least = (values) => values.reduce((a, b) => Math.min(a, b));
    const most = (values) => values.reduce((a, b) => Math.max(a, b));
    header.bounds = { min: all.map(least), max: all.map(most) };
    const flat = (rows) => rows.flat();
    const s16 = (rows) => rows.flat().map((x) => Math.round(x * 32767));
    const stored = this.storedVertices();
    const lightOf = positions.map((_, i) => [stored.indexOf.get(i) ?? NONE, NONE, NONE]);
    const direct = header.lights.map((_, light) => positions.map((p, i) => this.illuminance(light, p, normals[i])));
    const arrays = {
      positions: { type: "f32", components: 3, values: flat(positions), planes: true },
      normals: { type: "s16", components: 3, values: s16(normals), planes: true },
      triangles: { type: "u32", components: 3, values: flat(this.triangles), planes: true },
      direct: { type: "f16", values: flat(direct), planes: true },
      direct_error: { type: "f16", values: positions.map((_, i) => 0.01 * direct.reduce((sum, row) => sum + row[i], 0)) },
      light_of: { type: "u32", components: 3, values: flat(lightOf) },
      light_weights: { type: "f16", components: 3, values: flat(positions.map(() => [1, 0, 0])) },
      light_positions: { type: "f32", components: 3, values: flat(stored.vertices.map((i) => positions[i])) },
      light_normals: { type: "s16", components: 3, values: s16(stored.vertices.map((i) => normals[i])) },
      light_axes: { type: "s16", components: 3, values: s16(stored.vertices.map((i) => axisOf(normals[i]))) },
      light_materials: { type: "u16", values: stored.vertices.map((i) => this.vertexMaterials[i]) },
      light_terms: { type: "u32", values: stored.firstTerms },
      light_points: { type: "f32", components: 8, values: flat(this.lightPoints.map((p) => [...p.position, ...p.normal, p.weight, 0])) },
    };
    if (this.coarseTriangles) {
      arrays.coarse_triangles = { type: "u32", components: 3, values: flat(this.coarseTriangles), planes: true };
    }
    header.materials.forEach((material, i) => {
      if (!GLOSSY.includes(material.type)) return;
      if (material.type === "rough" || material.type === "plastic") {
        const { values, ...numbers } = facetTable(material.roughness, material.ior);
        material.facets = { array: `facets_${i}`, ...numbers };
        arrays[material.facets.array] = { type: "f32", values };
      }
      material.reflection = `reflection_${i}`;
      Object.assign(material, { thetas: THETAS, phis: 1 });
      arrays[material.reflection] = { type: "f32", components: 3, values: tableOf(material.made_up ?? { albedo: 0.4, tilt: 0 }) };
    });
    return packContainer(header, arrays);
  }

  /** One set of terms for all surfaces, divided evenly among the groups. */
  lightData(version = 1, strength = 1) {
    const stored = this.storedVertices();
    const groups = Math.max(this.header.groups.length, 1);
    const terms = [];
    for (let group = 0; group < groups; ++group) {
      for (const vertex of stored.vertices) {
        for (let k = 0; k < this.termsOf(vertex); ++k) {
          const value = (strength * this.term(k)) / groups;
          terms.push(value, value, value);
        }
      }
    }
    const header = { version, steps: 64 * version, error: 0.05 / version, elapsed_s: version, done: false };
    return packContainer(header, {
      terms: { type: "f16", components: 3, values: terms, planes: true },
      terms_error: { type: "f16", values: stored.vertices.map(() => 0.02) },
    });
  }

  term(k) {
    if (k === 0) return this.indirect.illuminance / Math.sqrt(Math.PI);
    return k === 2 ? this.indirect.cosine : k === 1 ? this.indirect.sine : 0;
  }

  termsOf(vertex) {
    return GLOSSY.includes(this.header.materials[this.vertexMaterials[vertex]].type) ? TERMS : 1;
  }

  storedVertices() {
    const vertices = this.positions
      .map((_, i) => i)
      .filter((i) => ["diffuse", ...GLOSSY].includes(this.header.materials[this.vertexMaterials[i]].type));
    const firstTerms = [0];
    for (const vertex of vertices) firstTerms.push(firstTerms.at(-1) + this.termsOf(vertex));
    return { vertices, firstTerms, indexOf: new Map(vertices.map((vertex, i) => [vertex, i])) };
  }
}

function tableOf(madeUp) {
  const values = [];
  for (let t = 0; t < THETAS; ++t) {
    const theta = t === THETAS - 1 ? Math.PI / 2 - Math.PI / 1800 : ((t / (THETAS - 1)) * Math.PI) / 2;
    for (let k = 0; k < TERMS; ++k) {
      const value = tableValue(k, theta, madeUp);
      values.push(value, value, value);
    }
  }
  return values;
}

const bulb = (position) => [{ position, normal: [0, 0, 0], weight: 1 }];

/** A square lamp of n x n points that shines downwards. */
export function panelPoints(middle, size, n = 4) {
  const at = (i) => size * ((i + 0.5) / n - 0.5);
  return Array.from({ length: n * n }, (_, i) => ({
    position: [middle[0] + at(i % n), middle[1] + at(Math.floor(i / n)), middle[2]], normal: [0, 0, -1], weight: 1 / n ** 2,
  }));
}

/** 6 m x 4 m x 3 m with a glossy box, a mirror, a pane, and one bulb. */
export function testRoom() {
  const scene = new SyntheticScene();
  const floor = scene.material({ name: "carpet", type: "diffuse", reflectance: [0.3, 0.3, 0.3] });
  const wall = scene.material({ name: "plaster", type: "diffuse", reflectance: [0.6, 0.6, 0.6] });
  const red = scene.material({ name: "red paint", type: "diffuse", reflectance: [0.6, 0.1, 0.1] });
  const lacquer = scene.material({
    name: "lacquer", type: "phong", diffuse: [0.2, 0.3, 0.4], specular: 0.3, exponent: 40, made_up: { albedo: 0.5, tilt: 0.2 },
  });
  const silver = scene.material({ name: "silver", type: "mirror", reflectance: 0.9 });
  const glazing = scene.material({ name: "glazing", type: "pane", ior: 1.52, internal_transmittance: 0.96 });
  const room = scene.object("room");
  scene.quad(room, floor, [0, 0, 0], [6, 0, 0], [0, 4, 0], 60, 40);
  scene.quad(room, wall, [0, 4, 3], [6, 0, 0], [0, -4, 0], 30, 20);
  scene.quad(room, wall, [0, 0, 3], [6, 0, 0], [0, 0, -3], 30, 15);
  scene.quad(room, wall, [6, 4, 3], [-6, 0, 0], [0, 0, -3], 30, 15);
  scene.quad(room, red, [0, 4, 3], [0, -4, 0], [0, 0, -3], 20, 15);
  scene.quad(room, wall, [6, 0, 3], [0, 4, 0], [0, 0, -3], 20, 15);
  scene.box(scene.object("cupboard"), lacquer, [2.2, 2.6, 0], [3.4, 3.4, 1], 10);
  const mirror = scene.object("mirror");
  scene.quad(mirror, silver, [5.98, 1.2, 0.6], [0, 0, 1.6], [0, 1.6, 0], 1);
  const pane = scene.object("pane");
  scene.quad(pane, glazing, [1.2, 2.2, 0], [0, 0, 2.2], [0, 1.4, 0], 1);
  scene.quad(pane, glazing, [1.2, 2.2, 0], [0, 1.4, 0], [0, 0, 2.2], 1);
  scene.light("bulb", 120, bulb([3, 1.4, 2.6]));
  scene.light("spot", 60, bulb([1, 1, 2.2]), [1.2, 0.97, 0.7]);
  scene.indirect = { illuminance: 60, cosine: 8, sine: 5 };
  scene.header.cameras.push(
    { name: "door", position: [0.4, 0.4, 1.6], target: [4, 3, 0.8], up: [0, 0, 1], fov: 80 },
    { name: "window", position: [5.2, 0.6, 1.6], target: [2.6, 3, 0.8], up: [0, 0, 1], fov: 70 },
  );
  scene.header.sensors.push({ name: "desk", type: "illuminance", position: [3, 2, 0.01], normal: [0, 0, 1] });
  return scene;
}

/** About 60 000 triangles: a room with glossy and matt furniture and four lamps of 16 points. */
export function furnishedRoom(cells = 11) {
  const scene = new SyntheticScene();
  const parquet = scene.material({ name: "parquet", type: "phong", diffuse: [0.35, 0.25, 0.15], specular: 0.1, exponent: 30, made_up: { albedo: 0.36, tilt: 0 } });
  const paint = scene.material({ name: "paint", type: "diffuse", reflectance: [0.7, 0.7, 0.66] });
  const matt = scene.material({ name: "cloth", type: "diffuse", reflectance: [0.2, 0.3, 0.45] });
  const gloss = scene.material({ name: "varnish", type: "phong", diffuse: [0.4, 0.25, 0.12], specular: 0.2, exponent: 60, made_up: { albedo: 0.45, tilt: 0 } });
  const lamp = scene.material({ name: "lamp", type: "diffuse", reflectance: [0.5, 0.5, 0.5] });
  const room = scene.object("room");
  scene.quad(room, parquet, [0, 0, 0], [8, 0, 0], [0, 6, 0], 64, 48);
  scene.quad(room, paint, [0, 6, 3], [8, 0, 0], [0, -6, 0], 64, 48);
  scene.quad(room, paint, [0, 0, 3], [8, 0, 0], [0, 0, -3], 64, 24);
  scene.quad(room, paint, [8, 6, 3], [-8, 0, 0], [0, 0, -3], 64, 24);
  scene.quad(room, paint, [0, 6, 3], [0, -6, 0], [0, 0, -3], 48, 24);
  scene.quad(room, paint, [8, 0, 3], [0, 6, 0], [0, 0, -3], 48, 24);
  for (let i = 0; i < 28; ++i) {
    const x = 0.6 + (i % 7) * 1.05;
    const y = 0.8 + Math.floor(i / 7) * 1.3;
    const height = 0.4 + 0.2 * ((i * 7) % 5);
    scene.box(scene.object(`piece ${i + 1}`), i % 2 ? gloss : matt, [x, y, 0], [x + 0.6, y + 0.7, height], cells);
  }
  for (let i = 0; i < 4; ++i) {
    const middle = [2 + 4 * (i % 2), 1.5 + 3 * Math.floor(i / 2), 2.98];
    const light = scene.light(`lamp ${i + 1}`, 900, panelPoints(middle, 0.6));
    scene.quad(scene.object(`lamp ${i + 1}`), lamp, [middle[0] - 0.3, middle[1] + 0.3, 2.98], [0.6, 0, 0], [0, -0.6, 0], 2, 2, {
      light, luminance_cd_m2: [2500, 2500, 2500],
    });
  }
  scene.header.cameras.push({ name: "view", position: [0.4, 0.4, 1.7], target: [5, 4, 0.6], up: [0, 0, 1], fov: 75 });
  return scene;
}
