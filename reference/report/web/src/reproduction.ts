// reproduction.json of `contactcheck reproduce` (fixtures/README.md, "The paper"), as far as the page
// reads it.
import type {Level} from "./results";

export interface Reproduction {
  command: string;
  scenes: PaperScene[];
  means: PaperMeans | null;
  paper: {source: PaperSource; findings: PaperFinding[]};
}

export interface PaperSource {
  authors: string[];
  title: string;
  journal: string;
  year: number;
  doi: string;
}

export interface PaperFinding {
  topic: string;
  table: string | null;
  scene: string | null;
  method: string | null;
  sentence: string;
  claimed: number | null;
  computed: number;
  unit: string;
  agrees: boolean | null;
}

export interface StepTimes {
  mss: number;
  cell: number;
  test: number;
  response: number;
  total: number;
  level?: string;
  truth?: number;
  missed?: number;
  spurious?: number;
}

export interface RangedRatio {
  ratio: number;
  low: number;
  high: number;
}

export interface ReadingRatio {
  test: RangedRatio;
  total: RangedRatio;
  same_contacts: boolean;
  missed_before: number;
  missed_after: number;
}

export type ReadingName = "safe" | "paper" | "exact";

export interface PaperScene {
  scene: string;
  ours: string;
  frames: number;
  contact_frames: number;
  counts: Record<string, {paper: number; ours: number; difference_percent: number}>;
  steps: ({
    method: string;
    paper_reports: (StepTimes & {table: string; device: string}) | null;
  } & Record<ReadingName, StepTimes | null>)[];
  ratios: ({
    before: string;
    after: string;
    paper_reports: {table: string; test: number; total: number} | null;
  } & Record<ReadingName, ReadingRatio | null>)[];
  frame_rate: {detector: string; steps_per_second: number; simulated_over_real_time: number} | null;
  hover_at_rest: Record<string, number | null> | null;
  closed_loop: ClosedLoop[];
  sentences: string[];
}

export interface ClosedLoop {
  detector: string;
  error: string;
  levels: Record<string, Level>;
  hover_at_rest_max: number | null;
  hover_at_rest_mean: number | null;
  deepest_penetration: number | null;
  energy_gain: number | null;
  last_speed: number;
  tunnelling_events: number;
}

export interface PaperMeans {
  scenes: number;
  test_ratio: {ours: number; paper: number};
  frame_rate_ratio: {ours: number; paper: number; paper_claims: number | null};
}
