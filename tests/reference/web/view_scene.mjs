// A scene by hand for the 3D view, in the container of reference/report/formats/view_bytes.h, written here by
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

const kTriangles = {missed: ["triangle", "triangle"], spurious: ["triangle", "triangle"]};

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
      {detector: "all-right", level: "triangle", elements: kTriangles, frames: []},
      {
        detector: "half-blind",
        level: "triangle",
        elements: kTriangles,
        frames: [
          {frame: 1, missed: {count: 1, pairs: kMissed.pair}, spurious: {count: 0, pairs: []}},
          {frame: 2, missed: {count: 0, pairs: []}, spurious: {count: 1, pairs: [0, 1, 1, 1]}},
        ],
      },
    ],
  };
}

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

// What the program computes of it, as far as tests look at it.
const kHard = {
  sums: {title: "", text: "", columns: [], rows: []},
  ranges: [
    {
      title: "In which range of sizes each is right",
      text: "By the edge of a triangle.",
      columns: [
        {title: "detector", left: true},
        {title: "right from", left: false},
      ],
      rows: [["half-blind", "1e-3"]],
    },
  ],
  matrix: {columns: ["family"], rows: []},
  families: [
    {
      id: "cases",
      title: "A tent at three heights",
      aside: "1 detector goes wrong",
      sentence: "By hand.",
      table: {
        title: "",
        text: "",
        columns: [
          {title: "detector", left: true},
          {title: "first wrong at", left: true},
        ],
        rows: [["half-blind", "a quarter below"]],
      },
      shown: [{detector: "half-blind", frame: 1, kind: "missed"}],
      picture:
        '<svg xmlns="http://www.w3.org/2000/svg" width="50" height="25">' +
        '<g data-detector="half-blind" data-frame="2"><title>half-blind at a half</title>' +
        '<rect width="22" height="22"/></g></svg>',
    },
  ],
};

/** @param template the bundler's page.html */
export function reportOf(template) {
  const page = {
    version: "0",
    title: "By hand",
    findings: [],
    run: "`by hand`",
    parts: [],
    detectors: ["half-blind"],
    options: ["-"],
    out: "out",
    reduce: ["--detector half-blind"],
    groups: [8],
    group_names: [],
    timed: false,
    fastest: [],
    references: [],
    sections: [],
    hard: kHard,
    levels: [{level: "finest", recall: {columns: ["detector"], rows: []}}],
    result_columns: [],
    choices: [],
    stages: [],
    times: [],
    graded: [],
    speed_error: {columns: [], shapes: [], first: 0, charts: []},
    scenes: [
      {
        id: "seeded",
        title: "A tent comes down through a square",
        frames: 3,
        sentence: "",
        tables: [],
        notes: [],
        disagreements: [],
        cost: {series: "seeded", triangles: 4, truth: [], distance: [], detectors: [null]},
      },
    ],
    // The same once more as a family of hard cases: frames are cases.
    families: [
      {
        id: "cases",
        title: "A tent at three heights",
        values: ["one", "a quarter below", "a half"],
      },
    ],
  };
  return template
    .replace("@page@", packed(Buffer.from(JSON.stringify(page))))
    .replace("@view@", packed(container()));
}
