// Where each entry arrives: shares by group and cell.

import { type Child, el } from "../../shared/dom";
import { type Cell, numericHeads, rowHeader, table } from "../../shared/table";
import type { BenchPayload } from "../payload";

/** A share in per cent on its colour; whole, as the colour is no finer. */
export function heatCell(share: number, digits = 0): Cell {
  const fill = `background: color-mix(in srgb, var(--series-1) ${Math.round(45 * share)}%, var(--ground))`;
  return { content: el("span", { class: "heat", style: fill }, (100 * share).toFixed(digits)), value: share, numeric: true };
}

export function heat(data: BenchPayload): Child[] {
  const { groups, cells } = data.entries[0]!;
  const rows: (Child | Cell)[][] = [];
  groups.forEach((group, g) => {
    rows.push([rowHeader(el("strong", { class: "heat-group" }, group.name)), ...data.entries.map((entry) => heatCell(entry.groups[g]!.arrived, 1))]);
    cells.forEach(({ name }, c) => {
      if (name.split("/")[0] !== group.name) return;
      rows.push([rowHeader(el("span", { class: "heat-cell" }, name.slice(group.name.length + 1) || name)), ...data.entries.map((entry) => heatCell(entry.cells[c]!.arrived))]);
    });
  });
  return [
    el("p", { class: "note" }, "True arrivals in per cent of the layouts of a cell; the darker, the more. Groups, in bold, weigh alike in the score, and so do the cells of a group."),
    table({ caption: "True arrivals by cell", className: "heat-table compact", tall: true, head: ["Cell", ...numericHeads(...data.entries.map(({ name }) => name))], rows }),
  ];
}
