// Small drawings inside tables.

import { el } from "../../shared/dom";
import { isNumber, percent, percentInterval, type Maybe } from "../../shared/format";

const place = (share: number) => `${(100 * Math.min(1, Math.max(0, share))).toFixed(2)}%`;

/** A rate and its interval on a scale from 0 to 100 %. */
export function rateBar(rate: Maybe, low: Maybe, high: Maybe): HTMLElement {
  const bar = el("span", {
    class: "rate-bar",
    role: "img",
    "aria-label": `${percent(rate)}, 95 % interval ${percentInterval(low, high)}`,
  });
  if (isNumber(low) && isNumber(high)) {
    bar.append(el("span", { class: "rate-interval", style: `left:${place(low)};width:${place(high - low)}` }));
  }
  if (isNumber(rate)) bar.append(el("span", { class: "rate-point", style: `left:${place(rate)}` }));
  return bar;
}

/** Where the published value lies against the predicted interval; each row has its own scale. */
export function predictionBar(published: Maybe, median: Maybe, low: Maybe, high: Maybe): HTMLElement | null {
  if (!isNumber(published) || !isNumber(low) || !isNumber(high)) return null;
  const from = Math.min(published, low);
  const width = Math.max(published, high) - from;
  if (width <= 0) return null;
  const at = (value: number) => place(0.06 + (0.88 * (value - from)) / width);
  const inside = published >= low && published <= high;
  const bar = el("span", {
    class: "prediction-bar",
    role: "img",
    "aria-label": inside ? "published value inside of the predicted interval" : "published value outside of the predicted interval",
  });
  bar.append(el("span", { class: "rate-interval", style: `left:${at(low)};width:${place((0.88 * (high - low)) / width)}` }));
  if (isNumber(median)) bar.append(el("span", { class: "rate-point", style: `left:${at(median)}` }));
  bar.append(el("span", { class: "published-point", style: `left:${at(published)}` }));
  return bar;
}
