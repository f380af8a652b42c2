// A part of the page with a heading of its own. One that cannot be drawn does not take the others
// with it.

import { el, type Child } from "../../shared/dom";
import type { Context } from "../context";

export interface Section {
  id: string; title: string;
  /** What the list of contents calls it, where that is not its title. */
  short?: string;
  /** True where the content depends on which runs are shown. */
  follows?: boolean;
  /** The content; null where the data has nothing of it. */
  render: (context: Context) => Child[] | null;
}

function contentOf(section: Section, context: Context): Child[] | null {
  try {
    return section.render(context);
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    return [el("p", { class: "problem" }, `This part could not be drawn: ${reason}.`)];
  }
}

/** The element of a section; null where there is nothing to show. */
export function sectionElement(section: Section, context: Context): HTMLElement | null {
  const content = contentOf(section, context);
  if (content === null) return null;
  const body = el("div", { class: "section-body" }, ...content);
  if (section.follows) {
    context.onChange(() => {
      const nodes = contentOf(section, context) ?? [el("p", {}, "None of the runs that are shown has this.")];
      body.replaceChildren(...nodes.filter((node): node is Node => node instanceof Node));
    });
  }
  return el("section", { id: section.id, "aria-labelledby": `${section.id}-title` },
    el("h2", { id: `${section.id}-title` }, section.title), body);
}
