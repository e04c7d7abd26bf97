// How large the errors of detectors are, over some scenes: mean, 95 %, largest, and how many are of
// which size.
import type {Report} from "./report";
import type {Bin, Geometry, Run, Scene} from "./results";

export interface Spread {
  detector: string;
  kind: string;
  judged: number;
  mean: number | null;
  p95: number | null;
  max: number;
  /** In the unit of the chart, as are the others; empty where the results hold no histograms. */
  bins: Bin[];
  /** Where few are known one by one. */
  points: number[];
}

/** What a run says of one quantity; null where nothing was judged. */
export interface Errors {
  judged: number;
  mean?: number | null;
  p95?: number | null;
  max: number;
  bins?: Bin[];
  points?: number[];
}

export interface Quantity {
  title: string;
  axis: string;
  unit: string;
  /** From the unit of results.json. */
  factor: number;
  /** What was judged. */
  what: string;
  /** Kinds that do not compare have charts of their own. */
  byKind: boolean;
  of(run: Run): Errors | null;
}

function errors(
  judged: number | undefined,
  max: number | null,
  rest: Partial<Errors>,
): Errors | null {
  return judged && max !== null ? {judged, max, ...rest} : null;
}

const total = (bins: Bin[] | undefined): number =>
  (bins ?? []).reduce((sum, bin) => sum + bin.count, 0);

// Of each episode; a mean or a 95 % of a handful would say little.
function hoverErrors({episodes}: Geometry): Errors | null {
  const points = (episodes ?? []).flatMap(({hover_gap}) => (hover_gap !== null ? [hover_gap] : []));
  return points.length > 0 ? {judged: points.length, max: Math.max(...points), points} : null;
}

export const kQuantities: Quantity[] = [
  {
    title: "Depth",
    axis: "error of the depth, mm →",
    unit: "mm",
    factor: 1e3,
    what: "contacts judged",
    byKind: true,
    of: ({geometry: g}) =>
      errors(g.depth_judged, g.depth_error_max, {
        mean: g.depth_error_mean,
        p95: g.depth_error_p95,
        bins: g.depth_error_histogram,
      }),
  },
  {
    title: "Normal",
    axis: "error of the normal, degrees →",
    unit: "°",
    factor: 1,
    what: "contacts judged",
    byKind: false,
    of: ({geometry: g}) =>
      errors(g.normal_judged, g.normal_error_deg_max, {
        mean: g.normal_error_deg_mean,
        p95: g.normal_error_deg_p95,
        bins: g.normal_error_deg_histogram,
      }),
  },
  {
    title: "Distance of spurious pairs of triangles",
    axis: "true distance of pairs reported as touching, mm →",
    unit: "mm",
    factor: 1e3,
    what: "spurious pairs",
    byKind: false,
    of: ({geometry: g}) =>
      errors(total(g.spurious_distance_histogram), g.spurious_distance_max, {
        bins: g.spurious_distance_histogram,
      }),
  },
  {
    title: "Hover",
    axis: "true distance at the first report of contact, mm →",
    unit: "mm",
    factor: 1e3,
    what: "episodes of contact",
    byKind: false,
    of: ({geometry}) => hoverErrors(geometry),
  },
];

function addBins(sum: Bin[], bins: Bin[], factor: number): void {
  for (const {from, below, count} of bins) {
    const same = sum.find((bin) => bin.from === factor * from);
    if (same) same.count += count;
    else sum.push({from: factor * from, below: factor * below, count});
  }
}

const larger = (a: number | null, b: number | null | undefined): number | null =>
  b === null || b === undefined ? a : Math.max(a ?? 0, b);

/** Over several scenes: the mean of all that was judged, the worst p95 and the worst maximum. */
export function spreadOf(
  report: Report,
  detector: string,
  scenes: Scene[],
  quantity: Quantity,
): Spread | null {
  const {factor} = quantity;
  const out: Spread = {
    detector,
    kind: "",
    judged: 0,
    mean: null,
    p95: null,
    max: 0,
    bins: [],
    points: [],
  };
  for (const scene of scenes) {
    const run = report.okRun(scene.id, detector),
      found = run && quantity.of(run);
    if (!run || !found) continue;
    out.kind = run.geometry.depth_kind ?? "";
    const mean = found.mean === null || found.mean === undefined ? null : factor * found.mean;
    if (mean !== null)
      out.mean = ((out.mean ?? 0) * out.judged + mean * found.judged) / (out.judged + found.judged);
    out.judged += found.judged;
    out.p95 = larger(
      out.p95,
      found.p95 === null || found.p95 === undefined ? null : factor * found.p95,
    );
    out.max = Math.max(out.max, factor * found.max);
    addBins(out.bins, found.bins ?? [], factor);
    out.points.push(...(found.points ?? []).map((point) => factor * point));
  }
  return out.judged > 0 ? out : null;
}
