// What a frame costs: against the number of triangles, the distance of the bodies, and frame by frame.
import * as Plot from "@observablehq/plot";
import {chart, type Chart} from "../chart";
import {checkboxes, controlBar, radios, select} from "../controls";
import {h, p, type Child} from "../dom";
import {compact, grouped, number} from "../format";
import {term} from "../glossary";
import type {Page, Regime, Scene} from "../page";
import type {Section} from "../section";
import {
  costsOf,
  firstChoice,
  frameCosts,
  kMost,
  lineLegend,
  linesOf,
  kCostAxis,
  kMargins,
  plainNumber,
  timedDetectors,
  type FrameCost,
  type Lines,
} from "./cost_lines";
import {drawSeparation, hasSeparation} from "./cost_separation";

/** What the controls of the section choose. */
interface State {
  lines: Lines;
  regime: Regime;
  scene: Scene;
}

const kSeparationTitle = "Milliseconds per frame against the distance of the bodies";

// Against triangles ------------------------------------------------------------------------------

interface Cost {
  detector: string;
  scene: string;
  series: string;
  triangles: number;
  ms: number;
}

function costs(page: Page, chosen: string[], regime: Regime): Cost[] {
  return page.scenes
    .flatMap((scene) =>
      costsOf(page, scene, chosen).flatMap(([detector, own]) => {
        const {series, triangles} = scene.cost,
          ms = own[regime];
        return ms ? [{detector, scene: scene.id, series, triangles, ms}] : [];
      }),
    )
    .sort((a, b) => a.triangles - b.triangles);
}

// A line joins the sizes of one scene: between scenes of different kinds a line would say nothing.
function series(all: Cost[]): Cost[][] {
  const groups = new Map<string, Cost[]>();
  for (const cost of all) {
    const key = JSON.stringify([cost.detector, cost.series]);
    groups.set(key, [...(groups.get(key) ?? []), cost]);
  }
  return [...groups.values()].filter((group) => group.length > 1);
}

// Between sizes near one another a logarithm has ticks without labels: they are ticks themselves then.
function sizeTicks(
  sizes: number[],
  [low, high]: [number, number],
  width: number,
): number | number[] {
  if (high > 10 * low) return width < 600 ? 3 : 6;
  const across = (size: number): number => (width * Math.log(size / low)) / Math.log(high / low),
    room = 60;
  const ticks: number[] = [];
  for (const size of [...new Set(sizes)].sort((a, b) => a - b))
    if (ticks.length === 0 || across(size) - across(ticks[ticks.length - 1]) > room)
      ticks.push(size);
  return ticks;
}

function drawCosts(width: number, all: Cost[], lines: Lines): Node {
  if (all.length === 0) return p("None of these detectors was timed so.");
  const xy = {x: "triangles", y: "ms"} as const,
    sizes = all.map((cost) => cost.triangles);
  const span: [number, number] = [Math.min(...sizes) / 1.2, Math.max(...sizes) * 1.2];
  const title = (d: Cost): string =>
    `${d.detector}\n${d.scene}: ${grouped(d.triangles)} triangles\n${number(d.ms)} ms per frame`;
  return Plot.plot({
    width,
    height: Math.min(400, 240 + width / 5),
    ...kMargins,
    x: {
      type: "log",
      domain: span,
      label: "triangles of all bodies →",
      grid: true,
      tickFormat: width < 600 ? compact : plainNumber,
      ticks: sizeTicks(sizes, span, width),
    },
    y: kCostAxis,
    marks: [
      ...series(all).map((group) =>
        Plot.line(group, {
          ...xy,
          stroke: lines.style(group[0].detector).colour,
          strokeDasharray: lines.style(group[0].detector).dash,
          strokeWidth: 1.8,
          strokeOpacity: 0.8,
        }),
      ),
      Plot.dot(all, {
        ...xy,
        fill: (d: Cost) => lines.style(d.detector).colour,
        r: 4,
        symbol: (d: Cost) => lines.style(d.detector).shape,
        ariaLabel: title,
      }),
      Plot.tip(all, Plot.pointer({...xy, title, fill: "var(--surface)", fontSize: 12})),
    ],
  });
}

// Frame by frame ---------------------------------------------------------------------------------

const frameAxis = (width: number, scene: Scene) => ({
  label: "frame →",
  domain: [0, Math.max(1, scene.frames - 1)],
  ticks: Math.min(scene.frames, width / 80),
});

function drawFrames(width: number, scene: Scene, all: FrameCost[], lines: Lines): Node {
  const xy = {x: "frame", y: "ms"} as const;
  const title = (d: FrameCost): string => `${d.detector}, frame ${d.frame}\n${number(d.ms)} ms`;
  return Plot.plot({
    width,
    height: 300,
    ...kMargins,
    x: frameAxis(width, scene),
    y: kCostAxis,
    marks: [
      ...lines.detectors.map((name) =>
        Plot.line(
          all.filter((d) => d.detector === name),
          {
            ...xy,
            stroke: lines.style(name).colour,
            strokeDasharray: lines.style(name).dash,
            strokeWidth: 1.8,
          },
        ),
      ),
      Plot.tip(all, Plot.pointer({...xy, title, fill: "var(--surface)", fontSize: 12})),
    ],
  });
}

