// Where, with what and how these results were made.
import {h} from "../dom";
import type {Section} from "../section";
import {withCode} from "../table";

export const machine: Section = {
  id: "machine",
  title: "Machine, libraries and command",
  short: "Machine",
  build: ({machine: lines}) => [
    h("ul", {class: "plain"}, ...lines.map((line) => h("li", {}, ...withCode(line)))),
  ],
};
