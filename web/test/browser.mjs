// Opens the built page in a headless Chromium that draws in software.
import { createServer } from "node:http";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

import { chromium } from "playwright-core";

const BUILT = process.env.STILB_PAGE ?? fileURLToPath(new URL("../dist", import.meta.url));
const CHROMIUM = process.env.STILB_CHROMIUM ?? "/usr/bin/chromium";

export const missing = !existsSync(CHROMIUM)
  ? `${CHROMIUM} is missing`
  : !existsSync(join(BUILT, "page.js")) ? `${BUILT} holds no built page` : false;

export function openBrowser() {
  return chromium.launch({
    executablePath: CHROMIUM,
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  });
}

const readBuilt = (name) => readFileSync(join(BUILT, name), "utf8");

/** One file with page and data, as `stilb view FILE -o walk.html` writes it. */
export function selfContained(scene) {
  const tag = (id, data) => `<script type="application/octet-stream" id="${id}">${data.toString("base64")}</script>`;
  return readBuilt("index.html")
    .replace('<script type="module" src="./page.js"></script>', () => `<script type="module">${readBuilt("page.js")}</script>`)
    .replace('<link rel="stylesheet" href="./page.css">', () => `<style>${readBuilt("page.css")}</style>`)
    .replace("</body>", () => `${tag("stilb-scene", scene.sceneData())}${tag("stilb-light", scene.lightData())}</body>`);
}

/** A page from a file on disk; any request for something else fails the test. */
export async function openFile(browser, scene, viewport = { width: 800, height: 600 }, options = {}) {
  const folder = mkdtempSync(join(tmpdir(), "stilb-page-"));
  const file = join(folder, "walk.html");
  writeFileSync(file, selfContained(scene));
  const { page, problems } = await openPage(browser, viewport, options);
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) problems.push(`request for ${request.url()}`);
  });
  await page.goto(pathToFileURL(file).href);
  await page.evaluate(() => window.stilb.ready);
  rmSync(folder, { recursive: true });
  return { page, problems };
}

export async function openPage(browser, viewport, options = {}) {
  const context = await browser.newContext({ viewport, ...options });
  const page = await context.newPage();
  const problems = [];
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("console", (message) => {
    const isAboutSpeed = message.text().includes("GPU stall due to ReadPixels");
    if (["error", "warning"].includes(message.type()) && !isAboutSpeed) problems.push(message.text());
  });
  return { page, problems };
}

const POLICY = "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data:";

/** Serves the page as the program does; `answers` may be changed while it runs. */
export async function serve(answers) {
  const types = { "/": "text/html", "/page.js": "text/javascript", "/page.css": "text/css" };
  const server = createServer(async (request, response) => {
    const path = request.url.replace("/token", "");
    const reply = (status, type, body) => {
      response.writeHead(status, { "Content-Type": type, "Content-Security-Policy": POLICY });
      response.end(body);
    };
    if (types[path]) return reply(200, types[path], readBuilt(path === "/" ? "index.html" : path.slice(1)));
    const answer = answers[path.slice(1)];
    if (!answer) return reply(503, "text/plain", "");
    if (request.method === "GET" && Buffer.isBuffer(answer)) return reply(200, "application/octet-stream", answer);
    let body = "";
    for await (const part of request) body += part;
    const result = typeof answer === "function" ? answer(body && JSON.parse(body)) : answer;
    return reply(result.status ?? 200, "application/json", JSON.stringify(result));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return { server, address: `http://127.0.0.1:${server.address().port}/token/` };
}
