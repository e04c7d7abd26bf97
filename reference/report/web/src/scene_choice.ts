// "All scenes", each scene, and all hard cases: what a chart can be drawn for.
import type {Option} from "./controls";
import type {Report} from "./report";
import type {Scene} from "./results";

const kAll = "all",
  kHard = "hard";

export function sceneOptions(report: Report): Option[] {
  const options: Option[] = report.scenes.map((scene, i) => [String(i), scene.id]);
  if (report.families.length > 0) options.unshift([kHard, "all hard cases"]);
  if (report.scenes.length > 1) options.unshift([kAll, "all scenes"]);
  return options;
}

/** @pre `value` is one of sceneOptions */
export function chosenScenes(report: Report, value: string): Scene[] {
  if (value === kAll) return report.scenes;
  return value === kHard ? report.families : [report.scenes[Number(value)]];
}
