// What `contactcheck check` found, by frame.
import * as Plot from "@observablehq/plot";
import {grouped, number} from "../format";
import type {CheckPage} from "./data";

const kMargins = {marginLeft: 56, marginTop: 28, marginRight: 24, marginBottom: 40};
const kLeast = 3; // pixels of a frame among thousands

const xAxis = (frames: number) => ({
  domain: [-0.5, Math.max(frames - 0.5, 0.5)],
  label: "frame →",
  ticks: Math.min(frames, 12),
  tickFormat: (value: number) => (Number.isInteger(value) ? String(value) : ""),
});

// A column per frame, of at least some pixels.
function columns(width: number, frames: number): number {
  const pixels = (width - kMargins.marginLeft - kMargins.marginRight) / frames;
  return Math.max(0.4, kLeast / pixels / 2);
}

export function drawPairs(
  width: number,
  frames: number,
  pairs: CheckPage["pairs"],
  steps: number[],
): Node {
  const half = columns(width, frames);
  const most = pairs.reduce((largest, [, count]) => Math.max(largest, count), 1);
  return Plot.plot({
    width,
    height: 220,
    ...kMargins,
    x: xAxis(frames),
    y: {label: "↑ pairs of triangles", grid: true, nice: true, ticks: 4, domain: [0, most]},
    marks: [
      Plot.rect(pairs, {
        x1: ([frame]) => frame - half,
        x2: ([frame]) => frame + half,
        y1: 0,
        y2: "1",
        fill: "var(--spurious)",
      }),
      Plot.ruleX(steps, {
        x: (step: number) => step + 0.5,
        y1: 0,
        y2: most,
        stroke: "var(--missed)",
        strokeWidth: 2,
      }),
      Plot.tip(
        pairs,
        Plot.pointerX({
          x: "0",
          y: "1",
          title: ([frame, count]: [number, number]) =>
            `frame ${frame}: ${grouped(count)} ${count === 1 ? "pair" : "pairs"} of triangles`,
          fill: "var(--surface)",
          fontSize: 12,
        }),
      ),
      Plot.ruleY([0]),
    ],
  });
}

export function drawDepths(width: number, frames: number, depths: CheckPage["depths"]): Node {
  const half = columns(width, frames);
  return Plot.plot({
    width,
    height: 220,
    ...kMargins,
    x: xAxis(frames),
    y: {label: "↑ mm", grid: true, nice: true, ticks: 4, zero: true},
    marks: [
      Plot.rect(depths, {
        x1: ([frame]) => frame - half,
        x2: ([frame]) => frame + half,
        y1: 0,
        y2: "2",
        fill: "var(--missed)",
      }),
      Plot.tip(
        depths,
        Plot.pointerX({
          x: "0",
          y: "2",
          title: ([frame, lower, upper]: [number, number, number]) =>
            upper - lower <= 1e-3 * upper
              ? `frame ${frame}: ${number(upper)} mm`
              : `frame ${frame}: ${number(lower)} to ${number(upper)} mm`,
          fill: "var(--surface)",
          fontSize: 12,
        }),
      ),
      Plot.ruleY([0]),
    ],
  });
}
