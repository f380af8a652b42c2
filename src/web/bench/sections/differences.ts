// Entries on the axis of scores; bars join those that are not told apart (Demsar 2006, J. Machine Learning Research 7,
// figure 1, with simultaneous intervals of paired differences in place of ranks).

import { el, svg } from "../../shared/dom";
import { percent, percentInterval } from "../../shared/format";
import { numeric, numericHeads, rowHeader, table } from "../../shared/table";
import type { BenchPayload, Entry } from "../payload";

/** The largest sets of entries none of which is told from another, two or more each, by place (Bron and Kerbosch 1973). */
export function together(entries: Pick<Entry, "name" | "not_told_from">[]): number[][] {
  const near = entries.map(({ not_told_from: names }) => new Set(names.map((name) => entries.findIndex((each) => each.name === name))));
  const found: number[][] = [];
  const grow = (chosen: number[], open: number[], done: number[]): void => {
    if (open.length === 0 && done.length === 0 && chosen.length > 1) found.push(chosen);
    for (const [i, place] of open.entries()) {
      const beside = (of: number) => near[place]!.has(of);
      grow([...chosen, place], open.slice(i + 1).filter(beside), [...done, ...open.slice(0, i)].filter(beside));
    }
  };
  grow([], entries.map((_, i) => i), []);
  return found;
}

const ROW = 26;
const TOP = 26;
const BAR = 14;

function drawing(data: BenchPayload, width: number): SVGElement {
  const { entries } = data;
  const groups = together(entries);
  const labels = Math.min(0.4 * width, 10 + 7 * Math.max(...entries.map(({ name }) => name.length)));
  const right = width - BAR * (groups.length + 1);
  const low = Math.floor(10 * Math.min(...entries.map(({ score }) => score.low ?? 0))) / 10;
  const high = Math.max(low + 0.1, Math.ceil(10 * Math.max(...entries.map(({ score }) => score.high ?? 1))) / 10);
  const x = (share: number) => labels + ((right - labels) * (share - low)) / (high - low);
  const y = (i: number) => TOP + ROW * (i + 0.5);
  const bottom = TOP + ROW * entries.length;
  const picture = svg("svg", { width, height: bottom + 6, viewBox: `0 0 ${width} ${bottom + 6}` });
  const step = high - low > 0.45 ? 0.2 : 0.1;
  for (let share = low; share <= high + 1e-9; share += step) {
    picture.append(
      svg("line", { class: "cd-grid", x1: x(share), x2: x(share), y1: TOP, y2: bottom }),
      svg("text", { class: "cd-tick", x: x(share), y: TOP - 8, "text-anchor": "middle" }, `${Math.round(100 * share)} %`));
  }
  entries.forEach(({ name, score }, i) => {
    const text = svg("text", { class: "cd-name", x: labels - 10, y: y(i) + 4, "text-anchor": "end" }, name);
    if (7 * name.length > labels - 10) text.setAttribute("textLength", String(labels - 12));
    picture.append(text,
      svg("line", { class: "cd-interval", x1: x(score.low ?? low), x2: x(score.high ?? high), y1: y(i), y2: y(i) }),
      svg("circle", { class: "cd-score", cx: x(score.value ?? low), cy: y(i), r: 5 }));
  });
  groups.forEach((group, g) => {
    const at = right + BAR * (g + 1);
    picture.append(svg("line", { class: "cd-bar", x1: at, x2: at, y1: y(group[0]!), y2: y(group.at(-1)!) }),
      ...group.map((i) => svg("circle", { class: "cd-member", cx: at, cy: y(i), r: 4 })));
  });
  return picture;
}

/** The chart's parts, for chartFigure. */
export function differences(data: BenchPayload) {
  const names = (group: number[]) => group.map((i) => data.entries[i]!.name).join(", ");
  const groups = together(data.entries);
  return {
    id: "critical-differences",
    title: "Scores, and who is not told apart",
    caption: "Points are scores, lines their 95 % intervals. Each bar on the right joins entries of which no two are told apart, by its dots, " +
      "when all pairs are compared at once over the same layouts (95 %, Bonferroni): paired differences tell more than overlapping lines.",
    alternative: `Scores of ${data.entries.length} entries. ${groups.length === 0 ? "All are told apart." : `Not told apart: ${groups.map(names).join("; ")}.`}`,
    draw: (width: number) => drawing(data, width),
    numbers: () => [table({
      caption: "Scores and who is not told from whom",
      head: ["Entry", ...numericHeads("Score", "95 % interval"), "Not told from"],
      rows: data.entries.map(({ name, score, not_told_from: others }) => [
        rowHeader(name), numeric(percent(score.value), score.value), numeric(percentInterval(score.low, score.high)), el("span", {}, others.join(", ") || "none")]),
    })],
  };
}
