// How much may be drawn. A processor that stands in for a graphics card pays for every pixel and every corner.

import type { WebGLRenderer } from "three";

export interface Quality {
  pixelRatio: number;
  /** More bodies than these are drawn with fewer pixels and plainer light. */
  crowd: number;
  /** Triangles of all bodies together. */
  triangles: number;
  /** Directions of light that make shadows soft. */
  directions: number;
}

const FULL: Quality = { pixelRatio: 2, crowd: 1e9, triangles: 3_000_000, directions: 12 };
const MODEST: Quality = { pixelRatio: 1, crowd: 200, triangles: 20_000, directions: 6 };

/** Names of renderers that compute on the processor. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** The context of a canvas and what suits the machine behind it; `#quality=full` in the address insists on the best. */
export function contextOf(
  canvas: HTMLCanvasElement,
): { context: WebGL2RenderingContext; quality: Quality } | null {
  // Whether edges are smoothed is settled with a context: the machine is asked through another one before.
  const modest = !location.hash.includes("quality=full") && drawsInSoftware();
  const context = canvas.getContext("webgl2", { alpha: false, stencil: true, antialias: !modest });
  return context && { context, quality: { ...(modest ? MODEST : FULL) } };
}

function drawsInSoftware(): boolean {
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) return false;
  const software = isSoftware(probe);
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return software;
}

function isSoftware(context: WebGL2RenderingContext): boolean {
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name: unknown = context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER);
  return typeof name === "string" && SOFTWARE.test(name);
}

/** Directions of light for so many triangles of bodies: none where the bodies alone are as much as can be drawn. */
export function directionsFor(quality: Quality, triangles: number): number {
  if (triangles > 0.8 * quality.triangles) return 0;
  return Math.max(
    1,
    Math.min(quality.directions, Math.floor((1.5 * quality.triangles) / Math.max(1, triangles))),
  );
}

/** Frames slower than this while playing [ms] cost pixels. */
const SLOW_MS = 60;
const LEAST_RATIO = 0.6;

/** Watches how long frames take while playing, and gives up pixels where they take long. */
export class Thrift {
  private slow = 0;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly quality: Quality,
  ) {}

  /** After a frame that took so long [ms]; returns whether something was given up. */
  saw(frame: number): boolean {
    this.slow = frame > SLOW_MS ? this.slow + 1 : Math.max(0, this.slow - 1);
    if (this.slow < 8 || this.quality.pixelRatio <= LEAST_RATIO) return false;
    this.slow = 0;
    this.quality.pixelRatio = Math.max(
      LEAST_RATIO,
      Math.min(this.quality.pixelRatio, devicePixelRatio) / 1.4,
    );
    this.renderer.setPixelRatio(this.quality.pixelRatio);
    return true;
  }
}
