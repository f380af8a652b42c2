// Numbers and names in words.

/** 65.2 s as 1:05.2, with hours where there are any. */
export function clock(seconds: number): string {
  const tenths = Math.round(Math.max(0, seconds) * 10);
  const s = (tenths % 600) / 10;
  const minutes = Math.floor(tenths / 600);
  const text = `${s < 10 ? "0" : ""}${s.toFixed(1)}`;
  if (minutes < 60) return `${minutes}:${text}`;
  return `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}:${text}`;
}

export const degrees = (rad: number): number => (rad * 180) / Math.PI;

/** In (-180, 180], as people read a heading. */
export function headingText(rad: number): string {
  const wrapped = degrees(Math.atan2(Math.sin(rad), Math.cos(rad)));
  return `${fixed(wrapped, 1)}°`;
}

export function fixed(value: number, digits: number): string {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}

/** A number of a record: 6 significant digits, whole ones as they are. */
export function recorded(value: number | null): string {
  if (value === null) return "undefined";
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return String(value).replace("-", "−");
  return String(Number(value.toPrecision(6))).replace("-", "−");
}

const OUTCOMES: Record<string, string> = {
  goal_reached: "It reached the goal, and believed so.",
  false_goal: "It believed that it was at the goal, but was not.",
  tip_over: "It tipped over.",
  high_centred: "Its belly came to rest on a rock.",
  jammed: "It got jammed and could move no further.",
  no_path: "It found no way on.",
  energy_depleted: "Its batteries were empty before it arrived.",
  time_limit: "It ran out of time before it arrived.",
  left_arena: "It left the area that it had to stay in.",
  simulator_fault: "The simulator failed; this says nothing of the rover.",
};

export function outcomeSentence(outcome: string): string {
  return OUTCOMES[outcome] ?? "";
}

export const spaced = (name: string): string => name.replaceAll("_", " ");
