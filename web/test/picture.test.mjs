// What the page draws, against formulas: diffuse and glossy luminances, mirrors, panes, dimming.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { missing, openBrowser, openFile } from "./browser.mjs";
import { axisOf, SyntheticScene, tableValue, testRoom, vec } from "./synthetic.mjs";

const { add, cross, dot, scaled, sub, unit } = vec;
const SIZE = { width: 400, height: 300 };
const EYE = [0.6, 0.6, 1.6];
const FOV = 80;

if (missing) console.log(`page test skipped: ${missing}`);
let browser;
before(async () => {
  if (!missing) browser = await openBrowser();
});
after(() => browser?.close());

/** The direction that a pixel's middle shows. */
function rayAt(x, y, eye, target, fov = FOV, size = SIZE) {
  const forward = unit(sub(target, eye));
  const right = unit(cross(forward, [0, 0, 1]));
  const up = cross(right, forward);
  const half = Math.tan((fov * Math.PI) / 360);
  const across = ((2 * (x + 0.5)) / size.width - 1) * half;
  const along = ((1 - (2 * (y + 0.5)) / size.height) * half * size.height) / size.width;
  return unit(add(forward, add(scaled(right, across), scaled(up, along))));
}

const onPlane = (eye, ray, axis, value) => add(eye, scaled(ray, (value - eye[axis]) / ray[axis]));

function isNear(actual, expected, tolerance, what) {
  assert.ok(Math.abs(actual - expected) <= tolerance * Math.abs(expected), `${what}: ${actual}, expected ${expected}`);
}

async function look(page, target, eye = EYE, fov = FOV) {
  await page.evaluate(([from, to, angle]) => window.stilb.camera(from, to, angle), [eye, target, fov]);
}

const luminanceAt = (page, x, y) => page.evaluate(([px, py]) => window.stilb.luminance(px, py), [x, y]);
const illuminanceAt = (page, x, y) => page.evaluate(([px, py]) => window.stilb.illuminance(px, py), [x, y]);

test("a diffuse floor shows E r / pi, by the middle of each pixel", { skip: missing }, async () => {
  const scene = testRoom();
  const { page, problems } = await openFile(browser, scene, SIZE);
  const target = [3.2, 1.4, 0.2];
  await look(page, target);
  for (const [x, y] of [[120, 180], [200, 190], [300, 250], [60, 280]]) {
    const place = onPlane(EYE, rayAt(x, y, EYE, target), 2, 0);
    const lux = scene.illuminance(0, place, [0, 0, 1]) + scene.illuminance(1, place, [0, 0, 1]) + 60;
    const seen = await luminanceAt(page, x, y);
    isNear(seen.value, (0.3 / Math.PI) * lux, 0.005, "cd/m2");
    const read = await illuminanceAt(page, x, y);
    isNear(read.value, lux, 0.005, "lx");
    isNear(read.standard_error * 1.96, Math.hypot(0.01 * (lux - 60), 0.02 * 60), 0.02, "error");
  }
  assert.deepEqual(problems, []);
  await page.close();
});

/** One glossy rectangle of a material under one bulb, seen at an angle. */
function glossyScene(material) {
  const scene = new SyntheticScene();
  const glossy = scene.material(material);
  scene.quad(scene.object("table"), glossy, [0, 0, 0], [2, 0, 0], [0, 2, 0], 80);
  scene.light("bulb", 200, [{ position: [1.4, 1.3, 1.2], normal: [0, 0, 0], weight: 1 }]);
  scene.indirect = { illuminance: 40, cosine: 7, sine: 4 };
  return scene;
}

/** Stored light towards the eye: the tables turned by the azimuth. */
function storedLuminance(scene, place, eye, madeUp) {
  const out = unit(sub(eye, place));
  const theta = Math.acos(out[2]);
  const u = axisOf([0, 0, 1]);
  const phi = Math.atan2(dot(out, cross([0, 0, 1], u)), dot(out, u));
  const { cosine, sine } = scene.indirect;
  const tilted = tableValue(2, theta, madeUp) * (cosine * Math.cos(phi) + sine * Math.sin(phi));
  return tableValue(0, theta, madeUp) * scene.term(0) + tilted;
}

