// Times, headings and recorded numbers as text.

import { fixed } from "../shared/format";

/** 65.2 s as 1:05.2, with hours where there are any. */
export function clock(seconds: number): string {
  const tenths = Math.round(Math.max(0, seconds) * 10);
  const s = (tenths % 600) / 10;
  const minutes = Math.floor(tenths / 600);
  const text = `${s < 10 ? "0" : ""}${s.toFixed(1)}`;
  if (minutes < 60) return `${minutes}:${text}`;
  return `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}:${text}`;
}

export const degrees = (rad: number): number => (rad * 180) / Math.PI;

/** In (-180, 180], as people read a heading. */
export function headingText(rad: number): string {
  const wrapped = degrees(Math.atan2(Math.sin(rad), Math.cos(rad)));
  return `${fixed(wrapped, 1)}°`;
}

/** A number of a record: 6 significant digits, whole ones as they are. */
export function recorded(value: number | null): string {
  if (value === null) return "undefined";
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return String(value).replace("-", "−");
  return String(Number(value.toPrecision(6))).replace("-", "−");
}
