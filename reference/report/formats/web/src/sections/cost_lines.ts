// The detectors that the charts of cost draw, each with a colour, dashes and a shape of its own.
import {legend} from "../chart";
import {grouped} from "../format";
import {kLineStyles} from "../groups";
import type {FrameCosts, Page, Scene} from "../page";
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

export function timedDetectors({detectors, scenes}: Page): string[] {
  return detectors.filter((_, i) => scenes.some(({cost}) => cost.detectors[i]?.playback));
}

/** The fastest that were right, the usual references, then others in file order. */
export function firstChoice({fastest, references}: Page, all: string[]): string[] {
  const wanted = [...fastest, ...references, "ffd-aabb-sphere2", ...all];
  return [...new Set(wanted)]
    .filter((name) => all.includes(name))
    .slice(0, 5)
    .sort((a, b) => all.indexOf(a) - all.indexOf(b));
}

/** What a scene cost each of these detectors that ended well in it. */
export function costsOf({detectors}: Page, scene: Scene, chosen: string[]): [string, FrameCosts][] {
  return chosen.flatMap((name): [string, FrameCosts][] => {
    const own = scene.cost.detectors[detectors.indexOf(name)];
    return own ? [[name, own]] : [];
  });
}

export interface FrameCost {
  detector: string;
  frame: number;
  ms: number;
}

/** Playback; frames that were not timed are left out. */
export function frameCosts(page: Page, scene: Scene, chosen: string[]): FrameCost[] {
  return costsOf(page, scene, chosen).flatMap(([detector, {frame_ms = []}]) =>
    frame_ms.flatMap((ms, frame) => (ms === null ? [] : [{detector, frame, ms}])),
  );
}

export const plainNumber = (value: number): string =>
  value >= 1000 ? grouped(value) : String(value);

/** What charts of cost have in common. */
export const kMargins = {marginLeft: 52, marginTop: 28, marginRight: 24, marginBottom: 40};
export const kCostAxis = {
  type: "log" as const,
  label: "↑ ms per frame",
  grid: true,
  nice: true,
  tickFormat: plainNumber,
  ticks: 6,
};
