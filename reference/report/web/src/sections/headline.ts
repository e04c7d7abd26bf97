// The top of the page: what was found, by which command, on which machine.
import {h, code} from "../dom";
import {findings, title} from "../headline";
import type {Report} from "../report";
import {themeSwitch} from "../theme";

export function header(report: Report): HTMLElement {
  const {command, version, machine, resumed = []} = report.results;
  const list = findings(report).flatMap(({topic, sentence}) => [h("dt", {}, topic), h("dd", {}, sentence)]);
  return h("header", {},
    h("div", {class: "topline"}, h("span", {class: "brand"}, `contactcheck ${version}`), themeSwitch()),
    h("h1", {}, title(report)),
    h("dl", {class: "findings"}, ...list),
    h("p", {class: "note"}, code(command), ` on ${machine.cpu}, ${machine.cores} cores, ${machine.isa}.`),
    resumed.length > 0 && h("p", {class: "note"},
      `Taken over from an earlier run that was interrupted (--resume), with the times measured then: ${resumed.join(", ")}.`));
}
