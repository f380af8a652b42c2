// The section of the trial table: it is made when the page is scrolled near it, or a chart asks for it.

import { type ColumnDefinition, FormatModule, PageModule, ResizeColumnsModule, SortModule, Tabulator } from "tabulator-tables";

import { button, el, labelled, select } from "../../shared/dom";
import { counted, fixed, isNumber, type Maybe, number, words } from "../../shared/format";
import type { Context, TrialQuery } from "../context";
import type { Run } from "../payload";
import { hasUnrated, partOfTrials } from "../prefix";
import { type ColumnInfo, columnsOf, fieldOf, matching, type TrialRow, trialRows } from "../trial_rows";
import { columnLabel } from "../words";
import type { Section } from "./section";

export const trials: Section = {
  id: "trials",
  title: "Trials",
  render: (context: Context) => {
    if (!context.runs.some((run) => (run.trials?.trial ?? []).length > 0)) return null;
    const box = el("div", { class: "trial-section" });
    let view: TrialTableView | null = null;
    const open = () => (view ??= new TrialTableView(context.runs, box));
    const observer = new IntersectionObserver(
      (entries) => {
        if (!entries.some((entry) => entry.isIntersecting)) return;
        observer.disconnect();
        open();
      },
      { rootMargin: "600px" },
    );
    observer.observe(box);
    // On paper: its first rows.
    addEventListener("beforeprint", open);
    context.showTrials = (query: TrialQuery) => {
      open().show(query);
      document.getElementById("trials")?.scrollIntoView();
    };
    const part = partOfTrials(context.runs, "The table holds");
    return [...(part ? [el("p", { class: "note", id: "trials-part" }, part)] : []), box, el("p", { class: "note print-only" }, "Every trial is in trials.csv of its run's folder.")];
  },
};

// ---- The table of all trials: search, filters, choice of columns, sorting, and each row's replay.

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

const outcomesOf = (runs: Run[]): string[] => [...new Set(runs.flatMap((run) => run.trials?.outcome_names ?? []))];

// A grid holds rows and nothing else: what turns its pages stands below it, and what scrolls is no
// stop of its own, since its buttons and links can be reached.
function leaveRowsAlone(grid: HTMLElement): void {
  const footer = grid.querySelector(".tabulator-footer");
  if (footer) grid.after(footer);
  grid.querySelector(".tabulator-tableholder")?.removeAttribute("tabindex");
}

class TrialTableView {
  private readonly rows = trialRows(this.runs);
  private readonly columns = columnsOf(this.runs);
  /** Some trials are in no rate: only then the page speaks of it. */
  private readonly someUnrated = this.runs.some(hasUnrated);
  private readonly table: Tabulator;
  private built = false;
  private readonly search = el("input", { type: "search", id: "trial-search", placeholder: "number, words, energy_wh>20" });
  private readonly run = select([["", "all runs"], ...this.runs.map(({ label }): [string, string] => [label, label])]);
  private readonly outcome = select([["", "all outcomes"], ...outcomesOf(this.runs).map((name): [string, string] => [name, words(name)])]);
  private readonly onlyReplays = el("input", { type: "checkbox" });
  private readonly onlyRated = el("input", { type: "checkbox", id: "trials-only-rated" });
  private readonly found = el("p", { class: "note", role: "status", id: "trials-found" });
  private readonly command = new ReplayCommand();

