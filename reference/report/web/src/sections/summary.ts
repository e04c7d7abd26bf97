// One line per detector: the sums over scenes, as the other reports have them.
import {p} from "../dom";
import {millimetres, number, plural, rate} from "../format";
import {term} from "../glossary";
import {kReferences} from "../results";
import type {Section} from "../section";
import {share, speedupRange, summaryLines, type SummaryLine} from "../sums";
import {left, right, table} from "../table";

function rangeText(line: SummaryLine, reference: string): string {
  const range = speedupRange(line, reference);
  if (!range) return "-";
  const [from, to] = range.map(number);
  return from === to ? `${from}x` : `${from} to ${to}x`;
}

export const summary: Section = {
  id: "summary",
  title: "Summary",
  build(report) {
    const rows = summaryLines(report).map((line) => [
      line.detector,
      line.scenes + (line.notOk > 0 ? ` (${line.notOk} not ok)` : ""),
      line.level,
      line.counts ? String(line.counts.truth) : "-",
      rate(line.counts && share(line.counts.hit, line.counts.truth)),
      line.counts ? String(line.counts.missed) : "-",
      line.counts ? String(line.counts.spurious) : "-",
      line.body ? `${line.body.missed}/${line.body.spurious}` : "-",
      line.hover === null ? "-" : millimetres(line.hover),
      line.question,
      ...kReferences.map((reference) => rangeText(line, reference)),
    ]);
    return [
      p(
        `Sums over ${plural(report.results.scenes.length, "scene")}, at the finest `,
        term("level"),
        " that a detector claims. " +
          "“body m/s” counts pairs of bodies missed and spurious. The last columns are speed-ups: the time of the " +
          "detector named divided by the time of this one in the same ",
        term("question"),
        ", ",
        term("cold"),
        ", the smallest and the largest of any scene. " + "A click on a heading sorts.",
      ),
      table(
        [
          left("detector"),
          right("scenes"),
          left("level"),
          right("truth"),
          right("recall"),
          right("missed"),
          right("spurious"),
          right("body m/s"),
          right("hover mm"),
          left("question"),
          ...kReferences.map((reference) => right(`vs ${reference}`)),
        ],
        rows,
        "Summary of all detectors",
      ),
    ];
  },
};
