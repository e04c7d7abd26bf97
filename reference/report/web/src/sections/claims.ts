// What the results say about claims of the paper and of the libraries.
import {h, p, type Child} from "../dom";
import {count, errorRate, millimetres, number, rate, ratio} from "../format";
import type {Report} from "../report";
import {type Geometry, kReferences, type Level, type Run, type Scene} from "../results";
import type {Section} from "../section";
import {left, right, table, type Column, type Row} from "../table";

const touching = (scene: Scene): boolean => scene.contact_frames > 0;

function claim(title: string, text: string, columns: Column[], rows: Row[], id?: string): Child[] {
  return rows.length > 0 ? [h("h3", {id}, title), p(text), table(columns, rows, title)] : [];
}

function allScenes(report: Report): Scene[] {
  return [...report.scenes, ...report.families];
}

function hoverVerdict(grid: number | null, aabb: number | null): string {
  if (grid === null || aabb === null) return "no episode";
  return grid > aabb ? "holds" : grid < aabb ? "does not hold" : "equal";
}

function hoverClaim(report: Report): Child[] {
  const rows = allScenes(report)
    .filter(touching)
    .flatMap((scene) => {
      const grid = report.okRun(scene.id, "ffd-grid"),
        aabb = report.okRun(scene.id, "ffd-aabb");
      if (!grid || !aabb) return [];
      const g = grid.geometry.hover_gap_max,
        a = aabb.geometry.hover_gap_max;
      return [[scene.id, millimetres(g), millimetres(a), hoverVerdict(g, a)]];
    });
  return claim(
    "Hover: is traditional FFD less tight than FFD-AABB?",
    "Largest true distance at the moment a detector first reports contact, touching scenes only.",
    [left("scene"), right("ffd-grid, mm"), right("ffd-aabb, mm"), left("the paper's claim")],
    rows,
  );
}

function errorsAt(run: Run | null, level: string): string {
  const counts = run?.levels[level];
  return counts ? `${rate(counts.recall)} / ${errorRate(counts.spurious_rate)}` : "-";
}

function speedClaim(report: Report, detector: string, question: string, level: string): Child[] {
  const rows = allScenes(report).flatMap((scene) => {
    const run = report.okRun(scene.id, detector);
    if (!run) return [];
    const peers = kReferences.flatMap((reference) => [
      errorsAt(report.okRun(scene.id, reference), level),
      ratio(run.speedup?.[question]?.[reference]?.cold),
    ]);
    return [[scene.id, errorsAt(run, level), ...peers]];
  });
  return claim(
    `${detector} against FCL and Embree, question ${question}`,
    `Errors are recall / spurious rate at level ${level}; a speed-up is the reference's time divided by this detector's, cold, with its 95 % interval.`,
    [
      left("scene"),
      right("errors"),
      ...kReferences.flatMap((name) => [
        right(`errors of ${name}`),
        right(`speed-up over ${name}`),
      ]),
    ],
    rows,
  );
}

function field(run: Run, level: string, name: keyof Level): string {
  const counts = run.levels[level];
  if (!counts) return "-";
  return name === "recall" ? rate(counts.recall) : count(counts[name] as number);
}

// Metres: no gap that rounding of doubles leaves in a scene of some metres is larger.
const kRounding = 1e-12;

function onlyRoundingParts(run: Run): boolean {
  const farthest = run.geometry?.spurious_distance_max;
  return (
    run.detector.startsWith("fcl-") &&
    (run.levels.triangle?.spurious ?? 0) > 0 &&
    typeof farthest === "number" &&
    farthest < kRounding
  );
}

function fclFinding(report: Report): Child[] {
  const rows = report.scenes.flatMap((scene) =>
    report
      .okRunsOf(scene.id)
      .filter(onlyRoundingParts)
      .map((run) => [
        scene.id,
        run.detector,
        field(run, "triangle", "reported"),
        field(run, "triangle", "spurious"),
        millimetres(run.geometry.spurious_distance_max),
      ]),
  );
  return claim(
    "FCL takes gaps below rounding for contact",
    "It tries the separating axes of two triangles in plain double, without a bound on the error (a known defect of FCL 0.7, its issue 502). Pairs " +
      "that are apart by less than the rounding of that test may be reported: neighbours of a corner, an edge or a plane where bodies just touch. " +
      "Every spurious pair of the rows below is closer than 1e-12 metres (rounding, unless bodies themselves are as small); the oracle, which is exact, says that it does not touch.",
    [
      left("scene"),
      left("detector"),
      right("reported"),
      right("spurious"),
      right("farthest apart, mm"),
    ],
    rows,
  );
}

