// What the run found, in words. Sentences only; sections/headline.ts shows them.
import {grouped, listed, number, percent, plural, shortList} from "./format";
import type {Report} from "./report";
import {
  meanFrameMs,
  missedShare,
  spuriousShare,
  verdictOf,
  type Counts,
  type Verdict,
} from "./sums";
import {type KnownDefects, kReferences, type Run, type Scene} from "./results";

export interface Finding {
  topic: string;
  sentence: string;
}

const kMost = 5;

interface Judged extends Verdict {
  crashed: boolean;
}

/** Runs that ended so by their detector's own doing: in a scene that was not judged, none was asked. */
function runsThat(report: Report, status: string): Run[] {
  const unjudged = new Set(report.results.scenes.filter((s) => s.unjudged).map((s) => s.id));
  return report.results.runs.filter((run) => run.status === status && !unjudged.has(run.scene));
}

function verdicts(report: Report): Judged[] {
  const crashed = new Set(runsThat(report, "error").map((run) => run.detector));
  const scenes = [...report.scenes, ...report.families];
  return report.detectors
    .map((detector) => verdictOf(report, detector, scenes))
    .filter((verdict) => verdict !== null)
    .filter((verdict) => verdict.tried)
    .map((verdict) => ({...verdict, crashed: crashed.has(verdict.detector)}));
}

const flawless = (verdict: Judged): boolean => verdict.exact && !verdict.crashed;

export function placesText(report: Report): string {
  const judged = (all: Scene[]): Scene[] => all.filter((scene) => !scene.unjudged);
  const cases = judged(report.families).reduce(
    (sum, scene) => sum + scene.family!.values.length,
    0,
  );
  const parts = [],
    scenes = judged(report.scenes).length;
  if (scenes > 0) parts.push(plural(scenes, "scene"));
  if (cases > 0) parts.push(plural(cases, "hard case"));
  return listed(parts);
}

export function title(report: Report): string {
  const all = verdicts(report),
    right = all.filter(flawless).length;
  const places = placesText(report);
  if (all.length === 0) return `Nothing was judged in ${places || "this run"}`;
  if (all.length === 1)
    return `${all[0].detector} made ${right === 1 ? "no error" : "errors"} in ${places}`;
  if (right === all.length) return `All ${right} detectors made no error in ${places}`;
  if (right === 0) return `None of ${all.length} detectors is without error in ${places}`;
  return `${right} of ${all.length} detectors made no error in ${places}`;
}

function exactFindings(all: Judged[]): Finding[] {
  const byLevel = new Map<string, string[]>();
  for (const verdict of all.filter(flawless))
    byLevel.set(verdict.finest, [...(byLevel.get(verdict.finest) ?? []), verdict.detector]);
  return [...byLevel].map(([level, names]) => ({
    topic: "No error",
    sentence: `At level ${level}: ${listed(names)}.`,
  }));
}

// The level that shows the error: the finest, unless that is without.
function worstLevel(verdict: Verdict, kind: "missed" | "spurious"): [string, Counts] | null {
  const finest = verdict.levels.get(verdict.finest);
  if (finest && finest[kind] > 0) return [verdict.finest, finest];
  return [...verdict.levels].find(([, counts]) => counts[kind] > 0) ?? null;
}

function wrongFinding(all: Judged[], kind: "missed" | "spurious"): Finding[] {
  const share = (c: Counts): number => (kind === "missed" ? missedShare(c) : spuriousShare(c)) ?? 0;
  const wrong = all
    .map((verdict) => ({verdict, at: worstLevel(verdict, kind)}))
    .filter((entry) => entry.at !== null)
    .sort((a, b) => share(b.at![1]) - share(a.at![1]));
  if (wrong.length === 0) return [];
  const levels = [...new Set(wrong.map(({at}) => at![0]))];
  const whole = (c: Counts): number => (kind === "missed" ? c.truth : c.reported);
  const texts = wrong.map(({verdict, at}) => {
    const [level, c] = at!;
    return (
      `${verdict.detector} ${percent(share(c))} (${grouped(c[kind])} of ${grouped(whole(c))}` +
      `${levels.length > 1 ? `, level ${level}` : ""})`
    );
  });
  const what =
    kind === "missed" ? "did not report all true contacts" : "reported contacts that are none";
  const where = levels.length === 1 ? `, at level ${levels[0]}` : "";
  return [
    {
      topic: kind === "missed" ? "Missed" : "Spurious",
      sentence: `${plural(wrong.length, "detector")} ${what}${where}: ${shortList(texts, kMost)}.`,
    },
  ];
}

const answersTriangles = (run: Run): boolean => run.time_ms.question === "triangles";

/** Per scene, the fastest detector without error that answers with all pairs of triangles. */
export function winners(report: Report, exact: Set<string>): Map<string, string[]> {
  const wins = new Map<string, string[]>();
  for (const scene of [...report.scenes, ...report.families]) {
    const timed = report
      .okRunsOf(scene.id)
      .filter((run) => exact.has(run.detector) && run.time_ms.cold && answersTriangles(run))
      .sort((a, b) => a.time_ms.cold!.frame - b.time_ms.cold!.frame);
    if (timed.length < 2) continue;
    wins.set(timed[0].detector, [...(wins.get(timed[0].detector) ?? []), scene.id]);
  }
  return wins;
}

