import {readResults} from "./data";

async function main(): Promise<void> {
  const results = await readResults();
  const report = document.getElementById("report")!;
  const heading = document.createElement("h1");
  heading.textContent = `contactcheck: ${results.scenes.length} scenes, ${results.runs.length} runs`;
  report.append(heading);
}

main().catch((error: unknown) => {
  document.getElementById("report")!.textContent = `This report cannot be shown: ${String(error)}`;
});
