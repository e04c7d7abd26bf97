// What the program put into the page: results.json (with the tables of `contactcheck reproduce`,
// where there are such), and the scenes for the 3D view.
import type {Results} from "./results";

export type {Results, Run, Scene} from "./results";

/** Inflates what html.cpp deflated; an empty text is nothing. */
async function unpacked(id: string): Promise<ArrayBuffer | null> {
  const text = document.getElementById(id)?.textContent?.trim() ?? "";
  if (text === "") return null;
  const packed = atob(text),
    bytes = new Uint8Array(packed.length);
  for (let i = 0; i < packed.length; ++i) bytes[i] = packed.charCodeAt(i);
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
