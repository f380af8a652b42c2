// What names in the data mean, in words.

import { words } from "../shared/format";

const COLUMNS: Record<string, string> = {
  true_distance_m: "true distance",
  dead_reckoned_distance_m: "dead-reckoned distance",
  sim_time_s: "simulated time",
  energy_wh: "energy",
  net_rate_m_s: "net rate",
  net_rate: "net rate",
  distance_error_percent: "distance error",
  heading_error_deg: "heading error",
  position_error_m: "position error",
  true_goal_distance_m: "true goal distance",
};

const UNIT_ENDINGS = /(_per)?_(m_s|m2|m|s|rad|deg|percent|wh|kg|w|px|hz)$/;

/** Whether the column holds what a navigator counts for itself: "mine.replans". No other has a dot in its name. */
export function isOwnColumn(name: string): boolean { return name.includes("."); }

/** A column's name for people, without its unit; of "mine.replans" "replans (mine)". */
export function columnWords(name: string): string {
  const [navigator = "", value] = name.split(".");
  if (value !== undefined) return `${columnWords(value)} (${words(navigator)})`;
  return COLUMNS[name] ?? words(name.replace(UNIT_ENDINGS, ""));
}

/** The same with the unit in brackets. */
export function columnLabel(name: string, unit: string): string {
  const shown = unit === "" || unit === "1" ? "" : ` [${unitText(unit)}]`;
  return columnWords(name) + shown;
}

/** Units as they are printed. */
export function unitText(unit: string): string {
  return unit.replace("m2", "m²").replace("m3", "m³").replace(/\bdeg\b/, "°");
}

const METHODS: Record<string, string> = {
  wilson: "Wilson",
  clopper_pearson: "Clopper-Pearson",
  clopper_pearson_stopped: "Clopper-Pearson, for trials that their half-width ends",
  clustered: "Clopper-Pearson, of as many independent trials as say as much",
};

export function methodName(method: unknown): string {
  return typeof method === "string" ? (METHODS[method] ?? method) : "unnamed";
}

/** Of runs where several trials drive over the same rocks. */
export const SHARED_LAYOUTS = "Trials share layouts of rocks: intervals allow for it, medians have none.";

interface VerdictWords { mark: string; tone: "good" | "bad" | "unsure" | "none"; meaning: string }

const VERDICTS: Record<string, VerdictWords> = {
  agrees: { mark: "✓", tone: "good", meaning: "not rejected, and enough published runs to have noticed a difference" },
  holds: { mark: "=", tone: "none", meaning: "a bound or arithmetic that any simulation meets: it says nothing of this one" },
  differs: { mark: "✗", tone: "bad", meaning: "the simulation and the published runs do not follow one law; of counts, if their rock layouts are independent" },
  underpowered: { mark: "?", tone: "unsure", meaning: "not rejected, but too few published runs to tell" },
  "not judged": { mark: "·", tone: "none", meaning: "no number to judge by, or no simulated trials" },
};

// Measured numbers are judged by a tolerance, not by a test.
const BY_TOLERANCE: Record<string, string> = {
  agrees: "the interval of the simulated value lies inside of the tolerance of the published one",
  differs: "the simulated or computed value lies apart from the tolerance",
  underpowered: "the interval lies across an end of the tolerance: too few trials to tell",
};

export function verdictWords(verdict: string, byTolerance = false): VerdictWords {
  const known = VERDICTS[words(verdict)] ?? { mark: "·", tone: "none", meaning: "" };
  return { ...known, meaning: (byTolerance && BY_TOLERANCE[words(verdict)]) || known.meaning };
}
