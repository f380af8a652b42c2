// Numbers as text. A missing number is a dash.

export const MISSING = "–";
// Keeps a number and its unit on one line.
const SPACE = "\u00a0";

export type Maybe = number | null | undefined;

export function isNumber(value: unknown): value is number {
  return typeof value === "number" && Number.isFinite(value);
}

/** `digits` significant digits, grouped by thousands; very small and very large ones by powers of ten. */
export function number(value: Maybe, digits = 4): string {
  if (!isNumber(value)) return MISSING;
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e9) return powerOfTen(value, digits);
  // Whole numbers are counts: shown in full.
  if (Number.isInteger(value)) return sign(value.toLocaleString("en-US"));
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return sign(
    value.toLocaleString("en-US", { maximumFractionDigits: Math.min(decimals, 12) }),
  );
}

function powerOfTen(value: number, digits: number): string {
  const [mantissa, exponent] = value.toExponential(Math.max(0, digits - 2)).split("e");
  return sign(`${mantissa}e${Number(exponent)}`);
}

// A minus as wide as a digit.
const sign = (text: string) => text.replace(/^-/, "−");

/** With as many decimals as are asked for. */
export function fixed(value: Maybe, decimals: number): string {
  if (!isNumber(value)) return MISSING;
  return sign(value.toLocaleString("en-US", { minimumFractionDigits: decimals, maximumFractionDigits: decimals }));
}

// Rare events keep their digits: 0.0004 is 0.04 %, not 0.0 %.
const decimalsOf = (rate: number, decimals: number) => (rate !== 0 && Math.abs(rate) < 0.005 ? 3 : decimals);

/** 0.9 as "90.0 %". */
export function percent(rate: Maybe, atLeast = 1): string {
  const decimals = isNumber(rate) ? decimalsOf(rate, atLeast) : atLeast;
  return isNumber(rate) ? `${sign((100 * rate).toFixed(decimals))}${SPACE}%` : MISSING;
}

/** [0.7, 0.97] as "69.9 to 97.2 %". */
export function percentInterval(low: Maybe, high: Maybe, atLeast = 1): string {
  if (!isNumber(low) || !isNumber(high)) return MISSING;
  const decimals = decimalsOf(high, atLeast);
  return `${sign((100 * low).toFixed(decimals))} to ${sign((100 * high).toFixed(decimals))}${SPACE}%`;
}

export function interval(low: Maybe, high: Maybe, digits = 3): string {
  if (!isNumber(low) || !isNumber(high)) return MISSING;
  return `${number(low, digits)} to ${number(high, digits)}`;
}

/** p-values: three decimals, "< 0.001" below. */
export function pValue(p: Maybe): string {
  if (!isNumber(p)) return MISSING;
  return p < 0.001 ? "< 0.001" : p.toFixed(3);
}

/** "1 trial", "2 trials". */
export function counted(count: number, noun: string): string {
  return `${number(count)} ${noun}${count === 1 ? "" : "s"}`;
}
