// The range of a slider around a value: by factors for what is positive, symmetric for what has a sign.

/** How a number may be dragged. */
export interface Range {
  /** The number at a place of the slider, from 0 to 1. */
  at(place: number): number;
  /** The place of a number. */
  place(value: number): number;
}

/** Keys whose values have a sign, or may be zero, whatever they are now. */
const SIGNED =
  /velocity|position|gradient|gravity|origin|normal|axis|angle|euler|quaternion|phase|orientation|pin|anchor|point|direction|amplitude|value|center|offset|from|to\b|gain|bias|matrix|^world/;

/** Factors up and down. */
const FACTOR = 10;

/** The range in which a number of this key that is now `value` may be dragged; `reach` is for a zero. */
export function rangeFor(key: string, value: number, reach: number): Range {
  return value > 0 && !SIGNED.test(key) ? byFactors(value) : symmetric(Math.abs(value) || reach);
}

function byFactors(middle: number): Range {
  return {
    at: (place) => middle * FACTOR ** (2 * place - 1),
    place: (value) => (value > 0 ? clamped(0.5 + 0.5 * (Math.log(value / middle) / Math.log(FACTOR))) : 0),
  };
}

function symmetric(size: number): Range {
  const most = 3 * size;
  return {
    at: (place) => {
      const value = most * (2 * place - 1);
      // Zero is easy to find again.
      return Math.abs(value) < 0.02 * most ? 0 : value;
    },
    place: (value) => clamped(0.5 + (0.5 * value) / most),
  };
}

function clamped(place: number): number {
  return Math.min(1, Math.max(0, place));
}

/** A dragged number with as few digits as tell it from its neighbours. */
export function tidy(value: number): number {
  return Number(value.toPrecision(4));
}
