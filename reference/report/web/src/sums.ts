// What a detector did over several scenes.
import {share} from "./format";

export {share};
import {claimedLevels, comparedQuestion, finestLevel, isOk, levelOf, Report} from "./report";
import type {Run, Scene} from "./results";

export interface Counts {
  truth: number;
  reported: number;
  hit: number;
  missed: number;
  spurious: number;
}

export const noCounts = (): Counts => ({truth: 0, reported: 0, hit: 0, missed: 0, spurious: 0});

export function add(sum: Counts, counts: Counts): void {
  for (const key of Object.keys(sum) as (keyof Counts)[]) sum[key] += counts[key];
}

export const missedShare = (c: Counts): number | null => share(c.missed, c.truth);
export const spuriousShare = (c: Counts): number | null => share(c.spurious, c.reported);

/** The larger of the two; null where there was nothing to find and nothing was reported. */
export function worseShare(c: Counts): number | null {
  const missed = missedShare(c),
    spurious = spuriousShare(c);
  return missed === null ? spurious : spurious === null ? missed : Math.max(missed, spurious);
}

/** Counts over runs at one level (or each at its finest); null where none was judged there. */
export function countsAt(runs: Run[], level: string): Counts | null {
  const sum = noCounts();
  let judged = false;
  for (const run of runs) {
    const counts = levelOf(run, level);
    if (!counts) continue;
    add(sum, counts);
    judged = true;
  }
  return judged ? sum : null;
}

/** Whether these runs were judged at different finest levels, whose counts do not add up. */
export const levelsDiffer = (runs: Run[]): boolean =>
  new Set(runs.map(finestLevel).filter((level) => level !== "")).size > 1;

/** Milliseconds per frame, the mean over all frames of these runs; null where one is not timed. */
export function meanFrameMs(runs: Run[], part: "cold" | "hot"): number | null {
  let ms = 0,
    frames = 0;
  for (const run of runs) {
    const phases = run.time_ms[part];
    if (!phases) return null;
    ms += phases.frame * run.frames;
    frames += run.frames;
  }
  return frames > 0 ? ms / frames : null;
}

/** A line of the summary: counts of different levels do not add up, so there is one per level. */
export interface SummaryLine {
  detector: string;
  level: string;
  question: string;
  scenes: number;
  notOk: number;
  counts: Counts | null;
  body: Counts | null;
  hover: number | null;
  runs: Run[];
}

const newLine = (detector: string, level: string): SummaryLine => ({
  detector,
  level,
  question: "",
  scenes: 0,
  notOk: 0,
  counts: null,
  body: null,
  hover: null,
  runs: [],
});

function addTo(sum: Counts | null, counts: Counts | undefined): Counts | null {
  if (!counts) return sum;
  const out = sum ?? noCounts();
  add(out, counts);
  return out;
}

function addRun(line: SummaryLine, run: Run): void {
  ++line.scenes;
  line.question = comparedQuestion(run);
  line.counts = addTo(line.counts, run.levels[line.level]);
  line.body = addTo(line.body, run.levels.body);
  const hover = run.geometry.hover_gap_max;
  if (hover !== null) line.hover = Math.max(line.hover ?? 0, hover);
  line.runs.push(run);
}

/** In the order of first runs. A run that did not end well counts in its detector's first line. */
export function summaryLines(report: Report): SummaryLine[] {
  const lines: SummaryLine[] = [],
    byDetector = new Map<string, SummaryLine[]>();
  for (const run of report.results.runs) {
    const ok = isOk(run),
      level = ok ? finestLevel(run) : "";
    const own = byDetector.get(run.detector) ?? [];
    byDetector.set(run.detector, own);
    let line = own.find((l) => !ok || l.scenes === 0 || l.level === level);
    if (!line) {
      line = newLine(run.detector, level);
      own.push(line);
      lines.push(line);
    }
    if (!ok) ++line.notOk;
    else {
      line.level = level;
      addRun(line, run);
    }
  }
  return lines;
}

/** Smallest and largest speed-up over a reference in cold frames, of any scene. */
export function speedupRange(line: SummaryLine, reference: string): [number, number] | null {
  const ratios = line.runs
    .map((run) => run.speedup?.[comparedQuestion(run)]?.[reference]?.cold.ratio)
    .filter((ratio) => ratio !== undefined);
  return ratios.length > 0 ? [Math.min(...ratios), Math.max(...ratios)] : null;
}

export interface Verdict {
  detector: string;
  /** Levels that it was judged at in the scenes that it finished, with sums over these. */
  levels: Map<string, Counts>;
  finest: string;
  exact: boolean;
  /** Something was there to find, or was reported. */
  tried: boolean;
}

/** What a detector claims, held against it over `scenes`; null where nothing was judged. */
export function verdictOf(report: Report, detector: string, scenes: Scene[]): Verdict | null {
  const levels = new Map<string, Counts>();
  let finest = "";
  for (const scene of scenes) {
    const run = report.okRun(scene.id, detector);
    if (!run) continue;
    finest = finest || finestLevel(run);
    for (const [name, counts] of claimedLevels(run)) {
      if (!levels.has(name)) levels.set(name, noCounts());
      add(levels.get(name)!, counts);
    }
  }
  if (levels.size === 0) return null;
  const all = [...levels.values()];
  return {
    detector,
    levels,
    finest,
    exact: all.every((c) => c.missed === 0 && c.spurious === 0),
    tried: all.some((c) => c.truth > 0 || c.reported > 0),
  };
}
