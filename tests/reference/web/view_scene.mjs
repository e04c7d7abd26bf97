// A scene by hand for the 3D view, in the container of reference/view/view_bytes.h, written here by
// its description; and a report that holds it.
import {deflateSync} from "node:zlib";

export const kOrigin = [10, 20, 30],
  kScale = 2;
/** Of the missed pair in frame 1: the middles of its triangles are (2/3, 1/3, 0) and (1/2, 1/4, -1/12). */
export const kMissed = {
  pair: [0, 0, 1, 0],
  frame: 1,
  centroid: [10 + 7 / 12, 20 + 7 / 24, 30 - 1 / 24],
};

// A square of two triangles, and a tent in a lattice of one cell that comes down through it.
const kSquare = [
  [0, 0, 0],
  [1, 0, 0],
  [1, 1, 0],
  [0, 1, 0],
];
const kTent = {
  local: [
    [0, 0, 0],
    [1, 0, 0],
    [0.5, 0, 1],
    [0.5, 1, 1],
  ],
  triangles: [
    [0, 1, 2],
    [1, 3, 2],
  ],
};
const kTentHeights = [1, -0.25, 0.5]; // metres, per frame

const cell = (height) =>
  [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => [
    0.25 + 0.5 * (corner & 1),
    0.25 + 0.5 * ((corner >> 1) & 1),
    height + 0.5 * (corner >> 2),
  ]);

class Arrays {
  bytes = Buffer.alloc(0);
  add(type, values) {
    const reference = {type, at: this.bytes.length, count: values.length};
    const size = type === "u16" ? 2 : 4,
      part = Buffer.alloc(Math.ceil((size * values.length) / 4) * 4);
    values.forEach((value, i) =>
      type === "f32" ? part.writeFloatLE(value, 4 * i) : part.writeUIntLE(value, size * i, size),
    );
    this.bytes = Buffer.concat([this.bytes, part]);
    return reference;
  }
}

function sceneHeader(arrays) {
  const nodes = kTentHeights
    .flatMap((height) => [...kSquare, ...cell(height)])
    .flat()
    .map((value) => value / kScale);
  return {
    id: "seeded",
    frames: 3,
    time_step: 0.5,
    base: 0,
    placements: [{origin: kOrigin, scale: kScale}],
    shapes: [
      {vertices: 4, nodes: 4, triangles: arrays.add("u16", [0, 1, 2, 0, 2, 3])},
      {
        vertices: 4,
        nodes: 8,
        triangles: arrays.add("u32", kTent.triangles.flat()),
        lattice: {
          cell_nodes: arrays.add("u16", [0, 1, 2, 3, 4, 5, 6, 7]),
          home: arrays.add("u16", [0, 0, 0, 0]),
          local: arrays.add("f32", kTent.local.flat()),
          boxes: arrays.add("f32", [0, 0, 0, 1, 1, 1]),
          spheres: {radius1: 0.5, centers2: arrays.add("u16", [0, 7]), radii2: [0.3, 0.4]},
        },
      },
    ],
    bodies: [
      {name: "square", shape: 0},
      {name: "tent", shape: 1},
    ],
    nodes: arrays.add("f32", nodes),
    truth: [{frame: 1, count: 2, pairs: [0, 0, 1, 0, 0, 0, 1, 1]}],
    detectors: [
      {detector: "all-right", level: "triangle", frames: []},
      {
        detector: "half-blind",
        level: "triangle",
        frames: [
          {frame: 1, missed: {count: 1, pairs: kMissed.pair}, spurious: {count: 0, pairs: []}},
          {frame: 2, missed: {count: 0, pairs: []}, spurious: {count: 1, pairs: [0, 1, 1, 1]}},
        ],
      },
    ],
  };
}

// The same once more as a family of hard cases: frames are cases.
const kFamily = {
  parameter: "height of the tent, m",
  values: ["one", "a quarter below", "a half"],
  origin: "by hand",
  stresses: "views",
  true_pairs: [0, 2, 0],
};
const kFamilyRun = {
  scene: "cases",
  detector: "half-blind",
  status: "ok",
  message: "",
  frames: 3,
  contact_frames: 1,
  semantics: {},
  options: {},
  per_frame: {level: "triangle", truth: [0, 2, 0], missed: [0, 1, 0], spurious: [0, 0, 1]},
  levels: {
    triangle: {
      truth: 2,
      reported: 2,
      hit: 1,
      missed: 1,
      spurious: 1,
      recall: 0.5,
      spurious_rate: 0.5,
    },
  },
  geometry: {},
  stages: [],
  time_ms: {prepare: 1},
  memory_bytes: 0,
  contact_hash: "0x0",
};

function container() {
  const arrays = new Arrays(),
    seeded = sceneHeader(arrays);
  const header = {
    schema: "contactcheck-view/1",
    left_out: [{scene: "lost", why: '"recordings/lost.ccr" cannot be read.'}],
    scenes: [seeded, {...seeded, id: "cases"}],
  };
  let text = JSON.stringify(header);
  text = text.padEnd(Math.ceil(text.length / 4) * 4);
  const size = Buffer.alloc(4);
  size.writeUInt32LE(text.length);
  return Buffer.concat([Buffer.from("CCVIEW1\n"), size, Buffer.from(text), arrays.bytes]);
}

const packed = (bytes) => deflateSync(bytes).toString("base64");

const kNoTable = {title: "", text: "", columns: [], rows: []};

/** @param template the bundler's page.html */
export function reportOf(template) {
  const results = {
    schema: "contactcheck-results/1",
    version: "0",
    command: "by hand",
    machine: {},
    libraries: {},
    scenes: [
      {
        id: "seeded",
        title: "A tent comes down through a square",
        frames: 3,
        contact_frames: 1,
        bodies: [],
      },
      {
        id: "cases",
        title: "A tent at three heights",
        frames: 3,
        contact_frames: 1,
        truth: {},
        bodies: [],
        family: kFamily,
      },
    ],
    runs: [kFamilyRun],
    disagreements: [],
    report: {
      title: "By hand",
      findings: [],
      fastest: [],
      summary: kNoTable,
      claims: [],
      goals: kNoTable,
      pairs: [],
      levels: ["triangle"],
      sums: {finest: [null], triangle: [null]},
      speed_error: {detectors: ["half-blind"], scenes: [], first: 0, charts: []},
    },
  };
  return template
    .replace("@results@", packed(Buffer.from(JSON.stringify(results))))
    .replace("@view@", packed(container()))
    .replace("@reproduction@", "");
}
