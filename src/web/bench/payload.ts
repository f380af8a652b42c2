// The data of the page of a benchmark, as campaign/bench/bench_page.cc writes it. Shares are 0 to 1; what is not known
// is null.

/** A number with its interval, 95 %. */
export interface Estimated { value: number | null; low: number | null; high: number | null }

export interface Regret extends Estimated { drives: number }

/** Of one entry in a group of cells, or in a cell. */
export interface Part { name: string; arrived: number; regret: Regret }

/** Layouts of a cell in which one of two arrives and the other does not. */
export interface Split {
  cell: string;
  /** Layouts in which this entry alone arrives, and the baseline alone. */
  entry: number[]; baseline: number[];
  /** Shows both on one clock; with {trial} for the layout. */
  command: string;
}

export interface Entry {
  name: string; folder: string; navigator: string; about: string; authors: string;
  entry_digest: string; head: string;
  score: Estimated; difference: Estimated; verdict: "better" | "worse" | "tied" | "unknown";
  best_rank: number; worst_rank: number;
  /** Entries that are not told from this one where all pairs are compared at once. */
  not_told_from: string[];
  declared: number; unsafe: number; passes_gate: boolean; scraped: number;
  regret: Regret;
  way_ratio: number | null; time_ratio: number | null; energy_ratio: number | null;
  ends: Record<string, number>;
  /** Arrivals by limit of patience, as BenchPayload.patience_m. */
  within: number[];
  groups: Part[]; cells: Part[];
  splits: Split[];
}

export interface BenchPayload {
  title: string; suite: string; layouts: number; seed: string; beacon: string; build: string; command: string;
  baseline: string; why_no_regret: string;
  patience_m: number[];
  /** The best score first. */
  entries: Entry[];
}
