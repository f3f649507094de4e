// Shadows of bodies on supports: each body once more, pressed flat onto the plane along the light.
//
// The light is not a point: a few directions within a narrow cone share the shade, so that a shadow is sharp where a
// body is close to the plane and soft where it is high above. For each direction the stencil lets a pixel be shaded once.

import {
  AlwaysStencilFunc,
  Group,
  type InstancedMesh,
  KeepStencilOp,
  NotEqualStencilFunc,
  ReplaceStencilOp,
  ShaderMaterial,
  Vector3,
} from "three";
import type { Vec3 } from "../data/header";
import { across, cross, dot } from "../math/mat3";
import { again } from "./instances";

const VERTEX = /* glsl */ `
uniform vec3 origin, normal_, light, middle;
uniform float extent;
varying float fade;
void main() {
	vec4 place = instanceMatrix * vec4( position, 1.0 );
	float height = dot( place.xyz - origin, normal_ );
	place.xyz -= light * ( max( height, 0.0 ) / dot( light, normal_ ) );
	fade = 1.0 - smoothstep( 0.2, 0.9, length( place.xyz - middle ) / ( 0.5 * extent ) );
	gl_Position = projectionMatrix * ( modelViewMatrix * place );
}`;

const FRAGMENT = /* glsl */ `
uniform float opacity;
varying float fade;
void main() {
	gl_FragColor = vec4( 0.0, 0.0, 0.02, opacity * fade );
}`;

/** Tangent of half the angle of the cone of light. */
const CONE = 0.09;

/** The plane as it is now. */
export interface Ground {
  origin: Vec3;
  normal: Vec3;
  /** The middle and the width of the piece that is drawn [m]. */
  middle: Vec3;
  extent: number;
}

export class ShadowLayer {
  readonly group = new Group();
  private readonly materials: ShaderMaterial[];

  /** `first` is the stencil value of the first direction; the following ones belong to the others. */
  constructor(
    casters: InstancedMesh[],
    private readonly directions: number,
    first: number,
  ) {
    this.materials = Array.from({ length: directions }, (_, k) => shade(first + k));
    for (const material of this.materials) {
      for (const caster of casters) {
        const flat = again(caster, material);
        flat.renderOrder = -1;
        this.group.add(flat);
      }
    }
  }

  /** Lets shade of a strength fall on a plane from a light in a direction. */
  place(ground: Ground, light: Vec3, strength: number): void {
    const steep = dot(light, ground.normal);
    this.group.visible = steep > 0.15 && strength > 0;
    const opacity = 1 - (1 - strength) ** (1 / this.directions);
    this.materials.forEach((material, k) => {
      const { uniforms } = material;
      uniforms.origin.value.set(...ground.origin);
      uniforms.normal_.value.set(...ground.normal);
      uniforms.middle.value.set(...ground.middle);
      uniforms.extent.value = ground.extent;
      uniforms.light.value.set(...around(light, k, this.directions));
      uniforms.opacity.value = opacity;
    });
  }

  dispose(): void {
    for (const material of this.materials) material.dispose();
  }
}

/** The k-th of n directions spread evenly over the cone, by the golden angle. */
function around(light: Vec3, k: number, n: number): Vec3 {
  if (n === 1) return light;
  const first = across(light);
  const second = cross(light, first);
  const radius = CONE * Math.sqrt((k + 0.5) / n);
  const angle = k * Math.PI * (3 - Math.sqrt(5));
  const [a, b] = [radius * Math.cos(angle), radius * Math.sin(angle)];
  return light.map((value, axis) => value + a * first[axis] + b * second[axis]) as Vec3;
}

function shade(stencil: number): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      origin: { value: new Vector3() },
      normal_: { value: new Vector3(0, 0, 1) },
      light: { value: new Vector3(0, 0, 1) },
      middle: { value: new Vector3() },
      extent: { value: 1 },
      opacity: { value: 0 },
    },
    transparent: true,
    depthWrite: false,
    stencilWrite: true,
    stencilRef: stencil,
    stencilFunc: stencil > 0 ? NotEqualStencilFunc : AlwaysStencilFunc,
    stencilFail: KeepStencilOp,
    stencilZFail: KeepStencilOp,
    stencilZPass: ReplaceStencilOp,
  });
}
