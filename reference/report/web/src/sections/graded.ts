// How far off depths and normals are: mean, 95th percentile and maximum as ranges.
import * as Plot from "@observablehq/plot";
import {chart} from "../chart";
import {controlBar, select} from "../controls";
import {h, p, type Child} from "../dom";
import {grouped, number} from "../format";
import {groupOf} from "../groups";
import type {Report} from "../report";
import type {Geometry, Scene} from "../results";
import {sceneOptions, chosenScenes} from "../scene_choice";
import type {Section} from "../section";

export interface Spread {
  detector: string;
  kind: string;
  judged: number;
  mean: number;
  p95: number;
  max: number;
}

interface Quantity {
  title: string;
  axis: string;
  unit: string;
  /** From the unit of results.json. */
  factor: number;
  scaleOf(largest: number): Plot.ScaleOptions;
  /** Kinds that do not compare have charts of their own. */
  byKind: boolean;
  of(g: Geometry): {judged?: number; mean?: number | null; p95?: number | null; max: number | null};
}

// Errors of rounding and of whole cells stand in one chart, and so does 0: linear below a micrometre.
const depthScale = (largest: number): Plot.ScaleOptions =>
  ({type: "symlog", constant: 1e-3, domain: [0, largest], ticks: [0, 0.01, 0.1, 1, 10, 100, 1000,
      10000].filter((tick) => tick <= largest)});
const angleScale = (): Plot.ScaleOptions => ({domain: [0, 180], ticks: [0, 45, 90, 135, 180]});

const kQuantities: Quantity[] = [
  {title: "Depth", axis: "error of the depth, mm →", unit: "mm", factor: 1e3, scaleOf: depthScale,
      byKind: true,
   of: (g) => ({judged: g.depth_judged, mean: g.depth_error_mean, p95: g.depth_error_p95,
       max: g.depth_error_max})},
  {title: "Normal", axis: "error of the normal, degrees →", unit: "°", factor: 1, scaleOf: angleScale,
      byKind: false,
   of: (g) => ({judged: g.normal_judged, mean: g.normal_error_deg_mean, p95: g.normal_error_deg_p95,
       max: g.normal_error_deg_max})},
];

// Over several scenes: the mean of all contacts judged, the worst p95 and the worst maximum.
function spreadOf(report: Report, detector: string, scenes: Scene[], quantity: Quantity): Spread | null {
  const out: Spread = {detector, kind: "", judged: 0, mean: 0, p95: 0, max: 0};
  for (const scene of scenes) {
    const geometry = report.okRun(scene.id, detector)?.geometry;
    const values = geometry && quantity.of(geometry);
    if (!geometry || !values?.judged || values.max === null) continue;
    out.kind = geometry.depth_kind ?? "";
    out.judged += values.judged;
    out.mean += values.judged * quantity.factor * (values.mean ?? 0);
    out.p95 = Math.max(out.p95, quantity.factor * (values.p95 ?? values.max));
    out.max = Math.max(out.max, quantity.factor * values.max);
  }
  out.mean /= Math.max(1, out.judged);
  return out.judged > 0 ? out : null;
}

const sentence = (spread: Spread, unit: string): string =>
  `${spread.detector} (${spread.kind})\nmean ${number(spread.mean)} ${unit}, 95 % below ${number(spread.p95)} ${unit}, `
  + `largest ${number(spread.max)} ${unit}\n${grouped(spread.judged)} contacts judged`;

function draw(width: number, all: Spread[], quantity: Quantity): Node {
  const narrow = width < 600, names = all.map((spread) => spread.detector);
  const wide = Math.max(...names.map((name) => name.length)) * 6.6 + 12;
  const title = (d: Spread): string => sentence(d, quantity.unit),
      colour = (d: Spread): string => groupOf(d.detector).colour;
  return Plot.plot({
    width, height: 50 + (narrow ? 44 : 26) * all.length, marginLeft: narrow ? 10 : wide, marginRight: 24,
        marginTop: 10, marginBottom: 38,
    x: {...quantity.scaleOf(Math.max(...all.map((d) => d.max))), label: quantity.axis, grid: true,
        tickFormat: String},
    y: {domain: names, label: null, axis: narrow ? null : "left", tickSize: 0},
    marks: [
      Plot.ruleY(all, {y: "detector", x1: "mean", x2: "max", stroke: colour, strokeWidth: 2}),
      Plot.dot(all, {y: "detector", x: "mean", fill: colour, r: 4.5, ariaLabel: title}),
      Plot.dot(all, {y: "detector", x: "p95", symbol: "diamond", fill: colour, stroke: "var(--surface)",
          r: 5}),
      Plot.tickX(all, {y: "detector", x: "max", stroke: colour, strokeWidth: 3, insetTop: 4, insetBottom: 4}),
      narrow ? Plot.text(all, {y: "detector", text: "detector", frameAnchor: "left", dy: -15,
          fill: "currentColor"}) : null,
      Plot.tip(all, Plot.pointerY({y: "detector", x: "p95", title, fill: "var(--surface)", fontSize: 12})),
    ],
  });
}

function picture(title: string, all: Spread[], quantity: Quantity): Child[] {
  return all.length > 0 ? [h("h3", {}, title), chart(title, (width) => draw(width, all,
      quantity)).element] : [];
}

function pictures(report: Report, scenes: Scene[]): Child[] {
  return kQuantities.flatMap((quantity) => {
    const all = report.detectors.map((name) => spreadOf(report, name, scenes,
        quantity)).filter((s) => s !== null);
    if (!quantity.byKind) return picture(quantity.title, all, quantity);
    return [...new Set(all.map((s) => s.kind))].flatMap((kind) =>
      picture(`${quantity.title}, ${kind}`, all.filter((s) => s.kind === kind), quantity));
  });
}

export const graded: Section = {
  id: "graded",
  title: "Depths and normals",
  build(report) {
    const judged = report.results.runs.some((run) => run.status === "ok" && (run.geometry.depth_judged
        || run.geometry.normal_judged));
    if (!judged) return [];
    const options = sceneOptions(report), place = h("div");
    const update = (value: string): void =>
      place.replaceChildren(...pictures(report, chosenScenes(report, value)) as Node[]);
    update(options[0][0]);
    return [
      p("How far the depths and normals of reported contacts are from the exact ones: ● mean, ◆ 95 % are below, ┃ largest. Over several "
        + "scenes the 95 % and the largest are those of the worst scene. Depths come in two kinds that do not compare: of vertices inside "
        + "a solid (vertex-surface) and of convex pieces (convex-pair)."),
      controlBar(select("Scenes", options, options[0][0], update)),
      place,
    ];
  },
};
