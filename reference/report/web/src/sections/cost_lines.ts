// The detectors that the charts of cost draw, each with a colour, dashes and a shape of its own.
import {legend} from "../chart";
import {grouped} from "../format";
import {kLineStyles} from "../groups";
import type {Report} from "../report";
import {kReferences, type Run, type Scene} from "../results";
import {stroke} from "../swatch";

export const kMost = kLineStyles.length;

export interface Lines {
  detectors: string[];
  style: (detector: string) => (typeof kLineStyles)[number];
}

export const linesOf = (detectors: string[]): Lines => ({
  detectors,
  style: (name) => kLineStyles[detectors.indexOf(name) % kMost],
});

export const lineLegend = ({detectors, style}: Lines): HTMLElement =>
  legend(
    detectors.map((name) => ({text: name, swatch: stroke(style(name).colour, style(name).dash)})),
  );

export const timed = (run: Run | null): run is Run => run?.time_ms.cold !== undefined;

export function timedDetectors(report: Report): string[] {
  return report.detectors.filter((name) =>
    report.scenes.some((scene) => timed(report.okRun(scene.id, name))),
  );
}

/** The fastest without error, the usual references, then others in file order. */
export function firstChoice(report: Report, all: string[]): string[] {
  const {fastest} = report.results.report;
  const wanted = [...fastest, ...kReferences, "ffd-aabb-sphere2", ...all];
  return [...new Set(wanted)]
    .filter((name) => all.includes(name))
    .slice(0, 5)
    .sort((a, b) => all.indexOf(a) - all.indexOf(b));
}

export interface FrameCost {
  detector: string;
  frame: number;
  ms: number;
}

/** Cold; frames that were not timed are left out. */
export function frameCosts(report: Report, scene: Scene, detectors: string[]): FrameCost[] {
  return detectors.flatMap((detector) => {
    const values = report.okRun(scene.id, detector)?.per_frame.frame_ms ?? [];
    return values.flatMap((ms, frame) => (ms !== null && ms > 0 ? [{detector, frame, ms}] : []));
  });
}

export const plainNumber = (value: number): string =>
  value >= 1000 ? grouped(value) : String(value);
