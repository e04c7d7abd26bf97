// results.json, as far as the page reads it; fixtures/results.schema.json has all of it. Units:
// metres, milliseconds, degrees, bytes. Fields that older versions did not write are optional.

import type {Reproduction} from "./reproduction";

export interface Results {
  schema: string;
  version: string;
  command: string;
  machine: Machine;
  libraries: Record<string, string>;
  scenes: Scene[];
  runs: Run[];
  disagreements: Disagreement[];
  resumed?: string[];
  /** A part of a run: these scenes are only some of `shard.scenes`. */
  shard?: {index: number; of: number; scenes: string[]; command: string};
  /** One entry per shard that these results were put together from. */
  merged?: unknown[];
  /** Not in results.json: the program adds reproduction.json of the same run. */
  reproduction?: Reproduction;
  /** Nor this: what it computes of them (reference/report/page_data.h). */
  report: Computed;
}

/** Sums, sentences and points for every choice that the page offers. */
export interface Computed {
  title: string;
  findings: {topic: string; sentence: string}[];
  /** Without error and fastest in some scene, most scenes first. */
  fastest: string[];
  summary: TextTable;
  /** Of the paper and of the libraries. */
  claims: TextTable[];
  goals: TextTable;
  known_defects?: {sentence: string; tables: TextTable[]};
  pairs: {scene: string; sentence: string; table: TextTable}[];
  /** That some detector claims and was judged at, coarse before fine. */
  levels: string[];
  /** By level ("finest": each at its own), per detector: a sum over all scenes, or why there is none. */
  sums: Record<string, (Counts | string | null)[]>;
  speed_error: SpeedError;
}

/** Code stands in backticks. */
export interface TextTable {
  id?: string;
  title: string;
  text: string;
  columns: {title: string; left: boolean}[];
  rows: string[][];
}

export interface Counts {
  truth: number;
  reported: number;
  hit: number;
  missed: number;
  spurious: number;
}

/** The points of the chart of speed against error. */
export interface SpeedError {
  detectors: string[];
  /** Choices of scenes, in words; `first` is shown first. */
  scenes: string[];
  first: number;
  /** By choice of scenes, then by level. */
  charts: Record<string, LevelCharts>[];
}

export type Caches = "cold" | "hot";
export type Measure = "worse" | "missed" | "spurious";

export type LevelCharts = {
  /** Per detector; null where it has no point. */
  counts: (PointCounts | null)[];
} & Record<`${Measure} ${Caches}`, {points: [number, number, number, boolean][]; left_out: string}>;

export interface PointCounts {
  question: string;
  level: string;
  truth: number;
  reported: number;
  missed: number;
  spurious: number;
}

export interface Machine {
  cpu: string;
  cores: number;
  isa: string;
  os: string;
  compiler: string;
  build: string;
}

export interface Scene {
  id: string;
  title: string;
  frames: number;
  size: number;
  contact_frames: number;
  truth: Record<string, number | string>;
  bodies: Body[];
  /** Why the oracle did not get through it; then no detector was asked. */
  unjudged?: string;
  /** Per frame, metres; 0 where surfaces touch. */
  separation?: number[];
  family?: Family;
  pairs?: unknown;
  simulation?: {driver: string; step: number; every: number};
}

export interface Body {
  name: string;
  source: string;
  notes: string;
  vertices: number;
  triangles: number;
  cells: number;
  solid: boolean;
}

export interface Family {
  parameter: string;
  values: string[];
  origin: string;
  stresses: string;
}

/** One detector in one scene. Everything below `message` is there when `status` is "ok". */
export interface Run {
  scene: string;
  detector: string;
  status: "ok" | "error" | "absent" | "refused";
  message: string;
  failed_frame?: number;
  frames: number;
  contact_frames: number;
  semantics: Semantics;
  options: Record<string, string>;
  per_frame: PerFrame;
  levels: Record<string, Level>;
  levels_rounded?: Record<string, Level>;
  geometry: Geometry;
  stages: Stage[];
  counters?: Record<string, number>;
  time_ms: Times;
  speedup?: Record<string, Record<string, Speedup>>;
  memory_bytes: number;
  contact_hash: string;
  not_judged?: Record<string, string>;
  notes?: string[];
  float_environment?: string[];
}

export interface Semantics {
  levels?: string[];
  informative?: string[];
  questions?: string[];
  body?: string;
  touching?: string;
  exact?: boolean;
  margin?: number;
  precision?: string;
  scale?: number;
  local_origin?: boolean;
  means?: string;
  depth_kind?: string;
}

export interface PerFrame {
  level?: string;
  truth: number[];
  missed: number[];
  spurious: number[];
  frame_ms?: (number | null)[];
}

export interface Level {
  truth: number;
  reported: number;
  hit: number;
  missed: number;
  spurious: number;
  recall: number | null;
  spurious_rate: number | null;
  margin?: number;
  informative?: boolean;
}

export interface Geometry {
  missed_length: number | null;
  covered_length_fraction: number | null;
  spurious_distance_max: number | null;
  spurious_distance_histogram?: Bin[];
  depth_kind?: string;
  depth_judged?: number;
  depth_error_mean?: number | null;
  depth_error_p95?: number | null;
  depth_error_max: number | null;
  depth_error_histogram?: Bin[];
  normal_judged?: number;
  normal_error_deg_mean?: number | null;
  normal_error_deg_p95?: number | null;
  normal_error_deg_max: number | null;
  normal_error_deg_histogram?: Bin[];
  hover_gap_max: number | null;
  late_frames: number | null;
  episodes?: {hover_gap: number | null}[];
}

/** Errors from `from` on and below `below`. */
export interface Bin {
  from: number;
  below: number;
  count: number;
}

export interface Stage {
  name: string;
  unit: string;
  in: number;
  out: number;
  missed: number;
  visited?: number;
  visited_unit?: string;
}

/** Milliseconds per frame. `map` is null where the detector maps what it needs itself. */
export interface Phases {
  map: number | null;
  update: number;
  query: number;
  frame: number;
  contact_frame: number | null;
  /** update and query, by the detector's own clock; absent: it has none */
  self_reported?: number;
}

/** A run without timing has `prepare` alone. */
export interface Times {
  prepare: number;
  question?: string;
  timed_frames?: number;
  repeats?: number;
  cold?: Phases;
  hot?: Phases;
}

export interface Ratio {
  ratio: number;
  low: number;
  high: number;
}

export interface Speedup {
  cold: Ratio;
  hot: Ratio | null;
  contact_frames: Ratio | null;
  without_map: Ratio | null;
  reference_options?: Record<string, string>;
}

export interface Disagreement {
  scene: string;
  frame: number;
  detector: string;
  level: string;
  kind: "missed" | "spurious";
  case: string;
}

/** The libraries that everything is measured against, as reference/results/references.h has them. */
export const kReferences = ["fcl-aabb", "fcl-obbrss", "embree"];
