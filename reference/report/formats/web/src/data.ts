// What the program put into the page: what to show, and the scenes for the 3D view.
import type {CheckPage} from "./check/data";
import type {Page} from "./page";

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

/** Of a run, or of `contactcheck check`. */
export async function readPage(): Promise<Page | CheckPage> {
  const bytes = await unpacked("contactcheck-page");
  if (!bytes) throw new Error("the page holds nothing to show");
  return JSON.parse(new TextDecoder().decode(bytes)) as Page | CheckPage;
}

/** The bytes described in reference/report/formats/view_bytes.h; null when the report has no recordings. */
export function readView(): Promise<ArrayBuffer | null> {
  return unpacked("contactcheck-view");
}
