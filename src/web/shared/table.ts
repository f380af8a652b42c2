// Plain tables. A wide one scrolls in its own box, which the keyboard reaches.

import { type Child, el } from "./dom";
import { type Maybe, number } from "./format";

export interface Cell {
  content: Child;
  /** The exact number behind the text, for whoever reads the page by program. */
  value?: number | string | null;
  numeric?: boolean; header?: boolean;
}

interface TableSpec {
  /** What the table shows: read out, and shown above it where `captionShown`. */
  caption: string;
  captionShown?: boolean;
  head: (string | Cell)[];
  rows: (Child | Cell)[][];
  className?: string;
  /** Scrolls up and down too, under its head. */
  tall?: boolean;
  /** On a narrow page each row becomes a block of named values. */
  stacks?: boolean;
}

/** A right-aligned number with its exact value. */
export function numeric(content: Child, value?: Cell["value"]): Cell { return { content, value, numeric: true }; }

/** Numbers as they are shown everywhere, with their exact values. */
export function numberCells(...values: Maybe[]): Cell[] { return values.map((value) => numeric(number(value), value)); }

/** Heads of columns of numbers. */
export function numericHeads(...heads: string[]): Cell[] { return heads.map((head) => numeric(head)); }

/** A cell that names its row. */
export function rowHeader(content: Child): Cell { return { content, header: true }; }

function isCell(cell: Child | Cell): cell is Cell {
  return typeof cell === "object" && cell !== null && !(cell instanceof Node);
}

function headCell(head: string | Cell): HTMLElement {
  const cell = typeof head === "string" ? { content: head } : head;
  return el("th", { scope: "col", class: cell.numeric ? "numeric" : null }, cell.content);
}

function bodyCell(given: Child | Cell, label: string | null): HTMLElement {
  const cell = isCell(given) ? given : { content: given };
  const attributes = { class: cell.numeric ? "numeric" : null, "data-value": cell.value, "data-label": label };
  return cell.header
    ? el("th", { scope: "row", ...attributes }, cell.content)
    : el("td", attributes, cell.content);
}

/** The table in its scrolling box. */
export function table(spec: TableSpec): HTMLElement {
  const head = el("thead", {}, el("tr", {}, ...spec.head.map(headCell)));
  const body = el("tbody", {});
  const labels = spec.head.map((head) => (spec.stacks ? String(typeof head === "string" ? head : head.content) : null));
  for (const row of spec.rows) body.append(el("tr", {}, ...row.map((cell, i) => bodyCell(cell, labels[i] ?? null))));
  const caption = el("caption", { class: spec.captionShown ? null : "visually-hidden" }, spec.caption);
  return el("div", { class: spec.tall ? "table-box tall" : "table-box", tabindex: 0, role: "region", "aria-label": spec.caption },
    el("table", { class: [spec.className, spec.stacks ? "stacks" : ""].join(" ").trim() || null }, caption, head, body));
}
