// The paper's tables beside ours: reproduction.json of `contactcheck reproduce`.
import {code, h, p, unfolding, type Child} from "../dom";
import {count, millimetres, number, rate, ratio} from "../format";
import type {
  ClosedLoop,
  PaperFinding,
  PaperMeans,
  PaperScene,
  ReadingName,
  Reproduction,
  StepTimes,
} from "../reproduction";
import type {Section} from "../section";
import {left, right, table, titledTable, type Row} from "../table";

const kReadings: [ReadingName, string][] = [
  ["safe", "bounds that contain what they bound, node against plane"],
  ["paper", "as the paper is written, node against plane"],
  ["exact", "safe bounds, exact triangle test"],
];

function countsTable(scene: PaperScene): Child[] {
  const rows = Object.entries(scene.counts).map(([name, c]) => [
    name,
    String(c.paper),
    String(c.ours),
    `${c.difference_percent < 0 ? "" : "+"}${c.difference_percent.toFixed(2)} %`,
  ]);
  return titledTable(
    "Counts",
    [left("count"), right("paper"), right("ours"), right("difference")],
    rows,
  );
}

function stepRow(method: string, whose: string, t: StepTimes | null): Row {
  const times = t
    ? [t.mss, t.cell, t.test, t.response, t.total].map(number)
    : ["-", "-", "-", "-", "-"];
  const judged = t?.level
    ? [t.level, `${t.missed} of ${t.truth}`, String(t.spurious)]
    : ["-", "-", "-"];
  return [method, whose, ...times, ...judged];
}

function stepsTable(scene: PaperScene): Child[] {
  const rows = scene.steps.flatMap((row) => [
    ...(row.paper_reports
      ? [
          stepRow(
            row.method,
            `paper, ${row.paper_reports.table}, ${row.paper_reports.device}`,
            row.paper_reports,
          ),
        ]
      : []),
    ...kReadings.map(([id]) => stepRow(row.method, `ours, ${id}`, row[id])),
  ]);
  return titledTable(
    "Milliseconds per whole step, timed in lockstep from the same states, cold",
    [
      left("method"),
      left("whose"),
      right("MSS"),
      right("CELL"),
      right("collision test"),
      right("response"),
      right("total"),
      left("level"),
      right("missed"),
      right("spurious"),
    ],
    rows,
  );
}

function ratiosTable(scene: PaperScene): Child[] {
  const rows = scene.ratios.flatMap((row) => {
    const paper = row.paper_reports;
    const ours = kReadings
      .filter(([id]) => row[id])
      .map(([id]) => {
        const r = row[id]!;
        return [
          row.before,
          row.after,
          `ours, ${id}`,
          ratio(r.test),
          ratio(r.total),
          r.same_contacts ? "yes" : "no",
          `${r.missed_before}, ${r.missed_after}`,
        ];
      });
    return [
      ...(paper
        ? [
            [
              row.before,
              row.after,
              `paper, ${paper.table}`,
              `${paper.test.toFixed(2)}x`,
              `${paper.total.toFixed(3)}x`,
              "-",
              "-",
            ],
          ]
        : []),
      ...ours,
    ];
  });
  return titledTable(
    "From one method to the next: the time before over the time after",
    [
      left("from"),
      left("to"),
      left("whose"),
      right("collision test"),
      right("frames per second"),
      left("same contacts"),
      right("missed before, after"),
    ],
    rows,
  );
}

function loopRow(loop: ClosedLoop): Row {
  if (loop.error)
    return [loop.detector, {text: loop.error, class: "wrap left"}, "", "", "", "", "", ""];
  const recalls = Object.entries(loop.levels)
    .map(([level, c]) => `${level} ${rate(c.recall)}`)
    .join(", ");
  return [
    loop.detector,
    millimetres(loop.hover_at_rest_max),
    millimetres(loop.hover_at_rest_mean),
    millimetres(loop.deepest_penetration),
    number(loop.energy_gain),
    number(loop.last_speed),
    count(loop.tunnelling_events),
    {text: recalls, class: "left"},
  ];
}

function restText(scene: PaperScene): Child[] {
  const rate = scene.frame_rate,
    hover = scene.hover_at_rest,
    two = hover?.["ffd-aabb-sphere2"],
    grid = hover?.["ffd-grid"];
  const factor =
    hover?.factor === null || hover?.factor === undefined
      ? ""
      : `: ${hover.factor.toFixed(1)} times as far`;
  return [
    rate &&
      p(
        code(rate.detector),
        `: ${rate.steps_per_second.toFixed(0)} whole steps per second, ` +
          `${rate.simulated_over_real_time.toFixed(1)} times real time, on one core.`,
      ),
    hover &&
      p(
        "At rest ",
        code("ffd-aabb-sphere2"),
        ` keeps the surfaces ${millimetres(two)} mm apart on average, `,
        code("ffd-grid"),
        ` ${millimetres(grid)} mm${factor}.`,
      ),
  ];
}

