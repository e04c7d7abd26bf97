// The chart of speed against error: every detector a point.
import * as Plot from "@observablehq/plot";
import {chart, legend} from "../chart";
import {controlBar, type Option, regimes, select, selectPlace} from "../controls";
import {h, p, unfolding} from "../dom";
import {term} from "../glossary";
import {groupColour, groupsOf} from "../groups";
import {names} from "../names";
import type {Measure, Page, PointsChart, Regime} from "../page";
import type {Section} from "../section";
import {square, symbol} from "../swatch";
import {left, table} from "../table";

interface Point {
  detector: string;
  options: string;
  /** Its line of the table, by the ids of columns. */
  cells: Record<string, string>;
  question: string;
  ms: number;
  error: number;
  onFront: boolean;
}

interface Choice {
  scenes: number;
  level: string;
  measure: Measure;
  regime: Regime;
}

interface Chart {
  points: Point[];
  leftOut: string;
}

const kFinest = "finest"; // each detector at the finest level that it claims everywhere
const kMeasures: Record<Measure, string> = {
  worse: "missed or spurious, whichever is worse",
  missed: "missed",
  spurious: "spurious",
};
const kAxis: Record<Measure, string> = {
  worse: "share of contacts missed, or of reports spurious (the worse)",
  missed: "share of true contacts missed",
  spurious: "share of reports that are no contact",
};
/** A circle, or the polygon of an outline's points. */
function plotSymbol(outline: string): Plot.SymbolType {
  if (outline.includes("A")) return "circle";
  let at = [0, 0];
  const corners = [...outline.matchAll(/([MLhv])(-?[\d.]+) ?(-?[\d.]+)?/g)].map(
    ([, command, first, second]) => {
      if (command === "h") at = [at[0] + Number(first), at[1]];
      else if (command === "v") at = [at[0], at[1] + Number(first)];
      else at = [Number(first), Number(second)];
      return at;
    },
  );
  return {
    draw(context: CanvasPath) {
      corners.forEach(([x, y], i) => (i === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
      context.closePath();
    },
  };
}

function sentenceOf({cells, options}: Point): string {
  const {detector, question, time, level, truth, missed, reported, spurious} = cells;
  return [
    `${detector}: ${time} ms per frame (question ${question})`,
    `missed ${missed} of ${truth}, spurious ${spurious} of ${reported} (level ${level})`,
    `options: ${options}`,
  ].join("\n");
}

// Shares of 0 and of 1 in 10,000 must both be seen: the axis is linear below 0.1 %, then a logarithm.
const kErrorAxis = {type: "symlog" as const, constant: 0.001, ticks: [0, 0.001, 0.01, 0.1, 0.5, 1]};

function isEnd(point: Point, front: Point[]): boolean {
  const own = front.filter((other) => other.question === point.question);
  return point === own[0] || point === own[own.length - 1];
}

// The fastest and the best of each front are named first, then all others by time.
function byImportance(all: Point[], front: Point[]): Point[] {
  const rank = (point: Point): number => (point.onFront ? (isEnd(point, front) ? 0 : 1) : 2);
  return [...all].sort((a, b) => rank(a) - rank(b) || a.ms - b.ms);
}

function draw(page: Page, width: number, all: Point[], choice: Choice): Node {
  if (all.length === 0) return p("No detector was timed and judged so.");
  const front = all.filter((point) => point.onFront).sort((a, b) => a.ms - b.ms);
  const times = all.map((point) => point.ms),
    span: [number, number] = [Math.min(...times) / 1.5, Math.max(...times) * 1.5];
  const highest = Math.max(0.01, ...all.map((point) => point.error));
  const top = Math.min(1, 1.6 * highest);
  const xy = {x: "ms", y: "error"} as const;
  const symbols = new Map(
    page.speed_error.shapes.map(({question, outline}) => [question, plotSymbol(outline)]),
  );
  return Plot.plot({
    width,
    height: Math.min(460, 260 + width / 4),
    marginLeft: 52,
    marginRight: 24,
    marginTop: 40,
    marginBottom: 44,
    x: {
      type: "log",
      domain: span,
      label: `time per frame, ms, ${choice.regime} →`,
      grid: true,
      ticks: width < 600 ? 4 : 8,
      tickFormat: (ms: number) => String(ms),
    },
    y: {
      ...kErrorAxis,
      ticks: kErrorAxis.ticks.filter((tick) => tick <= top),
      domain: [0, top],
      label: `↑ ${kAxis[choice.measure]}`,
      grid: true,
      insetBottom: 12,
      tickFormat: (share: number) => `${100 * share} %`,
    },
    marks: [
      Plot.ruleY([0]),
      Plot.line(front, {
        ...xy,
        z: "question",
        curve: "step-after",
        stroke: "currentColor",
        strokeOpacity: 0.55,
        strokeDasharray: "5 3",
        strokeWidth: 1.5,
        className: "fronts",
      }),
      Plot.dot(all, {
        ...xy,
        r: 5.5,
        fill: (d: Point) => groupColour(page, d.detector),
        stroke: "var(--surface)",
        symbol: (d: Point) => symbols.get(d.question),
        ariaLabel: sentenceOf,
        className: "points",
      }),
      names(byImportance(all, front), "ms", "error", "detector"),
      Plot.tip(all, Plot.pointer({...xy, title: sentenceOf, fill: "var(--surface)", fontSize: 12})),
    ],
  });
}

function legends(page: Page, all: Point[]): HTMLElement {
  const colours = groupsOf(
    page,
    all.map((point) => point.detector),
  ).map((group) => ({
    text: group.name,
    swatch: square(group.colour),
  }));
  const shapes = page.speed_error.shapes
    .filter(({question}) => all.some((point) => point.question === question))
    .map(({outline, means}) => ({text: means, swatch: symbol(outline)}));
  return legend([...colours, ...shapes]);
}

function pointsTable({speed_error: {columns}}: Page, all: Point[]): HTMLElement {
  return table(
    [columns[0], left("options"), ...columns.slice(1)],
    all.map(({cells, options}) => {
      const [first, ...others] = columns.map(({id}) => cells[id ?? ""] ?? "");
      return [first, options, ...others];
    }),
    "Points of the chart of speed against error",
  );
}

const kNothing: PointsChart = {points: [], left_out: ""};

function chartOf({options, speed_error: {columns, charts}}: Page, choice: Choice): Chart {
  const level = charts[choice.scenes]?.[choice.level];
  const {points, left_out} = level?.[`${choice.measure} ${choice.regime}`] ?? kNothing;
  return {
    points: points.map(([at, ms, error, onFront, time, share]) => {
      const line = level.cells[at]!,
        own = {time, error: share, front: onFront ? "yes" : ""};
      const cells = {...Object.fromEntries(columns.map(({id}, i) => [id, line[i]])), ...own};
      return {
        detector: cells.detector,
        options: options[at],
        question: cells.question,
        cells,
        ms,
        error,
        onFront,
      };
    }),
    leftOut: left_out,
  };
}

export const speedError: Section = {
  id: "speed-error",
  title: "Speed against error",
  build(page) {
    if (!page.timed)
      return [
        p(
          "This run measured no times (",
          h("code", {}, "--no-timing"),
          "), so that there is nothing to compare.",
        ),
      ];
    const computed = page.speed_error;
    const choice: Choice = {
      scenes: computed.first,
      level: kFinest,
      measure: "worse",
      regime: "playback",
    };
    let shown = chartOf(page, choice);
    const below = h("div");
    const picture = chart("Time per frame and share of errors of every detector", (width) =>
      draw(page, width, shown.points, choice),
    );
    const update = (change: Partial<Choice>): void => {
      shown = chartOf(page, Object.assign(choice, change));
      picture.redraw();
      below.replaceChildren(
        legends(page, shown.points),
        ...(shown.leftOut ? [h("p", {class: "note"}, shown.leftOut)] : []),
        unfolding("The same as a table", () => [pointsTable(page, shown.points)]),
      );
    };
    update({});
    const {choices} = page;
    const levels = page.levels.slice(1).map(({level}): Option => [level, level]);
    return [
      p(
        "Each point is one detector in one configuration. Left is faster, down is better: at the bottom line it " +
          "has no missed and no spurious contacts. The dashed steps are the Pareto fronts: no other detector that answers the same ",
        term("question"),
        " is both faster and better than a detector there. Times of different questions (shapes) do not compare.",
      ),
      controlBar(
        selectPlace("Scenes", choices, choice.scenes, (scenes) => update({scenes})),
        select("Level", [[kFinest, "finest in every scene"], ...levels], choice.level, (level) =>
          update({level}),
        ),
        select("Error", Object.entries(kMeasures), choice.measure, (value) =>
          update({measure: value as Measure}),
        ),
        regimes(choice.regime, (regime) => update({regime})),
      ),
      picture.element,
      below,
    ];
  },
};
