// What the results say about claims of the paper and of the libraries.
import {h} from "../dom";
import type {Page} from "../page";
import type {Section} from "../section";
import {textTable, withCode} from "../table";

/** The place of the claim about Bullet's normals, where the results have it. */
export const kTurnedNormals = "turned-normals";

export const hasTurnedNormals = ({claims: all}: Page): boolean =>
  all.some(({id}) => id === kTurnedNormals);

export const claims: Section = {
  id: "claims",
  title: "What the results say about claims",
  short: "Claims tested",
  build: (page) =>
    page.claims.flatMap((claim) => [
      h("h3", {id: claim.id}, ...withCode(claim.title)),
      ...textTable(claim),
    ]),
};
