// What made the numbers and the page.

import { el, type Child } from "../../shared/dom";
import { rowHeader, table } from "../../shared/table";
import type { Context } from "../context";
import type { Section } from "./section";

function text(value: unknown): string {
  if (Array.isArray(value)) return value.map(text).join("; ");
  if (typeof value === "object" && value !== null) return JSON.stringify(value);
  return value === undefined || value === null ? "" : String(value);
}

function list(entries: Record<string, unknown>, caption: string): HTMLElement {
  return table({
    caption,
    rows: Object.entries(entries).map(([name, value]) => [rowHeader(name.replaceAll("_", " ")), text(value)]),
    head: ["", ""],
    className: "provenance-table",
  });
}

function runs(context: Context): HTMLElement {
  return table({
    caption: "Runs of this page",
    head: ["Run", "Folder", "Seed", "Fingerprint", "Trial hash", "Build"],
    rows: context.runs.map(({ label, folder, summary }) => [
      rowHeader(label),
      el("code", {}, folder),
      text(summary?.seed),
      el("code", {}, text(summary?.fingerprint)),
      el("code", {}, text(summary?.trial_hash)),
      text(summary?.provenance?.builds),
    ]),
  });
}

export const provenance: Section = {
  id: "provenance",
  title: "Provenance",
  render: (context: Context): Child[] => [
    context.runs.length > 0 ? runs(context) : null,
    el("h3", {}, "This page"),
    context.payload.command ? el("pre", {}, context.payload.command) : null,
    context.payload.provenance ? list(context.payload.provenance, "The program that wrote this page") : null,
  ],
};
