// The page: finds where its recording is, and shows it.

import "./style";
import { App } from "./app";
import { LiveRun } from "./data/live";
import { embeddedReport } from "./data/report";
import { servedHeader, servedRecording } from "./data/served";
import type { Source } from "./data/source";

async function source(): Promise<Source> {
  const report = embeddedReport(document);
  if (report) return report;
  if (location.protocol === "file:") {
    throw new Error("This page holds no recording: `gyration report DIR` makes one that does.");
  }
  const header = await servedHeader();
  return header.mode === "live" ? new LiveRun() : servedRecording(header);
}

async function start(): Promise<void> {
  const app = new App(document.body);
  window.gyration = app.handle;
  try {
    await app.show(await source());
  } catch (error) {
    app.failed(error instanceof Error ? error.message : String(error));
  }
}

void start();
