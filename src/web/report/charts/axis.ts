// What the charts over a measured quantity share: labelled values on their axis and the steps of it.

/** A labelled value on the axis. */
export interface Mark {
  x: number;
  label: string;
}

/** The nearest step that is 1, 2 or 5 times a power of ten. */
export function niceStep(raw: number): number {
  const power = 10 ** Math.floor(Math.log10(raw));
  const lead = raw / power;
  return power * (lead < 1.4 ? 1 : lead < 3.2 ? 2 : lead < 7 ? 5 : 10);
}
