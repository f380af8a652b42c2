// The comparison with what was published.

import { breakable, el, type Child } from "../../shared/dom";
import { interval, isNumber, MISSING, number, pValue, words } from "../../shared/format";
import { type Cell, numeric, numericHeads, rowHeader, table } from "../../shared/table";
import { predictionBar } from "../charts/glyphs";
import type { Context } from "../context";
import type { PublishedRow, PublishedTable, Run } from "../payload";
import { unitText, verdictWords } from "../words";
import type { Section } from "./section";

const VERDICTS_IN_ORDER = ["agrees", "holds", "differs", "underpowered", "not judged"];
// Units of counts and of p-values say nothing more.
const NO_UNITS = ["", "1", "p", "runs"];

function verdict(row: PublishedRow): Cell {
  const { mark, tone } = verdictWords(row.verdict);
  return {
    content: el("span", { class: `verdict ${tone}` }, el("span", { "aria-hidden": "true", class: "verdict-mark" }, mark), words(row.verdict)),
    value: row.verdict,
  };
}

function predicted(row: PublishedRow): Cell {
  const text = row.predicted || (isNumber(row.predicted_value) ? number(row.predicted_value, 3) : MISSING);
  return numeric(el("div", { class: "rate-drawn" },
    el("span", {}, text),
    isNumber(row.predicted_low) && !text.includes("..")
      ? el("span", { class: "of" }, interval(row.predicted_low, row.predicted_high))
      : null), row.predicted_value);
}

function remarks(row: PublishedRow): HTMLElement | null {
  if ((row.remarks ?? []).length === 0) return null;
  return el("details", { class: "remarks" }, el("summary", {}, "more"), el("ul", {}, ...row.remarks.map((remark) => el("li", {}, remark))));
}

function cells(row: PublishedRow, tested: boolean): (Child | Cell)[] {
  const unit = NO_UNITS.includes(row.unit) ? "" : `\u00a0[${unitText(row.unit)}]`;
  return [
    rowHeader(el("div", {}, row.what + unit, remarks(row))),
    numeric(row.published || MISSING, row.published_value),
    predicted(row),
    predictionBar(row.published_value, row.predicted_value, row.predicted_low, row.predicted_high),
    verdict(row),
    ...(tested
      ? [numeric(pValue(row.p_holm), row.p_holm), numeric(isNumber(row.power) ? row.power.toFixed(2) : MISSING, row.power)]
      : []),
    row.source,
  ];
}

function meanings(rows: PublishedRow[], tested: boolean): HTMLElement {
  const present = [...new Set(rows.map((row) => row.verdict))];
  const names = [...VERDICTS_IN_ORDER.filter((name) => present.includes(name)), ...present.filter((name) => !VERDICTS_IN_ORDER.includes(name))];
  return el("dl", { class: "meanings" },
    ...names.map((name) => {
      const { mark, tone, meaning } = verdictWords(name, !tested);
      const count = rows.filter((row) => row.verdict === name).length;
      return el("div", {},
        el("dt", { class: `verdict ${tone}` }, el("span", { "aria-hidden": "true", class: "verdict-mark" }, mark), `${words(name)} (${count})`),
        el("dd", {}, meaning));
    }));
}

/** A run of another case than the published one must not be read as a verdict on it. */
function otherSettings(settings: string[]): HTMLElement | null {
  if (settings.length === 0) return null;
  return el("div", { class: "not-published-case", role: "note" },
    el("p", {}, el("strong", {}, "Not the published case."), " This run has other settings than the scenario that the published values are about. The verdicts are as computed, but say nothing of how well the published case is predicted."),
    el("ul", {}, ...settings.map((setting) => el("li", {}, breakable(setting)))));
}

function comparison(run: Run, titled: boolean): Child[] {
  const published = run.published!;
  const tested = run.kind !== "measurement";
  return [
    titled ? el("h3", {}, run.label) : null,
    el("p", { class: "note" }, `Against ${published.reference}${published.citation ? `: ${published.citation}` : ""}`),
    otherSettings(published.settings ?? []),
    ...folded(published.settings ?? [], judged(run, published, tested)),
  ];
}

/** Of another case than the published one the values stand back. */
function folded(settings: string[], content: Child[]): Child[] {
  if (settings.length === 0) return content;
  return [el("details", { class: "numbers other-case" }, el("summary", {}, "Published values and verdicts all the same"), ...content)];
}

function judged(run: Run, published: PublishedTable, tested: boolean): Child[] {
  return [
    meanings(published.rows, tested),
    table({
      caption: `${run.label} against ${published.reference}`,
      className: "published-table",
      stacks: true,
      head: [
        "Number", ...numericHeads("Published", "Predicted (95 %)"), "Where it lies", "Verdict",
        ...(tested ? numericHeads("p (Holm)", "Power") : []), "Place",
      ],
      rows: published.rows.map((row) => cells(row, tested)),
    }),
    el("p", { class: "note" },
      (tested
        ? "Where it lies: the bar is the 95 % interval of what as many simulated runs would have shown, the dot its middle, "
        : "Where it lies: the dot is the simulated value, the bar its interval, ") +
        "the diamond the published value; each row has its own scale."),
    (published.notes ?? []).length > 0
      ? el("details", { class: "numbers" }, el("summary", {}, "How it is judged"),
          el("ul", {}, ...published.notes.map((note) => el("li", {}, note))))
      : null,
  ];
}

export const published: Section = {
  id: "published",
  title: "Against what was published",
  short: "Published",
  render: (context: Context) => {
    const runs = context.runs.filter((run) => (run.published?.rows ?? []).length > 0);
    if (runs.length > 0) return runs.flatMap((run) => comparison(run, context.runs.length > 1));
    const why = context.payload.why_none_published;
    return why ? [el("p", { class: "note" }, why)] : null;
  },
};
