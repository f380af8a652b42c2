// Drives of the same layout by two entries of which one arrives: the command that shows both on one clock.

import { button, type Child, el } from "../../shared/dom";
import { counted } from "../../shared/format";
import { rowHeader, table } from "../../shared/table";
import type { BenchPayload, Entry, Split } from "../payload";

const count = (splits: Split[], of: "entry" | "baseline") => splits.reduce((sum, split) => sum + split[of].length, 0);
const first = (split: Split) => split.entry[0] ?? split.baseline[0]!;

function layouts(numbers: number[], split: Split, who: string, show: (split: Split, trial: number) => void): HTMLElement {
  if (numbers.length === 0) return el("span", {}, "none");
  return el("span", { class: "layouts" }, ...numbers.map((trial) =>
    button(String(trial), `${split.cell}, layout ${trial}: ${who} alone arrives`, () => show(split, trial), { "aria-label": `${split.cell}, layout ${trial}` })));
}

function pair(entry: Entry, data: BenchPayload): HTMLElement {
  const { splits } = entry;
  const command = el("code", {});
  const show = (split: Split, trial: number) => { command.textContent = split.command.replace("{trial}", String(trial)); };
  show(splits[0]!, first(splits[0]!));
  const details = el("details", { class: "split", id: `split-${entry.name}` },
    el("summary", {}, `${entry.name}: arrives in ${counted(count(splits, "entry"), "drive")} in which ${data.baseline} does not, ` +
      `and fails in ${count(splits, "baseline")} in which ${data.baseline} arrives`));
  // Hundreds of buttons: made when they are asked for.
  details.addEventListener("toggle", () => {
    if (details.childElementCount > 1) return;
    details.append(
      el("pre", { class: "split-command", "aria-live": "polite" }, command),
      table({
        caption: `Layouts that part ${entry.name} and ${data.baseline}`, className: "compact", tall: true,
        head: ["Cell", `${entry.name} alone arrives`, `${data.baseline} alone arrives`],
        rows: splits.map((split) => [
          rowHeader(split.cell), layouts(split.entry, split, entry.name, show), layouts(split.baseline, split, data.baseline, show)]),
      }));
  });
  return details;
}

export function replays(data: BenchPayload): Child[] | null {
  const parted = data.entries.filter(({ splits }) => splits.length > 0);
  if (parted.length === 0) return null;
  return [
    el("p", { class: "note" }, "The command drives one layout again by the kept runs and writes a page with both drives on one clock, the entry first. " +
      "Choose a layout for its command; it runs where the folders of the runs are."),
    ...parted.map((entry) => pair(entry, data)),
  ];
}
