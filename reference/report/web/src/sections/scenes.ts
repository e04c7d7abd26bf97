// Every number of every scene; a scene is filled in when it is opened.
import {code, h, p, unfolding, type Child} from "../dom";
import {count, errorRate, millimetres, number, optionsText, rate, ratio} from "../format";
import {comparedQuestion, finestLevel, isOk, type Report} from "../report";
import {type Geometry, kReferences, type Level, type Run, type Scene} from "../results";
import type {Section} from "../section";
import {showCell} from "../showing";
import {left, right, titledTable, type Row} from "../table";
import {canShow} from "../view_slot";
import {pairsContent} from "./pairs";

const kResultColumns = [
  left("detector", "as given to --detector"),
  left("level", "finest level judged"),
  right("truth", "true contacts at that level, over all frames"),
  right("recall", "hit / truth, cut, not rounded"),
  right("missed", "true contacts not reported"),
  right("spurious", "reported, not true"),
  right("body m/s", "pairs of bodies missed / spurious, over all frames"),
  right("hover mm", "largest true distance at the moment contact is first reported"),
  right("late", "frames reported after (+) or before (-) the truth, worst episode"),
  right(
    "ms/frame",
    "map + update + query, cold median, own question; (own ...): update + query by its own clock",
  ),
  left("question", "question in which the next columns compare"),
  ...kReferences.map((name) =>
    right(`vs ${name}`, `time of ${name} / time of this detector, cold`),
  ),
];

// Ours, with a pipe's way in it, and beside it what the detector says of itself.
function frameTime(run: Run): string {
  const cold = run.time_ms.cold,
    own = cold?.self_reported;
  return own === undefined ? number(cold?.frame) : `${number(cold?.frame)} (own ${number(own)})`;
}

function resultRow(run: Run): Row {
  if (!isOk(run)) {
    const rest = kResultColumns.slice(3).map(() => "");
    return [
      run.detector,
      {text: run.status, class: "error"},
      {text: run.message, class: "wrap left"},
      ...rest,
    ];
  }
  const counts: Level | undefined = run.levels[finestLevel(run)],
    body = run.levels.body,
    question = comparedQuestion(run);
  return [
    run.detector,
    finestLevel(run),
    count(counts?.truth),
    rate(counts?.recall),
    count(counts?.missed),
    count(counts?.spurious),
    body ? `${body.missed}/${body.spurious}` : "-",
    millimetres(run.geometry.hover_gap_max),
    count(run.geometry.late_frames),
    frameTime(run),
    question,
    ...kReferences.map((name) => ratio(run.speedup?.[question]?.[name]?.cold, false)),
  ];
}

const truthText = (scene: Scene): string =>
  Object.entries(scene.truth)
    .map(([level, n]) => `${level} ${n}`)
    .join(", ");

function bodies(scene: Scene): Child[] {
  const rows = scene.bodies.map((b) => [
    b.name,
    {text: b.source, class: "wrap"},
    String(b.vertices),
    String(b.triangles),
    String(b.cells),
    b.solid ? "yes" : "no",
    {text: b.notes, class: "wrap"},
  ]);
  return titledTable(
    "Bodies",
    [
      left("body"),
      left("mesh"),
      right("vertices"),
      right("triangles"),
      right("cells"),
      left("solid"),
      left("notes"),
    ],
    rows,
  );
}

function levelRows(run: Run, levels: Record<string, Level>, against: string): Row[] {
  return Object.entries(levels).map(([name, c]) => {
    const margin = c.margin === undefined ? "" : ` (below ${millimetres(c.margin)} mm)`;
    const text = `${name}${margin}${c.informative ? ", informative" : ""}`;
    return [
      run.detector,
      {text, class: c.informative ? "informative" : ""},
      against,
      String(c.truth),
      String(c.reported),
      String(c.missed),
      String(c.spurious),
      rate(c.recall),
      errorRate(c.spurious_rate),
    ];
  });
}

