// The paper's tables beside ours: what the program made of reproduction.json.
import {h, p, unfolding, type Child} from "../dom";
import type {PaperScene, TextTable} from "../page";
import type {Section} from "../section";
import {table, textTable, withCode, type Cell} from "../table";
import {list} from "./text";

const headed = (content: TextTable): Child[] =>
  content.rows.length > 0 ? [h("h4", {}, content.title), ...textTable(content)] : [];

const sceneDetails = ({title, aside, sentences, tables}: PaperScene): HTMLElement =>
  unfolding(
    h("span", {}, h("strong", {}, title), h("span", {class: "aside"}, " ", ...withCode(aside))),
    () => [sentences.length > 0 && list(sentences), ...tables.flatMap(headed)],
    {class: "block"},
  );

const kVerdicts: Record<string, Cell> = {
  agrees: {text: "✓ agrees"},
  "does not agree": {text: "✗ does not agree", class: "bad"},
};

// The last two cells are the verdict and the sentence.
const checksTable = ({title, columns, rows}: TextTable): HTMLElement =>
  table(
    columns,
    rows.map((row) => [
      ...row.slice(0, -2),
      kVerdicts[row.at(-2)!] ?? row.at(-2)!,
      {text: row.at(-1)!, class: "wrap"},
    ]),
    title,
  );

export const paper: Section = {
  id: "paper",
  title: "The paper's tables beside ours",
  short: "The paper",
  build({paper: part}) {
    if (!part) return [];
    return [
      p(
        "The paper's milliseconds are of phones of 2012: only ratios compare. A ratio above 1 says that the second level of spheres pays.",
      ),
      ...textTable(part.overview),
      list(part.readings),
      ...(part.means.length > 0 ? [h("h3", {}, part.means_title), list(part.means)] : []),
      h("h3", {}, "Scene by scene"),
      p(
        "MSS is the deformation with gravity and ground; CELL maps every vertex and updates the detector's boxes and spheres.",
      ),
      ...part.scenes.map(sceneDetails),
      h("h3", {}, "The paper's own numbers"),
      p(part.own_numbers),
      unfolding("All checks", () => [checksTable(part.checks)]),
    ];
  },
};
