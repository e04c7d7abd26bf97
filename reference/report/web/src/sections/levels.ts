// Recall and spurious contacts per scene, as a table with heat colours.
import {controlBar, radios, select} from "../controls";
import {h, p} from "../dom";
import {errorRate, grouped, rate, share} from "../format";
import {term} from "../glossary";
import {finestLevel, kFinest, levelOf, type Report} from "../report";
import type {Counts, Run} from "../results";
import type {Section} from "../section";
import {left, right, table, type Cell, type Row} from "../table";

type Measure = "recall" | "spurious";

/** The colour says a logarithm, so that one lost contact of 10,000 can be seen. */
export function heat(errors: number | null, colour: string): Cell["heat"] {
  if (errors === null || errors === 0) return undefined;
  const strength = 12 + 48 * Math.min(1, Math.max(0, 1 + Math.log10(errors) / 4));
  return {
    background: `color-mix(in srgb, var(${colour}) ${strength.toFixed(0)}%, var(--surface))`,
    ink: "var(--ink)",
  };
}

function countsCell(counts: Counts | null, measure: Measure, where: string): Cell {
  if (!counts) return {text: "", sort: null};
  const label =
    `${where}: ${grouped(counts.truth)} true, ${grouped(counts.missed)} missed, ` +
    `${grouped(counts.reported)} reported, ${grouped(counts.spurious)} spurious`;
  if (measure === "spurious") {
    const value = share(counts.spurious, counts.reported);
    return {text: errorRate(value), sort: value, heat: heat(value, "--spurious"), label};
  }
  const recall = share(counts.hit, counts.truth);
  return {
    text: rate(recall),
    sort: recall,
    heat: heat(share(counts.missed, counts.truth), "--missed"),
    label,
  };
}

function sceneCell(run: Run | null, level: string, measure: Measure): Cell {
  if (!run) return {text: "", sort: null};
  if (run.status !== "ok")
    return {
      text: run.status,
      class: "error",
      label: `${run.detector} in ${run.scene}: ${run.message}`,
    };
  const where = `${run.detector} in ${run.scene}, level ${level === kFinest ? finestLevel(run) : level}`;
  return countsCell(levelOf(run, level), measure, where);
}

function sumCell(detector: string, sum: Counts | string | null, measure: Measure): Cell {
  if (typeof sum === "string") return {text: sum, sort: null, class: "informative"};
  return countsCell(sum, measure, `${detector}, all scenes`);
}

function heatTable(report: Report, level: string, measure: Measure): HTMLElement {
  const rows: Row[] = [];
  for (const [i, detector] of report.detectors.entries()) {
    const runs = report.scenes.map((scene) => report.run(scene.id, detector));
    const ok = runs.filter((run) => run?.status === "ok") as Run[];
    if (!ok.some((run) => levelOf(run, level)) && !runs.some((run) => run && run.status !== "ok"))
      continue;
    const sum = sumCell(detector, report.results.report.sums[level][i], measure);
    rows.push([
      detector,
      ...(report.scenes.length > 1 ? [sum] : []),
      ...runs.map((run) => sceneCell(run, level, measure)),
    ]);
  }
  const columns = [
    left("detector"),
    ...(report.scenes.length > 1 ? [right("all scenes")] : []),
    ...report.scenes.map((scene) => right(scene.id)),
  ];
  return table(
    columns,
    rows,
    measure === "recall" ? "Recall per detector and scene" : "Spurious rate per detector and scene",
  );
}

export const levels: Section = {
  id: "levels",
  title: "Who finds what, scene by scene",
  short: "Scene by scene",
  build(report) {
    if (report.scenes.length === 0) return [];
    const choice: {level: string; measure: Measure} = {level: kFinest, measure: "recall"};
    const place = h("div");
    const update = (change: Partial<typeof choice>): void => {
      Object.assign(choice, change);
      place.replaceChildren(heatTable(report, choice.level, choice.measure));
    };
    update({});
    const names = report.results.report.levels.map((name): [string, string] => [name, name]);
    return [
      p(
        term("recall", "Recall"),
        " is the share of true contacts that was found: 1 is perfect, and any other number has a colour. " +
          "The ",
        term("spurious"),
        " rate is the share of reports that are no contact: 0 is perfect. A dash: nothing to find, or nothing " +
          "reported. An empty cell: the detector does not claim this ",
        term("level"),
        " there; " +
          "where its finest level is not the same in all scenes, choose a level to have a sum.",
      ),
      controlBar(
        select("Level", [[kFinest, "each detector's finest"], ...names], choice.level, (level) =>
          update({level}),
        ),
        radios(
          "Shown",
          [
            ["recall", "recall"],
            ["spurious", "spurious rate"],
          ],
          choice.measure,
          (value) => update({measure: value as Measure}),
        ),
      ),
      place,
    ];
  },
};
