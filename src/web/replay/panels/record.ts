// How the trial ended, whether this is what was stored, and all columns of its record.

import { button, el } from "../../shared/dom";
import { words } from "../../shared/format";
import { outcomeSentence } from "../../shared/outcomes";
import { recorded } from "../format";
import type { ReplayPayload } from "../payload";

// Where there is room beside the readouts, as in the style sheet.
const WIDE = "(min-width: 901px)";

const REPEATS = {
  yes: "This drive repeats the stored record bit for bit.",
  no: "This drive differs from the stored record: another build, or another machine. What is shown here is not the drive that was counted.",
  none: "There is no stored record to compare with.",
};

export function outcomeBanner({ outcome, detail, repeats_stored: repeats }: ReplayPayload): HTMLElement {
  const success = outcome === "goal_reached";
  const banner = el("div", { class: "outcome" });
  banner.append(el("strong", { class: success ? "good" : "bad" }, `${success ? "✓" : "✗"} ${words(outcome)}`));
  const sentence = outcomeSentence(outcome);
  if (sentence) banner.append(" ", sentence);
  const said = outcome === "simulator_fault" ? detail : `It ${detail}.`;
  if (detail) banner.append(" ", el("span", { class: "detail" }, `(${said})`));
  const state = repeats === null ? "none" : repeats ? "yes" : "no";
  banner.append(el("p", { class: `repeats ${state}`, role: state === "no" ? "alert" : null }, REPEATS[state]));
  return banner;
}

export function recordPanel(payload: ReplayPayload): HTMLElement {
  const body = el("tbody", {});
  const rows = payload.record.map(({ name, unit, value }) => {
    const row = el("tr", {}, el("th", { scope: "row" }, words(name)), el("td", {}, recorded(value)), el("td", {}, unit === "1" ? "" : unit));
    body.append(row);
    return { row, text: `${name} ${words(name)}` };
  });
  const find = el("input", { type: "search", placeholder: "Find a column", "aria-label": "Find a column of the record" });
  find.addEventListener("input", () => {
    const wanted = find.value.trim().toLowerCase();
    for (const { row, text } of rows) row.hidden = !text.includes(wanted);
  });
  const head = el("thead", {}, el("tr", {}, el("th", {}, "Column"), el("th", {}, "Value"), el("th", {}, "Unit")));
  return el("details", { class: "panel record", open: matchMedia(WIDE).matches },
    el("summary", {}, `Record of the trial: ${payload.record.length} columns`),
    find,
    // Scrolled by its keys, too.
    el("div", { class: "table", tabindex: 0, role: "group", "aria-label": "Columns of the record" }, el("table", {}, head, body)),
    el("p", { class: "caption" }, "6 significant digits; trials.csv of the run holds every digit."));
}

export function originPanel(payload: ReplayPayload): HTMLElement {
  const command = el("code", {}, payload.command);
  const said = el("span", { class: "said", role: "status" });
  const copy = button("Copy", "Copy the command", () => {
    navigator.clipboard?.writeText(payload.command).then(
      () => (said.textContent = "Copied."),
      () => (said.textContent = "The browser does not let this page copy."),
    );
  });
  const list = el("dl", {});
  const add = (name: string, value: string): void => list.append(el("dt", {}, name), el("dd", {}, value));
  add("scenario", payload.scenario);
  if (payload.cell) add("cell", payload.cell);
  add("seed", `${payload.seed}`);
  add("trial", `${payload.trial}`);
  add("record hash", payload.record_hash);
  for (const [name, value] of Object.entries(payload.provenance)) {
    add(words(name), typeof value === "object" ? JSON.stringify(value) : String(value));
  }
  return el("details", { class: "panel origin" },
    el("summary", {}, "Where this comes from"),
    el("p", {}, "To make this page again:"),
    el("p", { class: "command" }, command, " ", copy, said),
    list);
}
