// The engine as a WebAssembly module without imports: its exports, and the messages in its memory.
//
// `output` is frames one behind the other: u32 kind (0 text, 1 binary), u32 length, so many bytes, zeros up to a multiple
// of 8; all little-endian. After a trap only `message` may be called.

import { type Asked, FORMATS, type Format, type Frame } from "./messages";

export interface Exports {
  memory: { buffer: ArrayBuffer };
  /** Room for so many bytes of input. */
  input(length: number): number;
  /** Takes the input for a file that scenes may name: so many bytes of its name, then so many of its content. */
  file(name: number, content: number): void;
  /** Reads the input as JSON; 0: a run has begun, 1: refused. */
  open(length: number): number;
  /** Runs for about so many evaluations of the rates; 0: goes on, 1: has ended, 2: failed. */
  advance(evaluations: number): number;
  /** The frames since the last call. */
  output(): number;
  output_len(): number;
  /** A part of the run so far as a file; 0: there is none, 1: it stands in `saved`, 2: why not stands there. */
  save(format: number, part: number): number;
  saved(): number;
  saved_len(): number;
  /** The words of a panic. */
  message(): number;
  message_len(): number;
}

const HEAD = 8;

/** What the engine does not do, in its words: other than after a trap, it goes on. */
export class Refusal extends Error {}

/** The frames that stand one behind the other, copied. */
export function framesIn(bytes: Uint8Array): Frame[] {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const frames: Frame[] = [];
  let at = 0;
  while (at + HEAD <= bytes.length) {
    const [kind, length] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
    const from = at + HEAD;
    if (kind > 1 || from + length > bytes.length) throw new Error("The engine's messages are cut short.");
    const content = bytes.slice(from, from + length);
    frames.push(kind === 0 ? new TextDecoder().decode(content) : content.buffer);
    at = from + 8 * Math.ceil(length / 8);
  }
  return frames;
}

export class Engine {
  constructor(private readonly exports: Exports) {}

  /** Hands over a file that scenes may name, in the place of one of the same name. */
  give(name: string, content: ArrayBuffer): void {
    const [head, body] = [new TextEncoder().encode(name), new Uint8Array(content)];
    const length = head.length + body.length;
    const input = this.bytes(this.exports.input(length), length);
    input.set(head);
    input.set(body, head.length);
    this.exports.file(head.length, body.length);
  }

  /** Begins a run of a scene; false where it is refused. */
  open(asked: Asked): boolean {
    const bytes = new TextEncoder().encode(JSON.stringify(asked));
    this.bytes(this.exports.input(bytes.length), bytes.length).set(bytes);
    return this.exports.open(bytes.length) === 0;
  }

  /** Runs for about so many evaluations; false where the run is over. */
  advance(evaluations: number): boolean {
    return this.exports.advance(evaluations) === 0;
  }

  /** The messages since the last call. */
  frames(): Frame[] {
    const at = this.exports.output();
    return framesIn(this.bytes(at, this.exports.output_len()));
  }

  /** The run so far as a file, part by part; the words of a failure are thrown. */
  save(format: Format): ArrayBuffer[] {
    const parts: ArrayBuffer[] = [];
    for (;;) {
      const answer = this.exports.save(FORMATS.indexOf(format), parts.length);
      const bytes = this.bytes(this.exports.saved(), this.exports.saved_len()).slice();
      if (answer === 2) throw new Refusal(new TextDecoder().decode(bytes));
      if (answer === 0) return parts;
      parts.push(bytes.buffer);
    }
  }

  /** The words of a panic, or those of the trap. */
  lastWords(trap: unknown): string {
    const words = new TextDecoder().decode(
      this.bytes(this.exports.message(), this.exports.message_len()).slice(),
    );
    return words.trim() || (trap instanceof Error ? trap.message : String(trap));
  }

  /** A part of the memory, as long as no call moves it. */
  private bytes(at: number, length: number): Uint8Array<ArrayBuffer> {
    // Addresses are unsigned; the language hands them over with a sign.
    return new Uint8Array(this.exports.memory.buffer, at >>> 0, length >>> 0);
  }
}
