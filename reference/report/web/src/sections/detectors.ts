// What each detector claims, from its first run that ended well.
import {p} from "../dom";
import {millimetres, number, optionsText} from "../format";
import {isOk} from "../report";
import type {Semantics} from "../results";
import type {Section} from "../section";
import {left, table} from "../table";

export function semanticsText(s: Semantics): string {
  const names = (list: string[] | undefined): string => (list ?? []).join(", ");
  let text = `levels ${names(s.levels)}`;
  if (names(s.informative) !== "") text += `; informative ${names(s.informative)}`;
  text += `; questions ${names(s.questions)}; ${s.body ?? "surface"}, ${s.touching ?? "closed"}, ${s.exact ? "exact" : "not exact"}`;
  if ((s.margin ?? 0) > 0) text += `; margin ${millimetres(s.margin)} mm`;
  text += `; ${s.precision ?? "double"} precision`;
  if (s.local_origin) text += " about a local origin";
  if ((s.scale ?? 1) !== 1) text += `, scale ${number(s.scale)}`;
  if ((s.depth_kind ?? "none") !== "none") text += `; depth ${s.depth_kind}`;
  return s.means ? `${text}; ${s.means}` : text;
}

export const detectors: Section = {
  id: "detectors",
  title: "What each detector claims",
  short: "Detectors",
  build(report) {
    const rows = report.detectors.flatMap((detector) => {
      const run = report.results.runs.find((r) => r.detector === detector && isOk(r));
      if (!run?.semantics.levels) return [];
      return [
        [
          detector,
          {text: optionsText(run.options), class: "wrap"},
          {text: semanticsText(run.semantics), class: "wrap"},
        ],
      ];
    });
    if (rows.length === 0) return [];
    return [
      p("A level that is not claimed is not judged."),
      table(
        [left("detector"), left("options"), left("claims")],
        rows,
        "Options and claims of the detectors",
      ),
    ];
  },
};
