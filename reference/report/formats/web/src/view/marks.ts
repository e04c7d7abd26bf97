// Contacts: true ones, missed ones and spurious ones differ in colour, in the pattern of their faces
// and in the shape of their markers, so that no eye needs the colour.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  Mesh,
  Points,
  ShaderMaterial,
} from "three";
import {LineMaterial} from "three/examples/jsm/lines/LineMaterial.js";
import {LineSegments2} from "three/examples/jsm/lines/LineSegments2.js";
import {LineSegmentsGeometry} from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import {kEdges} from "./bounds";
import {centroid, type PairGeometry, reach} from "./scene_model";

export type MarkKind = "true" | "missed" | "spurious";

/** Numbers in the shaders: 0 plain and a dot, 1 stripes and a cross, 2 dots and a square, 3 a ring. */
const kPattern: Record<MarkKind, number> = {true: 0, missed: 1, spurious: 2};
const kRing = 3;
const kMarkerPixels: Record<MarkKind, number> = {true: 6, missed: 12, spurious: 11};
const kRingPixels = 46;

const kFaceVertex = `
  varying vec3 seen;
  void main() {
    vec4 at = modelViewMatrix * vec4(position, 1.0);
    seen = at.xyz;
    gl_Position = projectionMatrix * at;
  }`;

// Patterns are fixed to the screen: they look alike on faces of every size.
const kFaceFragment = `
  uniform vec3 color;
  uniform float opacity, pixel;
  uniform int pattern;
  varying vec3 seen;
  void main() {
    vec2 at = gl_FragCoord.xy / pixel;
    float mark = 1.0;
    if (pattern == 1) mark = step(0.45, fract((at.x + at.y) / 9.0));
    if (pattern == 2) mark = step(0.3, length(fract(at / 7.0) - 0.5));
    vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
    vec3 shade = mix(mix(color, vec3(1.0), 0.72), color, mark) * (0.7 + 0.3 * abs(normal.z));
    gl_FragColor = vec4(shade, opacity);
    #include <colorspace_fragment>
  }`;

const kMarkerVertex = `
  uniform float size, pixel, extent;
  void main() {
    vec4 at = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * at;
    gl_PointSize = size * pixel;
    if (extent * projectionMatrix[1][1] > -0.1 * at.z) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }`;

const kMarkerFragment = `
  uniform vec3 color;
  uniform float opacity;
  uniform int pattern;
  void main() {
    vec2 p = 2.0 * gl_PointCoord - 1.0;
    float r = length(p), inside = step(r, 1.0);
    if (pattern == 1) inside = step(min(abs(p.x - p.y), abs(p.x + p.y)), 0.42);
    if (pattern == 2) inside = step(0.55, max(abs(p.x), abs(p.y)));
    if (pattern == 3) inside = step(0.86, r) * step(r, 1.0);
    if (inside < 0.5) discard;
    gl_FragColor = vec4(color, opacity);
    #include <colorspace_fragment>
  }`;

// Two triangles a side; corners by the bits of their numbers.
const kFaces = [
  [0, 2, 3, 1],
  [4, 5, 7, 6],
  [0, 1, 5, 4],
  [2, 6, 7, 3],
  [0, 4, 6, 2],
  [1, 3, 7, 5],
].flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);

const pixelRatio = (): number => Math.min(window.devicePixelRatio, 2);

const moved = (points: number[], origin: number[]): number[] =>
  points.map((value, i) => value - origin[i % 3]);

const cornersOf = (points: number[], numbers: readonly number[]): number[] =>
  numbers.flatMap((n) => points.slice(3 * n, 3 * n + 3));

function positions(values: number[]): BufferGeometry {
  return new BufferGeometry().setAttribute(
    "position",
    new BufferAttribute(new Float32Array(values), 3),
  );
}

export interface MarkStyle {
  kind: MarkKind;
  color: Color;
  /** The pair that was asked for: thick outlines, and a ring that finds it however small it is. */
  selected: boolean;
  /** The second element of that pair, which the first one's ring finds. */
  second?: boolean;
  /** Another pair was asked for. */
  dimmed: boolean;
}

