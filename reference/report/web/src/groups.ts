// Detectors of one family have one colour and, in legends, one name. The colours (style.css) are
// Okabe and Ito's, which all kinds of eyes tell apart.

import type * as Plot from "@observablehq/plot";

export interface Group {
  name: string;
  colour: string;
}

const kGroups: [RegExp, Group][] = [
  [/^(ffd-lazy|full-refit)/, {name: "lazy and refitted tree", colour: "var(--black)"}],
  [/^ffd-[^:]*\+tri/, {name: "FFD with exact triangle test (+tri)", colour: "var(--green)"}],
  [/^ffd-/, {name: "FFD, node against plane (the paper)", colour: "var(--orange)"}],
  [/^fcl/, {name: "FCL", colour: "var(--blue)"}],
  [/^embree/, {name: "Embree", colour: "var(--sky)"}],
  [/^bullet/, {name: "Bullet", colour: "var(--red)"}],
  [/^libccd/, {name: "libccd", colour: "var(--purple)"}],
  [/^(spatial-hash|aabb-tree|sphere-tree|bd-tree)/, {name: "historic", colour: "var(--yellow)"}],
];
const kOther: Group = {name: "other", colour: "var(--grey)"};

export const groupOf = (detector: string): Group =>
  kGroups.find(([pattern]) => pattern.test(detector))?.[1] ?? kOther;

/** Each group once, in the order above. */
export function groupsOf(detectors: string[]): Group[] {
  const present = new Set(detectors.map(groupOf));
  return [...kGroups.map(([, group]) => group), kOther].filter((group) => present.has(group));
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
