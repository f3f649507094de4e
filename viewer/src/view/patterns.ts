// What is painted on bodies so that they can be seen to turn: the pips of a die, the poles and the equator of a ball, a
// stripe along what is turned on a lathe. Paint is fixed to the material: it turns and deforms with the body.

import { type Extent, extentOf } from "../data/shapes";

export type Paint = "plain" | "pips" | "poles" | "stripe";

export interface Pattern {
  paint: Paint;
  /** The box around the surface, in which the pattern is told. */
  extent: Extent;
}

/** Sides of a cube agree to this part: points are kept in single precision. */
const EQUAL = 1e-5;

const PAINTS = new Map<string, Paint>([
  ["sphere", "poles"],
  ["ellipsoid", "poles"],
  ["cylinder", "stripe"],
  ["cone", "stripe"],
  ["capsule", "stripe"],
  ["torus", "stripe"],
]);

/** The pattern for a kind of shape with this surface; other boxes than cubes, hulls and meshes show how they turn. */
export function patternOf(shape: string | null, points: ArrayLike<number>): Pattern {
  const extent = extentOf(points);
  const [a, b, c] = extent.half;
  const isCube = shape === "box" && Math.max(Math.abs(a - b), Math.abs(b - c)) <= EQUAL * a;
  return { paint: isCube ? "pips" : (PAINTS.get(shape ?? "") ?? "plain"), extent };
}

/**
 * How much of a mark there is at a point q of a surface, −1 ≤ q ≤ 1 in its box, as GLSL. Opposite faces of a die have
 * seven pips together; one, two and three stand on +x, +y and +z, counter-clockwise about their corner.
 */
export const MARKED: Record<Exclude<Paint, "plain">, string> = {
  pips: /* glsl */ `
float marked( vec3 q ) {
	vec3 a = abs( q );
	bool onX = a.x >= a.y && a.x >= a.z;
	bool onY = !onX && a.y >= a.z;
	vec2 at = onX ? q.yz : onY ? q.zx : q.xy;
	float least = onX ? 1.0 : onY ? 2.0 : 3.0;
	float side = onX ? q.x : onY ? q.y : q.z;
	float pips = side > 0.0 ? least : 7.0 - least;
	float off = 9.0;
	if ( mod( pips, 2.0 ) > 0.5 ) off = length( at );
	if ( pips > 1.5 ) off = min( off, min( length( at - 0.5 ), length( at + 0.5 ) ) );
	if ( pips > 3.5 ) off = min( off, length( abs( at ) - 0.5 ) );
	if ( pips > 5.5 ) off = min( off, length( vec2( abs( at.x ) - 0.5, at.y ) ) );
	return within( 0.17 - off, q );
}`,
  poles: /* glsl */ `
float marked( vec3 q ) {
	float band = within( 0.07 - abs( q.z ), q );
	float north = within( 0.3 - length( q.xy ) - 9.0 * step( q.z, 0.0 ), q );
	float south = within( 0.1 - abs( length( q.xy ) - 0.22 ) - 9.0 * step( 0.0, q.z ), q );
	return max( 0.8 * band, max( north, south ) );
}`,
  stripe: /* glsl */ `
float marked( vec3 q ) {
	return within( 0.1 - abs( q.y ) - 9.0 * step( q.x, 0.0 ), q );
}`,
};
