// The container of reference/report/formats/view_bytes.h, and what the page says about it.

export interface ArrayReference {
  type: "f32" | "u16" | "u32";
  at: number;
  count: number;
}

export type Numbers = Float32Array | Uint16Array | Uint32Array;

export interface ShapeHeader {
  vertices: number;
  nodes: number;
  triangles: ArrayReference;
  kept?: {triangles: ArrayReference; vertices: ArrayReference};
  numbers?: ArrayReference;
  lattice?: {
    cell_nodes: ArrayReference;
    home: ArrayReference;
    local: ArrayReference;
    boxes: ArrayReference;
    spheres: {radius1: number; centers2: ArrayReference; radii2: number[]};
  };
}

/** Flat: body, element, body, element of each pair; -1 where there is no element. */
export interface Listed {
  count: number;
  pairs: number[];
}

export interface Differences {
  frame: number;
  missed: Listed;
  spurious: Listed;
}

export type Element = "triangle" | "cell" | "vertex" | "edge" | "body" | "nothing";
/** What the numbers of a pair count; "nothing" has no place on the screen. */
export type Elements = [Element, Element];

export interface DetectorContacts {
  detector: string;
  level: string;
  elements: Record<Kind, Elements>;
  frames: Differences[];
}

export interface SceneHeader {
  id: string;
  frames: number;
  time_step: number;
  base: number;
  placements: {origin: [number, number, number]; scale: number}[];
  shapes: ShapeHeader[];
  bodies: {name: string; shape: number}[];
  nodes: ArrayReference;
  truth: ({frame: number} & Listed)[];
  detectors: DetectorContacts[];
}

export type Kind = "missed" | "spurious";
export type Pair = [number, number, number, number];

export interface ViewTarget {
  scene: string;
  detector?: string;
  frame: number;
  pair?: Pair;
  level?: string;
  kind?: Kind;
}

/** A pair that can be shown. */
export interface ListedPair extends Required<Omit<ViewTarget, "scene">> {
  scene: string;
  elements: Elements;
}

/** What stands on the screen; positions in metres. */
export interface ViewState {
  scene: string;
  detector: string;
  frame: number;
  frames: number;
  pair: Pair | null;
  target: [number, number, number];
  distance: number;
  drawn: number;
}

export interface View {
  /** Whether it holds the scene: some are left out. */
  has(scene: string): boolean;
  /**
   * Goes to a frame of a scene, and to a pair where one is given, or the first of a kind: the camera
   * looks at its centroid.
   */
  show(target: ViewTarget): void;
  /** What can be shown of a scene, in the order of detectors, missed before spurious, frames. */
  missedPairs(scene: string, detector?: string): ListedPair[];
  state(): ViewState;
}
