// The hard cases: who is right in how many, and from which value of its parameter on each goes wrong.
import {legend} from "../chart";
import {h, p, unfolding, type Child} from "../dom";
import {familyResults, type FamilyResult} from "../family";
import {number, plural} from "../format";
import type {Report} from "../report";
import type {Scene} from "../results";
import type {Section} from "../section";
import {showCell} from "../showing";
import {stabilityPlot} from "../stability_plot";
import {square} from "../swatch";
import {left, right, table, type Cell, type Row} from "../table";
import {canShow, showInView} from "../view_slot";
import {heat} from "./levels";

function sumCells(detector: string, all: FamilyResult[]): Row {
  const results = all.filter((r) => r.run.status !== "absent"),
    judged = results.filter((r) => r.judged);
  const sum = (of: (r: FamilyResult) => number): number => judged.reduce((n, r) => n + of(r), 0);
  const count = (list: FamilyResult[], test: (r: FamilyResult) => boolean): number =>
    list.filter(test).length;
  const timed = judged.filter((r) => r.milliseconds !== null);
  const slowest = timed.reduce<FamilyResult | null>(
    (best, r) => (!best || r.milliseconds! > best.milliseconds! ? r : best),
    null,
  );
  const level = judged.length > 0 ? judged[judged.length - 1].run.per_frame.level! : "-";
  return [
    detector,
    level,
    `${count(judged, (r) => r.wrong === 0)} of ${results.length}`,
    `${sum((r) => r.cases - r.wrong)} of ${sum((r) => r.cases)}`,
    String(sum((r) => r.sum("missed"))),
    String(sum((r) => r.sum("spurious"))),
    String(count(results, (r) => r.failed)),
    String(count(results, (r) => r.run.status === "refused")),
    timed.length > 0
      ? number(timed.reduce((ms, r) => ms + r.milliseconds!, 0) / timed.length)
      : "-",
    slowest ? `${number(slowest.milliseconds)} ${slowest.scene.id}` : "-",
  ];
}

function sumTable(report: Report, results: Map<Scene, FamilyResult[]>): HTMLElement {
  const byDetector = new Map<string, FamilyResult[]>();
  for (const result of [...results.values()].flat()) {
    const name = result.run.detector;
    if (!byDetector.has(name)) byDetector.set(name, []);
    byDetector.get(name)!.push(result);
  }
  const rows = report.detectors
    .filter((name) => byDetector.has(name))
    .map((name) => sumCells(name, byDetector.get(name)!));
  return table(
    [
      left("detector"),
      left("level"),
      right("families right"),
      right("cases right"),
      right("missed"),
      right("spurious"),
      right("families with error"),
      right("refused"),
      right("ms a case"),
      left("slowest family"),
    ],
    rows,
    "Hard cases per detector",
  );
}

function matrixCell(result: FamilyResult | undefined): Cell {
  if (!result) return {text: "", sort: null};
  if (result.failed || !result.judged)
    return {text: result.run.status, class: "error", label: result.run.message};
  const label = `${result.run.detector} in ${result.scene.id}: ${result.wrong} of ${result.cases} cases wrong`;
  return {
    text: result.wrong === 0 ? "·" : String(result.wrong),
    sort: result.wrong,
    label,
    heat: heat(result.wrong / result.cases, "--red"),
  };
}

// Families in which nobody goes wrong would only make the table longer.
function matrix(report: Report, results: Map<Scene, FamilyResult[]>): Child[] {
  const bad = [...results].filter(([, all]) => all.some((r) => r.goesWrong));
  const wrongDetectors = new Set(
    bad.flatMap(([, all]) => all.filter((r) => r.goesWrong).map((r) => r.run.detector)),
  );
  const names = report.detectors.filter((name) => wrongDetectors.has(name));
  if (bad.length === 0) return [p("No detector goes wrong in any family.")];
  const rows: Row[] = bad.map(([scene, all]) => {
    const own = new Map(all.map((r) => [r.run.detector, r]));
    return [
      scene.id,
      String(scene.family!.values.length),
      ...names.map((name) => matrixCell(own.get(name))),
    ];
  });
  return [
    table(
      [left("family"), right("cases"), ...names.map((name) => right(name))],
      rows,
      "Cases that each detector gets wrong, by family",
    ),
  ];
}

