// Canvas, camera and light. It draws when something has changed, and never by itself.
//
// Whatever is drawn is given relative to `origin`, which is where the camera looks first: single
// precision then has its finest steps there, and a pair far from the scene's middle does not jitter.
import {
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  PerspectiveCamera,
  Scene,
  Spherical,
  Vector3,
  WebGLRenderer,
} from "three";
import {OrbitControls} from "three/examples/jsm/controls/OrbitControls.js";

const kFieldOfView = 40; // degrees, of the shorter side
const kKeyTurn = Math.PI / 24,
  kKeyZoom = 1.15;

export const kOverview = new Vector3(0.45, 0.35, 0.82).normalize();

/** null where the browser has no WebGL 2. */
export function makeStage(canvas: HTMLCanvasElement, onDraw: () => void): Stage | null {
  // Kept after it was shown: printing asks for it again.
  const context = canvas.getContext("webgl2", {
    antialias: true,
    powerPreference: "low-power",
    preserveDrawingBuffer: true,
  });
  return context && new Stage(canvas, context, onDraw);
}

export class Stage {
  /** Of all that is drawn, in the view's unit box. */
  origin: number[] = [0, 0, 0];
  /** Frames drawn so far. */
  drawn = 0;
  readonly content = new Group();
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(kFieldOfView, 1, 0.01, 100);
  private readonly renderer: WebGLRenderer;
  private readonly controls: OrbitControls;
  private sceneRadius = 1;
  private waiting = false;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    private readonly onDraw: () => void,
  ) {
    this.renderer = new WebGLRenderer({canvas, context});
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    const lamp = new DirectionalLight(0xffffff, 1.7);
    lamp.position.set(0.4, 0.6, 1);
    this.camera.add(lamp);
    this.scene.add(this.content, this.camera, new HemisphereLight(0xffffff, 0x8a8f98, 1.5));
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.invalidate());
    this.letPageScroll();
    canvas.addEventListener("keydown", (event) => this.onKey(event));
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
  }

  set background(color: Color) {
    this.scene.background = color;
    this.invalidate();
  }

  set radius(radius: number) {
    this.sceneRadius = radius;
  }

  /** What the camera looks at, in the view's unit box. */
  target(): number[] {
    return this.controls.target.toArray().map((value, k) => value + this.origin[k]);
  }

  distance(): number {
    return this.camera.position.distanceTo(this.controls.target);
  }

  /** From where the camera looks, seen from its target. */
  direction(): Vector3 {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }

  /** Looks at `center` so that a ball of `radius` about it fills a good part of the canvas. */
  look(center: number[], radius: number, direction: Vector3): void {
    this.origin = [...center];
    this.controls.target.set(0, 0, 0);
    const distance = radius / Math.sin((0.5 * kFieldOfView * Math.PI) / 180);
    this.camera.position.copy(direction).multiplyScalar(distance);
    this.controls.minDistance = 1e-3 * radius;
    this.controls.maxDistance = 20 * this.sceneRadius;
    this.controls.update();
    this.invalidate();
  }

  invalidate(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.draw());
  }

  private draw(): void {
    this.waiting = false;
    const distance = this.distance();
    this.camera.near = 0.02 * distance;
    this.camera.far = distance + 4 * this.sceneRadius;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
    ++this.drawn;
    this.onDraw();
  }

  // The wheel scrolls the page until the canvas has been clicked, or reached by the keyboard.
  private letPageScroll(): void {
    this.controls.enableZoom = false;
    this.canvas.addEventListener("focus", () => (this.controls.enableZoom = true));
    this.canvas.addEventListener("blur", () => (this.controls.enableZoom = false));
    this.canvas.addEventListener("pointerdown", () => this.canvas.focus({preventScroll: true}));
  }

  private onKey(event: KeyboardEvent): void {
    const turns: Record<string, [number, number, number]> = {
      ArrowLeft: [-kKeyTurn, 0, 1],
      ArrowRight: [kKeyTurn, 0, 1],
      ArrowUp: [0, -kKeyTurn, 1],
      ArrowDown: [0, kKeyTurn, 1],
      "+": [0, 0, 1 / kKeyZoom],
      "=": [0, 0, 1 / kKeyZoom],
      "-": [0, 0, kKeyZoom],
    };
    const turn = turns[event.key];
    if (!turn || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const place = new Spherical().setFromVector3(
      this.camera.position.clone().sub(this.controls.target),
    );
    place.theta += turn[0];
    place.phi += turn[1];
    place.radius *= turn[2];
    place.makeSafe();
    this.camera.position.setFromSpherical(place).add(this.controls.target);
    this.controls.update();
    this.invalidate();
  }

  private resize(): void {
    const {clientWidth, clientHeight} = this.canvas.parentElement!;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    // A tall canvas would show less than the width needs.
    const half = Math.tan((0.5 * kFieldOfView * Math.PI) / 180) / Math.min(1, this.camera.aspect);
    this.camera.fov = (2 * Math.atan(half) * 180) / Math.PI;
    // At once: a canvas of a new size is empty until it is drawn.
    this.draw();
  }
}
