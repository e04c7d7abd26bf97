// What the program gives the page (reference/report/formats/page_data.h): it is all computed, in words where
// there are words, and drawn here. Code in texts stands in backticks. Units: milliseconds,
// millimetres, degrees.

/** What the page shows: sums, sentences and points for every choice that it offers. */
export interface Page {
  version: string;
  title: string;
  findings: {topic: string; sentence: string}[];
  /** The command, and where it ran. */
  run: string;
  /** Of what whole this is a part. */
  parts: string[];
  /** The folder of the run, as a word of a shell. */
  out: string;
  /**
   * In the order of their first runs; of each its options in words, the words that name it to
   * `reduce`, and its place in `group_names`.
   */
  detectors: string[];
  options: string[];
  reduce: string[];
  groups: number[];
  group_names: string[];
  /** Of the results; `scenes` has no drawn ones where there are many. */
  scene_count: number;
  /** Whether any run was timed. */
  timed: boolean;
  /** Right and fastest in some scene, most scenes first. */
  fastest: string[];
  references: string[];
  /** Of texts and tables alone, in the order of the other reports; those that have something to say. */
  sections: TextSection[];
  hard?: Hard;
  /** Where reproduction.json is of the same run. */
  paper?: PaperPart;
  /** The first is "finest": each detector at its own. */
  levels: {level: string; recall: HeatTable; spurious: HeatTable}[];
  result_columns: TextColumn[];
  /** Of scenes, in words; each of the next has an entry per choice. */
  choices: string[];
  stages: StageLosses[];
  times: Record<Regime, PhaseTimes>[];
  graded: ErrorChart[][];
  speed_error: SpeedError;
  /** Motions (and random pairs). */
  scenes: Scene[];
  /** Whose frames are hard cases, each a value of a parameter. */
  families: {id: string; title: string; values: string[]}[];
}

/** One of the report's. */
export interface TextSection {
  id: string;
  title: string;
  /** In the list of contents. */
  short: string;
  blocks: Block[];
}

export type Block =
  | {text: string}
  | {heading: string}
  | {items: string[]}
  | {table: TextTable}
  | {picture: string; what: string};

export interface TextColumn {
  title: string;
  left: boolean;
  meaning?: string;
  /** Of columns that some part of the page looks for. */
  id?: string;
  /** Its cells are "yes", "no", or say why neither. */
  verdict?: true;
}

/** `share`: of errors, the colour. */
export interface HeatCell {
  text: string;
  share?: number;
  label?: string;
  kind?: "error" | "aside";
}

/** The first column names the row. */
export interface HeatTable {
  columns: string[];
  rows: HeatCell[][];
}

/** Units: milliseconds, millimetres. */
export interface Scene {
  id: string;
  title: string;
  frames: number;
  sentence: string;
  tables: TextTable[];
  notes: string[];
  /** With the truth, the first of each kind. */
  disagreements: Disagreement[];
  cost: {
    /** The same for scenes that are one at several sizes. */
    series: string;
    triangles: number;
    /** By frame. */
    truth: number[];
    /** By frame; empty where the results hold none. */
    distance: number[];
    /** In the order of `detectors`; null where a detector has no row, or one that is not ok. */
    detectors: (FrameCosts | null)[];
  };
}

export interface FrameCosts {
  /** [frame, how many] */
  missed: [number, number][];
  spurious: [number, number][];
  /** Milliseconds per frame; this and what follows where it was timed. */
  playback?: number;
  cold?: number;
  /** By frame, playback; null where it was not timed. */
  frame_ms?: (number | null)[];
  /** [distance, milliseconds]: medians of frames about equally far. */
  by_distance?: [number, number][];
  /** Of frames that touch: lowest, median, highest, and how many there are. */
  touching?: [number, number, number, number];
}

export interface Disagreement {
  frame: number;
  detector: string;
  level: string;
  kind: "missed" | "spurious";
  case: string;
}

/** The families of hard cases. */
export interface Hard {
  sums: TextTable;
  /** In which sizes and distances each is right; empty without families of such a range. */
  ranges: TextTable[];
  matrix: HeatTable;
  families: WrongFamily[];
}

/** One that some detector goes wrong in. */
export interface WrongFamily {
  id: string;
  title: string;
  aside: string;
  sentence: string;
  table: TextTable;
  /** Per row of the table; null where the case is not known. */
  shown: ({detector: string; frame: number; kind?: "missed" | "spurious"} | null)[];
  /** An SVG document; its squares have data-detector and data-frame. */
  picture: string;
}

/** The paper's tables beside ours. */
export interface PaperPart {
  /** Two levels of spheres over one. */
  overview: TextTable;
  /** Ways to read the paper's method. */
  readings: string[];
  means_title: string;
  means: string[];
  scenes: PaperScene[];
  own_numbers: string;
  /** Of the paper's own numbers. */
  checks: TextTable;
}

export interface PaperScene {
  title: string;
  aside: string;
  sentences: string[];
  tables: TextTable[];
}

/** Where true pairs of triangles are lost. */
export interface StageLosses {
  /** Detector, stage, how many, share of the true ones, the same in percent. */
  bars: [string, string, number, number, string][];
  /** That lost some. */
  stages: string[];
  sentences: string[];
  /** A sentence: who lost nothing, or why there is no bar. */
  without_loss: string;
  table: TextTable;
}

/** Milliseconds per frame. */
export interface PhaseTimes {
  /** Detector, map (null: none), update, query, their sum, their sum without map; least sum first. */
  bars: [string, number | null, number, number, number, number][];
  table: TextTable;
}

/** Errors of one quantity, in its unit. */
export interface ErrorChart {
  title: string;
  axis: string;
  unit: string;
  /** What was judged. */
  what: string;
  /** A sentence: what errors are measured against; may be empty. */
  truth: string;
  rows: ErrorRow[];
  always_zero: string;
}

export type ErrorRow = [
  detector: string,
  kind: string,
  judged: number,
  mean: number | null,
  p95: number | null,
  max: number,
  bins: [from: number, below: number, count: number, share: number, percent: string][],
  points: number[],
];

export interface TextTable {
  id?: string;
  title: string;
  text: string;
  columns: TextColumn[];
  rows: string[][];
}

/** The points of the chart of speed against error. */
export interface SpeedError {
  /** By question: an SVG path about (0, 0), and what the legend says. */
  shapes: {question: string; outline: string; means: string}[];
  /** Of the choices of scenes. */
  first: number;
  columns: TextColumn[];
  /** By choice of scenes, then by level. */
  charts: Record<string, LevelCharts>[];
}

/** Playback: all frames in order. Cold: some frames, each after a sweep through the caches. */
export type Regime = "playback" | "cold";
export type Measure = "worse" | "missed" | "spurious";

export type LevelCharts = {
  /** Per detector its line of the table; the cells of time, error and front are each chart's own. */
  cells: (string[] | null)[];
} & Record<`${Measure} ${Regime}`, PointsChart>;

export interface PointsChart {
  /** Place in `detectors`, milliseconds, error, is on the front; the first two numbers in words. */
  points: [number, number, number, boolean, string, string][];
  left_out: string;
}
