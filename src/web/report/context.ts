// What the sections share: the data, which runs the charts show, and what the table of trials is asked.

import type { ReportPayload, Run } from "./payload";

/** As many runs as there are colours, marks and dashes that can be told apart. */
export const MOST_SHOWN = 6;

export interface ShownRun {
  run: Run;
  index: number;
  /** Which colour, mark and dash: 0 to MOST_SHOWN - 1; a run keeps its own while it is shown. */
  slot: number;
}

/** What a chart asks the table of trials to show. */
export interface TrialQuery {
  run?: string; outcome?: string;
  /** Only trials that are in the rates. */
  onlyRated?: boolean;
}

type Listener = () => void;

export class Context {
  /** Index of a run to its slot. */
  private slots = new Map<number, number>();
  private listeners: Listener[] = [];
  /** Set by the section of trials; does nothing without it. */
  showTrials: (query: TrialQuery) => void = () => {};
  readonly runs = this.payload.runs ?? [];

  constructor(readonly payload: ReportPayload) {
    for (const index of spread(this.runs.length, MOST_SHOWN)) this.slots.set(index, this.slots.size);
  }

  shown(): ShownRun[] {
    return [...this.slots.entries()]
      .map(([index, slot]) => ({ run: this.runs[index]!, index, slot }))
      .sort((a, b) => a.index - b.index);
  }

  drives(): ShownRun[] { return this.shown().filter((each) => each.run.kind !== "measurement"); }

  isShown(index: number): boolean { return this.slots.has(index); }

  full(): boolean { return this.slots.size >= MOST_SHOWN; }

  setShown(index: number, shown: boolean): void {
    if (shown && !this.full()) this.slots.set(index, this.freeSlot());
    if (!shown) this.slots.delete(index);
    for (const listener of this.listeners) listener();
  }

  onChange(listener: Listener): void { this.listeners.push(listener); }

  private freeSlot(): number {
    const taken = new Set(this.slots.values());
    let slot = 0;
    while (taken.has(slot)) ++slot;
    return slot;
  }
}

/** At most `most` of the indices 0 to n - 1, evenly spread, both ends included. */
function spread(n: number, most: number): number[] {
  if (n <= most) return Array.from({ length: n }, (_, i) => i);
  return Array.from({ length: most }, (_, i) => Math.round((i * (n - 1)) / (most - 1)));
}

// ---- Cells of a sweep differ in few parameters: the data holds the others once.

/** The same data with every parameter in every run, in the order of the run that has them all. */
export function withParameters(payload: ReportPayload): ReportPayload {
  const runs = payload.runs?.map((run) => {
    const base = payload.runs[run.parameters_as ?? -1];
    if (!base) return run;
    const own = new Map(run.parameters.map((each) => [each.path, each]));
    return { ...run, parameters: base.parameters.map((each) => own.get(each.path) ?? each) };
  });
  return { ...payload, runs };
}
