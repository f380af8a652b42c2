// The resolved scenario: every parameter with where its value comes from.

import { el, labelled, select, type Child } from "../../shared/dom";
import { counted, number } from "../../shared/format";
import { numeric, rowHeader, table } from "../../shared/table";
import type { Context } from "../context";
import type { Parameter, Run } from "../payload";
import { unitText } from "../words";
import type { Section } from "./section";

const ORIGINS: Record<string, string> = {
  published: "printed in the source",
  calibrated: "chosen so that a stated number comes out",
  assumed: "not published: assumed, with a range to study",
  setting: "a choice of the user, no claim about the world",
};

function countsByOrigin(parameters: Parameter[]): HTMLElement {
  const names = [...new Set([...Object.keys(ORIGINS), ...parameters.map((each) => each.origin)])];
  return el("dl", { class: "meanings" },
    ...names.map((name) => {
      const count = parameters.filter((each) => each.origin === name).length;
      return el("div", { "data-origin": name, "data-value": count },
        el("dt", {}, el("span", { class: `origin ${name in ORIGINS ? name : ""}` }, name), ` ${number(count)}`), el("dd", {}, ORIGINS[name] ?? ""));
    }));
}

function rowsTable(parameters: Parameter[], caption: string): HTMLElement {
  return table({
    caption,
    className: "parameter-table",
    tall: true,
    head: ["Parameter", numeric("Value"), "Unit", "Origin", "Range", "Source"],
    rows: parameters.map((each) => [
      rowHeader(el("div", {}, el("code", {}, each.path), el("span", { class: "doc" }, each.doc))),
      numeric(each.value, each.value),
      each.unit === "1" ? "" : unitText(each.unit),
      el("span", { class: `origin ${each.origin in ORIGINS ? each.origin : ""}` }, each.origin),
      each.range,
      each.source,
    ]),
  });
}

function matches(parameter: Parameter, text: string, origin: string): boolean {
  if (origin !== "" && parameter.origin !== origin) return false;
  const all = `${parameter.path} ${parameter.value} ${parameter.source} ${parameter.doc}`.toLowerCase();
  return text.toLowerCase().split(/\s+/).every((word) => all.includes(word));
}

// Paths whose values are not the same in all runs.
function differing(runs: Run[]): HTMLElement | null {
  const values = new Map<string, Map<string, string>>();
  for (const run of runs) {
    for (const each of run.parameters) {
      if (!values.has(each.path)) values.set(each.path, new Map());
      values.get(each.path)!.set(run.label, each.value);
    }
  }
  const paths = [...values].filter(([, of]) => of.size < runs.length || new Set(of.values()).size > 1);
  if (paths.length === 0) return null;
  return el("details", { class: "numbers" }, el("summary", {}, `${counted(paths.length, "parameter")} in which the runs differ`), table({
    caption: "Parameters in which the runs differ",
    head: ["Parameter", ...runs.map((run) => run.label)],
    rows: paths.map(([path, of]) => [rowHeader(el("code", {}, path)), ...runs.map((run) => of.get(run.label) ?? "")]),
  }));
}

function browser(runs: Run[]): Child[] {
  const chosen = select(runs.map((run, i) => [String(i), run.label]), "0");
  const origin = select([["", "all origins"], ...Object.keys(ORIGINS).map((name): [string, string] => [name, name])]);
  const search = el("input", { type: "search", placeholder: "path, value, source", id: "parameter-search" });
  const counts = el("div");
  const box = el("div");
  const found = el("p", { class: "note", role: "status" });
  const show = () => {
    const { parameters, label } = runs[Number(chosen.value)]!;
    const kept = parameters.filter((each) => matches(each, search.value.trim(), origin.value));
    counts.replaceChildren(countsByOrigin(parameters));
    found.textContent = `${number(kept.length)} of ${counted(parameters.length, "parameter")}`;
    box.replaceChildren(rowsTable(kept, `Parameters of ${label}`));
  };
  for (const control of [chosen, origin]) control.addEventListener("change", show);
  search.addEventListener("input", show);
  show();
  return [
    counts,
    el("div", { class: "controls" }, runs.length > 1 ? labelled("Run", chosen) : null, labelled("Search", search), labelled("Origin", origin)),
    found,
    box,
    el("p", { class: "note print-only" }, "Their values are on the page itself and in scenario.resolved.json of the run's folder."),
  ];
}

export const parameters: Section = {
  id: "parameters",
  title: "Parameters",
  render: (context: Context) => {
    const runs = context.runs.filter((run) => (run.parameters ?? []).length > 0);
    if (runs.length === 0) return null;
    return [...browser(runs), runs.length > 1 ? differing(runs) : null];
  },
};
