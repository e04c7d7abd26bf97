// What a suite hoped to measure, and what it did.
import {p} from "../dom";
import type {Section} from "../section";
import {table, type Cell} from "../table";

const kMet: Record<string, Cell> = {
  yes: {text: "✓ yes", class: "good"},
  no: {text: "✗ no", class: "bad"},
};

export const goals: Section = {
  id: "goals",
  title: "Goals of the suite",
  short: "Goals",
  build({goals: {text, columns, rows}}) {
    if (rows.length === 0) return [];
    return [
      p(text),
      table(
        columns,
        rows.map((row) => [
          ...row.slice(0, -1),
          kMet[row.at(-1)!] ?? {text: row.at(-1)!, class: "wrap"},
        ]),
        "Goals",
      ),
    ];
  },
};