function scaleFinding(report: Report): Child[] {
  const rows = allScenes(report)
    .filter(touching)
    .flatMap((scene) => {
      const scaled = report.okRun(scene.id, "bullet-vf"),
        plain = report.okRun(scene.id, "bullet-vf:scale=1");
      if (!scaled || !plain) return [];
      return [
        [
          scene.id,
          number(scaled.semantics.scale),
          field(scaled, "body", "recall"),
          field(scaled, "near", "recall"),
          field(plain, "body", "recall"),
          field(plain, "near", "recall"),
        ],
      ];
    });
  return claim(
    "Bullet's vertex-face query at scale 1: small triangles do not exist",
    "It skips every triangle whose cross product of two sides, squared, is at most FLT_EPSILON (1.19e-7) in Bullet's own units: at scale 1 that " +
      "is every triangle below 1.73e-4 square metres, without a warning. At the default the scene is scaled by a power of two until its smallest triangles count.",
    [
      left("scene"),
      right("scale"),
      right("body recall"),
      right("near recall"),
      right("body recall at scale 1"),
      right("near recall at scale 1"),
    ],
    rows,
  );
}

function insideFinding(report: Report): Child[] {
  const rows = allScenes(report)
    .filter(touching)
    .flatMap((scene) => {
      const run = report.okRun(scene.id, "bullet-vf");
      if (!run?.levels.vertex) return [];
      return [
        [
          scene.id,
          millimetres(run.semantics.margin),
          field(run, "vertex", "truth"),
          field(run, "vertex", "hit"),
          field(run, "vertex", "spurious"),
        ],
      ];
    });
  return claim(
    "Bullet's vertex-face query is an unsigned proximity query",
    "It reports vertices near a surface, on either side. Of the vertices that are truly inside the other body it names those near its surface alone; " +
      "that is its specification and no error, but it is no penetration query.",
    [
      left("scene"),
      right("margin mm"),
      right("vertices inside"),
      right("of them reported"),
      right("reported, not inside"),
    ],
    rows,
  );
}

// Of the normals judged, those that point away from the way out; older results do not tell.
function turnedNormals({normal_error_deg_histogram: bins}: Geometry): string {
  return bins ? count(bins.reduce((sum, bin) => (bin.from >= 90 ? sum + bin.count : sum), 0)) : "-";
}

/** The place of the finding below, where the results have it. */
export const kTurnedNormals = "turned-normals";

export const hasTurnedNormals = (report: Report): boolean => normalFinding(report).length > 0;

function normalFinding(report: Report): Child[] {
  const rows = allScenes(report).flatMap((scene) => {
    const geometry = report.okRun(scene.id, "bullet-vf")?.geometry;
    if (!geometry || (geometry.normal_error_deg_max ?? 0) < 90) return [];
    return [
      [
        scene.id,
        count(geometry.normal_judged),
        turnedNormals(geometry),
        number(geometry.normal_error_deg_mean),
        number(geometry.normal_error_deg_max),
      ],
    ];
  });
  return claim(
    "Bullet's vertex-face normals turn with the side of the vertex",
    "Its normal points from the face to the vertex, on whichever side of the face the vertex is. Normals are judged for vertices that are truly " +
      "inside the other body: there it points further in, about 180 degrees off the way out. That is Bullet's own convention and no rounding, and a " +
      "solver that follows it pushes such a vertex further in.",
    [
      left("scene"),
      right("normals judged"),
      right("of them 90 degrees off or more"),
      right("mean, degrees"),
      right("largest, degrees"),
    ],
    rows,
    kTurnedNormals,
  );
}

function clusterFinding(report: Report): Child[] {
  const rows = allScenes(report).flatMap((scene) =>
    ["bullet-cl", "bullet-cl:k=256"].flatMap((detector) => {
      const run = report.okRun(scene.id, detector);
      return run
        ? [
            [
              scene.id,
              detector,
              field(run, "body", "truth"),
              field(run, "body", "missed"),
              field(run, "body", "spurious"),
            ],
          ]
        : [];
    }),
  );
  return claim(
    "Bullet's clusters touch where the surfaces do not",
    "A cluster is the convex hull of a group of vertices, so it fills what is concave between them: false contact between shells and near concave parts.",
    [
      left("scene"),
      left("detector"),
      right("true body contacts"),
      right("missed"),
      right("spurious"),
    ],
    rows,
  );
}

export const claims: Section = {
  id: "claims",
  title: "What the results say about claims",
  short: "Claims tested",
  build: (report) => [
    ...hoverClaim(report),
    ...speedClaim(report, "ffd-aabb-sphere2+tri", "triangles", "triangle"),
    ...speedClaim(report, "ffd-aabb-sphere2", "body", "body"),
    ...fclFinding(report),
    ...scaleFinding(report),
    ...insideFinding(report),
    ...normalFinding(report),
    ...clusterFinding(report),
  ],
};
