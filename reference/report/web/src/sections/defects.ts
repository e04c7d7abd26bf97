// The list of known defects beside what the run shows.
import {p} from "../dom";
import type {Section} from "../section";
import {textTable} from "../table";

export const defects: Section = {
  id: "defects",
  title: "Known wrong answers",
  short: "Known defects",
  build({known_defects: known}) {
    if (!known) return [];
    return [
      p(known.sentence),
      ...known.tables.flatMap((table) => textTable(table, table.text || "Known defects")),
    ];
  },
};
