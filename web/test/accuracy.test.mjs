// The page's luminances of solved scenes, at pixels drawn at random, against two other computations: `render --from`
// of the same solution, and method `auto`, which has no patches, no display mesh and no stored light.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { promisify } from "node:util";

import { missing as missingPage, openBrowser, openPage } from "./browser.mjs";
import { readRadiancePicture } from "./radiance_picture.mjs";
import { vec } from "./synthetic.mjs";

const { add, cross, dot, scaled, sub, unit } = vec;
const norm = (a) => Math.sqrt(dot(a, a));
const PROGRAM = process.env.STILB ?? fileURLToPath(new URL("../../build/release/stilb", import.meta.url));
const SCENES = process.env.STILB_SCENES ?? fileURLToPath(new URL("../../scenes", import.meta.url));
const OWN_SCENES = fileURLToPath(new URL("scenes", import.meta.url));
const missing = missingPage || (existsSync(PROGRAM) ? false : `${PROGRAM} is missing`);

const SIZE = { width: 300, height: 300 };
const FINER = 2;
const [COLUMNS, ROWS] = [20, 10];
/** Of the pixels: the share that must agree. */
const ENOUGH = 0.95;
const TOLERANCE = 0.02;
const STANDARD_ERRORS = 1.959964;

if (missing) console.log(`page test skipped: ${missing}`);
let browser;
let folder;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), "stilb-accuracy-"));
  if (!missing) browser = await openBrowser();
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

const stilb = (...args) => promisify(execFile)(PROGRAM, [...args, "--quiet"], { maxBuffer: 1 << 26, cwd: folder });

/** One pixel in each of 20 x 10 equal parts of the picture. */
function drawPixels() {
  // A linear congruential generator (Knuth's MMIX), of which the upper 32 bits are used.
  let state = 16n;
  const uniform = () => {
    state = BigInt.asUintN(64, state * 6364136223846793005n + 1442695040888963407n);
    return Number(state >> 32n) / 2 ** 32;
  };
  const pixels = [];
  for (let row = 0; row < ROWS; ++row) {
    for (let column = 0; column < COLUMNS; ++column) {
      const x = Math.floor(((column + uniform()) / COLUMNS) * SIZE.width);
      pixels.push([x, Math.floor(((row + uniform()) / ROWS) * SIZE.height)]);
    }
  }
  return pixels;
}

/** The direction of a pixel's middle. */
function rayAt(x, y, { position, target, fov }) {
  const forward = unit(sub(target, position));
  const right = unit(cross(forward, [0, 0, 1]));
  const half = Math.tan((fov * Math.PI) / 360);
  const across = ((2 * (x + 0.5)) / SIZE.width - 1) * half;
  const along = ((SIZE.height - 2 * (y + 0.5)) / SIZE.width) * half;
  return unit(add(forward, add(scaled(right, across), scaled(cross(right, forward), along))));
}

/** A reading along the line of sight of each pixel, by method auto. */
async function measured(file, camera, pixels, ...options) {
  const sensors = pixels.map(([x, y], i) =>
    `\n[sensors.pixel_${i}]\ntype = "luminance"\nposition = [${camera.position}]\ndirection = [${rayAt(x, y, camera)}]\n`);
  const beside = (name) => JSON.stringify(join(dirname(file), name));
  const text = readFileSync(file, "utf8").replaceAll(/^file = "(.*)"/gm, (_, name) => `file = ${beside(name)}`);
  writeFileSync(join(folder, "lines.toml"), text + sensors.join(""));
  const names = pixels.flatMap((_, i) => ["--sensor", `pixel_${i}`]);
  const { stdout } = await stilb("measure", "lines.toml", "--json", ...options, ...names);
  return JSON.parse(stdout).sensors.map(({ values }) => values[0]);
}

/**
 * Whether pixels and their neighbours show one smooth surface each: of three neighbours in a row, the middle one must
 * see the middle. render's value is a mean over the pixel, the page's belongs to its middle, and at outlines of objects
 * they differ for this reason.
 */
async function showOneSurface(file, camera, pixels) {
  const steps = [[0, 0], [-1, 0], [1, 0], [0, -1], [0, 1], [-1, -1], [1, 1], [-1, 1], [1, -1]];
  const around = pixels.flatMap(([x, y]) => steps.map(([dx, dy]) => [x + dx, y + dy]));
  const hits = (await measured(file, camera, around, "--bounces", "0", "--paths", "32")).map(({ hit }) => hit);
  return pixels.map((_, i) => {
    const [middle, ...others] = hits.slice(i * steps.length, (i + 1) * steps.length);
    return [0, 2, 4, 6].every((k) => {
      const [a, b] = [others[k], others[k + 1]];
      const length = norm(sub(a, b));
      return norm(sub(scaled(add(a, b), 0.5), middle)) < 0.1 * length;
    });
  });
}

