// How sure the light is by now, and messages.

import type { Walkthrough } from "../app";
import type { State } from "../data/source";
import { byId } from "./dom";

const NOTICE_TIME = 6000;

export function showStatus(walk: Walkthrough | null, state: State | null) {
  byId("status").textContent = statusText(walk, state);
}

function statusText(walk: Walkthrough | null, state: State | null): string {
  const light = walk?.lighting.header;
  if (!light) return state ? stageText(state) : "";
  const error = `light within ${percent(light.error)}`;
  if (state && !state.done) return `${error}, ${stageText(state)}`;
  return light.elapsed_s > 0 ? `${error} after ${light.elapsed_s.toFixed(1)} s` : error;
}

function stageText({ stage, share, message }: State): string {
  if (message) return message;
  return share > 0 && share < 1 ? `${stage} ${Math.round(100 * share)} %` : stage;
}

function percent(share: number): string {
  if (!Number.isFinite(share)) return "an unknown error";
  return `${(100 * share).toFixed(share < 0.0995 ? 1 : 0)} %`;
}

export function showLoading(text: string | null) {
  byId("loading").hidden = text === null;
  if (text !== null) byId("loading-text").textContent = text;
}

let hiding: ReturnType<typeof setTimeout> | undefined;

export function showNotice(text: string, stays = false) {
  const notice = byId("notice");
  notice.textContent = text;
  notice.hidden = false;
  clearTimeout(hiding);
  if (!stays) hiding = setTimeout(hideNotice, NOTICE_TIME);
}

export function hideNotice() {
  byId("notice").hidden = true;
}
