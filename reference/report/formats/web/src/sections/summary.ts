// One line per detector: the sums over scenes, as the other reports have them.
import {p} from "../dom";
import {term} from "../glossary";
import type {TextTable} from "../page";
import type {Section} from "../section";
import {table} from "../table";
import {tablesOf} from "./text";

// What only makes the table wider than the window: recall, which is truth and missed, and columns in
// which every line says the same.
function narrowed({columns, rows}: TextTable): Pick<TextTable, "columns" | "rows"> {
  const kept = columns.map(
    ({id}, i) =>
      id !== "recall" &&
      (!["scenes", "passes", "question"].includes(id ?? "") ||
        rows.some((row) => row[i] !== rows[0][i])),
  );
  const keep = <T>(cells: T[]): T[] => cells.filter((_, i) => kept[i]);
  return {columns: keep(columns), rows: rows.map(keep)};
}

export const summary: Section = {
  id: "summary",
  title: "Summary",
  build(page) {
    const [whole] = tablesOf(page, "summary"),
      count = page.scene_count;
    if (!whole) return [];
    const {columns, rows} = narrowed(whole);
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
