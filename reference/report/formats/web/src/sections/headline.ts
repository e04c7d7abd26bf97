// The top of the page: what was found, by which command, on which machine.
import {h} from "../dom";
import type {Page} from "../page";
import {withCode} from "../table";
import {themeSwitch} from "../theme";

export function header({
  version,
  title,
  findings,
  run,
  parts,
}: Pick<Page, "version" | "title" | "findings" | "run" | "parts">): HTMLElement {
  return h(
    "header",
    {},
    h(
      "div",
      {class: "topline"},
      h("span", {class: "brand"}, `contactcheck ${version}`),
      themeSwitch(),
    ),
    h("h1", {}, title),
    h(
      "dl",
      {class: "findings"},
      ...findings.flatMap(({topic, sentence}) => [h("dt", {}, topic), h("dd", {}, sentence)]),
    ),
    ...[run, ...parts].map((text) => h("p", {class: "note"}, ...withCode(text))),
  );
}