const BRDFS = {
  phong: {
    material: { diffuse: 0.2, specular: 0.3, exponent: 50 },
    brdf: (i, o) => 0.2 / Math.PI + ((0.3 * 52) / (2 * Math.PI)) * Math.max(i[2] * o[2] - i[0] * o[0] - i[1] * o[1], 0) ** 50,
  },
  ward: {
    material: { diffuse: 0.1, specular: 0.4, roughness: [0.1, 0.3], rotation: 30 },
    brdf: (i, o) => {
      const h = add(i, o);
      const [c, s] = [Math.cos(Math.PI / 6), Math.sin(Math.PI / 6)];
      const u = (c * h[0] + s * h[1]) / 0.1;
      const v = (c * h[1] - s * h[0]) / 0.3;
      const lobe = (Math.exp(-(u * u + v * v) / h[2] ** 2) * dot(h, h)) / (Math.PI * 0.03 * h[2] ** 4);
      return 0.1 / Math.PI + 0.4 * lobe;
    },
  },
};

for (const [type, { material, brdf }] of Object.entries(BRDFS)) {
  test(`${type} highlights are those of the formula`, { skip: missing }, async () => {
    const madeUp = { albedo: 0.5, tilt: 0.2 };
    const scene = glossyScene({ name: type, type, ...material, made_up: madeUp });
    const { page, problems } = await openFile(browser, scene, SIZE);
    const eye = [0.5, -0.8, 1];
    const target = [1, 0.7, 0];
    await look(page, target, eye, 60);
    for (const [x, y] of [[200, 150], [215, 120], [240, 100], [150, 200], [260, 180]]) {
      const place = onPlane(eye, rayAt(x, y, eye, target, 60), 2, 0);
      const toLamp = unit(sub([1.4, 1.3, 1.2], place));
      const expected = scene.illuminance(0, place, [0, 0, 1]) * brdf(toLamp, unit(sub(eye, place))) + storedLuminance(scene, place, eye, madeUp);
      isNear((await luminanceAt(page, x, y)).value, expected, 0.01, `${type} at ${x}, ${y}`);
    }
    assert.deepEqual(problems, []);
    await page.close();
  });
}

// White facets and a white base return all light: the integral over directions is 1, at every roughness.
for (const material of [
  { type: "rough", reflectance: 1, roughness: 0.5 },
  { type: "plastic", diffuse: 1, ior: 1.5, roughness: 0.4 },
]) {
  test(`${material.type}: seen from all sides, a white surface returns its light`, { skip: missing }, async () => {
    const scene = glossyScene({ name: "white", ...material, made_up: { albedo: 0, tilt: 0 } });
    scene.indirect = { illuminance: 0, cosine: 0, sine: 0 };
    scene.header.cameras.push({ name: "top", position: [1, 1, 3], target: [1, 1, 0], up: [0, 1, 0], fov: 30 });
    const { page } = await openFile(browser, scene, { width: 60, height: 60 });
    const place = [1, 1, 0];
    const sum = await page.evaluate(([point]) => {
      const [rings, rays] = [16, 12];
      let total = 0;
      for (let i = 0; i < rings; ++i) {
        // Even in the square of the sine: each direction has the same projected solid angle.
        const sine = Math.sqrt((i + 0.5) / rings);
        for (let j = 0; j < rays; ++j) {
          const phi = (2 * Math.PI * (j + 0.5)) / rays;
          const out = [sine * Math.cos(phi), sine * Math.sin(phi), Math.sqrt(1 - sine * sine)];
          window.stilb.camera(point.map((x, k) => x + 4 * out[k]), point, 1);
          total += window.stilb.luminance(30, 30).value;
        }
      }
      return (total * Math.PI) / (rings * rays);
    }, [place]);
    isNear(sum / scene.illuminance(0, place, [0, 0, 1]), 1, 0.02, "share of the light");
    await page.close();
  });
}

test("a mirror shows what its image would", { skip: missing }, async () => {
  const { page, problems } = await openFile(browser, testRoom(), SIZE);
  const target = [5.98, 2, 1.4];
  const eye = [3.6, 2.2, 1.5];
  await look(page, target, eye, 50);
  const inMirror = await luminanceAt(page, 200, 150);
  // From behind the mirror along the mirrored ray, that is from the mirror towards what it shows.
  const ray = rayAt(200, 150, eye, target, 50);
  const place = onPlane(eye, ray, 0, 5.98);
  const onward = [-ray[0], ray[1], ray[2]];
  await look(page, add(place, onward), add(place, scaled(onward, 0.05)), 50);
  const directly = await page.evaluate(() => window.stilb.luminance(199, 149));
  isNear(inMirror.value, 0.9 * directly.value, 0.01, "mirrored luminance");
  assert.deepEqual(problems, []);
  await page.close();
});

