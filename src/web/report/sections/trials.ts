// The section of the trial table: it is made when the page is scrolled near it, or a chart asks for it.

import { el } from "../../shared/dom";
import type { Context, TrialQuery } from "../context";
import { partOfTrials } from "../prefix";
import { TrialTableView } from "../trial_table";
import type { Section } from "./section";

export const trials: Section = {
  id: "trials",
  title: "Trials",
  short: "Trials",
  render: (context: Context) => {
    if (!context.runs.some((run) => (run.trials?.trial ?? []).length > 0)) return null;
    const box = el("div", { class: "trial-section" });
    let view: TrialTableView | null = null;
    const open = () => (view ??= new TrialTableView(context.runs, box));
    const observer = new IntersectionObserver(
      (entries) => {
        if (!entries.some((entry) => entry.isIntersecting)) return;
        observer.disconnect();
        open();
      },
      { rootMargin: "600px" },
    );
    observer.observe(box);
    // On paper: its first rows.
    addEventListener("beforeprint", open);
    context.showTrials = (query: TrialQuery) => {
      open().show(query);
      document.getElementById("trials")?.scrollIntoView();
    };
    const part = partOfTrials(context.runs, "The table holds");
    return [...(part ? [el("p", { class: "note", id: "trials-part" }, part)] : []), box, el("p", { class: "note print-only" }, "Every trial is in trials.csv of its run's folder.")];
  },
};
