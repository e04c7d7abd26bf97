// The geometry of a shape, from the nodes of a frame: the formulas of core/deform/mapping.h and
// core/detect/ffd_state.cpp, in doubles, on nodes in single precision.
import type {Container} from "./container";
import type {Numbers, SceneHeader, ShapeHeader} from "./types";

export interface Sphere {
  center: number[];
  radius: number;
}

interface Lattice {
  cellNodes: Numbers;
  home: Numbers;
  local: Numbers;
  boxes: Numbers;
  radius1: number;
  centers2: Numbers;
  radii2: number[];
}

const blend = (a: number, b: number, w: number): number => a * (1 - w) + b * w;

function bounds(points: Float64Array): {low: number[]; high: number[]} {
  const low = [Infinity, Infinity, Infinity],
    high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], points[i]);
    high[i % 3] = Math.max(high[i % 3], points[i]);
  }
  return {low, high};
}

export class Shape {
  readonly triangles: Numbers;
  readonly vertices: number;
  readonly nodes: number;
  /** Only what is near contacts is here. */
  readonly cut: boolean;
  /** Of triangles and vertices, by the numbers that pairs name. */
  private readonly places: Partial<Record<"triangles" | "vertices", Map<number, number>>> = {};
  private readonly lattice: Lattice | null = null;

  constructor(container: Container, scene: SceneHeader, header: ShapeHeader) {
    const array = (reference: ShapeHeader["triangles"]): Numbers =>
      container.array(scene, reference);
    this.triangles = array(header.triangles);
    this.vertices = header.vertices;
    this.nodes = header.nodes;
    this.cut = header.kept !== undefined;
    const places = (reference: ShapeHeader["triangles"]): Map<number, number> =>
      new Map(Array.from(array(reference), (number, place) => [number, place]));
    if (header.kept) this.places.triangles = places(header.kept.triangles);
    const numbers = header.kept?.vertices ?? header.numbers;
    if (numbers) this.places.vertices = places(numbers);
    if (!header.lattice) return;
    const {cell_nodes, home, local, boxes, spheres} = header.lattice;
    this.lattice = {
      cellNodes: array(cell_nodes),
      home: array(home),
      local: array(local),
      boxes: array(boxes),
      radius1: spheres.radius1,
      centers2: array(spheres.centers2),
      radii2: spheres.radii2,
    };
  }

  /** Where a triangle or vertex of a pair stands in the arrays. */
  place(kind: "triangles" | "vertices", number: number): number {
    const places = this.places[kind];
    return places ? places.get(number)! : number;
  }

  get cells(): number {
    return this.lattice ? this.lattice.boxes.length / 6 : 0;
  }

  /** Three numbers per vertex. */
  vertexPositions(nodes: Float32Array): Float64Array {
    if (!this.lattice) return Float64Array.from(nodes);
    const {home, local} = this.lattice;
    const out = new Float64Array(3 * this.vertices);
    for (let v = 0; v < this.vertices; ++v)
      this.map(nodes, home[v], local[3 * v], local[3 * v + 1], local[3 * v + 2], out, 3 * v);
    return out;
  }

  /** Eight corners of a cell's FFD-AABB, three numbers each; corner c is high where its bits are set. */
  boxCorners(nodes: Float32Array, cell: number): Float64Array {
    const out = new Float64Array(24);
    const {boxes} = this.lattice!;
    const at = (corner: number, axis: number): number =>
      boxes[6 * cell + 3 * ((corner >> axis) & 1) + axis];
    for (let c = 0; c < 8; ++c) this.map(nodes, cell, at(c, 0), at(c, 1), at(c, 2), out, 3 * c);
    return out;
  }

  /** Eight corners of the lattice's own cell. */
  cellCorners(nodes: Float32Array, cell: number): Float64Array {
    const out = new Float64Array(24);
    for (let c = 0; c < 8; ++c) {
      const node = this.lattice!.cellNodes[8 * cell + c];
      for (let k = 0; k < 3; ++k) out[3 * c + k] = nodes[3 * node + k];
    }
    return out;
  }

  /** Of level 1 or 2, as the paper has them. `scale`: metres per unit of the view. */
  spheres(nodes: Float32Array, level: number, scale: number): Sphere[] {
    if (!this.lattice) return [];
    const {radius1, centers2, radii2} = this.lattice;
    if (level === 1) return [{center: this.boxesCenter(nodes), radius: radius1 / scale}];
    return radii2.map((radius, i) => {
      const node = centers2[i];
      return {center: Array.from(nodes.subarray(3 * node, 3 * node + 3)), radius: radius / scale};
    });
  }

  private boxesCenter(nodes: Float32Array): number[] {
    const corners = new Float64Array(24 * this.cells);
    for (let cell = 0; cell < this.cells; ++cell)
      corners.set(this.boxCorners(nodes, cell), 24 * cell);
    const {low, high} = bounds(corners);
    return low.map((value, k) => 0.5 * value + 0.5 * high[k]);
  }

  private map(
    nodes: Float32Array,
    cell: number,
    s: number,
    t: number,
    u: number,
    out: Float64Array,
    at: number,
  ): void {
    const {cellNodes} = this.lattice!;
    for (let k = 0; k < 3; ++k) {
      const node = (c: number): number => nodes[3 * cellNodes[8 * cell + c] + k];
      const low = blend(blend(node(0), node(1), s), blend(node(2), node(3), s), t);
      const high = blend(blend(node(4), node(5), s), blend(node(6), node(7), s), t);
      out[at + k] = blend(low, high, u);
    }
  }
}
