// The table of all trials: search, filters, choice of columns, sorting, and each row's replay.

import { FormatModule, PageModule, ResizeColumnsModule, SortModule, Tabulator, type ColumnDefinition } from "tabulator-tables";

import { el, labelled, select } from "../shared/dom";
import { counted, fixed, isNumber, number, words, type Maybe } from "../shared/format";
import type { TrialQuery } from "./context";
import type { Run } from "./payload";
import { hasUnrated } from "./prefix";
import { replayCell, ReplayCommand, replayPages } from "./replay_command";
import { columnsOf, fieldOf, trialRows, type ColumnInfo, type TrialRow } from "./trial_rows";
import { matching } from "./trial_search";
import { columnLabel } from "./words";

Tabulator.registerModule([FormatModule, PageModule, ResizeColumnsModule, SortModule]);

const SHOWN_AT_FIRST = [
  "true_distance_m", "true_goal_distance_m", "sim_time_s", "energy_wh", "distance_error_percent", "heading_error_deg", "position_error_m",
];
const MOST_AT_FIRST = 7;
const VALUE_WIDTH = 112;
const PAGE_SIZES = [25, 50, 100, 250];

// A button in the header, so that the keyboard can sort too.
function headerButton(title: string): ColumnDefinition["titleFormatter"] {
  return () => el("button", { type: "button", class: "sort-button" }, title);
}

// As many decimals for a whole column as its greatest value needs for four digits: points stand below
// each other.
function numberFormatter(rows: TrialRow[], field: `v_${string}`): ColumnDefinition["formatter"] {
  let greatest = 0;
  let whole = true;
  for (const row of rows) {
    const value = row[field];
    if (!isNumber(value)) continue;
    greatest = Math.max(greatest, Math.abs(value));
    whole &&= Number.isInteger(value);
  }
  const decimals = whole || greatest === 0 ? 0 : Math.min(8, Math.max(0, 3 - Math.floor(Math.log10(greatest))));
  return (cell) => document.createTextNode(fixed(cell.getValue() as Maybe, decimals)) as unknown as HTMLElement;
}

function columnAtFirst(columns: ColumnInfo[]): Set<string> {
  const usual = columns.filter((column) => SHOWN_AT_FIRST.includes(column.name));
  return new Set((usual.length > 0 ? usual : columns.slice(0, MOST_AT_FIRST)).map((column) => column.name));
}

// A grid holds rows and nothing else: what turns its pages stands below it, and what scrolls is no
// stop of its own, since its buttons and links can be reached.
function leaveRowsAlone(grid: HTMLElement): void {
  const footer = grid.querySelector(".tabulator-footer");
  if (footer) grid.after(footer);
  grid.querySelector(".tabulator-tableholder")?.removeAttribute("tabindex");
}

export class TrialTableView {
  private readonly rows: TrialRow[];
  private readonly columns: ColumnInfo[];
  private readonly table: Tabulator;
  private built = false;
  private readonly search = el("input", { type: "search", id: "trial-search", placeholder: "number, words, energy_wh>20" });
  private readonly run: HTMLSelectElement;
  private readonly outcome: HTMLSelectElement;
  private readonly onlyReplays = el("input", { type: "checkbox" });
  private readonly onlyRated = el("input", { type: "checkbox", id: "trials-only-rated" });
  /** Some trials are in no rate: only then the page speaks of it. */
  private readonly someUnrated: boolean;
  private readonly found = el("p", { class: "note", role: "status", id: "trials-found" });
  private readonly command = new ReplayCommand();

  constructor(private readonly runs: Run[], box: HTMLElement) {
    this.rows = trialRows(runs);
    this.columns = columnsOf(runs);
    this.someUnrated = runs.some(hasUnrated);
    const outcomes = [...new Set(runs.flatMap((run) => run.trials?.outcome_names ?? []))];
    this.run = select([["", "all runs"], ...runs.map((run): [string, string] => [run.label, run.label])]);
    this.outcome = select([["", "all outcomes"], ...outcomes.map((name): [string, string] => [name, words(name)])]);
    const shown = columnAtFirst(this.columns);
    const place = el("div", { role: "grid", "aria-label": "Trials" });
    const pages = replayPages(this.rows, runs.length > 1);
    box.replaceChildren(...(pages ? [pages] : []), this.controls(), this.columnChooser(shown), this.found, this.command.element,
      el("div", { class: "trial-table" }, place));
    this.table = this.makeTable(place, shown);
    this.listen(place);
    this.refresh();
  }

  /** Shows what a chart asks for; other conditions are taken away. */
  show(query: TrialQuery): void {
    this.search.value = "";
    this.onlyReplays.checked = false;
    this.onlyRated.checked = query.onlyRated ?? false;
    this.run.value = query.run ?? "";
    this.outcome.value = query.outcome ?? "";
    this.refresh();
  }

