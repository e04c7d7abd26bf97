// Where true contacts are lost: stage by stage.
import * as Plot from "@observablehq/plot";
import {chart, legend} from "../chart";
import {controlBar, selectPlace} from "../controls";
import {h, p, unfolding} from "../dom";
import {grouped} from "../format";
import type {StageLosses} from "../page";
import type {Section} from "../section";
import {square} from "../swatch";
import {textTable} from "../table";

const kColours = [
  "var(--blue)",
  "var(--orange)",
  "var(--green)",
  "var(--purple)",
  "var(--red)",
  "var(--sky)",
  "var(--grey)",
];

interface Loss {
  detector: string;
  stage: string;
  missed: number;
  share: number;
  percent: string;
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
            `${d.detector}\nstage ${d.stage}\n${grouped(d.missed)} true pairs lost (${d.percent})`,
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

function picture({bars, stages: names, sentences, without_loss}: StageLosses): HTMLElement[] {
  if (bars.length === 0) return [p(without_loss)];
  const losses = bars.map(([detector, stage, missed, share, percent]) => ({
    detector,
    stage,
    missed,
    share,
    percent,
  }));
  return [
    chart("Share of true contacts lost in each stage", (width) => draw(width, losses, names))
      .element,
    legend(
      names.map((name, i) => ({
        text: `lost in ${name}`,
        swatch: square(kColours[i % kColours.length]),
      })),
    ),
    h("ul", {class: "plain"}, ...sentences.map((text) => h("li", {}, text))),
    ...(without_loss ? [h("p", {class: "note"}, without_loss)] : []),
  ];
}

export const stages: Section = {
  id: "stages",
  title: "Where contacts are lost, stage by stage",
  short: "Stages",
  build({choices, stages: computed}) {
    if (computed.every(({table}) => table.rows.length === 0)) return [];
    const place = h("div");
    const update = (choice: number): void =>
      place.replaceChildren(
        ...picture(computed[choice]),
        unfolding("What went in and out of every stage", () => textTable(computed[choice].table)),
      );
    update(0);
    return [
      p(
        "A detector sorts pairs out in stages, from coarse to fine. A stage loses a true pair of triangles when what goes in still ",
        "covers it and what comes out does not. The losses of all stages add up to what the detector misses; ",
        "a scene in which it is judged by pairs of bodies alone does not count.",
      ),
      controlBar(selectPlace("Scenes", choices, 0, update)),
      place,
    ];
  },
};