// To where it goes wrong first, or to the case without an answer.
function shownCase({scene, run}: FamilyResult, frame: number | undefined, missed: number): Cell[] {
  if (!canShow(scene.id)) return [];
  if (frame === undefined) return [{text: "-"}];
  return [
    showCell({
      scene: scene.id,
      detector: run.detector,
      frame,
      kind: missed > 0 ? "missed" : "spurious",
    }),
  ];
}

function wrongRow(result: FamilyResult): Row {
  const detector = result.run.detector;
  if (result.failed) {
    const frame = result.run.failed_frame;
    return [
      detector,
      frame === undefined ? "-" : result.value(frame),
      {text: result.run.message, class: "wrap"},
      "-",
      "-",
      "-",
      ...shownCase(result, frame, 0),
    ];
  }
  const first = result.frames().find((frame) => result.wrongAt(frame))!;
  return [
    detector,
    result.value(first),
    `${result.at("missed", first)} missed, ${result.at("spurious", first)} spurious of ${result.at("truth", first)} true`,
    `${result.wrong} of ${result.cases}`,
    String(result.sum("missed")),
    String(result.sum("spurious")),
    ...shownCase(result, first, result.at("missed", first)),
  ];
}

function familyDetails(scene: Scene, wrong: FamilyResult[]): HTMLElement {
  const {parameter, values, stresses, origin} = scene.family!;
  const who = plural(wrong.length, "detector goes wrong", "detectors go wrong");
  const aside = h("span", {class: "aside"}, ` ${scene.title}: ${who}`);
  return unfolding(
    h("span", {}, h("strong", {}, scene.id), aside),
    () => [
      p(
        `Parameter: ${parameter}, ${values.length} values from ${values[0]} on. Hard for: ${stresses}. From: ${origin}.`,
      ),
      h(
        "div",
        {class: "scroll", role: "region", tabindex: 0, "aria-label": `Case by case, ${scene.id}`},
        h(
          "figure",
          {class: "chart"},
          stabilityPlot(
            wrong,
            (detector, frame) =>
              canShow(scene.id) && showInView({scene: scene.id, detector, frame}),
          ),
        ),
      ),
      h("p", {class: "note"}, parameter),
      table(
        [
          left("detector"),
          left("first wrong at"),
          left("there"),
          right("cases wrong"),
          right("missed"),
          right("spurious"),
          ...(canShow(scene.id) ? [left("in 3D")] : []),
        ],
        wrong.map(wrongRow),
        `Who goes wrong in ${scene.id}`,
      ),
    ],
    {class: "block", id: `family-${scene.id}`},
  );
}

export const hard: Section = {
  id: "hard",
  title: "Hard cases",
  build(report) {
    if (report.families.length === 0) return [];
    const results = new Map(report.families.map((scene) => [scene, familyResults(report, scene)]));
    const wrong = [...results]
      .map(([scene, all]): [Scene, FamilyResult[]] => [scene, all.filter((r) => r.goesWrong)])
      .filter(([, all]) => all.length > 0);
    return [
      p(
        "Families of cases made to be hard, each with a parameter that makes it harder. Every case is judged exactly, at the finest level " +
          "that a detector claims. Milliseconds are means over families, mapping and update included, cold; beside them the family that costs most.",
      ),
      sumTable(report, results),
      h("h3", {}, "Cases wrong, by family"),
      p("Only families and detectors with an error; a dot means that all cases are right."),
      ...matrix(report, results),
      wrong.length > 0 && h("h3", {}, "Where they go wrong"),
      wrong.length > 0 &&
        p(
          "One square per case: a triangle pointing down in its upper half for a share missed, one pointing up in its " +
            "lower half for a share spurious; the fuller the colour the larger. A cross is an error, a dashed square a case without an answer.",
        ),
      wrong.length > 0 &&
        legend([
          {text: "share missed", swatch: square("var(--missed)")},
          {text: "share spurious", swatch: square("var(--spurious)")},
          {text: "right", swatch: square("var(--right)")},
          {text: "error", swatch: square("var(--ink)")},
        ]),
      ...wrong.map(([scene, all]) => familyDetails(scene, all)),
    ];
  },
};