interface FrameCount {
  detector: string;
  kind: "missed" | "spurious";
  frame: number;
  n: number;
}

function frameErrors(page: Page, scene: Scene, chosen: string[]): FrameCount[] {
  return costsOf(page, scene, chosen).flatMap(([detector, own]) =>
    (["missed", "spurious"] as const).flatMap((kind) =>
      own[kind].map(([frame, n]) => ({detector, kind, frame, n})),
    ),
  );
}

// What truly touches, and the errors of each.
function drawContacts(width: number, scene: Scene, errors: FrameCount[], lines: Lines): Node {
  const xy = {x: "frame", y: "n"} as const;
  const title = (d: FrameCount): string =>
    `${d.detector}, frame ${d.frame}\n${grouped(d.n)} ${d.kind}`;
  return Plot.plot({
    width,
    height: 170,
    ...kMargins,
    x: frameAxis(width, scene),
    y: {
      label: "↑ true contacts (area); errors: ▲ missed, × spurious",
      grid: true,
      ticks: 4,
      nice: true,
    },
    marks: [
      Plot.areaY(scene.cost.truth, {
        x: (_, i) => i,
        y: (n: number) => n,
        fill: "var(--right)",
        stroke: "var(--grey)",
      }),
      Plot.dot(errors, {
        ...xy,
        stroke: (d: FrameCount) => lines.style(d.detector).colour,
        r: 3.5,
        symbol: (d: FrameCount) => (d.kind === "missed" ? "triangle" : "times"),
        ariaLabel: title,
      }),
      Plot.tip(errors, Plot.pointer({...xy, title, fill: "var(--surface)", fontSize: 12})),
      Plot.ruleY([0]),
    ],
  });
}

function charts(page: Page, state: State): Chart[] {
  const withDistances = page.scenes.some(hasSeparation);
  return [
    chart("Milliseconds per frame against the number of triangles", (width) =>
      drawCosts(width, costs(page, state.lines.detectors, state.regime), state.lines),
    ),
    chart("Milliseconds of each frame", (width) =>
      drawFrames(
        width,
        state.scene,
        frameCosts(page, state.scene, state.lines.detectors),
        state.lines,
      ),
    ),
    chart("True, missed and spurious contacts of each frame", (width) =>
      drawContacts(
        width,
        state.scene,
        frameErrors(page, state.scene, state.lines.detectors),
        state.lines,
      ),
    ),
    ...(withDistances
      ? [
          chart(kSeparationTitle, (width) =>
            hasSeparation(state.scene)
              ? drawSeparation(width, page, state.scene, state.lines)
              : p("The results hold no distances of this scene."),
          ),
        ]
      : []),
  ];
}

function separationPart(separation: Chart | undefined): Child[] {
  if (!separation) return [];
  return [
    h("h4", {}, "Against the distance of the bodies"),
    p(
      "Each point is a frame in playback, the median over passes; the smallest distance between the surfaces of any two bodies is the oracle's. Lines go through " +
        "medians of frames that are about equally far. Frames in which surfaces touch stand to the left: median, and the range.",
    ),
    separation.element,
  ];
}

export const cost: Section = {
  id: "cost",
  title: "What a frame costs",
  short: "Cost",
  build(page) {
    const all = timedDetectors(page);
    if (all.length === 0) return [];
    const state: State = {
      lines: linesOf(firstChoice(page, all)),
      regime: "playback",
      scene: page.scenes[0],
    };
    const sizes = new Set(page.scenes.map((scene) => scene.cost.triangles));
    const legends = h("div"),
      [triangles, frames, contacts, separation] = charts(page, state);
    const redraw = (change: Partial<State>): void => {
      Object.assign(state, change);
      legends.replaceChildren(lineLegend(state.lines));
      [triangles, frames, contacts, separation].forEach((one) => one?.redraw());
    };
    redraw({});
    return [
      p(
        `Up to ${kMost} detectors, each with its own colour, dashes and shape. Times are of `,
        term("playback"),
        " unless said.",
      ),
      controlBar(
        radios(
          "Timed (by triangles)",
          [
            ["playback", "playback"],
            ["cold", "cold"],
          ],
          state.regime,
          (value) => redraw({regime: value as Regime}),
        ),
        checkboxes("Choose detectors", all, state.lines.detectors, kMost, (names) =>
          redraw({lines: linesOf(names)}),
        ),
      ),
      legends,
      ...(sizes.size < 2
        ? []
        : [
            h("h3", {}, "Against the number of triangles"),
            p(
              "A line joins the sizes of one scene; the suite scaling has scenes of 1, 4 and 16 times the triangles.",
            ),
            triangles.element,
          ]),
      h("h3", {}, "In one scene"),
      controlBar(
        select(
          "Scene",
          page.scenes.map((s, i) => [String(i), s.id]),
          "0",
          (value) => redraw({scene: page.scenes[Number(value)]}),
        ),
      ),
      ...separationPart(separation),
      h("h4", {}, "Frame by frame"),
      p(
        "Playback, medians over passes; frames that were not timed are left out. Below, what each of these frames holds, and where each detector chosen errs.",
      ),
      frames.element,
      contacts.element,
    ];
  },
};
