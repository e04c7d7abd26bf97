import {readResults, readView} from "./data";
import {h} from "./dom";
import {mountView} from "./view/view";

async function main(): Promise<void> {
  const results = await readResults();
  const report = document.getElementById("report")!;
  const heading = document.createElement("h1");
  heading.textContent = `contactcheck: ${results.scenes.length} scenes, ${results.runs.length} runs`;
  report.append(heading);
  const bytes = await readView();
  if (!bytes) return;
  const place = h("div");
  report.append(h("section", {id: "view"}, h("h2", {}, "Scenes in 3D"), place));
  mountView(place, results, bytes);
}

main().catch((error: unknown) => {
  document.getElementById("report")!.textContent = `This report cannot be shown: ${String(error)}`;
});
