// Where true contacts are lost: stage by stage.
import * as Plot from "@observablehq/plot";
import {chart, legend} from "../chart";
import {controlBar, select} from "../controls";
import {h, p, unfolding} from "../dom";
import {grouped, listed, percent, share, shortList} from "../format";
import {finestLevel, type Report} from "../report";
import type {Run, Scene, Stage} from "../results";
import {chosenScenes, sceneOptions} from "../scene_choice";
import type {Section} from "../section";
import {square} from "../swatch";
import {left, right, table} from "../table";

const kColours = [
  "var(--blue)",
  "var(--orange)",
  "var(--green)",
  "var(--purple)",
  "var(--red)",
  "var(--sky)",
  "var(--grey)",
];

interface Losses {
  detector: string;
  truth: number;
  stages: Stage[];
}

interface Loss {
  detector: string;
  stage: string;
  missed: number;
  share: number;
}

function addStage(stages: Stage[], stage: Stage): void {
  const own = stages.find(
    (s) => s.name === stage.name && s.unit === stage.unit && s.visited_unit === stage.visited_unit,
  );
  if (!own) {
    stages.push({...stage});
    return;
  }
  own.in += stage.in;
  own.out += stage.out;
  own.missed += stage.missed;
  if (own.visited !== undefined) own.visited += stage.visited ?? 0;
}

// Stages cover pairs of triangles, and so do truth and missed of these two levels. What is judged by
// pairs of bodies alone may stop at the first contact: the others are no loss.
const countsTriangles = (run: Run): boolean => ["cell", "triangle"].includes(finestLevel(run));

function lossesOf(report: Report, detector: string, scenes: Scene[]): Losses | null {
  const runs = scenes
    .map((scene) => report.okRun(scene.id, detector))
    .filter((run) => run !== null)
    .filter((run) => (run.stages ?? []).length > 0 && countsTriangles(run));
  if (runs.length === 0) return null;
  const stages: Stage[] = [];
  let truth = 0;
  for (const run of runs) {
    truth += run.levels[finestLevel(run)]?.truth ?? 0;
    for (const stage of run.stages) addStage(stages, stage);
  }
  return {detector, truth, stages};
}

function draw(width: number, losses: Loss[], names: string[]): Node {
  const detectors = [...new Set(losses.map((loss) => loss.detector))];
  const wide = Math.max(0, ...detectors.map((name) => name.length)) * 6.6 + 12;
  const narrow = width < 600;
  return Plot.plot({
    width,
    height: 52 + (narrow ? 48 : 30) * detectors.length,
    marginLeft: narrow ? 8 : wide,
    marginBottom: 36,
    marginTop: 8,
    marginRight: 20,
    x: {label: "share of the true contacts lost, % →", percent: true, grid: true, nice: true},
    y: {
      label: null,
      domain: detectors,
      axis: narrow ? null : "left",
      tickSize: 0,
      paddingInner: narrow ? 0.5 : 0.25,
    },
    color: {domain: names, range: kColours},
    marks: [
      Plot.barX(
        losses,
        Plot.stackX({
          y: "detector",
          x: "share",
          fill: "stage",
          order: names,
          insetRight: 1,
          ariaLabel: (d: Loss) => `${d.detector}: ${d.missed} lost in ${d.stage}`,
          tip: true,
          title: (d: Loss) =>
            `${d.detector}\nstage ${d.stage}\n${grouped(d.missed)} true pairs lost (${percent(d.share)})`,
        }),
      ),
      Plot.text(
        losses.filter((d) => d.share * width > 0.02 * width),
        Plot.stackX({
          y: "detector",
          x: "share",
          z: "stage",
          order: names,
          text: (d: Loss) => grouped(d.missed),
          fill: "currentColor",
          stroke: "var(--surface)",
          strokeWidth: 4,
        }),
      ),
      narrow
        ? Plot.text(detectors, {
            y: (d: string) => d,
            text: (d: string) => d,
            frameAnchor: "left",
            dy: -19,
            fill: "currentColor",
          })
        : null,
      Plot.ruleX([0]),
    ],
  });
}

function sentences(all: Losses[]): string[] {
  return all
    .filter((l) => l.stages.some((stage) => stage.missed > 0))
    .map(({detector, stages}) => {
      const parts = stages
        .filter((stage) => stage.missed > 0)
        .map((stage) => `${grouped(stage.missed)} in ${stage.name}`);
      const total = stages.reduce((sum, stage) => sum + stage.missed, 0);
      return `${detector} loses ${grouped(total)}: ${listed(parts)}.`;
    });
}

function stagesTable(all: Losses[]): HTMLElement {
  const rows = all.flatMap(({detector, stages}) =>
    stages.map((stage) => [
      detector,
      stage.name,
      stage.unit,
      String(stage.in),
      String(stage.out),
      stage.visited === undefined ? "-" : `${stage.visited} ${stage.visited_unit}`,
      String(stage.missed),
    ]),
  );
  return table(
    [
      left("detector"),
      left("stage"),
      left("unit"),
      right("in"),
      right("out"),
      right("visited"),
      right("missed"),
    ],
    rows,
    "What went in and out of every stage, summed over the scenes chosen",
  );
}

function picture(all: Losses[]): HTMLElement[] {
  if (all.length === 0)
    return [p("No detector with stages was judged by pairs of triangles here.")];
  const losses: Loss[] = all.flatMap(({detector, truth, stages}) =>
    stages
      .filter((stage) => stage.missed > 0)
      .map((stage) => ({
        detector,
        stage: stage.name,
        missed: stage.missed,
        share: share(stage.missed, truth) ?? 0,
      })),
  );
  if (losses.length === 0) return [p("No stage of any detector lost a true contact here.")];
  const order = [...new Set(all.flatMap(({stages}) => stages.map((stage) => stage.name)))];
  const names = order.filter((name) => losses.some((loss) => loss.stage === name));
  const clean = all
    .filter(({stages}) => stages.every((stage) => stage.missed === 0))
    .map(({detector}) => detector);
  return [
    chart("Share of true contacts lost in each stage", (width) => draw(width, losses, names))
      .element,
    legend(
      names.map((name, i) => ({
        text: `lost in ${name}`,
        swatch: square(kColours[i % kColours.length]),
      })),
    ),
    h(
      "ul",
      {class: "plain"},
      ...sentences(all)
        .slice(0, 12)
        .map((text) => h("li", {}, text)),
    ),
    ...(clean.length > 0
      ? [h("p", {class: "note"}, `Without a loss in any stage: ${shortList(clean, 24)}.`)]
      : []),
  ];
}

export const stages: Section = {
  id: "stages",
  title: "Where contacts are lost, stage by stage",
  short: "Stages",
  build(report) {
    if (!report.results.runs.some((run) => (run.stages ?? []).length > 0)) return [];
    const options = sceneOptions(report),
      place = h("div");
    const update = (value: string): void => {
      const all = report.detectors
        .map((name) => lossesOf(report, name, chosenScenes(report, value)))
        .filter((l) => l !== null);
      place.replaceChildren(
        ...picture(all),
        unfolding("What went in and out of every stage", () => [stagesTable(all)]),
      );
    };
    update(options[0][0]);
    return [
      p(
        "A detector sorts pairs out in stages, from coarse to fine. A stage loses a true pair of triangles when what goes in still ",
        "covers it and what comes out does not. The losses of all stages add up to what the detector misses; ",
        "a scene in which it is judged by pairs of bodies alone does not count.",
      ),
      controlBar(select("Scenes", options, options[0][0], update)),
      place,
    ];
  },
};
