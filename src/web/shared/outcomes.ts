// How trials end, in a sentence each.

const SENTENCES: Record<string, string> = {
  goal_reached: "It reached the goal, and believed so.",
  false_goal: "It believed that it was at the goal, but was not.",
  tip_over: "It tipped over.",
  high_centred: "Its belly came to rest on a rock.",
  jammed: "Its wheels were told to turn, but it moved no further.",
  no_path: "It found no way on.",
  energy_depleted: "Its batteries were empty before it arrived.",
  time_limit: "It ran out of time before it arrived.",
  left_arena: "It left the area that it had to stay in.",
  simulator_fault: "The simulator failed; this says nothing of the rover and is in no rate.",
  measured: "It was measured.",
};

// What the referee writes names the setting that decided.
const DETAILS: Record<string, string> = {
  "drove no_path_distance_m without coming nearer": "it drove for too long without coming nearer to the goal: no_path_distance_m",
  "turned no_path_turn_deg without coming nearer": "it turned for too long without coming nearer to the goal: no_path_turn_deg",
  "spent no_path_time_s without coming nearer": "it came no nearer to the goal for too long: no_path_time_s",
  "arrived within goal_radius_m": "within goal_radius_m of the goal",
  "believed to have arrived outside goal_radius_m": "further from the goal than goal_radius_m",
};

/** The detail of an outcome as a person would say it; the name of a setting stays, to be looked up. */
export function detailSentence(detail: string): string {
  return DETAILS[detail] ?? detail;
}

/** What an outcome means; "" of one that is not known. */
export function outcomeSentence(outcome: string): string {
  return SENTENCES[outcome] ?? "";
}
