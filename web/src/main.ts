// Starts the page: reads the scene, draws it, and follows the program while it refines the light.

import "./page.css";

import { publish } from "./api";
import { Walkthrough } from "./app";
import { findSource, type Source, type State } from "./data/source";
import { byId } from "./ui/dom";
import { buildInterface } from "./ui/interface";
import { hideNotice, showLoading, showNotice, showStatus } from "./ui/status";

const POLL_INTERVAL = 500;

const wait = (ms: number) => new Promise((done) => setTimeout(done, ms));

async function start(): Promise<Walkthrough> {
  const source = findSource();
  if (source.live) await awaitState(source, (state) => state.scene);
  const walk = new Walkthrough(await source.scene(), byId<HTMLCanvasElement>("picture"));
  let state: State | null = null;
  if (source.live) state = await awaitState(source, ({ light }) => light > 0);
  walk.receiveLight(await source.light());
  buildInterface(walk, source);
  showStatus(walk, state);
  await firstPicture(walk);
  showLoading(null);
  if (source.live) void follow(walk, source);
  return walk;
}

/** Shows the stage until the program has what is waited for. */
async function awaitState(source: Source, isThere: (state: State) => boolean): Promise<State | null> {
  for (;;) {
    const state = await source.state();
    if (!state || isThere(state)) return state;
    showLoading(state.message || stageOf(state));
    await wait(POLL_INTERVAL / 2);
  }
}

function stageOf({ stage, share }: State): string {
  return share > 0 ? `${stage} ${Math.round(100 * share)} %` : stage || "Starting";
}

function firstPicture(walk: Walkthrough): Promise<void> {
  return new Promise((done) => walk.addEventListener("frame", () => done(), { once: true }));
}

async function follow(walk: Walkthrough, source: Source) {
  for (let isLost = false; ; await wait(POLL_INTERVAL)) {
    try {
      const state = await source.state();
      if (isLost) hideNotice();
      isLost = false;
      if (state && state.light > (walk.lighting.header?.version ?? 0)) walk.receiveLight(await source.light());
      showStatus(walk, state);
    } catch {
      // The picture stays usable without the program, which may come back.
      if (!isLost) showNotice("The program no longer answers. The picture stays as it is.", true);
      isLost = true;
    }
  }
}

const walkthrough = start();
publish(walkthrough);
walkthrough.catch((error: unknown) => {
  showLoading(null);
  showNotice(error instanceof Error ? error.message : String(error), true);
});
