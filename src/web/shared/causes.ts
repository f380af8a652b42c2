// Why drives end, in plain words, from an outcome and the detail that the referee writes. Each is what a
// number of drives did: "19 drove too far without coming nearer to the goal".

const BY_OUTCOME: Record<string, string> = {
  goal_reached: "reached the goal, and believed so",
  false_goal: "believed that the goal was reached, but stood too far from it",
  tip_over: "tipped over",
  high_centred: "came to rest with the belly on a rock",
  jammed: "got stuck: told to drive, but moved no further",
  no_path: "found no way on",
  energy_depleted: "ran out of energy before the goal",
  time_limit: "ran out of time before the goal",
  left_arena: "left the area that the rover has to stay in",
  simulator_fault: "ended with a fault of the simulator, which says nothing of the rover",
};

// Outcomes that have several causes.
const BY_DETAIL: Record<string, string> = {
  "drove no_path_distance_m without coming nearer": "drove too far without coming nearer to the goal",
  "turned no_path_turn_deg without coming nearer": "turned too much without coming nearer to the goal",
  "spent no_path_time_s without coming nearer": "spent too long without coming nearer to the goal",
  "the navigator gave up": "gave up: the navigator found no way on",
  "the rover noticed that it is stuck": "stopped, since the rover noticed that it was stuck",
};

/** What a drive did that ended so. */
export function causeWords(outcome: string, detail = ""): string {
  return BY_DETAIL[detail] ?? BY_OUTCOME[outcome] ?? `ended as ${outcome.replaceAll("_", " ")}`;
}
