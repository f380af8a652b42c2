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
  excessive_slip: "It stopped, as its wheels were seen to slip too much.",
  navigator_fault: "Its navigator failed: the plugin or process that decides where it drives.",
  simulator_fault: "The simulator failed; this says nothing of the rover and is in no rate.",
  measured: "It was measured.",
};

/** What an outcome means; "" of one that is not known. */
export function outcomeSentence(outcome: string): string { return SENTENCES[outcome] ?? ""; }

// ---- Why drives end, in plain words, from an outcome and the detail that the referee writes. Each is what a
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
  excessive_slip: "stopped, since the wheels were seen to slip too much",
  navigator_fault: "stopped, since the navigator failed",
  simulator_fault: "ended with a fault of the simulator, which says nothing of the rover",
};

// Outcomes that have several causes, by the sentences of truth/end_cause.h.
const BY_DETAIL: Record<string, string> = {
  "sank into the soil beyond the axles of its wheels": "sank into the soil beyond the axles of the wheels",
  "found no way on and gave up": "gave up: the navigator found no way on",
  "noticed that it was stuck, and gave up": "stopped, since the rover noticed that it was stuck",
  "drove on without coming nearer to the goal until its operator ended the run":
    "drove too far without coming nearer to the goal",
  "turned in place without coming nearer to the goal until its operator ended the run":
    "turned too much without coming nearer to the goal",
  "came no nearer to the goal for so long that its operator ended the run":
    "spent too long without coming nearer to the goal",
  "stopped because its navigator reported an error": "stopped, since the navigator reported an error",
  "stopped because its navigator decided what cannot be done": "stopped, since the navigator decided what cannot be done",
  "stopped because its navigator answered with no right message": "stopped, since an answer of the navigator was no right message",
  "stopped because the process of its navigator ended": "stopped, since the process of the navigator ended",
  "stopped because its navigator crashed the process that ran it": "stopped, since the navigator crashed",
  "stopped because its navigator used more CPU time than it may": "stopped, since the navigator used more CPU time than it may",
  "stopped because its navigator used more memory than it may": "stopped, since the navigator used more memory than it may",
  "stopped because its navigator gave no answer": "stopped, since the navigator gave no answer",
};

/** What a drive did that ended so. */
export function causeWords(outcome: string, detail = ""): string {
  // What the navigator said of its fault follows the sentence.
  const sentence = outcome === "navigator_fault" ? detail.split(": ", 1)[0]! : detail;
  return BY_DETAIL[sentence] ?? BY_OUTCOME[outcome] ?? `ended as ${outcome.replaceAll("_", " ")}`;
}
