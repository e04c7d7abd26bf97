// The top of the page: what was found, by which command, on which machine.
import {code, h, type Child} from "../dom";
import type {Report} from "../report";
import {themeSwitch} from "../theme";

/** Whoever reads a part must not take it for the whole. */
function partNote({results: {shard, merged, scenes}}: Report): Child {
  if (shard)
    return h(
      "p",
      {class: "note"},
      `Shard ${shard.index} of ${shard.of}: ${scenes.length} of the ${shard.scenes.length} scenes of `,
      code(shard.command),
      "; ",
      code("contactcheck merge"),
      " puts the shards together.",
    );
  return (
    merged &&
    h(
      "p",
      {class: "note"},
      `Put together from ${merged.length} shards (`,
      code("contactcheck merge"),
      ").",
    )
  );
}

export function header(report: Report): HTMLElement {
  const {command, version, machine, resumed = [], report: said} = report.results;
  return h(
    "header",
    {},
    h(
      "div",
      {class: "topline"},
      h("span", {class: "brand"}, `contactcheck ${version}`),
      themeSwitch(),
    ),
    h("h1", {}, said.title),
    h(
      "dl",
      {class: "findings"},
      ...said.findings.flatMap(({topic, sentence}) => [h("dt", {}, topic), h("dd", {}, sentence)]),
    ),
    h(
      "p",
      {class: "note"},
      code(command),
      ` on ${machine.cpu}, ${machine.cores} cores, ${machine.isa}.`,
    ),
    partNote(report),
    resumed.length > 0 &&
      h(
        "p",
        {class: "note"},
        `Taken over from an earlier run that was interrupted (--resume), with the times measured then: ${resumed.join(", ")}.`,
      ),
  );
}
