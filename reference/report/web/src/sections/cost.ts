// What a frame costs: against the number of triangles, and frame by frame.
import * as Plot from "@observablehq/plot";
import {chart, legend, type Chart} from "../chart";
import {checkboxes, controlBar, radios, select} from "../controls";
import {h, p} from "../dom";
import {grouped, number} from "../format";
import {kLineStyles} from "../groups";
import {flawlessDetectors, winners} from "../headline";
import {trianglesOf, type Report} from "../report";
import type {Run, Scene} from "../results";
import type {Section} from "../section";
import {stroke} from "../swatch";

type Part = "cold" | "hot";

const kMost = kLineStyles.length;

interface Lines {
  detectors: string[];
  style: (detector: string) => (typeof kLineStyles)[number];
}

const linesOf = (detectors: string[]): Lines =>
  ({detectors, style: (name) => kLineStyles[detectors.indexOf(name) % kMost]});

const lineLegend = ({detectors, style}: Lines): HTMLElement =>
  legend(detectors.map((name) => ({text: name, swatch: stroke(style(name).colour, style(name).dash)})));

const timed = (run: Run | null): run is Run => run?.time_ms.cold !== undefined;

function timedDetectors(report: Report): string[] {
  return report.detectors.filter((name) => report.scenes.some((scene) => timed(report.okRun(scene.id,
      name))));
}

/** The fastest without error, the usual references, then others in file order. */
function firstChoice(report: Report, all: string[]): string[] {
  const wins = [...winners(report, new Set(flawlessDetectors(report)))].sort((a,
      b) => b[1].length - a[1].length);
  const wanted = [...wins.map(([name]) => name), "fcl-aabb", "fcl-obbrss", "embree", "ffd-aabb-sphere2",
      ...all];
  return [...new Set(wanted)].filter((name) => all.includes(name)).slice(0, 5).sort((a,
      b) => all.indexOf(a) - all.indexOf(b));
}

// Against triangles ------------------------------------------------------------------------------

interface Cost {
  detector: string;
  scene: string;
  series: string;
  triangles: number;
  ms: number;
}

// scaling-contact-4 and contact are one scene at two sizes.
const seriesOf = (scene: string): string => scene.replace(/^scaling-/, "").replace(/-\d+$/, "");

