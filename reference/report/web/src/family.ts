// A detector's answers to one family of hard cases.
import {finestLevel, isOk, type Report} from "./report";
import type {Run, Scene} from "./results";

export type Kind = "truth" | "missed" | "spurious";

export class FamilyResult {
  constructor(
    readonly scene: Scene,
    readonly run: Run,
  ) {}

  get cases(): number {
    return this.scene.family!.values.length;
  }
  get judged(): boolean {
    return isOk(this.run) && finestLevel(this.run) !== "";
  }
  get failed(): boolean {
    return this.run.status === "error";
  }
  value(frame: number): string {
    return this.scene.family!.values[frame] ?? "-";
  }
  at(kind: Kind, frame: number): number {
    return this.run.per_frame[kind][frame] ?? 0;
  }
  wrongAt(frame: number): boolean {
    return this.at("missed", frame) + this.at("spurious", frame) > 0;
  }
  /** Over all cases; 0 where nothing was judged. */
  sum(kind: Kind): number {
    return this.judged ? this.frames().reduce((sum, frame) => sum + this.at(kind, frame), 0) : 0;
  }
  get wrong(): number {
    return this.judged ? this.frames().filter((frame) => this.wrongAt(frame)).length : 0;
  }
  /** Wrong somewhere, or without an answer because of an error. */
  get goesWrong(): boolean {
    return this.failed || this.wrong > 0;
  }
  /** Milliseconds of a case, cold; null where none was timed. */
  get milliseconds(): number | null {
    return this.judged ? (this.run.time_ms.cold?.frame ?? null) : null;
  }
  frames(): number[] {
    return [...this.scene.family!.values.keys()];
  }
}

export const familyResults = (report: Report, scene: Scene): FamilyResult[] =>
  report.runsOf(scene.id).map((run) => new FamilyResult(scene, run));
