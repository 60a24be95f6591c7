// Where a page gets its data: from the file that contains it, or from the program that serves it.

import { type Container, readContainer } from "./container";
import type { LightHeader, SceneHeader, Vec3 } from "./scene";

export interface State {
  stage: string;
  share: number;
  scene: boolean;
  light: number;
  error: number;
  elapsed_s: number;
  done: boolean;
  message: string;
}

export interface MeasureRequest {
  kind: "illuminance" | "luminance";
  position: Vec3;
  normal?: Vec3;
  direction?: Vec3;
  factors: Record<string, number | Vec3>;
}

export interface Measurement {
  value: number;
  half_width: number;
  unit: string;
  time_s: number;
  method: string;
}

export interface PlacedSensor {
  name: string;
  type: "illuminance";
  position: Vec3;
  normal: Vec3;
}

export interface Source {
  /** Whether a program answers: only then can points be measured and sensors saved. */
  readonly live: boolean;
  scene(): Promise<Container<SceneHeader>>;
  light(): Promise<Container<LightHeader>>;
  state(): Promise<State | null>;
  measure(request: MeasureRequest): Promise<Measurement>;
  saveSensors(sensors: PlacedSensor[]): Promise<{ toml: string; saved: string }>;
}

class InlineSource implements Source {
  readonly live = false;

  scene = () => readContainer<SceneHeader>(dataOfTag("stilb-scene"));
  light = () => readContainer<LightHeader>(dataOfTag("stilb-light"));
  state = async () => null;
  measure = () => Promise.reject(new Error("a page from a file cannot measure: there is no program behind it"));
  saveSensors = () => Promise.reject(new Error("a page from a file cannot save"));
}

class ServerSource implements Source {
  readonly live = true;

  scene = async () => readContainer<SceneHeader>(await bytesOf("scene"));
  light = async () => readContainer<LightHeader>(await bytesOf("light"));
  state = async () => (await answerOf("state")).json() as Promise<State>;
  measure = async (request: MeasureRequest) => post<Measurement>("measure", request);
  saveSensors = (sensors: PlacedSensor[]) => post<{ toml: string; saved: string }>("sensors", { sensors });
}

export function findSource(): Source {
  return document.getElementById("stilb-scene") ? new InlineSource() : new ServerSource();
}

function dataOfTag(id: string): Uint8Array {
  const text = document.getElementById(id)?.textContent;
  if (!text) throw new Error(`this file contains no data "${id}"`);
  return Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
}

async function answerOf(path: string, options?: RequestInit): Promise<Response> {
  const answer = await fetch(`./${path}`, { cache: "no-store", ...options });
  if (answer.ok) return answer;
  const reason = await answer
    .json()
    .then((body) => body?.error as string | undefined)
    .catch(() => undefined);
  throw new Error(reason ?? `${path}: the program answered with status ${answer.status}`);
}

async function bytesOf(path: string): Promise<Uint8Array> {
  return new Uint8Array(await (await answerOf(path)).arrayBuffer());
}

async function post<Result>(path: string, body: object): Promise<Result> {
  const options = { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) };
  return (await answerOf(path, options)).json() as Promise<Result>;
}