  constructor(private readonly runs: Run[], box: HTMLElement) {
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
    return el("div", { class: "controls" },
      labelled("Search", this.search),
      this.runs.length > 1 ? labelled("Run", this.run) : null,
      labelled("Outcome", this.outcome),
      el("label", { class: "tick" }, this.onlyReplays, "with a replay page"),
      this.someUnrated ? el("label", { class: "tick" }, this.onlyRated, "in the rates") : null,
      button("Show all", "", () => this.show({})));
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
    const column = (title: string, field: string, more: Partial<ColumnDefinition>): ColumnDefinition =>
      ({ title, field, titleFormatter: headerButton(title), sorter: "string", ...more });
    const text = { formatter: "plaintext", headerSort: true, resizable: true } as const;
    const count = { hozAlign: "right", headerHozAlign: "right", sorter: "number" } as const;
    const drives = this.runs.some((run) => run.kind !== "measurement");
    return [
      column("Trial", "trial", { width: 92, ...count, ...text }),
      column("Run", "run", { visible: this.runs.length > 1, width: 220, ...text }),
      column("Outcome", "outcome", {
        ...text, formatter: (cell) => document.createTextNode(words(cell.getValue() as string)) as unknown as HTMLElement,
      }),
      column("Rates", "unrated", { visible: this.someUnrated, headerSortStartingDir: "desc", width: 140, ...text }),
      column("Replay", "replay", {
        visible: drives, headerSortStartingDir: "desc", width: 118,
        formatter: (cell) => replayCell(cell.getData() as TrialRow, this.runs, this.command),
      }),
      ...this.columns.map(({ name, unit }) => column(columnLabel(name, unit), fieldOf(name), {
        visible: shown.has(name), width: VALUE_WIDTH, ...count, sorterParams: { alignEmptyValues: "bottom" },
        formatter: numberFormatter(this.rows, fieldOf(name)),
      })),
      column("Detail", "detail", { minWidth: 220, ...text }),
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

// ---- A trial's replay: the link of its page, or the command that writes it.

/** The line that shows a command, with a button that copies it. */
class ReplayCommand {
  private readonly code = el("code");
  private readonly copy = button("Copy", "", () => void this.toClipboard());
  readonly element = el("div", { class: "replay-command", role: "status", hidden: true },
    el("span", {}, "This trial's page is written by"), this.code, this.copy, button("Close", "", () => (this.element.hidden = true)));

  constructor() {
    this.element.addEventListener("keydown", ({ key }) => {
      if (key === "Escape") this.element.hidden = true;
    });
  }

  show(command: string): void {
    this.code.textContent = command;
    this.copy.textContent = "Copy";
    this.element.hidden = false;
    this.element.scrollIntoView({ block: "nearest" });
  }

  // Where a page from disk may not use the clipboard, the text is selected: copying is one key then.
  private async toClipboard(): Promise<void> {
    try {
      await navigator.clipboard.writeText(this.code.textContent ?? "");
      this.copy.textContent = "Copied";
    } catch {
      getSelection()?.selectAllChildren(this.code);
      this.copy.textContent = "Selected";
    }
  }
}

/** What stands in the table. */
function replayCell(row: TrialRow, runs: Run[], command: ReplayCommand): HTMLElement {
  if (row.replay !== "") return el("a", { href: row.replay }, "Replay", el("span", { class: "visually-hidden" }, ` of trial ${row.trial}`));
  const run = runs[row.of];
  const text = run?.replay_command;
  // Measurements have no course to replay.
  if (!text || run.kind === "measurement") return el("span");
  return button(["Command", el("span", { class: "visually-hidden" }, ` for trial ${row.trial}`)], "",
    () => command.show(text.replaceAll("{trial}", String(row.trial))), { class: "command-button" });
}

const MOST_NAMED = 12;

/** The replay pages that are there, above the table, whose first rows may have none; null where there is none. */
function replayPages(rows: TrialRow[], several: boolean): HTMLElement | null {
  const pages = rows.filter((row) => row.replay !== "");
  if (pages.length === 0) return null;
  const links = pages.slice(0, MOST_NAMED).map((row) =>
    el("li", {}, el("a", { href: row.replay }, `${several ? `${row.run}, ` : ""}trial ${row.trial}: ${words(row.outcome)}`)));
  const more = pages.length > MOST_NAMED ? el("li", {}, `and ${pages.length - MOST_NAMED} more in the table`) : null;
  return el("div", { class: "note replay-pages" }, "Replay pages", el("ul", {}, ...links, more));
}
