// What each detector claims.
import type {Section} from "../section";
import {textTable} from "../table";

export const detectors: Section = {
  id: "detectors",
  title: "What each detector claims",
  short: "Detectors",
  build: ({claimed}) => textTable(claimed, "Options and claims of the detectors"),
};
