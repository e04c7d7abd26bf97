// A part of the page under a heading of its own.
import type {Child} from "./dom";
import type {Page} from "./page";

export interface Section {
  id: string;
  title: string;
  /** In the list of contents, where the title is long. */
  short?: string;
  /** Nothing where there is nothing to show. `view`: the bytes of the 3D view, where there are such. */
  build(page: Page, view: ArrayBuffer | null): Child[];
}
