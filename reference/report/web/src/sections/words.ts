// The words that a newcomer needs.
import {h} from "../dom";
import type {Report} from "../report";
import type {Section} from "../section";

const kWords: [string, string][] = [
  ["contact",
      "Two surfaces share a point; touching counts. What truly is in contact (the truth) is computed exactly, frame by frame."],
  ["missed", "A true contact that a detector did not report. Objects would sink into one another."],
  ["spurious",
      "A contact that a detector reported and that does not exist. Objects would stop before they touch."],
  ["recall",
      "The share of true contacts that was found: 1 is all. A dash means that there was nothing to find."],
  ["level",
      "What is counted: pairs of bodies (body), of lattice cells (cell), of mapped cell boxes (box), of triangles (triangle), "
    + "vertices inside another body (vertex), or vertices nearer than a margin (near). A detector is held to the levels that it claims, and to no others."],
  ["hover", "The true distance of two surfaces when a detector first reports that they touch."],
  ["question",
      "What a detector was asked while it was timed: all pairs of triangles, which bodies touch, all pairs of cells, or contacts "
    + "with depth and normal. Only times of one question compare."],
  ["cold, hot", "Cold: the processor's caches were swept before. Hot: the same frame once more."],
  ["FFD, lattice", "Bodies are deformed by moving the nodes of a lattice of boxes (cells) around them."],
];

export const words: Section = {
  id: "words",
  title: "Words used here",
  build: (_: Report) => [
    h("dl", {class: "words"}, ...kWords.flatMap(([word, meaning]) => [h("dt", {}, word), h("dd", {},
        meaning)])),
  ],
};
