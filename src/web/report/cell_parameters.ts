// Cells of a sweep differ in few parameters: the data holds the others once.

import type { ReportPayload } from "./payload";

/** The same data with every parameter in every run, in the order of the run that has them all. */
export function withParameters(payload: ReportPayload): ReportPayload {
  const runs = payload.runs?.map((run) => {
    const base = payload.runs[run.parameters_as ?? -1];
    if (!base) return run;
    const own = new Map(run.parameters.map((each) => [each.path, each]));
    return { ...run, parameters: base.parameters.map((each) => own.get(each.path) ?? each) };
  });
  return { ...payload, runs };
}
