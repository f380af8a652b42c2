// Tracks and ends of a run's trials, by outcome.

import { trackLines, type Place, type PlanLayer } from "./charts/plan";
import type { Run, Track } from "./payload";

/** The outcome of a trial; "" where the page does not hold it. */
export function outcomeOf(run: Run, trial: number): string {
  const row = rowOf(run, trial);
  return row < 0 ? "" : (run.trials.outcome_names[run.trials.outcome[row]!] ?? "");
}

/** The detail of a trial's outcome. */
export function detailOf(run: Run, trial: number): string {
  const row = rowOf(run, trial);
  return row < 0 ? "" : (run.trials.detail_texts[run.trials.detail[row]!] ?? "");
}

export function valueOf(run: Run, trial: number, column: string): number | null {
  const row = rowOf(run, trial);
  return run.trials?.columns?.find(({ name }) => name === column)?.values[row] ?? null;
}

const rows = new WeakMap<Run, Map<number, number>>();

function rowOf(run: Run, trial: number): number {
  let known = rows.get(run);
  if (!known) {
    known = new Map((run.trials?.trial ?? []).map((each, row) => [each, row]));
    rows.set(run, known);
  }
  return known.get(trial) ?? -1;
}

export const trackOf = (run: Run, trial: number): Track | undefined => (run.tracks ?? []).find((track) => track.trial === trial);

/** Where every trial that the page holds truly ended, by outcome. */
function endsOf(run: Run): Map<string, Place[]> {
  const column = (wanted: string) => run.trials?.columns?.find(({ name }) => name === wanted)?.values ?? [];
  const [x, y] = [column("final_x_m"), column("final_y_m")];
  const ends = new Map<string, Place[]>();
  (run.trials?.outcome ?? []).forEach((index, row) => {
    const outcome = run.trials.outcome_names[index]!;
    if (x[row] == null || y[row] == null) return;
    if (!ends.has(outcome)) ends.set(outcome, []);
    ends.get(outcome)!.push([x[row]!, y[row]!]);
  });
  return ends;
}

/** The commonest outcome first, so that the rare ones lie above it. */
export function layersOf(run: Run): PlanLayer[] {
  const layers = [...endsOf(run)].map(([outcome, ends]): PlanLayer => ({ outcome, ends, lines: [] }));
  for (const track of run.tracks ?? []) {
    layers.find(({ outcome }) => outcome === outcomeOf(run, track.trial))?.lines.push(...trackLines(track));
  }
  return layers.sort((a, b) => b.ends.length - a.ends.length);
}
