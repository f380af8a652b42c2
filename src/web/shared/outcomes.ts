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
  simulator_fault: "The simulator failed; this says nothing of the rover and is in no rate.",
  measured: "It was measured.",
};

/** What an outcome means; "" of one that is not known. */
export function outcomeSentence(outcome: string): string {
  return SENTENCES[outcome] ?? "";
}
