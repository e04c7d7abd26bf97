// Detectors of one group have one colour and, in legends, one name.

import type * as Plot from "@observablehq/plot";
import type {Page} from "./page";

// By group. The colours (style/colours.css) are Okabe and Ito's, which all kinds of eyes tell apart;
// reference/report/tables/detector_group.cpp has them for pictures without a page.
const kColours = [
  "var(--black)",
  "var(--green)",
  "var(--orange)",
  "var(--blue)",
  "var(--sky)",
  "var(--red)",
  "var(--purple)",
  "var(--yellow)",
  "var(--grey)",
];

/** The colour of a detector's group. @pre the detector is one of the page */
export const groupColour = ({detectors, groups}: Page, detector: string): string =>
  kColours[groups[detectors.indexOf(detector)]];

/** The groups of these detectors, each once. */
export function groupsOf(page: Page, shown: string[]): {name: string; colour: string}[] {
  const present = new Set(shown.map((name) => page.groups[page.detectors.indexOf(name)]));
  return page.group_names
    .map((name, i) => ({name, colour: kColours[i]}))
    .filter((_, i) => present.has(i));
}

/** For lines of single detectors: dash pattern and shape beside colour, so that none is told by colour alone. */
export const kLineStyles: {colour: string; dash: string; shape: Plot.SymbolType}[] = [
  {colour: "var(--blue)", dash: "none", shape: "circle"},
  {colour: "var(--orange)", dash: "7 3", shape: "square"},
  {colour: "var(--green)", dash: "2 2", shape: "triangle"},
  {colour: "var(--red)", dash: "10 3 2 3", shape: "diamond"},
  {colour: "var(--purple)", dash: "4 4", shape: "star"},
  {colour: "var(--black)", dash: "1 3", shape: "cross"},
  {colour: "var(--sky)", dash: "12 4", shape: "wye"},
  {colour: "var(--grey)", dash: "3 6", shape: "hexagon"},
];
