// What `rockyard report` writes into its page (report/page_data.h). Numbers are SI unless a name
// says otherwise; what is undefined is null.

export interface ReportPayload {
  version: 1;
  title: string;
  /** The command that made the page, and the program. */
  command: string;
  /** Where references with published values were looked for; "" where some run is held against one. */
  why_none_published: string;
  provenance: Record<string, unknown>;
  /** One per run folder, or per cell of a campaign. */
  runs: Run[];
  /** One per sweep folder: summary.json of the sweep, its fitted curves. */
  sweeps: Sweep[];
  /** Runs compared in pairs: the first with each other; empty for one run and within sweeps. */
  comparisons: Comparison[];
}

export interface Run {
  /** What the run goes by on the page: unique. */
  label: string;
  folder: string;
  /** Name of the cell in its campaign; "" for a run. */
  cell: string;
  /** Index in `sweeps`, or null. */
  sweep: number | null;
  kind: "drive" | "measurement";
  /** What summary.json has, by Wilson's intervals or those of a stopping rule. */
  summary: Record<string, any>;
  /** Exact in trials.csv; here 6 significant digits, and of more than 20 000 trials every k-th and those with a replay. */
  trials: TrialTable;
  /** Finished trials: more than `trials` has where that is thinned. All of them are in summary, cdf and published. */
  stored_trials: number;
  /** The trials below this number are in every rate, mean and curve of the run: those before the first that is not stored. */
  prefix_trials: number;
  /** Trials share layouts of rocks: intervals allow for it. */
  shared_layouts: boolean;
  /** How the trials of the rates ended, the commonest way first. */
  /** `limit`: patience or time was at an end, and the drive had neither arrived nor failed. */
  endings: { outcome: string; detail: string; count: number; limit?: boolean }[];
  /** What all drives share; null of a measurement, or where another version of the program made the run. */
  course: Course | null;
  /** Of each outcome the trial of median true distance, of the commonest outcome first; absent of cells of a sweep. */
  examples?: number[];
  /** True paths of trials that were driven again for the page, by number; absent of cells of a sweep. */
  tracks?: Track[];
  /** So many of them are of the run's first trials, whatever became of these; the others are of trials with a replay. */
  first_tracks?: number;
  /** distance_cdf.csv by column, thinned to at most 1000 steps (none lower by more than 1/998 of the trials); null where nothing drives. */
  cdf: Record<string, (number | null)[]> | null;
  /** Steps of distance_cdf.csv: more than `cdf` has where that is thinned. */
  cdf_steps: number;
  /** `rockyard check` against the published reference; null where it says nothing of the scenario. */
  published: PublishedTable | null;
  /** Columns that tell the cells of a measurement apart; empty for drives. */
  factors: string[];
  parameters: Parameter[];
  /** Index of an earlier run whose parameters hold here too, but for those above; null: all are above. */
  parameters_as: number | null;
  /** Replay pages that were written with the report, by trial number: links relative to the page. */
  replays: Record<string, string>;
  /** The command that writes any other; {trial} stands for the number. */
  replay_command: string;
}

export interface Course {
  /** Name of the rover; "" where it has the shape of none that is known. */
  rover: string;
  start: [number, number]; goal: [number, number];
  goal_radius_m: number;
  waypoints: [number, number][];
  /** y of the lines at which operators reflect the rover. */
  mirror_lines_m: number[];
  /** Of an elevation model: x, y, x, y ... in whole centimetres. */
  contours: { height_m: number; line_cm: number[] }[];
  contour_interval_m: number;
}

export interface Track {
  trial: number;
  /** x, y, x, y ... in whole centimetres; interrupted where operators reflected the rover. */
  pieces_cm: number[][];
  /** x, y and radius of each rock, for examples; empty of others. */
  rocks_cm: number[];
}

interface TrialTable {
  /** Finished trials in the order of their numbers, faults included. */
  trial: number[];
  /** Indices into outcome_names. */
  outcome: number[];
  outcome_names: string[];
  /** Indices into detail_texts. */
  detail: number[];
  detail_texts: string[];
  /** The records' columns; see Column. */
  columns: Column[];
}

export interface Column {
  name: string; unit: string;
  /** One sentence, as the navigator declares it; of what navigators count for themselves alone. */
  meaning?: string;
  /** One per trial. */
  values: (number | null)[];
}

export interface PublishedTable {
  reference: string; citation: string;
  /** What the verdicts mean. */
  notes: string[];
  /** In which the run differs from the scenario that the reference is about; not empty: not the published case. */
  settings: string[];
  rows: PublishedRow[];
}

export interface PublishedRow {
  id: string; what: string; unit: string;
  /** As text, the way that it was published: "39/40", ">= 7.6", "1.7". */
  published: string;
  /** The value as a number where it is one: a rate, a mean. */
  published_value: number | null;
  predicted: string;
  predicted_value: number | null;
  /** 95 % prediction interval of what as many runs would have shown. */
  predicted_low: number | null;
  predicted_high: number | null;
  /** Adjusted by Holm; null where not judged. */
  p_holm: number | null;
  power: number | null;
  verdict: string; source: string;
  /** What else is to be said of it: the kinds of failure, other readings, one layout for all. */
  remarks: string[];
}

export interface Parameter {
  path: string; value: string; unit: string;
  /** "published", "calibrated", "assumed" or "setting". */
  origin: string;
  range: string; source: string; doc: string;
}

export interface Sweep {
  label: string; folder: string;
  /** summary.json of the sweep, as it is. */
  summary: Record<string, any>;
  curves: Curve[];
}

/** Success along a numeric axis. */
export interface Curve {
  label: string; axis: string; unit: string;
  scale: "linear" | "log";
  success: "declared" | "true";
  /** One per cell. */
  points: { x: number; rate: number; low: number; high: number; trials: number; cell: string }[];
  /** The fit with its pointwise 95 % band; empty where there is none, and then why. */
  fit: { x: number; rate: number; low: number; high: number }[];
  fit_status: string;
  /** The settings scatter about the fit by more than chance, as the terminal's table says; null where that is not known. */
  fit_rejected: boolean | null;
}

export interface Comparison {
  first: string; second: string;
  paired: boolean;
  pairs: number;
  notes: string[];
  /** In which the two runs differ: values as text. */
  settings: { path: string; first: string; second: string }[];
  successes: (Differing & { what: string; p: number | null })[];
  columns: (Differing & {
    trials: "all" | "arrived";
    name: string; unit: string;
    /** Pairs, or trials of the first run where the two are not paired. */
    n: number;
    /** Of the second run; null where paired. */
    n_second: number | null;
  })[];
}

/** What both runs have, the second less the first, and the 95 % interval of that. */
interface Differing {
  first: number | null; second: number | null; difference: number | null; low: number | null; high: number | null;
}
