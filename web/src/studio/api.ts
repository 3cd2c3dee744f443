// Requests to the server of this page.

import type { Problem } from "./types";

const KEY = "lissom-key";
const NEW_ADDRESS = "Open the address that the command `lissom studio` prints. It works once: for one more page open the file open.html of its folder.";
const NO_ANSWER = "lissom studio does not answer";

/** An error that the page shows. */
export class Refused extends Error {
  constructor(
    readonly problem: Problem,
    readonly status: number,
  ) {
    super(problem.error);
  }
}

async function answered(response: Response): Promise<Response> {
  if (response.ok) return response;
  const text = await response.text();
  let problem: Problem;
  try {
    problem = JSON.parse(text) as Problem;
  } catch {
    problem = { error: text || `the server answered ${response.status}` };
  }
  throw new Refused(problem, response.status);
}

async function asked(path: string, options: RequestInit = {}): Promise<Response> {
  const headers = { ...(options.headers ?? {}), "x-lissom-key": sessionStorage.getItem(KEY) ?? "" };
  let response: Response;
  try {
    response = await fetch(path, { ...options, headers });
  } catch {
    const hint = "If it has ended, start it again in a terminal and open the address that it prints: the session is kept.";
    throw new Refused({ error: NO_ANSWER, hint }, 0);
  }
  return answered(response);
}

/** Exchanges the one-time token in the address for a key of this page. */
export async function enter(): Promise<void> {
  const token = location.hash.slice(1);
  if (/^[0-9a-f]{64}$/.test(token)) {
    history.replaceState(null, "", location.pathname);
    const headers = { "content-type": "application/json" };
    const response = await fetch("/api/key", { method: "POST", headers, body: JSON.stringify({ token }) });
    const { key } = (await (await answered(response)).json()) as { key: string };
    sessionStorage.setItem(KEY, key);
  } else if (!sessionStorage.getItem(KEY)) {
    throw new Refused({ error: "this page has no key", hint: NEW_ADDRESS }, 401);
  }
}

export async function get<T>(path: string): Promise<T> {
  return (await asked(path)).json() as Promise<T>;
}

export async function getText(path: string): Promise<string> {
  return (await asked(path)).text();
}

export async function getFile(path: string): Promise<Blob> {
  return (await asked(path)).blob();
}

export async function send<T>(method: string, path: string, body?: unknown): Promise<T> {
  const json = body === undefined ? {} : { body: JSON.stringify(body), headers: { "content-type": "application/json" } };
  return (await asked(path, { method, ...json })).json() as Promise<T>;
}

export async function sendFile<T>(file: File): Promise<T> {
  const path = `/api/files/${encodeURIComponent(file.name)}`;
  return (await asked(path, { method: "PUT", body: file })).json() as Promise<T>;
}