/**
 * Means over FINER x FINER pixels. In soft shadows the 16 rays of a pixel of `render --from` have a noise of some percent,
 * which a finer picture lowers.
 */
function coarser(luminances) {
  return Float64Array.from({ length: SIZE.width * SIZE.height }, (_, i) => {
    const [x, y] = [i % SIZE.width, Math.floor(i / SIZE.width)];
    let sum = 0;
    for (let dy = 0; dy < FINER; ++dy) {
      for (let dx = 0; dx < FINER; ++dx)
        sum += luminances[(y * FINER + dy) * FINER * SIZE.width + x * FINER + dx];
    }
    return sum / FINER ** 2;
  });
}

/** What the page reads: [{value, standard_error}]. */
async function byPage(html, camera, pixels) {
  const { page, problems } = await openPage(browser, SIZE);
  await page.goto(pathToFileURL(html).href);
  await page.evaluate(() => window.stilb.ready);
  const values = await page.evaluate(([{ position, target, fov }, places]) => {
    window.stilb.camera(position, target, fov);
    return places.map(([x, y]) => window.stilb.luminance(x, y));
  }, [camera, pixels]);
  assert.deepEqual(problems, []);
  await page.close();
  return values;
}

const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];
/** Median half-width in proportion to the value. */
const medianError = (readings) => median(readings.map((r) => (STANDARD_ERRORS * r.standard_error) / r.value));
const percent = (share) => `${(100 * share).toFixed(1)} %`;

const CASES = [
  {
    what: "the furnished room", file: join(SCENES, "paper/furnished.toml"), steps: 256,
    camera: { position: [3.2, 0.15, 1.6], target: [3, 5, 0.9], fov: 80 },
  },
  {
    what: "a glossy room", file: join(OWN_SCENES, "glossy.toml"), steps: 256,
    camera: { position: [1.8, 0.2, 1.5], target: [2, 3, 0.7], fov: 75 },
  },
  {
    what: "a body by harmonics", file: join(OWN_SCENES, "harmonic.toml"), steps: 256,
    camera: { position: [1.2, 0.2, 1.4], target: [1.5, 1.8, 0.7], fov: 70 },
  },
];

for (const { what, file, camera, steps } of CASES) {
  test(`${what}: the page shows what render --from and auto compute`, { skip: missing }, async () => {
    const pixels = drawPixels();
    const solution = join(folder, "light.solution");
    await stilb("solve", file, "-o", solution, "--paths", String(steps));
    const html = join(folder, "walk.html");
    await stilb("view", solution, "-o", html);
    const picture = join(folder, "view.hdr");
    const resolution = `sensors.view.resolution=[${FINER * SIZE.width}, ${FINER * SIZE.height}]`;
    await stilb("render", "--from", solution, "-o", picture, "--set", resolution);
    const rendered = coarser(readRadiancePicture(readFileSync(picture)).luminances);
    // That of the least certain pixel: the median is 1 %, little beside the 4 to 5 % of the page.
    const exact = await measured(file, camera, pixels, "--error", "8%");
    const showsOne = await showOneSurface(file, camera, pixels);
    const seen = await byPage(html, camera, pixels);

    const compared = pixels.map((_, i) => i).filter((i) => showsOne[i]);
    const fromRender = compared.map((i) => {
      const [x, y] = pixels[i];
      const value = rendered[y * SIZE.width + x];
      return (seen[i].value - value) / value;
    });
    const asRendered = fromRender.filter((x) => Math.abs(x) <= TOLERANCE).length / compared.length;
    const fromAuto = pixels.map((_, i) => (seen[i].value - exact[i].value) / exact[i].value);
    const within = pixels.filter((_, i) => {
      const error = Math.hypot(seen[i].standard_error, exact[i].standard_error);
      return Math.abs(seen[i].value - exact[i].value) <= STANDARD_ERRORS * error;
    }).length / pixels.length;
    console.log(`${what}: ${percent(asRendered)} of ${compared.length} pixels within ${percent(TOLERANCE)} of render --from`
      + ` (${pixels.length - compared.length} on outlines left out; median difference ${percent(median(fromRender))});`
      + ` ${percent(within)} of ${pixels.length} within the stated error of auto (median difference ${percent(median(fromAuto))},`
      + ` median half-widths ${percent(medianError(seen))} and ${percent(medianError(exact))})`);
    assert.ok(asRendered >= ENOUGH, `as render --from: ${percent(asRendered)}`);
    assert.ok(within >= ENOUGH, `within the stated error of auto: ${percent(within)}`);
  });
}
