// Results with what every section asks of them: who ran where.
import type {Level, Results, Run, Scene} from "./results";

export class Report {
  /** Scenes that are motions (or random pairs), and families, whose frames are hard cases. */
  readonly scenes: Scene[];
  readonly families: Scene[];
  /** In the order of their first runs. */
  readonly detectors: string[];
  private readonly runsByScene = new Map<string, Run[]>();
  private readonly runsByName = new Map<string, Run>();

  constructor(
    readonly results: Results,
    readonly viewBytes: ArrayBuffer | null,
  ) {
    const scenes = results.scenes ?? [];
    this.scenes = scenes.filter((scene) => !scene.family);
    this.families = scenes.filter((scene) => scene.family);
    this.detectors = [...new Set(results.runs.map((run) => run.detector))];
    for (const scene of scenes) this.runsByScene.set(scene.id, []);
    for (const run of results.runs) {
      this.runsByScene.get(run.scene)?.push(run);
      this.runsByName.set(key(run.scene, run.detector), run);
    }
  }

  /** All runs of a scene, in file order. */
  runsOf(scene: string): Run[] {
    return this.runsByScene.get(scene) ?? [];
  }

  /** Those that ended well. */
  okRunsOf(scene: string): Run[] {
    return this.runsOf(scene).filter(isOk);
  }

  /** The run of a detector in a scene, when it ended well. */
  okRun(scene: string, detector: string): Run | null {
    const run = this.runsByName.get(key(scene, detector));
    return run && isOk(run) ? run : null;
  }

  run(scene: string, detector: string): Run | null {
    return this.runsByName.get(key(scene, detector)) ?? null;
  }

  /** Whether any run was timed. */
  get timed(): boolean {
    return this.results.runs.some((run) => isOk(run) && run.time_ms.cold);
  }
}

const key = (scene: string, detector: string): string => JSON.stringify([scene, detector]);

export const isOk = (run: Run): boolean => run.status === "ok";

/** The finest level that a detector claims and that was judged, or "". */
export const finestLevel = (run: Run): string => run.per_frame.level ?? "";

/** The question a run is compared in: triangles where it answers them, else body. */
export function comparedQuestion(run: Run): string {
  return (run.semantics.questions ?? []).includes("triangles") ? "triangles" : "body";
}

export const trianglesOf = (scene: Scene): number =>
  scene.bodies.reduce((sum, body) => sum + body.triangles, 0);

/** "all levels" of this page: each detector at the finest level that it claims. */
export const kFinest = "finest";

/** At a level, or at the finest; null where that was not judged, or is no claim of the detector. */
export function levelOf(run: Run, level: string): Level | null {
  const found = run.levels[level === kFinest ? finestLevel(run) : level];
  return found && !found.informative ? found : null;
}
