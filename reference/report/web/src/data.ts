// What the program put into the page: results.json, and the scenes for the 3D view.

/** Inflates what html.cpp deflated; an empty text is nothing. */
async function unpacked(id: string): Promise<ArrayBuffer | null> {
  const text = document.getElementById(id)?.textContent?.trim() ?? "";
  if (text === "") return null;
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

export async function readResults(): Promise<Results> {
  const bytes = await unpacked("contactcheck-results");
  if (!bytes) throw new Error("the page holds no results");
  return JSON.parse(new TextDecoder().decode(bytes)) as Results;
}

/** The bytes described in reference/view/view_bytes.h; null when the report has no recordings. */
export function readView(): Promise<ArrayBuffer | null> {
  return unpacked("contactcheck-view");
}

/** results.json, as far as the page reads it; fixtures/results.schema.json has all of it. */
export interface Results {
  schema: string;
  version: string;
  command: string;
  machine: Record<string, string | number>;
  libraries: Record<string, string>;
  scenes: Scene[];
  runs: Run[];
}

export interface Scene {
  id: string;
  title: string;
  frames: number;
}

export interface Run {
  scene: string;
  detector: string;
  status: "ok" | "error" | "absent" | "refused";
  message: string;
}
