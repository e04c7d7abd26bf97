// One row per detector that goes wrong, one square per case: the upper half says which share of the
// true contacts it missed, the lower which share of its answers is none (like
// reference/report/stability_plot.cpp, for a page).
import {s} from "./dom";
import type {FamilyResult} from "./family";
import {share} from "./format";

const kSquare = 22,
  kStep = 24,
  kLetter = 7.2;
const kFaintest = 0.3; // one wrong contact of many must still be seen

const longest = (texts: string[]): number => Math.max(0, ...texts.map((text) => text.length));
const opacity = (part: number): number => kFaintest + (1 - kFaintest) * Math.min(part, 1);

function half(x: number, y: number, part: number, colour: string): SVGElement[] {
  const box = {x, y, width: kSquare, height: kSquare / 2};
  return [
    s("rect", {...box, fill: "var(--right)"}),
    ...(part > 0
      ? [s("rect", {...box, fill: colour, "fill-opacity": opacity(part).toFixed(2)})]
      : []),
  ];
}

// Not by colour alone: missed points down, as what sinks in, spurious up.
function mark(x: number, y: number, part: number, down: boolean): SVGElement[] {
  if (part <= 0) return [];
  const cx = x + kSquare / 2,
    cy = y + kSquare / 4,
    d = down ? 2.5 : -2.5;
  return [s("path", {d: `M${cx - 3.5} ${cy - d}h7l-3.5 ${2 * d}Z`, fill: "var(--surface)"})];
}

function judgedSquare(result: FamilyResult, frame: number, x: number, y: number): SVGElement {
  const truth = result.at("truth", frame),
    missed = result.at("missed", frame),
    spurious = result.at("spurious", frame);
  const lost = share(missed, truth) ?? 0,
    invented = share(spurious, truth - missed + spurious) ?? 0;
  const words = `${result.run.detector} at ${result.value(frame)}: ${missed} missed of ${truth}, ${spurious} spurious`;
  return s(
    "g",
    {},
    s("title", {}, words),
    ...half(x, y, lost, "var(--missed)"),
    ...half(x, y + kSquare / 2, invented, "var(--spurious)"),
    ...mark(x, y, lost, true),
    ...mark(x, y + kSquare / 2, invented, false),
  );
}

// Without answers nobody knows about the other cases.
function failedSquare(result: FamilyResult, frame: number, x: number, y: number): SVGElement {
  const box = {x, y, width: kSquare, height: kSquare};
  if (result.run.failed_frame !== frame)
    return s("rect", {...box, fill: "none", stroke: "var(--grey)", "stroke-dasharray": "2 2"});
  const cross = `M${x + 6} ${y + 6}l10 10m0-10l-10 10`;
  return s(
    "g",
    {},
    s("title", {}, `${result.run.detector} at ${result.value(frame)}: ${result.run.message}`),
    s("rect", {...box, fill: "var(--ink)"}),
    s("path", {d: cross, stroke: "var(--surface)", "stroke-width": 2}),
  );
}

/** `onClick`: on a square. @pre `rows` are of one family, and there is at least one */
export function stabilityPlot(
  rows: FamilyResult[],
  onClick: (detector: string, frame: number) => void,
): SVGElement {
  const {family, title} = rows[0].scene,
    values = family!.values;
  const left = 8 + kLetter * longest(rows.map((row) => row.run.detector));
  const below = rows.length * kStep,
    foot = 14 + 0.9 * kLetter * longest(values);
  const width = left + values.length * kStep + 8,
    height = below + foot;
  const squares = rows.flatMap((row, r) => [
    s("text", {x: left - 8, y: r * kStep + 15, "text-anchor": "end"}, row.run.detector),
    ...row.frames().map((frame) => {
      const square = (row.failed ? failedSquare : judgedSquare)(
        row,
        frame,
        left + frame * kStep,
        r * kStep,
      );
      square.addEventListener("click", () => onClick(row.run.detector, frame));
      return square;
    }),
  ]);
  const names = values.map((value, i) => {
    const x = left + i * kStep + 15,
      y = below + 10;
    return s("text", {x, y, "text-anchor": "end", transform: `rotate(-60 ${x} ${y})`}, value);
  });
  return s(
    "svg",
    {
      class: "stability",
      width,
      height,
      viewBox: `0 0 ${width} ${height}`,
      role: "img",
      "aria-label": `${title}: missed and spurious, case by case`,
    },
    ...squares,
    ...names,
  );
}
