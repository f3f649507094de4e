// Supports: planes with a grid that fits the scene, fades far away, and moves as the support does.
//
// The piece of the plane that is drawn stays where the scene is; the grid on it is fixed to the support, so that a belt
// runs and a shaken table shakes. From behind a plane is nearly clear.

import {
  Color,
  DoubleSide,
  Group,
  type InstancedMesh,
  Mesh,
  PlaneGeometry,
  ShaderMaterial,
  Vector2,
  Vector3,
} from "three";
import type { Support, Vec3 } from "../data/header";
import type { Recording } from "../data/recording";
import { applied, type Carriage, carriage, placeOf } from "../math/carriage";
import { roundBelow } from "../math/format";
import { across, cross, dot } from "../math/mat3";
import { ShadowLayer } from "./shadows";

const VERTEX = /* glsl */ `
uniform float extent;
varying vec2 onPlane;
void main() {
	onPlane = position.xy * extent;
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`;

const FRAGMENT = /* glsl */ `
uniform float extent, spacing;
uniform vec2 offset;
uniform vec3 ground, line;
varying vec2 onPlane;
float lines( vec2 at, float width ) {
	vec2 pixels = fwidth( at );
	vec2 away = abs( fract( at - 0.5 ) - 0.5 ) / max( pixels, vec2( 1e-9 ) );
	vec2 drawn = ( 1.0 - smoothstep( width - 0.5, width + 0.5, away ) ) * ( 1.0 - smoothstep( 0.15, 0.5, pixels ) );
	return max( drawn.x, drawn.y );
}
void main() {
	vec2 at = ( onPlane - offset ) / spacing;
	float fade = 1.0 - smoothstep( 0.35, 1.0, length( onPlane ) / ( 0.5 * extent ) );
	float drawn = max( 0.4 * lines( at, 0.6 ), 0.9 * lines( at / 5.0, 0.8 ) );
	float side = gl_FrontFacing ? 1.0 : 0.25;
	gl_FragColor = vec4( mix( ground, line, drawn ), fade * side * mix( 0.86, 1.0, drawn ) );
	#include <colorspace_fragment>
}`;

/** Where a support is at a time [s]: a point of the plane [m], and its normal. */
export function planeAt(support: Support, time: number): { origin: Vec3; normal: Vec3; carried: Carriage } {
  const carried = carriage(support.motion, time);
  return { origin: placeOf(carried, support.origin), normal: applied(carried.turn, support.normal), carried };
}

interface Plane {
  support: Support;
  /** Right-handed: two directions in the plane, and the normal. */
  axes: [Vec3, Vec3, Vec3];
  grid: Mesh<PlaneGeometry, ShaderMaterial>;
  shadows: ShadowLayer | null;
}

export class SupportLayer {
  readonly group = new Group();
  /** Distance of thin lines [m]. */
  spacing = 1;
  private readonly planes: Plane[];
  private extent = 1;
  private strength = 0;

  constructor(recording: Recording) {
    const geometry = new PlaneGeometry(1, 1);
    this.planes = recording.header.supports.map((support) => {
      const first = across(support.normal);
      const axes: Plane["axes"] = [first, cross(support.normal, first), support.normal];
      const grid = new Mesh(geometry, gridMaterial());
      grid.matrixAutoUpdate = false;
      grid.frustumCulled = false;
      grid.renderOrder = -2;
      this.group.add(grid);
      return { support, axes, grid, shadows: null };
    });
  }

  /** Lets bodies cast shadows, with so many directions of light. */
  shade(casters: InstancedMesh[], directions: number): void {
    this.planes.forEach((plane, index) => {
      const first = 1 + index * directions;
      // The stencil has eight bits.
      if (first + directions > 255) return;
      plane.shadows?.dispose();
      plane.shadows?.group.removeFromParent();
      plane.shadows = new ShadowLayer(casters, directions, first);
      this.group.add(plane.shadows.group);
    });
  }

  /** Fits the drawn pieces to a scene of this radius [m]. */
  fit(radius: number): void {
    this.extent = 11 * radius;
    this.spacing = roundBelow(radius / 6);
  }

  /** Puts the planes where they are at a time, drawn around a point, in light from a direction. */
  place(time: number, center: Vec3, light: Vec3): void {
    const { extent, spacing } = this;
    for (const { support, axes, grid, shadows } of this.planes) {
      const { origin, normal, carried } = planeAt(support, time);
      const [u, v] = axes.map((axis) => applied(carried.turn, axis));
      const height = dot(center, normal) - dot(origin, normal);
      const middle = center.map((value, k) => value - height * normal[k]) as Vec3;
      const basis = [u, v, normal].map((axis, k) => new Vector3(...axis).multiplyScalar(k < 2 ? extent : 1));
      grid.matrix.makeBasis(basis[0], basis[1], basis[2]).setPosition(...middle);
      const { uniforms } = grid.material;
      uniforms.extent.value = extent;
      uniforms.spacing.value = spacing;
      const fixed = origin.map((value, k) => value - middle[k]) as Vec3;
      uniforms.offset.value.set(dot(fixed, u), dot(fixed, v));
      shadows?.place({ origin, normal, middle, extent }, light, this.strength);
    }
  }

  paint(ground: string, line: string, shadow: number): void {
    this.strength = shadow;
    for (const { grid } of this.planes) {
      grid.material.uniforms.ground.value.set(ground);
      grid.material.uniforms.line.value.set(line);
    }
  }

  dispose(): void {
    for (const { grid, shadows } of this.planes) {
      grid.material.dispose();
      grid.geometry.dispose();
      shadows?.dispose();
    }
  }
}

function gridMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      extent: { value: 1 },
      spacing: { value: 1 },
      offset: { value: new Vector2() },
      ground: { value: new Color() },
      line: { value: new Color() },
    },
    transparent: true,
    depthWrite: false,
    side: DoubleSide,
  });
}
