// A scene at one of its frames: positions of everything that can be drawn, in the view's unit box.
import type {Container} from "./container";
import {Shape} from "./shape";
import type {
  DetectorContacts,
  Element,
  Elements,
  Kind,
  ListedPair,
  Numbers,
  Pair,
  SceneHeader,
} from "./types";

/** What a pair consists of on the screen: triangles, boxes (corners of a hexahedron) and points. */
export interface PairGeometry {
  triangles: number[][];
  boxes: number[][];
  points: number[][];
}

export const kTrianglePair: Elements = ["triangle", "triangle"];

export class SceneModel {
  readonly shapes: Shape[];
  private readonly nodes: Numbers;
  private readonly firstNode: number[] = [];
  private readonly nodesPerFrame: number;
  private vertices = new Map<number, Float64Array>();
  private current = 0;

  constructor(
    container: Container,
    readonly header: SceneHeader,
  ) {
    this.shapes = header.shapes.map((shape) => new Shape(container, header, shape));
    this.nodes = container.array(header, header.nodes);
    let first = 0;
    for (let b = 0; b < header.bodies.length; ++b) {
      this.firstNode.push(first);
      first += this.shapeOf(b).nodes;
    }
    this.nodesPerFrame = first;
  }

  get frame(): number {
    return this.current;
  }

  set frame(frame: number) {
    this.current = frame;
    this.vertices.clear();
  }

  get placement(): SceneHeader["placements"][number] {
    const {placements} = this.header;
    return placements[Math.min(this.current, placements.length - 1)];
  }

  shapeOf(body: number): Shape {
    return this.shapes[this.header.bodies[body].shape];
  }

  nodesOf(body: number): Float32Array {
    const start = 3 * (this.current * this.nodesPerFrame + this.firstNode[body]);
    return (this.nodes as Float32Array).subarray(start, start + 3 * this.shapeOf(body).nodes);
  }

  verticesOf(body: number): Float64Array {
    let found = this.vertices.get(body);
    if (!found)
      this.vertices.set(body, (found = this.shapeOf(body).vertexPositions(this.nodesOf(body))));
    return found;
  }

  /** The middle of everything in the frame, and how far from it that reaches. */
  extent(): {center: number[]; radius: number} {
    const low = [Infinity, Infinity, Infinity],
      high = [-Infinity, -Infinity, -Infinity];
    const bodies = this.header.bodies.map((_, b) => this.verticesOf(b));
    for (const points of bodies)
      for (let i = 0; i < points.length; ++i) {
        low[i % 3] = Math.min(low[i % 3], points[i]);
        high[i % 3] = Math.max(high[i % 3], points[i]);
      }
    const center = low.map((value, k) => 0.5 * (value + high[k]));
    return {center, radius: Math.max(1e-6, ...bodies.map((points) => farthest(points, center)))};
  }

  truth(): Pair[] {
    return pairsIn(this.header.truth.find(({frame}) => frame === this.current)?.pairs ?? []);
  }

  detector(name: string): DetectorContacts | undefined {
    return this.header.detectors.find(({detector}) => detector === name);
  }

  differences(detector: string, kind: Kind): Pair[] {
    const frame = this.detector(detector)?.frames.find((entry) => entry.frame === this.current);
    return pairsIn(frame?.[kind].pairs ?? []);
  }

  /** Positions of a pair of this frame. */
  geometry(pair: Pair, [first, second]: Elements): PairGeometry {
    const out: PairGeometry = {triangles: [], boxes: [], points: []};
    this.add(pair[0], pair[1], first, out);
    this.add(pair[2], pair[3], second, out);
    return out;
  }

  private add(body: number, element: number, what: Element, out: PairGeometry): void {
    if (what === "triangle") out.triangles.push(this.triangle(body, element));
    else if (what === "cell")
      out.boxes.push(Array.from(this.shapeOf(body).boxCorners(this.nodesOf(body), element)));
    else if (what === "vertex") {
      const at = 3 * this.shapeOf(body).place("vertices", element);
      out.points.push(Array.from(this.verticesOf(body).subarray(at, at + 3)));
    } else if (what === "body") out.points.push(this.middleOf(body));
  }

  private triangle(body: number, number: number): number[] {
    const shape = this.shapeOf(body),
      points = this.verticesOf(body),
      at = shape.place("triangles", number);
    return [0, 1, 2].flatMap((i) => {
      const v = shape.triangles[3 * at + i];
      return [points[3 * v], points[3 * v + 1], points[3 * v + 2]];
    });
  }

  private middleOf(body: number): number[] {
    const points = this.verticesOf(body),
      sum = [0, 0, 0];
    for (let i = 0; i < points.length; ++i) sum[i % 3] += points[i];
    return sum.map((value) => (3 * value) / points.length);
  }
}

export function pairsIn(flat: number[]): Pair[] {
  const out: Pair[] = [];
  for (let i = 0; i + 3 < flat.length; i += 4)
    out.push([flat[i], flat[i + 1], flat[i + 2], flat[i + 3]]);
  return out;
}

/** In the order of detectors, missed before spurious, frames. */
export function listedPairs(scene: SceneHeader, wanted?: string): ListedPair[] {
  const out: ListedPair[] = [];
  for (const {detector, level, elements, frames} of scene.detectors) {
    if (wanted !== undefined && detector !== wanted) continue;
    for (const kind of ["missed", "spurious"] as const)
      for (const entry of frames)
        for (const pair of pairsIn(entry[kind].pairs))
          out.push({
            scene: scene.id,
            detector,
            level,
            elements: elements[kind],
            frame: entry.frame,
            kind,
            pair,
          });
  }
  return out;
}

/** The mean of the points that make the pair, each element's own middle counting the same. */
export function centroid(geometry: PairGeometry): number[] {
  const parts = [...geometry.triangles, ...geometry.boxes, ...geometry.points];
  const sum = [0, 0, 0];
  for (const part of parts)
    for (let i = 0; i < part.length; ++i) sum[i % 3] += part[i] / (part.length / 3) / parts.length;
  return sum;
}

function farthest(points: ArrayLike<number>, center: number[]): number {
  let out = 0;
  for (let i = 0; i < points.length; i += 3)
    out = Math.max(
      out,
      Math.hypot(points[i] - center[0], points[i + 1] - center[1], points[i + 2] - center[2]),
    );
  return out;
}

/** The largest distance of a point of the pair from `center`. */
export function reach(geometry: PairGeometry, center: number[]): number {
  return Math.max(
    0,
    ...[...geometry.triangles, ...geometry.boxes, ...geometry.points].map((part) =>
      farthest(part, center),
    ),
  );
}
