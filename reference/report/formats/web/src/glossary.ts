// The words that a newcomer needs, and links to them.
import {h} from "./dom";

export interface Word {
  id: string;
  word: string;
  meaning: string;
}

export const kGlossary: Word[] = [
  {
    id: "contact",
    word: "contact",
    meaning:
      "Two surfaces share a point; touching counts. What truly is in contact (the truth) is computed exactly, frame by frame.",
  },
  {
    id: "missed",
    word: "missed",
    meaning: "A true contact that a detector did not report. Objects would sink into one another.",
  },
  {
    id: "spurious",
    word: "spurious",
    meaning:
      "A contact that a detector reported and that does not exist. Objects would stop before they touch.",
  },
  {
    id: "recall",
    word: "recall",
    meaning:
      "The share of true contacts that was found: 1 is all. A dash means that there was nothing to find.",
  },
  {
    id: "level",
    word: "level",
    meaning:
      "What is counted: pairs of bodies (body), of lattice cells (cell), of mapped cell boxes (box), of triangles (triangle), " +
      "vertices inside another body (vertex), or vertices nearer than a margin (near); between frames, what meets while all vertices move on straight lines from one frame to the next (impact and the levels that begin so). " +
      "A detector is held to the levels that it claims, and to no others.",
  },
  {
    id: "tunnelled",
    word: "tunnelled",
    meaning:
      "Two bodies that meet between two frames, touch in neither, and are not reported: they pass through one another.",
  },
  {
    id: "hover",
    word: "hover",
    meaning: "The true distance of two surfaces when a detector first reports that they touch.",
  },
  {
    id: "question",
    word: "question",
    meaning:
      "What a detector was asked while it was timed: all pairs of triangles, which bodies touch, all pairs of cells, or contacts " +
      "with depth and normal. Only times of one question compare.",
  },
  {
    id: "playback",
    word: "playback, cold",
    meaning:
      "Playback: a detector goes through all frames in order, as in a simulator; times leave the first frame out. " +
      "Cold: some frames, drawn at random, each after the processor's caches were swept.",
  },
  {
    id: "passes",
    word: "passes",
    meaning:
      "Times that a detector went through the frames, each in a fresh process. From 5 passes on a ratio has a 95 % interval, " +
      "[low, high]; with fewer it has the range of the passes, (low to high).",
  },
  {
    id: "depth",
    word: "depth, normal",
    meaning:
      "How deep two bodies are in one another at a contact, and the direction in which they part the soonest.",
  },
  {
    id: "ffd",
    word: "FFD, lattice",
    meaning:
      "Free-form deformation: bodies are deformed by moving the nodes of a lattice of boxes (cells) around them.",
  },
];

/** A link to a word's meaning, which also shows when the pointer rests on it. @pre the id is known */
export function term(id: string, text = id): HTMLElement {
  const {meaning} = kGlossary.find((word) => word.id === id)!;
  return h("a", {class: "term", href: `#word-${id}`, title: meaning}, text);
}

/** Of a table's heading ("missed", "hover mm"), where its first word is in the list. */
export function meaningOf(heading: string): string | undefined {
  const first = heading.split(" ")[0];
  return kGlossary.find(({word}) => word.split(", ").includes(first))?.meaning;
}
