// What the program gives the page of `contactcheck check` (reference/check/check_page.cpp): all in words where
// there are words.

export interface CheckPage {
  version: string;
  title: string;
  findings: {topic: string; sentence: string}[];
  run: string;
  parts: string[];
  /** How many were checked. */
  frames: number;
  bodies: [name: string, triangles: string, files: string, notes: string][];
  /** Those that are not allowed, or between frames and allowed by --allow impact; `at`: the place in the 3D view, where it has one. */
  contacts: {place: string; words: string; at: number | null}[];
  /** Contacts that are in check.csv alone. */
  more: number;
  /** Pairs of triangles by frame, of contacts that are not allowed. */
  pairs: [frame: number, pairs: number][];
  /** The deepest of a frame, of known depth, in millimetres. */
  depths: [frame: number, lower: number, upper: number][];
  /** Frames with a contact of unknown depth. */
  unknown: number[];
  /** Steps with a contact that neither of their frames decides upon, by their first frame. */
  steps: number[];
  /** Of each frame of the 3D view. */
  view: {names: string[]; words: string[][]};
  /** Says which frames the 3D view has, where it has not all. */
  view_note: string;
  /** What is said of all steps; empty without any. */
  paths: string;
}
