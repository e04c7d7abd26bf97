// Numbers in tips and on axes of charts. Tables and sentences come in words from the program.

/** Three significant digits. */
export function number(value: number): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(2);
  return value.toFixed(Math.max(0, 2 - Math.floor(Math.log10(size))));
}

// Made once: toLocaleString makes one per number.
const kGrouped = new Intl.NumberFormat("en-US");

/** 12,345,678 */
export const grouped = (value: number): string => kGrouped.format(value);

const kCompact = new Intl.NumberFormat("en-US", {notation: "compact"});

/** 10K, 12M: for axes where there is little room. */
export const compact = (value: number): string => kCompact.format(value);