test("a pane lets through what Fresnel's equations leave", { skip: missing }, async () => {
  const scene = testRoom();
  const { page } = await openFile(browser, scene, SIZE);
  const eye = [2, 2.9, 1.2];
  await look(page, [0, 2.9, 1.2], eye, 40);
  const through = await luminanceAt(page, 200, 150);
  const ray = rayAt(200, 150, eye, [0, 2.9, 1.2], 40);
  const place = onPlane(eye, ray, 0, 0);
  const lux = scene.illuminance(0, place, [1, 0, 0]) + scene.illuminance(1, place, [1, 0, 0]) + 60;
  // ior 1.52, internal transmittance 0.96 at normal incidence: T = 0.8815 (docs/materials.md). Red paint: 0.205.
  const [r, colour] = [0.2126 * 0.6 + 0.7874 * 0.1, [1.2, 0.97, 0.7]];
  const second = scene.illuminance(1, place, [1, 0, 0]);
  const coloured = 0.2126 * 0.6 * colour[0] + 0.1 * (0.7152 * colour[1] + 0.0722 * colour[2]);
  const behind = (r * (lux - second) + coloured * second) / Math.PI;
  // What it mirrors is the plaster at x = 6 behind the eye, seen with R = 0.0815.
  const facing = onPlane([1.2, place[1], place[2]], [-ray[0], ray[1], ray[2]], 0, 6);
  const mirrored = [[1, 1, 1], colour].reduce(
    (sum, c, l) => sum + scene.illuminance(l, facing, [-1, 0, 0]) * (0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]), 60);
  isNear(through.value, 0.8815 * behind + (0.0815 * 0.6 * mirrored) / Math.PI, 0.01, "through the pane");
  await page.close();
});

test("dimming is linear, and each light is its own", { skip: missing }, async () => {
  const { page } = await openFile(browser, testRoom(), SIZE);
  await look(page, [3.2, 1.4, 0.2]);
  const values = await page.evaluate(() => {
    const at = () => window.stilb.luminance(200, 190).value;
    const both = at();
    window.stilb.set("spot", 0);
    const bulb = at();
    window.stilb.set("bulb", 0.25);
    const dimmed = at();
    window.stilb.set("bulb", 0);
    window.stilb.set("spot", [1, 1, 1]);
    const spot = at();
    window.stilb.set("spot", 0);
    return { both, bulb, dimmed, spot, none: at() };
  });
  isNear(values.bulb + values.spot, values.both, 1e-5, "sum of both");
  isNear(values.dimmed, values.bulb / 4, 1e-5, "a quarter");
  assert.equal(values.none, 0);
  await assert.rejects(page.evaluate(() => window.stilb.set("candle", 1)), /no light or group "candle"/);
  await page.close();
});

test("bodies of mirror and glass show their surroundings", { skip: missing }, async () => {
  const scene = testRoom();
  const silver = scene.header.materials.findIndex(({ type }) => type === "mirror");
  scene.body(scene.object("ball"), silver, [2, 1, 0.8], [2.5, 1.5, 1.3]);
  scene.body(scene.object("block"), scene.material({ name: "crystal", type: "glass", ior: 1.5 }), [3.5, 1, 0.8], [4, 1.5, 1.3]);
  const { page, problems } = await openFile(browser, scene, SIZE);
  const eye = [2.25, 0.1, 1.05];
  await look(page, [2.25, 1, 1.05], eye, 40);
  // The plaster at y = 0, behind the eye, from the ball's middle by the box of the scene.
  const place = [2.25, 0, 1.05];
  const lamps = [[1, 1, 1], [1.2, 0.97, 0.7]];
  const lux = lamps.reduce((sum, c, l) => sum + scene.illuminance(l, place, [0, 1, 0]) * (0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]), 60);
  isNear((await luminanceAt(page, 200, 150)).value, (0.9 * 0.6 * lux) / Math.PI, 0.03, "in the ball");
  await look(page, [3.75, 4, 1.05], [3.75, 0.1, 1.05], 40);
  const through = (await luminanceAt(page, 200, 150)).value;
  const wall = [3.75, 4, 1.05];
  const behind = lamps.reduce((sum, c, l) => sum + scene.illuminance(l, wall, [0, -1, 0]) * (0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]), 60);
  const [loss, gain] = [0.92 * 0.6 * behind, 0.04 * 0.6 * 200];
  assert.ok(through > (0.98 * loss) / Math.PI && through < (loss + gain) / Math.PI, `through the block: ${through}, ${loss / Math.PI}`);
  assert.deepEqual(problems, []);
  await page.close();
});
