// What a frame costs against how far apart the bodies are; frames with contact stand apart.
import * as Plot from "@observablehq/plot";
import {p} from "../dom";
import {number} from "../format";
import type {Page, Scene} from "../page";
import {
  costsOf,
  frameCosts,
  kCostAxis,
  kMargins,
  plainNumber,
  type FrameCost,
  type Lines,
} from "./cost_lines";

interface ApartCost extends FrameCost {
  /** Millimetres. */
  apart: number;
}

interface Touching {
  detector: string;
  x: number;
  low: number;
  middle: number;
  high: number;
  frames: number;
}

/** Of the chart's width, in powers of ten, that frames with contact take. */
const kStrip = 0.16;

export const hasSeparation = ({cost}: Scene): boolean => cost.distance.length > 0;

function apartCosts({cost: {distance}}: Scene, all: FrameCost[]): ApartCost[] {
  return all.flatMap((one) =>
    distance[one.frame] > 0 ? [{...one, apart: distance[one.frame]}] : [],
  );
}

/** The smallest and largest distance, and the strip of contact left of them. */
class Span {
  readonly low: number;
  readonly high: number;
  private readonly powers: number;
  private readonly margin: number;

  constructor(all: ApartCost[]) {
    const distances = all.map((cost) => cost.apart),
      low = Math.min(...distances),
      high = Math.max(...distances);
    // Distances that hardly differ have the whole width, too.
    this.margin = high > 1.0001 * low ? (high / low) ** 0.05 : 1.1;
    this.low = low / this.margin;
    this.high = high * this.margin;
    this.powers = Math.log10(this.high / this.low);
  }
  /** A place in the strip: 0 is its left edge, 1 its right one, 1.3 the smallest distance. */
  strip(place: number): number {
    return this.low * 10 ** (kStrip * this.powers * (place - 1.3));
  }
  /** Powers of ten; where there is at most one, both ends. */
  ticks(): number[] {
    const first = Math.ceil(Math.log10(this.low)),
      last = Math.floor(Math.log10(this.high));
    if (last - first >= 1)
      return Array.from({length: last - first + 1}, (_, i) => Number(`1e${first + i}`));
    return [
      ...new Set(
        [this.low * this.margin, this.high / this.margin].map((mm) => Number(mm.toPrecision(4))),
      ),
    ];
  }
}

function touchingCosts(page: Page, scene: Scene, {detectors}: Lines, span: Span): Touching[] {
  return costsOf(page, scene, detectors).flatMap(([detector, {touching}]) => {
    if (!touching) return [];
    const [low, middle, high, frames] = touching;
    const x = span.strip((detectors.indexOf(detector) + 0.5) / detectors.length);
    return [{detector, x, low, middle, high, frames}];
  });
}

function touchingMarks(touching: Touching[], {style}: Lines, span: Span): Plot.Markish[] {
  if (touching.length === 0) return [];
  const colour = (d: Touching): string => style(d.detector).colour;
  const title = (d: Touching): string =>
    `${d.detector}, surfaces touch (frames: ${d.frames})\n` +
    `${number(d.low)} to ${number(d.high)} ms, median ${number(d.middle)} ms`;
  return [
    Plot.ruleX([span.strip(1.15)], {stroke: "var(--grey)", strokeDasharray: "2 3"}),
    Plot.ruleX(touching, {x: "x", y1: "low", y2: "high", stroke: colour, strokeWidth: 2}),
    Plot.dot(touching, {
      x: "x",
      y: "middle",
      fill: colour,
      r: 4.5,
      className: "touching",
      symbol: (d: Touching) => style(d.detector).shape,
      ariaLabel: title,
    }),
    Plot.text([span.strip(0.5)], {
      x: (d: number) => d,
      text: () => "touching",
      frameAnchor: "bottom",
      dy: 14,
      fill: "currentColor",
    }),
    Plot.tip(
      touching,
      Plot.pointer({x: "x", y: "middle", title, fill: "var(--surface)", fontSize: 12}),
    ),
  ];
}

/** @pre hasSeparation(scene) */
export function drawSeparation(width: number, page: Page, scene: Scene, lines: Lines): Node {
  const all = frameCosts(page, scene, lines.detectors),
    apart = apartCosts(scene, all);
  if (all.length === 0) return p("No frame of this scene was timed for these detectors.");
  if (apart.length === 0) return p("The surfaces touch in every timed frame of this scene.");
  const span = new Span(apart),
    touching = touchingCosts(page, scene, lines, span);
  const xy = {x: "apart", y: "ms"} as const,
    style = (d: ApartCost) => lines.style(d.detector);
  const title = (d: ApartCost): string =>
    `${d.detector}, frame ${d.frame}\n${number(d.apart)} mm apart, ${number(d.ms)} ms`;
  return Plot.plot({
    width,
    height: 320,
    ...kMargins,
    x: {
      type: "log",
      domain: [touching.length > 0 ? span.strip(0) : span.low, span.high],
      label: "smallest distance between two bodies, mm →",
      grid: true,
      ticks: span.ticks(),
      tickFormat: plainNumber,
    },
    y: kCostAxis,
    marks: [
      ...costsOf(page, scene, lines.detectors).map(([name, {by_distance = []}]) =>
        Plot.line(by_distance, {
          x: "0",
          y: "1",
          stroke: lines.style(name).colour,
          strokeDasharray: lines.style(name).dash,
          strokeWidth: 1.8,
        }),
      ),
      Plot.dot(apart, {
        ...xy,
        fill: (d: ApartCost) => style(d).colour,
        fillOpacity: 0.55,
        r: 2.8,
        symbol: (d: ApartCost) => style(d).shape,
        className: "apart",
        ariaLabel: title,
      }),
      ...touchingMarks(touching, lines, span),
      Plot.tip(apart, Plot.pointer({...xy, title, fill: "var(--surface)", fontSize: 12})),
    ],
  });
}
