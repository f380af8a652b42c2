// The table of entries, the best score first.

import { rateBar } from "../../report/charts/glyphs";
import { type Child, el } from "../../shared/dom";
import { fixed, MISSING, percent, percentInterval, points, pointsInterval } from "../../shared/format";
import { type Cell, numeric, numericHeads, rowHeader, table } from "../../shared/table";
import type { BenchPayload, Entry, Estimated } from "../payload";

const VERDICTS = {
  better: { mark: "▲", tone: "good" }, worse: { mark: "▼", tone: "bad" },
  tied: { mark: "=", tone: "none" }, unknown: { mark: "?", tone: "unsure" },
} as const;

const of = (text: string) => el("span", { class: "of" }, text);

/** A share in per cent and its interval below it. */
export function shareCell(share: Estimated): Cell {
  if (share.value === null) return numeric(MISSING, null);
  const ends = share.low === null || share.high === null ? "no interval" : percentInterval(share.low, share.high);
  return numeric(el("div", {}, percent(share.value), of(ends)), share.value);
}

function scoreCell({ value, low, high }: Estimated): Cell {
  return { content: el("div", { class: "rate-drawn" }, rateBar(value, low, high), of(`${percent(value)}, ${percentInterval(low, high)}`)), value };
}

function verdictCell(entry: Entry, data: BenchPayload): Cell {
  if (entry.name === data.baseline) return { content: "baseline", value: "baseline" };
  const { mark, tone } = VERDICTS[entry.verdict];
  const { value, low, high } = entry.difference;
  return {
    content: el("div", {},
      el("span", { class: `verdict ${tone}` }, el("span", { class: "verdict-mark", "aria-hidden": "true" }, mark), entry.verdict),
      of(`${points(value)} points, ${pointsInterval(low, high)}`)),
    value: entry.verdict,
  };
}

function nameCell(entry: Entry): Cell {
  return rowHeader(el("span", {}, entry.name, entry.passes_gate ? null : el("span", { class: "verdict bad" }, " not safe enough")));
}

const ranks = ({ best_rank: best, worst_rank: worst }: Entry) => (best === worst ? `${best}` : `${best} to ${worst}`);

function row(entry: Entry, data: BenchPayload): (Child | Cell)[] {
  return [
    nameCell(entry), scoreCell(entry.score), verdictCell(entry, data), numeric(ranks(entry), entry.best_rank), shareCell(entry.regret),
    ...[entry.declared, entry.unsafe, entry.scraped].map((share) => numeric(percent(share), share)),
    ...[entry.way_ratio, entry.time_ratio, entry.energy_ratio].map((ratio) => numeric(fixed(ratio, 2), ratio)),
  ];
}

export function standings(data: BenchPayload): Child[] {
  const [best] = data.entries;
  const tied = best!.not_told_from;
  return [
    el("p", { class: "answer-line" }, el("strong", {}, best!.name), ` arrives truly in ${percent(best!.score.value)} of the suite`,
      tied.length > 0 ? `; ${tied.length === 1 ? `${tied[0]} is` : `${tied.length} others are`} not told from it.` : data.entries.length > 1 ? ", and is told from all others." : "."),
    table({
      caption: "Entries, the best score first", className: "standings-table compact", stacks: true,
      head: ["Entry", "Arrived truly", `To ${data.baseline}`, ...numericHeads("Ranks", "Regret", "Declared", "Unsafe", "Scraped", "Way", "Time", "Energy")],
      rows: data.entries.map((entry) => row(entry, data)),
    }),
    el("p", { class: "note" }, "The bar is the score from 0 to 100 % with its 95 % interval over layouts. Verdicts are of paired differences to the baseline; " +
      "ranks are those that remain possible when all pairs are compared at once. Way, time and energy are over the baseline's, in drives in which both arrive."),
  ];
}
