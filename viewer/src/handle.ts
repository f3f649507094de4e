// `window.gyration`: what tests and the console may ask of the page.

export interface Handle {
  /** Once the first frame of a recording has been drawn. */
  ready: Promise<void>;
  /** The time that is shown [s]. */
  readonly time: number;
  /** Samples that are there of what the picture shows. */
  readonly rows: number;
  /** Frames drawn so far. */
  readonly frame: number;
  /** Shows the sample nearest to a time [s]. */
  seek(time: number): void;
  /** Draws now instead of with the browser's next frame. */
  renderNow(): void;
}

declare global {
  interface Window {
    gyration: Handle;
  }
}
