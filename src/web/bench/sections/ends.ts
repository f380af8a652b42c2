// How drives end, and what patience of the operators is worth.

import { type Child, el } from "../../shared/dom";
import { words } from "../../shared/format";
import { outcomeSentence } from "../../shared/outcomes";
import { numericHeads, rowHeader, table } from "../../shared/table";
import type { BenchPayload } from "../payload";
import { heatCell } from "./heat";

export function ends(data: BenchPayload): Child[] {
  const outcomes = Object.keys(data.entries[0]!.ends).filter((end) => data.entries.some((entry) => (entry.ends[end] ?? 0) > 0));
  return [
    table({
      caption: "Shares of drives by their end, in per cent", captionShown: true, className: "heat-table compact",
      head: ["Entry", ...numericHeads(...outcomes.map(words))],
      rows: data.entries.map((entry) => [rowHeader(entry.name), ...outcomes.map((end) => heatCell(entry.ends[end] ?? 0, 1))]),
    }),
    el("dl", { class: "meanings" }, ...outcomes.map((end) => el("div", {}, el("dt", {}, words(end)), el("dd", {}, outcomeSentence(end))))),
    table({
      caption: "True arrivals in per cent, by how far operators let the rover drive without progress", captionShown: true, className: "heat-table compact",
      head: ["Entry", ...numericHeads(...data.patience_m.map((limit) => `${limit} m`))],
      rows: data.entries.map((entry) => [rowHeader(entry.name), ...entry.within.map((share) => heatCell(share, 1))]),
    }),
  ];
}
