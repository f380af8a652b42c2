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
  return sign(value.toLocaleString("en-US", { maximumFractionDigits: Math.min(decimals, 12) }));
}

function powerOfTen(value: number, digits: number): string {
  const [mantissa, exponent] = value.toExponential(Math.max(0, digits - 2)).split("e");
  return sign(`${mantissa}e${Number(exponent)}`);
}

// A minus as wide as a digit; none before a zero.
const sign = (text: string) => (/[1-9]/.test(text) ? text.replace(/^-/, "−") : text.replace(/^-/, ""));

/** With as many decimals as are asked for. */
export function fixed(value: Maybe, decimals: number): string {
  if (!isNumber(value)) return MISSING;
  return sign(value.toLocaleString("en-US", { minimumFractionDigits: decimals, maximumFractionDigits: decimals }));
}

const MOST_DECIMALS = 4;

// Decimals, in per cent, with which no rate becomes 0 or 100 % that is neither: those of the one that
// comes nearest to an end of the scale.
function decimalsOf(rates: number[], atLeast: number): number {
  const apart = rates.flatMap((rate) => [Math.abs(rate), Math.abs(1 - Math.abs(rate))]).filter((each) => each > 0);
  if (apart.length === 0) return atLeast;
  // 1 - 0.999 is a little less or more than 0.001.
  const nearest = Number((100 * Math.min(...apart)).toPrecision(6));
  return Math.min(MOST_DECIMALS, Math.max(atLeast, -Math.floor(Math.log10(nearest))));
}

// A rate in per cent. What is still nearer to an end than the decimals show is a bound.
function hundredfold(rate: number, decimals: number): string {
  const size = Math.abs(rate);
  const least = 10 ** -decimals;
  const side = rate < 0 ? -1 : 1;
  const shown = Number((100 * size).toFixed(decimals));
  if (shown === 0 && size > 0) return `${side < 0 ? ">" : "<"} ${sign((side * least).toFixed(decimals))}`;
  if (shown === 100 && size < 1) return `${side < 0 ? "<" : ">"} ${sign((side * (100 - least)).toFixed(decimals))}`;
  return sign((100 * rate).toFixed(decimals));
}

const unitless = (rate: Maybe, atLeast: number) => (isNumber(rate) ? hundredfold(rate, decimalsOf([rate], atLeast)) : MISSING);

/** 0.9 as "90.0 %". */
export function percent(rate: Maybe, atLeast = 1): string {
  return isNumber(rate) ? `${unitless(rate, atLeast)}${SPACE}%` : MISSING;
}

/** A difference of rates in percentage points: 0.35 as "35.0". */
export function points(difference: Maybe, atLeast = 1): string { return unitless(difference, atLeast); }

/** [-0.12, 0.001] as "−12.0 to 0.1". */
export function pointsInterval(low: Maybe, high: Maybe, atLeast = 1): string {
  if (!isNumber(low) || !isNumber(high)) return MISSING;
  const decimals = decimalsOf([low, high], atLeast);
  return `${hundredfold(low, decimals)} to ${hundredfold(high, decimals)}`;
}

/** [0.7, 0.97] as "70.0 to 97.0 %". */
export function percentInterval(low: Maybe, high: Maybe, atLeast = 1): string {
  return isNumber(low) && isNumber(high) ? `${pointsInterval(low, high, atLeast)}${SPACE}%` : MISSING;
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

/** A name of the data as words: "false_goal" as "false goal". */
export function words(name: string): string { return name.replaceAll("_", " "); }