  private controls(): HTMLElement {
    const reset = el("button", { type: "button" }, "Show all");
    reset.addEventListener("click", () => this.show({}));
    return el(
      "div",
      { class: "controls" },
      labelled("Search", this.search),
      this.runs.length > 1 ? labelled("Run", this.run) : null,
      labelled("Outcome", this.outcome),
      el("label", { class: "tick" }, this.onlyReplays, "with a replay page"),
      this.someUnrated ? el("label", { class: "tick" }, this.onlyRated, "in the rates") : null,
      reset,
    );
  }

  private columnChooser(shown: Set<string>): HTMLElement {
    const boxes = this.columns.map(({ name, unit }) => {
      const box = el("input", { type: "checkbox", value: name });
      box.checked = shown.has(name);
      box.addEventListener("change", () => {
        if (box.checked) this.table.showColumn(fieldOf(name));
        else this.table.hideColumn(fieldOf(name));
      });
      return el("label", { class: "tick" }, box, columnLabel(name, unit));
    });
    return el("details", { class: "numbers" }, el("summary", {}, `Columns (${this.columns.length})`), el("div", { class: "column-list" }, ...boxes));
  }

  private definitions(shown: Set<string>): ColumnDefinition[] {
    const text = { formatter: "plaintext", headerSort: true, resizable: true } as const;
    const fixed: ColumnDefinition[] = [
      { title: "Trial", field: "trial", titleFormatter: headerButton("Trial"), hozAlign: "right", headerHozAlign: "right", width: 92, sorter: "number", ...text },
      { title: "Run", field: "run", titleFormatter: headerButton("Run"), visible: this.runs.length > 1, sorter: "string", width: 220, ...text },
      {
        title: "Outcome", field: "outcome", titleFormatter: headerButton("Outcome"), sorter: "string", ...text,
        formatter: (cell) => document.createTextNode(words(cell.getValue() as string)) as unknown as HTMLElement,
      },
      { title: "Rates", field: "unrated", titleFormatter: headerButton("Rates"), visible: this.someUnrated, sorter: "string", headerSortStartingDir: "desc", width: 140, ...text },
      {
        title: "Replay", field: "replay", titleFormatter: headerButton("Replay"), visible: this.runs.some((run) => run.kind !== "measurement"), sorter: "string", headerSortStartingDir: "desc", width: 118,
        formatter: (cell) => replayCell(cell.getData() as TrialRow, this.runs, this.command),
      },
    ];
    const values = this.columns.map(({ name, unit }): ColumnDefinition => ({
      title: columnLabel(name, unit),
      field: fieldOf(name),
      titleFormatter: headerButton(columnLabel(name, unit)),
      visible: shown.has(name),
      width: VALUE_WIDTH,
      hozAlign: "right",
      headerHozAlign: "right",
      sorter: "number",
      sorterParams: { alignEmptyValues: "bottom" },
      formatter: numberFormatter(this.rows, fieldOf(name)),
    }));
    return [
      ...fixed,
      ...values,
      { title: "Detail", field: "detail", titleFormatter: headerButton("Detail"), minWidth: 220, sorter: "string", ...text },
    ];
  }

  private makeTable(place: HTMLElement, shown: Set<string>): Tabulator {
    return new Tabulator(place, {
      columns: this.definitions(shown),
      // No field name is a path: "a.b" is one name.
      nestedFieldSeparator: false,
      layout: "fitDataFill",
      pagination: true,
      paginationSize: PAGE_SIZES[0],
      paginationSizeSelector: PAGE_SIZES,
      paginationCounter: "rows",
      renderHorizontal: "basic",
      placeholder: "No trial meets these conditions.",
    });
  }

  private listen(grid: HTMLElement): void {
    this.search.addEventListener("input", () => this.refresh());
    for (const control of [this.run, this.outcome, this.onlyReplays, this.onlyRated]) control.addEventListener("change", () => this.refresh());
    this.table.on("tableBuilt", () => {
      this.built = true;
      leaveRowsAlone(grid);
      this.refresh();
    });
  }

  private refresh(): void {
    const { rows: kept, problems } = matching(this.rows, this.columns, {
      text: this.search.value,
      run: this.run.value,
      outcome: this.outcome.value,
      onlyReplays: this.onlyReplays.checked,
      onlyRated: this.onlyRated.checked,
    });
    this.found.textContent = [`${number(kept.length)} of ${counted(this.rows.length, "trial")}`, ...problems].join("; ");
    if (this.built) void this.table.replaceData(kept);
  }
}