function levels(runs: Run[]): Child[] {
  const rows = runs.flatMap((run) => [
    ...levelRows(run, run.levels, "doubles"),
    ...levelRows(run, run.levels_rounded ?? {}, "values fed"),
  ]);
  return titledTable(
    "Every level judged (sums over frames)",
    [
      left("detector"),
      left("level"),
      left("truth for"),
      right("truth"),
      right("reported"),
      right("missed"),
      right("spurious"),
      right("recall"),
      right("spurious rate"),
    ],
    rows,
  );
}

function spread(
  values: (number | null | undefined)[],
  text: (value: number | null | undefined) => string,
): string {
  return values.map(text).join(" / ");
}

const hasGraded = (g: Geometry): boolean =>
  g.covered_length_fraction !== null ||
  g.depth_error_max !== null ||
  (g.depth_kind ?? "none") !== "none";

function gradedErrors(runs: Run[]): Child[] {
  const rows = runs
    .filter((run) => hasGraded(run.geometry))
    .map(({detector, geometry: g}) => [
      detector,
      millimetres(g.missed_length),
      rate(g.covered_length_fraction),
      millimetres(g.spurious_distance_max),
      g.depth_kind ?? "none",
      count(g.depth_judged),
      spread([g.depth_error_max, g.depth_error_mean, g.depth_error_p95], millimetres),
      count(g.normal_judged),
      spread([g.normal_error_deg_max, g.normal_error_deg_mean, g.normal_error_deg_p95], number),
    ]);
  return titledTable(
    "Graded errors (lengths in mm, angles in degrees; max / mean / 95th percentile)",
    [
      left("detector"),
      right("contour missed"),
      right("contour covered"),
      right("spurious up to"),
      left("depth kind"),
      right("depths judged"),
      right("depth error"),
      right("normals judged"),
      right("normal error"),
    ],
    rows,
  );
}

function stages(runs: Run[]): Child[] {
  const rows = runs.flatMap((run) =>
    (run.stages ?? []).map((stage) => [
      run.detector,
      stage.name,
      stage.unit,
      String(stage.in),
      String(stage.out),
      stage.visited === undefined ? "-" : `${stage.visited} ${stage.visited_unit}`,
      String(stage.missed),
    ]),
  );
  return titledTable(
    "Which stage lost which true triangle pairs (sums over frames)",
    [
      left("detector"),
      left("stage"),
      left("unit"),
      right("in"),
      right("out"),
      right("visited"),
      right("missed"),
    ],
    rows,
  );
}

function times(runs: Run[]): Child[] {
  const rows = runs
    .filter((run) => run.time_ms.cold)
    .map(({detector, time_ms: t, memory_bytes}) => [
      detector,
      t.question ?? "",
      number(t.prepare),
      number(t.cold!.map),
      number(t.cold!.update),
      number(t.cold!.query),
      number(t.cold!.frame),
      number(t.cold!.contact_frame),
      number(t.cold!.self_reported),
      number(t.hot?.frame),
      count(t.timed_frames),
      count(t.repeats),
      number(memory_bytes / 1048576),
    ]);
  return titledTable(
    "Times in milliseconds per frame (medians over repeats; cold unless said)",
    [
      left("detector"),
      left("question"),
      right("prepare"),
      right("map"),
      right("update"),
      right("query"),
      right("frame"),
      right("contact frame"),
      right(
        "own clock",
        "update + query as the detector itself measured them, without the way through a pipe",
      ),
      right("frame, hot"),
      right("timed frames"),
      right("repeats"),
      right("memory, MiB"),
    ],
    rows,
  );
}

function counters(runs: Run[]): Child[] {
  const rows = runs
    .filter((run) => run.counters)
    .map((run) => {
      const texts = Object.entries(run.counters!).map(
        ([name, sum]) => `${number(sum / run.frames)} ${name.replaceAll("_", " ")}`,
      );
      return [run.detector, {text: texts.join(", "), class: "wrap left"}];
    });
  return titledTable("Work per frame (means)", [left("detector"), left("counted")], rows);
}

