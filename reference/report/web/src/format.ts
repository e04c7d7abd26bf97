// Numbers and lists as the other reports write them (reference/report/format.cpp): a rate is cut, so
// that 1 is said of a perfect score alone, and an error rate is raised.
import type {Ratio} from "./results";

type Maybe = number | null | undefined;

const kRateSteps = 1e5;
// A product that falls a rounding step beside a whole number is forgiven.
const kSlack = 2 ** -50;

const missing = (value: Maybe): value is null | undefined => value === null || value === undefined;

function exponent(value: number): string {
  return value.toExponential(2).replace(/e([+-])(\d)$/, "e$10$2");
}

// Halves go to the even digit, as printf has them; toFixed rounds them up.
function fixed(value: number, digits: number): string {
  const rounded = value.toFixed(digits),
    rest = value.toFixed(digits + 40).slice(value.toFixed(digits + 1).length - 1);
  if (!/^50*$/.test(rest)) return rounded;
  return ((2 * Math.round((value * 10 ** digits) / 2)) / 10 ** digits).toFixed(digits);
}

function significant(value: number): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return exponent(value);
  return fixed(value, Math.max(0, 2 - Math.floor(Math.log10(size))));
}

/** Three significant digits. */
export const number = (value: Maybe): string =>
  missing(value) || Number.isNaN(value) ? "-" : significant(value);

export const count = (value: Maybe): string => (missing(value) ? "-" : String(value));

// Made once: toLocaleString makes one per number.
const kGrouped = new Intl.NumberFormat("en-US");

/** 12,345,678 */
export const grouped = (value: number): string => kGrouped.format(value);

const kCompact = new Intl.NumberFormat("en-US", {notation: "compact"});

/** 10K, 12M: for axes where there is little room. */
export const compact = (value: number): string => kCompact.format(value);

export const millimetres = (value: Maybe): string => number(missing(value) ? null : 1e3 * value);

export function rate(value: Maybe): string {
  if (missing(value)) return "-";
  if (value === 1 || value === 0) return String(value);
  const cut = Math.min(Math.floor(value * kRateSteps * (1 + kSlack)), kRateSteps - 1);
  return (cut / kRateSteps).toFixed(5);
}

export function errorRate(value: Maybe): string {
  if (missing(value)) return "-";
  if (value === 1 || value === 0) return String(value);
  const raised = Math.max(Math.ceil(value * kRateSteps * (1 - kSlack)), 1);
  return (raised / kRateSteps).toFixed(5);
}

/** A share of errors in percent: never "0 %" for more than none, nor "100 %" for less than all. */
export function percent(share: Maybe): string {
  if (missing(share)) return "-";
  if (share === 0 || share === 1) return `${100 * share} %`;
  if (share < 1e-4) return "< 0.01 %";
  if (share > 0.999) return "> 99.9 %";
  return `${(100 * share).toFixed(share < 0.01 ? 2 : 1)} %`;
}

/** "12.3x", with the 95 % interval "12.3x [11.8, 12.9]" */
export function ratio(value: Ratio | null | undefined, interval = true): string {
  if (!value) return "-";
  const text = `${significant(value.ratio)}x`;
  return interval ? `${text} [${significant(value.low)}, ${significant(value.high)}]` : text;
}

export const share = (part: number, whole: number): number | null =>
  whole > 0 ? part / whole : null;

export const optionsText = (options: Record<string, string> | undefined): string =>
  Object.entries(options ?? {})
    .map(([name, value]) => `${name}=${value}`)
    .join(", ") || "-";

export const plural = (n: number, one: string, many = `${one}s`): string =>
  `${grouped(n)} ${n === 1 ? one : many}`;

/** "a, b and c" */
export function listed(names: string[]): string {
  if (names.length < 2) return names.join("");
  return `${names.slice(0, -1).join(", ")} and ${names[names.length - 1]}`;
}

/** The first few, and how many there are besides. */
export function shortList(names: string[], most: number): string {
  if (names.length <= most + 1) return listed(names);
  return `${names.slice(0, most).join(", ")} and ${names.length - most} more`;
}
