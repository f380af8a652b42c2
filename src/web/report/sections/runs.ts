// Which runs the charts show, where there are several.

import { breakable, el } from "../../shared/dom";
import { MOST_SHOWN, type Context } from "../context";
import { seriesStyle, swatch } from "../series";

/** The choice of runs; null where there is no choice. */
export function runPicker(context: Context): HTMLElement | null {
  if (context.runs.length < 2) return null;
  const boxes = context.runs.map((run, index) => {
    const box = el("input", { type: "checkbox", value: index });
    const mark = el("span", { class: "picker-mark" });
    box.addEventListener("change", () => context.setShown(index, box.checked));
    return { run, index, box, mark };
  });
  const update = () => {
    for (const { index, box, mark } of boxes) {
      const shown = context.shown().find((each) => each.index === index);
      box.checked = shown !== undefined;
      box.disabled = !shown && context.full();
      mark.replaceChildren(...(shown ? [swatch(shown.slot)] : []));
      mark.style.color = shown ? seriesStyle(shown.slot).colour : "";
    }
  };
  context.onChange(update);
  update();
  return el("fieldset", { class: "run-picker", id: "runs" },
    el("legend", {}, `Runs in the charts (at most ${MOST_SHOWN})`),
    el("div", { class: "picker-list" }, ...boxes.map(({ run, box, mark }) => el("label", {}, box, mark, breakable(run.label)))));
}
