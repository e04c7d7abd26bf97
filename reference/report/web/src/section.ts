// A part of the page under a heading of its own.
import type {Child} from "./dom";
import type {Report} from "./report";

export interface Section {
  id: string;
  title: string;
  /** In the list of contents, where the title is long. */
  short?: string;
  /** Nothing where the results have nothing to show. */
  build(report: Report): Child[];
}