function speedups(runs: Run[]): Child[] {
  const rows = runs.flatMap((run) =>
    Object.entries(run.speedup ?? {}).flatMap(([question, references]) =>
      Object.entries(references)
        .filter(([reference]) => reference !== run.detector)
        .map(([reference, s]) => [
          run.detector,
          optionsText(run.options),
          question,
          reference,
          optionsText(s.reference_options),
          ratio(s.cold),
          ratio(s.hot),
          ratio(s.contact_frames),
          ratio(s.without_map),
        ]),
    ),
  );
  return titledTable(
    "Speed-ups: time of the reference / time of the detector on the same question, frames and repeats, with 95 % intervals",
    [
      left("detector"),
      left("its options"),
      left("question"),
      left("reference"),
      left("its options"),
      right("cold"),
      right("hot"),
      right("contact frames, cold"),
      right("without map, cold"),
    ],
    rows,
  );
}

// What a reader must know about single runs and no table shows.
function notes(runs: Run[]): Child[] {
  const texts = runs.flatMap((run) =>
    [
      ...(run.float_environment ?? []),
      ...(run.notes ?? []),
      ...Object.entries(run.not_judged ?? {}).map(([level, why]) => `level ${level} ${why}`),
    ].map((note) => `${run.detector}: ${note}`),
  );
  return texts.length > 0
    ? [h("h4", {}, "Notes"), h("ul", {class: "plain"}, ...texts.map((text) => h("li", {}, text)))]
    : [];
}

function disagreements(report: Report, scene: Scene): Child[] {
  const own = report.results.disagreements.filter((d) => d.scene === scene.id);
  const rows = own.map((d) => [
    d.detector,
    d.kind,
    d.level,
    String(d.frame),
    {text: d.case, node: code(d.case)},
    ...(canShow(scene.id) ? [showCell(d)] : []),
  ]);
  return titledTable(
    "Disagreements with the truth (first of each kind)",
    [
      left("detector"),
      left("kind"),
      left("level"),
      right("frame"),
      left("case"),
      ...(canShow(scene.id) ? [left("in 3D")] : []),
    ],
    rows,
  );
}

function sceneContent(report: Report, scene: Scene): Child[] {
  const all = report.runsOf(scene.id),
    ok = all.filter(isOk);
  return [
    p(
      `${scene.frames} frames, ${scene.contact_frames} with contact, size ${number(scene.size)} m. True contacts, summed over frames: ${truthText(scene)}.`,
    ),
    ...pairsContent(report, scene),
    ...titledTable("Result", kResultColumns, all.map(resultRow)),
    ...bodies(scene),
    ...levels(ok),
    ...gradedErrors(ok),
    ...stages(ok),
    ...times(ok),
    ...counters(ok),
    ...speedups(ok),
    ...notes(ok),
    ...disagreements(report, scene),
  ];
}

function columnLegend(): HTMLElement {
  return unfolding("How to read the result table", () => [
    h(
      "dl",
      {class: "words"},
      ...kResultColumns.flatMap((c) => [h("dt", {}, c.title), h("dd", {}, c.meaning ?? "")]),
    ),
  ]);
}

export const scenes: Section = {
  id: "scenes",
  title: "Every number, scene by scene",
  short: "All numbers",
  build(report) {
    if (report.scenes.length === 0) return [];
    return [
      p(
        "Open a scene for its bodies, results, levels, graded errors, stages, times, work, speed-ups, notes and the first disagreements.",
      ),
      columnLegend(),
      ...report.scenes.map((scene) =>
        unfolding(
          h("span", {}, h("strong", {}, scene.id), h("span", {class: "aside"}, ` ${scene.title}`)),
          () => sceneContent(report, scene),
          {class: "block", id: `scene-${scene.id}`},
        ),
      ),
    ];
  },
};
