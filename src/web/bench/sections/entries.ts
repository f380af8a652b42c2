// Who entered, and what holds the results together.

import { breakable, type Child, el } from "../../shared/dom";
import { rowHeader, table } from "../../shared/table";
import type { BenchPayload } from "../payload";

const code = (text: string) => el("code", { class: "digest" }, text);

export function entries(data: BenchPayload): Child[] {
  return [
    table({
      caption: "Entries", stacks: true, className: "entries-table",
      head: ["Entry", "Navigator", "About", "Run", "Digest of the entry", "Head of the chain"],
      rows: data.entries.map((entry) => [
        rowHeader(entry.name), entry.navigator, [entry.about, entry.authors].filter(Boolean).join(" By ") || "–",
        breakable(entry.folder), code(entry.entry_digest), code(entry.head)]),
    }),
    el("p", { class: "note" }, "Each run is verified by rockyard bench verify and its folder; this page by:"),
    el("pre", {}, el("code", {}, data.command)),
  ];
}