function slowerText(report: Report, detector: string): string {
  const texts = [];
  for (const reference of kReferences) {
    if (reference === detector) continue;
    const ratios = [...report.scenes, ...report.families]
      .map((scene) => report.okRun(scene.id, detector)?.speedup?.triangles?.[reference]?.cold.ratio)
      .filter((ratio) => ratio !== undefined);
    if (ratios.length === 0) continue;
    const low = number(Math.min(...ratios)),
      high = number(Math.max(...ratios));
    texts.push(`${reference} takes ${low === high ? low : `${low} to ${high}`} times as long`);
  }
  return texts.length > 0 ? ` ${listed(texts)}.` : "";
}

function fastestFinding(report: Report, all: Judged[]): Finding[] {
  const exact = new Set(all.filter(flawless).map((verdict) => verdict.detector));
  const wins = [...winners(report, exact)].sort((a, b) => b[1].length - a[1].length);
  if (wins.length === 0) return [];
  const [[best, scenes], ...others] = wins;
  const total = wins.reduce((sum, [, won]) => sum + won.length, 0);
  const where =
    total === scenes.length
      ? total === 1
        ? "in the scene"
        : `in all ${total} scenes`
      : `in ${scenes.length} of ${total} scenes`;
  const rest = others.map(([name, won]) => `${name} in ${shortList(won, 3)}`);
  const runs = scenes.map((scene) => report.okRun(scene, best)!);
  return [
    {
      topic: "Fastest without error",
      sentence:
        `${best} ${where}: ${number(meanFrameMs(runs, "cold"))} ms per frame there for all pairs ` +
        `of triangles, caches cold${rest.length > 0 ? `; ${listed(rest)}` : ""}.` +
        slowerText(report, best),
    },
  ];
}

const cases = (groups: {values: string[]}[]): number =>
  groups.reduce((sum, group) => sum + group.values.length, 0);

export function defectsSentence(known: KnownDefects): string {
  const sum = (key: "listed" | "shown"): number => known.defects.reduce((n, d) => n + d[key], 0);
  return (
    `Of ${grouped(sum("listed"))} listed wrong answers that this run could show, ` +
    `${grouped(sum("shown"))} show and ${grouped(cases(known.not_shown))} do not; ` +
    `${grouped(cases(known.unlisted))} show that are not listed.`
  );
}

function defectsFinding(report: Report): Finding[] {
  const known = report.results.known_defects;
  return known ? [{topic: "Known defects", sentence: defectsSentence(known)}] : [];
}

function statusFinding(report: Report, status: string, topic: string): Finding[] {
  const runs = runsThat(report, status);
  if (runs.length === 0) return [];
  const texts = runs.map((run) => `${run.detector} in ${run.scene} (${run.message})`);
  return [{topic, sentence: `${shortList(texts, 3)}.`}];
}

function unjudgedFinding(report: Report): Finding[] {
  const whys = report.results.scenes.flatMap((scene) => scene.unjudged ?? []);
  return whys.length > 0 ? [{topic: "Not judged", sentence: `${shortList(whys, 3)}.`}] : [];
}

function absentFinding(report: Report): Finding[] {
  const absent = report.results.runs.filter((run) => run.status === "absent");
  const names = [...new Set(absent.map((run) => run.detector))];
  return names.length > 0 ? [{topic: "Not built", sentence: `${listed(names)}.`}] : [];
}

function oracleFinding(report: Report): Finding[] {
  return report.scenes
    .filter((scene) => scene.pairs)
    .map((scene) => {
      const {checked, oracle_wrong} = scene.pairs!.rational;
      const verdict =
        oracle_wrong === 0
          ? "was never wrong"
          : `was wrong ${plural(oracle_wrong, "time")}: an error of contactcheck itself`;
      return {
        topic: "The judge itself",
        sentence:
          `On ${grouped(checked)} random pairs of triangles the oracle ${verdict} ` +
          "(checked by rational arithmetic).",
      };
    });
}

function goalsFinding(report: Report): Finding[] {
  const goals = report.results.goals ?? [];
  if (goals.length === 0) return [];
  const met = goals.filter((goal) => goal.met).length,
    unknown = goals.filter((goal) => goal.met === null).length;
  const rest = unknown > 0 ? `; ${plural(unknown, "goal")} could not be measured` : "";
  return [
    {
      topic: "Goals",
      sentence:
        `${met} of ${plural(goals.length, "goal")} of the suite ` +
        `${met === 1 ? "is" : "are"} met${rest}.`,
    },
  ];
}

export function findings(report: Report): Finding[] {
  const all = verdicts(report);
  return [
    ...exactFindings(all),
    ...fastestFinding(report, all),
    ...wrongFinding(all, "missed"),
    ...wrongFinding(all, "spurious"),
    ...statusFinding(report, "error", "Ended in an error"),
    ...statusFinding(report, "refused", "Refused the input"),
    ...absentFinding(report),
    ...unjudgedFinding(report),
    ...defectsFinding(report),
    ...oracleFinding(report),
    ...goalsFinding(report),
  ];
}

/** Detectors without error in everything they were judged by. */
export const flawlessDetectors = (report: Report): string[] =>
  verdicts(report)
    .filter(flawless)
    .map((verdict) => verdict.detector);
