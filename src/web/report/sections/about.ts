// What was run: the facts of a run or of all of them.

import type { Context } from "../context";
import { pageFacts } from "./header";
import type { Section } from "./section";

export const about: Section = {
  id: "about",
  title: "What was run",
  short: "What was run",
  render: (context: Context) => (context.runs.length > 0 ? [pageFacts(context)] : null),
};
