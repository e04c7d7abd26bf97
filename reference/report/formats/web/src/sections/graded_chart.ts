// Errors of one quantity, a row per detector: bars or single values above the line, and on it mean,
// 95 % and maximum.
import * as Plot from "@observablehq/plot";
import {grouped, number} from "../format";
import type {ErrorChart, ErrorRow} from "../page";

interface Spread {
  detector: string;
  kind: string;
  judged: number;
  mean: number | null;
  p95: number | null;
  max: number;
}

interface Bar {
  detector: string;
  from: number;
  below: number;
  count: number;
  share: number;
  percent: string;
}

interface Point {
  detector: string;
  value: number;
}

const kMicrometre = 1e-3; // of the charts of lengths, which are in millimetres
const kRow = 46,
  kLabel = 16;
// Above and below the bars, the tallest of which is 1 high.
const kAbove = 1.1,
  kBelow = -0.3;

// Errors of rounding and of whole cells stand in one chart, and so does 0: linear below a micrometre.
function xScale({unit}: ErrorChart, largest: number): Plot.ScaleOptions {
  if (unit === "°") return {domain: [0, 180], ticks: [0, 45, 90, 135, 180]};
  const ticks = [0, 0.01, 0.1, 1, 10, 100, 1000, 10000].filter((tick) => tick <= largest);
  return {
    type: "symlog",
    constant: kMicrometre,
    domain: [0, Math.max(largest, 2 * kMicrometre)],
    ticks,
  };
}

const spreadOf = ([detector, kind, judged, mean, p95, max]: ErrorRow): Spread => ({
  detector,
  kind,
  judged,
  mean,
  p95,
  max,
});

const barsOf = ([detector, , , , , , bins]: ErrorRow): Bar[] =>
  bins.map(([from, below, count, share, percent]) => ({
    detector,
    from,
    below,
    count,
    share,
    percent,
  }));

const pointsOf = ([detector, , , , , , , points]: ErrorRow): Point[] =>
  points.map((value) => ({detector, value}));

function sentence(spread: Spread, {unit, what}: ErrorChart): string {
  const kind = spread.kind && spread.kind !== "none" ? ` (${spread.kind})` : "";
  const parts = [
    [spread.mean, "mean "],
    [spread.p95, "95 % below "],
    [spread.max, "largest "],
  ] as const;
  const values = parts.flatMap(([value, text]) =>
    value === null ? [] : [`${text}${number(value)} ${unit}`],
  );
  return `${spread.detector}${kind}\n${values.join(", ")}\n${grouped(spread.judged)} ${what}`;
}

const barSentence = (bar: Bar, {unit}: ErrorChart): string =>
  `${bar.detector}: ${bar.percent} (${grouped(bar.count)}) from ${number(bar.from)} to ${number(bar.below)} ${unit}`;

type ColourOf = (d: {detector: string}) => string;

function marks(errors: ErrorChart, colour: ColourOf, narrow: boolean): Plot.Markish[] {
  const all = errors.rows.map(spreadOf),
    bars = errors.rows.flatMap(barsOf),
    points = errors.rows.flatMap(pointsOf);
  const tallest = Math.sqrt(Math.max(...bars.map(({share}) => share), Number.MIN_VALUE));
  const row = {fy: "detector", y: () => kBelow / 2} as const,
    title = (d: Spread): string => sentence(d, errors);
  const known = (name: "mean" | "p95"): Spread[] => all.filter((spread) => spread[name] !== null);
  return [
    Plot.ruleY(all, {fy: "detector", y: () => 0, stroke: "var(--line)"}),
    Plot.rect(bars, {
      fy: "detector",
      x1: "from",
      x2: "below",
      y1: () => 0,
      y2: (d: Bar) => Math.sqrt(d.share) / tallest,
      fill: colour,
      fillOpacity: 0.55,
      insetLeft: 0.5,
      insetRight: 0.5,
      className: "bars",
      ariaLabel: (d: Bar) => barSentence(d, errors),
      title: (d: Bar) => barSentence(d, errors),
    }),
    Plot.ruleX(points, {
      fy: "detector",
      x: "value",
      y1: () => 0,
      y2: () => 1,
      stroke: colour,
      strokeWidth: 2,
      strokeOpacity: 0.7,
      className: "points",
    }),
    Plot.link(known("mean"), {
      fy: "detector",
      x1: "mean",
      x2: "max",
      y1: () => kBelow / 2,
      y2: () => kBelow / 2,
      stroke: colour,
      strokeWidth: 2,
    }),
    Plot.dot(known("mean"), {...row, x: "mean", fill: colour, r: 4}),
    Plot.dot(known("p95"), {
      ...row,
      x: "p95",
      symbol: "diamond",
      fill: colour,
      stroke: "var(--surface)",
      r: 4.5,
    }),
    Plot.ruleX(all, {
      fy: "detector",
      x: "max",
      y1: () => kBelow,
      y2: () => 0,
      stroke: colour,
      strokeWidth: 3,
      className: "largest",
      ariaLabel: title,
    }),
    narrow
      ? Plot.text(all, {
          fy: "detector",
          text: "detector",
          frameAnchor: "top-left",
          dy: 1,
          fill: "currentColor",
        })
      : null,
    Plot.tip(all, Plot.pointer({...row, x: "max", title, fill: "var(--surface)", fontSize: 12})),
  ];
}

/** @pre there is a row */
export function drawErrors(width: number, errors: ErrorChart, colour: ColourOf): Node {
  const narrow = width < 600,
    {rows} = errors;
  const names = rows.map(([detector]) => detector),
    wide = Math.max(...names.map((name) => name.length)) * 6.6 + 12;
  const bars = rows.some(([, , , , , , bins, points]) => bins.length + points.length > 0);
  const height = (bars ? kRow : kLabel + 6) + (narrow ? kLabel : 0),
    largest = Math.max(...rows.map(([, , , , , max]) => max));
  const above = (bars ? kAbove : 0.2) + (narrow ? (kLabel / height) * 1.6 : 0);
  return Plot.plot({
    width,
    height: 48 + height * rows.length,
    marginLeft: narrow ? 10 : wide,
    marginRight: 24,
    marginTop: 6,
    marginBottom: 42,
    x: {...xScale(errors, largest), label: `${errors.axis} →`, grid: true, tickFormat: String},
    y: {domain: [kBelow, above], axis: null},
    fy: {domain: names, label: null, axis: narrow ? null : "left", tickSize: 0, padding: 0.06},
    marks: marks(errors, colour, narrow),
  });
}