function costs(report: Report, detectors: string[], part: Part): Cost[] {
  const out: Cost[] = [];
  for (const scene of report.scenes)
    for (const detector of detectors) {
      const run = report.okRun(scene.id, detector), ms = timed(run) ? run.time_ms[part]!.frame : 0;
      if (ms > 0) out.push({detector, scene: scene.id, series: seriesOf(scene.id),
          triangles: trianglesOf(scene), ms});
    }
  return out.sort((a, b) => a.triangles - b.triangles);
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

const plainNumber = (value: number): string => (value >= 1000 ? grouped(value) : String(value));

function drawCosts(width: number, all: Cost[], lines: Lines): Node {
  const xy = {x: "triangles", y: "ms"} as const, sizes = all.map((cost) => cost.triangles);
  const title = (d: Cost): string =>
      `${d.detector}\n${d.scene}: ${grouped(d.triangles)} triangles\n${number(d.ms)} ms per frame`;
  return Plot.plot({
    width, height: Math.min(400, 240 + width / 5), marginLeft: 52, marginTop: 28, marginRight: 24,
        marginBottom: 40,
    x: {type: "log", domain: [Math.min(...sizes) / 1.2, Math.max(...sizes) * 1.2],
        label: "triangles of all bodies →", grid: true,
        tickFormat: plainNumber, ticks: width < 600 ? 3 : 6},
    y: {type: "log", label: "↑ ms per frame", grid: true, nice: true, tickFormat: plainNumber, ticks: 6},
    marks: [
      ...series(all).map((group) => Plot.line(group, {...xy, stroke: lines.style(group[0].detector).colour,
        strokeDasharray: lines.style(group[0].detector).dash, strokeWidth: 1.8, strokeOpacity: 0.8})),
      Plot.dot(all, {...xy, fill: (d: Cost) => lines.style(d.detector).colour, r: 4,
          symbol: (d: Cost) => lines.style(d.detector).shape, ariaLabel: title}),
      Plot.tip(all, Plot.pointer({...xy, title, fill: "var(--surface)", fontSize: 12})),
    ],
  });
}

// Frame by frame ---------------------------------------------------------------------------------

interface FrameCost {
  detector: string;
  frame: number;
  ms: number;
}

function frameCosts(report: Report, scene: Scene, detectors: string[]): FrameCost[] {
  return detectors.flatMap((detector) => {
    const values = report.okRun(scene.id, detector)?.per_frame.frame_ms ?? [];
    return values.flatMap((ms, frame) => (ms !== null && ms > 0 ? [{detector, frame, ms}] : []));
  });
}

const frameAxis = (width: number, scene: Scene) =>
  ({label: "frame →", domain: [0, Math.max(1, scene.frames - 1)], ticks: Math.min(scene.frames, width / 80)});

function drawFrames(width: number, scene: Scene, all: FrameCost[], lines: Lines): Node {
  const xy = {x: "frame", y: "ms"} as const;
  const title = (d: FrameCost): string => `${d.detector}, frame ${d.frame}\n${number(d.ms)} ms`;
  return Plot.plot({
    width, height: 300, marginLeft: 52, marginTop: 28, marginRight: 24, marginBottom: 38,
    x: frameAxis(width, scene),
    y: {type: "log", label: "↑ ms per frame", grid: true, nice: true, tickFormat: plainNumber, ticks: 6},
    marks: [
      ...lines.detectors.map((name) => Plot.line(all.filter((d) => d.detector === name),
        {...xy, stroke: lines.style(name).colour, strokeDasharray: lines.style(name).dash,
            strokeWidth: 1.8})),
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

function frameErrors(report: Report, scene: Scene, detectors: string[]): FrameCount[] {
  return detectors.flatMap((detector) => (["missed", "spurious"] as const).flatMap((kind) =>
    (report.okRun(scene.id, detector)?.per_frame[kind] ?? []).flatMap((n, frame) => (n > 0 ? [{detector, kind,
        frame, n}] : []))));
}

// The truth of the finest level that any of them is judged at, and the errors of each.
function drawContacts(width: number, scene: Scene, truth: number[], errors: FrameCount[],
    lines: Lines): Node {
  const xy = {x: "frame", y: "n"} as const;
  const title = (d: FrameCount): string => `${d.detector}, frame ${d.frame}\n${grouped(d.n)} ${d.kind}`;
  return Plot.plot({
    width, height: 170, marginLeft: 52, marginTop: 28, marginRight: 24, marginBottom: 38,
    x: frameAxis(width, scene),
    y: {label: "↑ true contacts (area); errors: ▲ missed, × spurious", grid: true, ticks: 4, nice: true},
    marks: [
      Plot.areaY(truth, {x: (_, i) => i, y: (n: number) => n, fill: "var(--right)", stroke: "var(--grey)"}),
      Plot.dot(errors, {...xy, stroke: (d: FrameCount) => lines.style(d.detector).colour, r: 3.5,
                        symbol: (d: FrameCount) => (d.kind === "missed" ? "triangle" : "times"),
                            ariaLabel: title}),
      Plot.tip(errors, Plot.pointer({...xy, title, fill: "var(--surface)", fontSize: 12})),
      Plot.ruleY([0]),
    ],
  });
}

function truthOf(report: Report, scene: Scene): number[] {
  const truths = report.okRunsOf(scene.id).map((run) => run.per_frame.truth ?? []);
  const sum = (all: number[]): number => all.reduce((a, b) => a + b, 0);
  return truths.reduce((best, truth) => (sum(truth) > sum(best) ? truth : best), [] as number[]);
}

export const cost: Section = {
  id: "cost",
  title: "What a frame costs",
  short: "Cost",
  build(report) {
    const all = timedDetectors(report);
    if (all.length === 0 || report.scenes.length === 0) return [];
    let lines = linesOf(firstChoice(report, all)), part: Part = "cold", scene = report.scenes[0];
    const legends = h("div");
    const charts: Chart[] = [
      chart("Milliseconds per frame against the number of triangles", (width) => drawCosts(width,
          costs(report, lines.detectors, part), lines)),
      chart("Milliseconds of each frame", (width) => drawFrames(width, scene, frameCosts(report, scene,
          lines.detectors), lines)),
      chart("True, missed and spurious contacts of each frame", (width) =>
        drawContacts(width, scene, truthOf(report, scene), frameErrors(report, scene, lines.detectors),
            lines)),
    ];
    const redraw = (): void => {
      legends.replaceChildren(lineLegend(lines));
      charts.forEach((one) => one.redraw());
    };
    redraw();
    return [
      p(`Up to ${kMost} detectors, each with its own colour, dashes and shape. A line joins the sizes of one scene; `
        + "the suite scaling has scenes of 1, 4 and 16 times the triangles."),
      controlBar(
        radios("Caches (by triangles)", [["cold", "cold"], ["hot", "hot"]], part,
            (value) => { part = value as Part; redraw(); }),
        checkboxes("Choose detectors", all, lines.detectors, kMost,
            (names) => { lines = linesOf(names); redraw(); })),
      legends, h("h3", {}, "Against the number of triangles"), charts[0].element,
      h("h3", {}, "Frame by frame"),
      p("Cold; frames that were not timed are left out. Below, what each of these frames holds, and where each detector chosen errs."),
      controlBar(select("Scene", report.scenes.map((s, i) => [String(i), s.id]), "0",
          (value) => { scene = report.scenes[Number(value)]; redraw(); })),
      charts[1].element, charts[2].element,
    ];
  },
};
