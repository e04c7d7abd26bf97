// Time per phase of a frame, as stacked bars, with and without the mapping of the vertices.
import * as Plot from "@observablehq/plot";
import {chart, legend} from "../chart";
import {controlBar, radios, regimes, selectPlace} from "../controls";
import {h, p, unfolding} from "../dom";
import {number} from "../format";
import {term} from "../glossary";
import type {PhaseTimes, Regime} from "../page";
import type {Section} from "../section";
import {square} from "../swatch";
import {textTable} from "../table";

type Phase = "map" | "update" | "query";

const kPhases: [Phase, string, string][] = [
  ["map", "map: deform the vertices", "var(--sky)"],
  ["update", "update: refit trees and bounds", "var(--orange)"],
  ["query", "query: find the contacts", "var(--blue)"],
];

interface Bar {
  detector: string;
  phases: Record<Phase, number | null>;
  total: number;
}

interface Piece {
  detector: string;
  phase: Phase;
  ms: number;
}

interface Choice {
  scenes: number;
  regime: Regime;
  mapping: boolean;
  whole: boolean;
}

// The fastest first.
function barsOf({bars}: PhaseTimes, mapping: boolean): Bar[] {
  return bars
    .map(([detector, map, update, query, sum, withoutMap]) => ({
      detector,
      phases: {map: mapping ? map : null, update, query},
      total: mapping ? sum : withoutMap,
    }))
    .sort((a, b) => a.total - b.total);
}

const kCutFrom = 2; // axes: what is hardly longer is not cut

// Some detectors take a thousand times as long: unless all is asked for, the axis then ends where
// two thirds of the bars fit, and longer ones are cut and say how long they are.
function axisEnd(bars: Bar[], whole: boolean): number {
  const longest = bars[bars.length - 1].total;
  const most = 1.25 * bars[Math.floor((bars.length - 1) * 0.67)].total;
  return whole || longest < kCutFrom * most ? longest : most;
}

const kMost = 40;

function draw(width: number, all: Bar[], whole: boolean): Node {
  const bars = all.slice(0, kMost),
    end = axisEnd(bars, whole),
    narrow = width < 600;
  const names = bars.map((bar) => bar.detector);
  const pieces: Piece[] = bars.flatMap(({detector, phases}) =>
    kPhases
      .filter(([phase]) => phases[phase] !== null)
      .map(([phase]) => ({detector, phase, ms: phases[phase]!})),
  );
  const wide = Math.max(...names.map((name) => name.length)) * 6.6 + 12;
  const label = (bar: Bar): string =>
    bar.total > end ? `${number(bar.total)} ms ▸` : `${number(bar.total)} ms`;
  return Plot.plot({
    width,
    height: 44 + (narrow ? 44 : 24) * bars.length,
    marginLeft: narrow ? 14 : wide,
    marginRight: 76,
    marginTop: 8,
    marginBottom: 36,
    x: {domain: [0, end], label: "milliseconds per frame →", grid: true},
    y: {
      domain: names,
      label: null,
      axis: narrow ? null : "left",
      tickSize: 0,
      paddingInner: narrow ? 0.55 : 0.25,
    },
    color: {domain: kPhases.map(([phase]) => phase), range: kPhases.map(([, , colour]) => colour)},
    marks: [
      Plot.barX(
        pieces,
        Plot.stackX({
          y: "detector",
          x: "ms",
          fill: "phase",
          order: kPhases.map(([phase]) => phase),
          clip: true,
          ariaLabel: (d: Piece) => `${d.detector}: ${d.phase} ${number(d.ms)} ms`,
          title: (d: Piece) => `${d.detector}\n${d.phase}: ${number(d.ms)} ms per frame`,
          tip: true,
        }),
      ),
      Plot.text(bars, {
        y: "detector",
        x: (bar: Bar) => Math.min(bar.total, end),
        text: label,
        textAnchor: "start",
        dx: 5,
        fill: "currentColor",
      }),
      narrow
        ? Plot.text(bars, {
            y: "detector",
            text: "detector",
            frameAnchor: "left",
            dy: -18,
            fill: "currentColor",
          })
        : null,
      Plot.ruleX([0]),
    ],
  });
}

export const times: Section = {
  id: "times",
  title: "Where the time goes",
  short: "Time per phase",
  build({timed, choices, times: computed}) {
    if (!timed) return [];
    const choice: Choice = {scenes: 0, regime: "playback", mapping: true, whole: false};
    const chosen = (): PhaseTimes => computed[choice.scenes][choice.regime];
    let bars = barsOf(chosen(), choice.mapping);
    const below = h("div");
    const picture = chart("Milliseconds per frame and phase of every detector", (width) =>
      bars.length > 0 ? draw(width, bars, choice.whole) : h("p", {}, "No detector was timed here."),
    );
    const update = (change: Partial<Choice>): void => {
      Object.assign(choice, change);
      bars = barsOf(chosen(), choice.mapping);
      picture.redraw();
      const {table} = chosen();
      below.replaceChildren(
        ...(bars.length > kMost
          ? [
              h(
                "p",
                {class: "note"},
                `The ${kMost} fastest of ${bars.length} are drawn; the table has all.`,
              ),
            ]
          : []),
        unfolding("As a table, with mapping", () => textTable(table)),
      );
    };
    update({});
    return [
      p(
        "Milliseconds per frame, means over ",
        term("passes"),
        " and over the scenes in which a detector was timed. A detector without a piece “map” ",
        "maps only the vertices that it needs, within its query. Each is timed in its own question, so that two bars of different questions ",
        "do not compare. A bar with ▸ is cut.",
      ),
      controlBar(
        selectPlace("Scenes", choices, choice.scenes, (scenes) => update({scenes})),
        regimes(choice.regime, (regime) => update({regime})),
        radios(
          "Mapping",
          [
            ["with", "with"],
            ["without", "without"],
          ],
          "with",
          (value) => update({mapping: value === "with"}),
        ),
        radios(
          "Long bars",
          [
            ["cut", "cut"],
            ["whole", "whole"],
          ],
          "cut",
          (value) => update({whole: value === "whole"}),
        ),
      ),
      picture.element,
      legend(kPhases.map(([, text, colour]) => ({text, swatch: square(colour)}))),
      below,
    ];
  },
};
