// A trial's replay: the link of its page, or the command that writes it.

import { el } from "../shared/dom";
import { words } from "../shared/format";
import type { Run } from "./payload";
import type { TrialRow } from "./trial_rows";

/** The line that shows a command, with a button that copies it. */
export class ReplayCommand {
  private readonly code = el("code");
  private readonly copy = el("button", { type: "button" }, "Copy");
  private readonly close = el("button", { type: "button" }, "Close");
  readonly element = el("div", { class: "replay-command", role: "status", hidden: true },
    el("span", {}, "This trial's page is written by"), this.code, this.copy, this.close);

  constructor() {
    this.copy.addEventListener("click", () => void this.toClipboard());
    this.close.addEventListener("click", () => (this.element.hidden = true));
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
export function replayCell(row: TrialRow, runs: Run[], command: ReplayCommand): HTMLElement {
  if (row.replay !== "") return el("a", { href: row.replay }, "Replay", el("span", { class: "visually-hidden" }, ` of trial ${row.trial}`));
  const run = runs[row.of];
  const text = run?.replay_command;
  // Measurements have no course to replay.
  if (!text || run.kind === "measurement") return el("span");
  const button = el("button", { type: "button", class: "command-button" }, "Command",
    el("span", { class: "visually-hidden" }, ` for trial ${row.trial}`));
  button.addEventListener("click", () => command.show(text.replaceAll("{trial}", String(row.trial))));
  return button;
}

const MOST_NAMED = 12;

/** The replay pages that are there, above the table, whose first rows may have none; null where there is none. */
export function replayPages(rows: TrialRow[], several: boolean): HTMLElement | null {
  const pages = rows.filter((row) => row.replay !== "");
  if (pages.length === 0) return null;
  const links = pages.slice(0, MOST_NAMED).map((row) =>
    el("li", {}, el("a", { href: row.replay }, `${several ? `${row.run}, ` : ""}trial ${row.trial}: ${words(row.outcome)}`)));
  const more = pages.length > MOST_NAMED ? el("li", {}, `and ${pages.length - MOST_NAMED} more in the table`) : null;
  return el("div", { class: "note replay-pages" }, "Replay pages", el("ul", {}, ...links, more));
}
