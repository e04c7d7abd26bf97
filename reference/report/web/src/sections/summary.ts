// One line per detector: the sums over scenes, as the other reports have them.
import {p} from "../dom";
import {term} from "../glossary";
import type {Section} from "../section";
import {table} from "../table";

export const summary: Section = {
  id: "summary",
  title: "Summary",
  build({summary: {columns, rows}, scene_count: count}) {
    return [
      p(
        `Sums over ${count} ${count === 1 ? "scene" : "scenes"}, at the finest `,
        term("level"),
        " that a detector claims. " +
          "“body m/s” counts pairs of bodies missed and spurious. The last columns are speed-ups: the time of the " +
          "detector named divided by the time of this one in the same ",
        term("question"),
        ", in ",
        term("playback"),
        ", the smallest and the largest of any scene. " + "A click on a heading sorts.",
      ),
      table(columns, rows, "Summary of all detectors"),
    ];
  },
};
