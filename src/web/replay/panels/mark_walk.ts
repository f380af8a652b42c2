// Walking along the marks of the time line by keys: left and right along a row, up and down between
// rows. One stop of the Tab key for all marks.
import type { TrialEvent } from "../payload";

export interface Mark {
  event: TrialEvent;
  element: SVGGElement;
}

/** Makes the first mark the one that the Tab key stops at. */
export function startWalk(marks: Mark[]): void {
  marks[0]?.element.setAttribute("tabindex", "0");
}

/** Goes where the key says; true where it was a key of the walk. */
export function walk(marks: Mark[], key: string, go: (event: TrialEvent) => void): boolean {
  const at = marks.findIndex(({ element }) => element === document.activeElement);
  const here = marks[at];
  if (!here) return false;
  const goal = next(marks, at, key);
  if (goal) {
    here.element.setAttribute("tabindex", "-1");
    goal.element.setAttribute("tabindex", "0");
    goal.element.focus();
    go(goal.event);
  } else if (key === "Enter" || key === " ") {
    go(here.event);
  } else {
    return false;
  }
  return true;
}

function next(marks: Mark[], at: number, key: string): Mark | null {
  const { kind, t } = marks[at]!.event;
  if (key === "ArrowRight" || key === "ArrowLeft") {
    const other = marks[at + (key === "ArrowRight" ? 1 : -1)];
    return other?.event.kind === kind ? other : null;
  }
  if (key !== "ArrowDown" && key !== "ArrowUp") return null;
  const rows = [...new Set(marks.map(({ event }) => event.kind))];
  const row = rows[rows.indexOf(kind) + (key === "ArrowDown" ? 1 : -1)];
  const away = (mark: Mark): number => Math.abs(mark.event.t - t);
  return marks.filter(({ event }) => event.kind === row).sort((a, b) => away(a) - away(b))[0] ?? null;
}
