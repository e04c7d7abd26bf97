// The points of the chart of speed against error, and the front of those that no other beats.
import {commonLevel, kFinest, levelOf, type Report} from "./report";
import {countsAt, meanFrameMs, missedShare, spuriousShare, worseShare, type Counts} from "./sums";
import type {Run, Scene} from "./results";

export type Measure = "worse" | "missed" | "spurious";

export interface Choice {
  scenes: Scene[];
  level: string;
  measure: Measure;
  part: "cold" | "hot";
}

export interface Point {
  detector: string;
  options: Record<string, string>;
  question: string;
  /** Of the counts. */
  level: string;
  ms: number;
  error: number;
  counts: Counts;
  onFront: boolean;
}

export interface LeftOut {
  detector: string;
  why: string;
}

const kShares: Record<Measure, (c: Counts) => number | null> = {
  worse: worseShare,
  missed: missedShare,
  spurious: spuriousShare,
};

function whyNot(runs: (Run | null)[], choice: Choice): string {
  const there = runs.filter((run) => run !== null);
  if (there.length < runs.length) return `ended well in ${there.length} of ${runs.length} scenes`;
  if (there.some((run) => !run.time_ms[choice.part])) return "not timed";
  if (choice.level !== kFinest && there.every((run) => !levelOf(run, choice.level)))
    return `does not claim level ${choice.level}`;
  return "nothing to judge";
}

function pointOf(detector: string, runs: Run[], choice: Choice): Point | null {
  const level = choice.level === kFinest ? commonLevel(runs) : choice.level;
  const ms = meanFrameMs(runs, choice.part),
    counts = countsAt(runs, level);
  const error = counts && kShares[choice.measure](counts);
  if (ms === null || !counts || error === null) return null;
  return {
    detector,
    options: runs[0].options,
    question: runs[0].time_ms.question ?? "",
    level,
    ms,
    error,
    counts,
    onFront: false,
  };
}

/** Marks points that none of the same question beats in time without being worse in error. */
function markFront(points: Point[]): void {
  const best = new Map<string, number>();
  for (const point of [...points].sort((a, b) => a.ms - b.ms || a.error - b.error)) {
    const least = best.get(point.question) ?? Infinity;
    point.onFront = point.error < least;
    best.set(point.question, Math.min(least, point.error));
  }
}

export function points(report: Report, choice: Choice): {points: Point[]; leftOut: LeftOut[]} {
  const found: Point[] = [],
    leftOut: LeftOut[] = [];
  for (const detector of report.detectors) {
    const runs = choice.scenes.map((scene) => report.okRun(scene.id, detector));
    const complete = runs.filter((run) => run !== null);
    const point =
      complete.length === runs.length && runs.length > 0
        ? pointOf(detector, complete, choice)
        : null;
    if (point) found.push(point);
    else leftOut.push({detector, why: whyNot(runs, choice)});
  }
  markFront(found);
  return {points: found, leftOut};
}
