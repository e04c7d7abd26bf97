// The list of known defects beside what the run shows.
import {p, type Child} from "../dom";
import type {KnownDefect, Sightings} from "../results";
import type {Section} from "../section";
import {left, right, table, titledTable} from "../table";

const shown = (defect: KnownDefect): string =>
  defect.other_version ? "other version" : `${defect.shown} of ${defect.listed}`;

function sightings(title: string, groups: Sightings[]): Child[] {
  const rows = groups.map((g) => [
    g.detector,
    g.scene,
    g.kind,
    {text: g.values.join(", "), class: "wrap"},
  ]);
  return titledTable(title, [left("detector"), left("family"), left("kind"), left("at")], rows);
}

export const defects: Section = {
  id: "defects",
  title: "Known defects of libraries",
  short: "Known defects",
  build(report) {
    const known = report.results.known_defects;
    if (!known) return [];
    const rows = known.defects.map((d) => [
      `${d.library} ${d.version}`,
      {text: d.issue, class: "wrap"},
      d.kind,
      {text: d.sentence, class: "wrap"},
      {text: d.detectors.join(", "), class: "wrap"},
      String(d.scenes.length),
      shown(d),
    ]);
    return [
      p(report.results.report.known_defects!),
      rows.length > 0 &&
        table(
          [
            left("library"),
            left("described in"),
            left("seen as"),
            left("why"),
            left("detectors"),
            right("families"),
            right("cases that show it"),
          ],
          rows,
          "Known defects",
        ),
      ...sightings(
        "Listed, and not shown: mended in this build of the library, or the case has changed.",
        known.not_shown,
      ),
      ...sightings("Shown, and not listed.", known.unlisted),
    ];
  },
};