function faces(geometries: PairGeometry[], origin: number[], style: MarkStyle): Mesh {
  const all = geometries.flatMap(({triangles, boxes}) => [
    ...triangles.flat(),
    ...boxes.flatMap((box) => cornersOf(box, kFaces)),
  ]);
  const box = geometries.some(({boxes}) => boxes.length > 0);
  const opacity = (box ? 0.3 : 0.95) * (style.dimmed ? 0.3 : 1);
  const material = new ShaderMaterial({
    vertexShader: kFaceVertex,
    fragmentShader: kFaceFragment,
    side: DoubleSide,
    uniforms: {
      color: {value: style.color},
      opacity: {value: opacity},
      pattern: {value: kPattern[style.kind]},
      pixel: {value: pixelRatio()},
    },
    // In front of the body's own face, which lies in the same plane.
    polygonOffset: true,
    polygonOffsetFactor: style.selected ? -4 : -2,
    polygonOffsetUnits: -2,
    transparent: opacity < 1,
    depthWrite: opacity === 1,
  });
  return new Mesh(positions(moved(all, origin)), material);
}

function outlines(geometries: PairGeometry[], origin: number[], style: MarkStyle): LineSegments2 {
  const all = geometries.flatMap(({triangles, boxes}) => [
    ...triangles.flatMap((t) => cornersOf(t, [0, 1, 1, 2, 2, 0])),
    ...boxes.flatMap((box) => cornersOf(box, kEdges.flat())),
  ]);
  const material = new LineMaterial({
    color: style.color,
    linewidth: style.selected ? 3.5 : 1.5,
    transparent: true,
    opacity: style.dimmed ? 0.25 : 1,
    polygonOffset: true,
    polygonOffsetFactor: -6,
    polygonOffsetUnits: -6,
  });
  return new LineSegments2(new LineSegmentsGeometry().setPositions(moved(all, origin)), material);
}

// Gone where a thing of size `extent` about its point is large enough on the screen by itself.
function markers(
  points: number[],
  origin: number[],
  style: MarkStyle,
  pattern: number,
  size: number,
  extent = 0,
): Points {
  const material = new ShaderMaterial({
    vertexShader: kMarkerVertex,
    fragmentShader: kMarkerFragment,
    transparent: true,
    depthTest: false,
    depthWrite: false,
    uniforms: {
      color: {value: style.color},
      opacity: {value: 1},
      pattern: {value: pattern},
      size: {value: size},
      pixel: {value: pixelRatio()},
      extent: {value: extent},
    },
  });
  const out = new Points(positions(moved(points, origin)), material);
  out.renderOrder = 10; // over all surfaces: a contact inside a body is seen too
  return out;
}

/** Without the faces in `drawn`, to which it adds: many pairs share a triangle, which is drawn once. */
function notYet(geometries: PairGeometry[], drawn: Set<string>): PairGeometry[] {
  const fresh = (part: number[]): boolean => {
    const size = drawn.size;
    return drawn.add(part.join(" ")).size > size;
  };
  return geometries.map(({triangles, boxes, points}) => ({
    triangles: triangles.filter(fresh),
    boxes: boxes.filter(fresh),
    points,
  }));
}

/** One kind of contacts of a frame. `origin` is taken off all positions; faces: see notYet. */
export function makeMarks(
  all: PairGeometry[],
  origin: number[],
  style: MarkStyle,
  drawn: Set<string>,
): Group {
  const group = new Group();
  if (all.length === 0) return group;
  const centers = all.flatMap(centroid),
    geometries = notYet(all, drawn);
  // Boxes of other pairs would hide the one that was asked for.
  if (!style.dimmed || geometries.every(({boxes}) => boxes.length === 0))
    group.add(faces(geometries, origin, style));
  if (geometries.some(({triangles, boxes}) => triangles.length + boxes.length > 0))
    group.add(outlines(geometries, origin, style));
  const own = (points: number[], extent = 0): Points =>
    markers(points, origin, style, kPattern[style.kind], kMarkerPixels[style.kind], extent);
  if (style.selected && !style.second) {
    const extent = Math.max(...all.map((g) => reach(g, centroid(g))));
    group.add(markers(centers, origin, style, kRing, kRingPixels, extent));
    group.add(own(geometries.flatMap(({points}) => points.flat())));
  } else if (!style.dimmed && !style.second) {
    group.add(own(centers));
  }
  for (const child of group.children) {
    child.frustumCulled = false;
    if (style.selected) child.renderOrder += 5; // over what is transparent
  }
  return group;
}
