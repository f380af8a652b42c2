// Regret: ways against those of an optimist with perfect eyes.

import { type Child, el } from "../../shared/dom";
import { counted } from "../../shared/format";
import { numericHeads, rowHeader, table } from "../../shared/table";
import type { BenchPayload } from "../payload";
import { shareCell } from "./standings";

export function regret(data: BenchPayload): Child[] | null {
  if (data.why_no_regret) return [el("p", { class: "note caution" }, `${data.why_no_regret}.`)];
  if (data.entries.every((entry) => entry.regret.value === null)) return null;
  const groups = data.entries[0]!.groups.map((_, g) => g).filter((g) => data.entries.some((entry) => entry.groups[g]!.regret.value !== null));
  return [
    el("p", { class: "note" }, "Regret is the way driven, with what is left to the goal, over the way of a rover that sees perfectly as far as the stereo " +
      "cameras reach, takes for free what it has not seen and plans anew where a rock comes to light, less 1. It is told over drives that truly arrive: " +
      "an entry that arrives on the easy layouts alone has little of it."),
    table({
      caption: "Mean regret by group", className: "compact", stacks: true,
      head: ["Entry", ...numericHeads("All", "Drives", ...groups.map((g) => data.entries[0]!.groups[g]!.name))],
      rows: data.entries.map((entry) => [
        rowHeader(entry.name), shareCell(entry.regret), { content: counted(entry.regret.drives, "drive"), value: entry.regret.drives, numeric: true },
        ...groups.map((g) => shareCell(entry.groups[g]!.regret))]),
    }),
  ];
}
