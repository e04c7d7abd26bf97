// What the results say about claims of the paper and of the libraries.
import {code, h, type Child} from "../dom";
import type {Report} from "../report";
import type {Section} from "../section";
import {table} from "../table";

/** The place of the claim about Bullet's normals, where the results have it. */
export const kTurnedNormals = "turned-normals";
const kNormals = "Bullet's vertex-face normals";

export const hasTurnedNormals = (report: Report): boolean =>
  report.results.report.claims.some(({title}) => title.startsWith(kNormals));

const withCode = (text: string): Child[] =>
  text.split("`").map((part, i) => (i % 2 === 1 ? code(part) : part));

export const claims: Section = {
  id: "claims",
  title: "What the results say about claims",
  short: "Claims tested",
  build: (report) =>
    report.results.report.claims.flatMap(({title, text, columns, rows}) => [
      h("h3", {id: title.startsWith(kNormals) ? kTurnedNormals : undefined}, ...withCode(title)),
      h("p", {}, ...withCode(text)),
      table(columns, rows, title.replaceAll("`", "")),
    ]),
};