function sceneDetails(scene: PaperScene): HTMLElement {
  const aside = ` ${scene.ours}, ${scene.frames} frames, ${scene.contact_frames} with contact`;
  return unfolding(
    h("span", {}, h("strong", {}, scene.scene), h("span", {class: "aside"}, aside)),
    () => [
      scene.sentences.length > 0 &&
        h("ul", {class: "plain"}, ...scene.sentences.map((text) => h("li", {}, text))),
      ...restText(scene),
      ...ratiosTable(scene),
      ...stepsTable(scene),
      ...countsTable(scene),
      ...titledTable(
        "Closed loop: each detector drives the simulation itself, judged on the frames of its own motion",
        [
          left("detector"),
          right("hover at rest mm, largest"),
          right("mean"),
          right("deepest penetration mm"),
          right("energy gain"),
          right("last speed m/s"),
          right("tunnelling"),
          left("recall"),
        ],
        scene.closed_loop.map(loopRow),
      ),
    ],
    {class: "block"},
  );
}

function meansText({scenes, test_ratio: test, frame_rate_ratio: frames}: PaperMeans): Child[] {
  const claimed =
    frames.paper_claims === null ? "" : `, its text says ${frames.paper_claims.toFixed(3)}x`;
  return [
    h("h3", {}, `Two levels of spheres against one, safe bounds, mean of ${scenes} scenes`),
    h(
      "ul",
      {class: "plain"},
      h(
        "li",
        {},
        `collision test (geometric mean): ours ${test.ours.toFixed(2)}x, the paper's ${test.paper.toFixed(2)}x`,
      ),
      h(
        "li",
        {},
        `frames per second (mean): ours ${frames.ours.toFixed(3)}x; the paper's totals give ${frames.paper.toFixed(3)}x${claimed}`,
      ),
    ),
  ];
}

// Two levels over one is the paper's own step: a line per scene, ours beside the paper's.
function headTable(reproduction: Reproduction): HTMLElement {
  const rows = reproduction.scenes.flatMap((scene) =>
    scene.ratios
      .filter((row) => row.after === "ffd-aabb-sphere2" && row.paper_reports)
      .map((row) => [
        scene.scene,
        `${row.paper_reports!.test.toFixed(2)}x`,
        ...kReadings.map(([id]) => ratio(row[id]?.test)),
        `${row.paper_reports!.total.toFixed(3)}x`,
        ...kReadings.map(([id]) => ratio(row[id]?.total)),
      ]),
  );
  return table(
    [
      left("scene"),
      right("collision test: paper"),
      ...kReadings.map(([id]) => right(`ours, ${id}`)),
      right("frames per second: paper"),
      ...kReadings.map(([id]) => right(`ours, ${id}`)),
    ],
    rows,
    "Two levels of spheres over one: the paper's ratios beside ours",
  );
}

// As sentences about the paper show figures of a unit.
const kDecimals: Record<string, number> = {ratio: 3, ms: 3, fps: 2, "%": 1, count: 0};

const figure = (value: number, unit: string): string => value.toFixed(kDecimals[unit] ?? 3);

function findingRow(f: PaperFinding): Row {
  const verdict = f.agrees === null ? "no claim" : f.agrees ? "✓ agrees" : "✗ contradicts";
  return [
    f.topic,
    f.table ?? "-",
    f.scene ?? "-",
    f.method ?? "-",
    f.claimed === null ? "-" : String(Number(f.claimed.toFixed(4))),
    figure(f.computed, f.unit),
    f.unit,
    {text: verdict, class: f.agrees === false ? "bad" : ""},
    {text: f.sentence, class: "wrap left"},
  ];
}

function paperNumbers({source, findings}: Reproduction["paper"]): Child[] {
  const wrong = findings.filter((f) => f.agrees === false).length;
  return [
    h("h3", {}, "The paper's own numbers"),
    p(
      `${source.authors.join(", ")}: ${source.title}. ${source.journal}, ${source.year}, doi ${source.doi}. ` +
        `${findings.length} checks by arithmetic alone; ${wrong} contradict a claim or cannot be.`,
    ),
    unfolding("All checks", () => [
      table(
        [
          left("topic"),
          left("table"),
          left("scene"),
          left("method"),
          right("claimed"),
          right("computed"),
          left("unit"),
          left("verdict"),
          left("in words"),
        ],
        findings.map(findingRow),
        "Checks of the paper's own numbers",
      ),
    ]),
  ];
}

export const paper: Section = {
  id: "paper",
  title: "The paper's tables beside ours",
  short: "The paper",
  build({results: {reproduction}}) {
    if (!reproduction) return [];
    return [
      p(
        "The paper's milliseconds are of phones of 2012: only ratios compare. A ratio above 1 says that the second level of spheres pays.",
      ),
      headTable(reproduction),
      h(
        "ul",
        {class: "plain"},
        ...kReadings.map(([id, says]) => h("li", {}, code(id), `: ${says}`)),
      ),
      ...(reproduction.means ? meansText(reproduction.means) : []),
      h("h3", {}, "Scene by scene"),
      p(
        "MSS is the deformation with gravity and ground; CELL maps every vertex and updates the detector's boxes and spheres.",
      ),
      ...reproduction.scenes.map(sceneDetails),
      ...paperNumbers(reproduction.paper),
    ];
  },
};
