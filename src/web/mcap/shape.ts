// What a JSON value must look like, and what about it does not.

/** "number" is finite; a list of one is a list of such; an object is an object with these members. */
export type Shape =
  | "number"
  | "number?"
  | "text"
  | "boolean"
  | "any"
  | readonly [Shape]
  | { readonly [member: string]: Shape };

const isObject = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);

const LEAVES: Record<string, { test: (value: unknown) => boolean; words: string }> = {
  number: { test: Number.isFinite, words: "a number" },
  "number?": { test: (value) => value === null || Number.isFinite(value), words: "a number or null" },
  text: { test: (value) => typeof value === "string", words: "text" },
  boolean: { test: (value) => typeof value === "boolean", words: "true or false" },
  any: { test: (value) => value !== undefined, words: "there" },
};

/** The first place in `value` that differs from `shape`, in words; null where there is none. */
export function mismatch(value: unknown, shape: Shape, path = ""): string | null {
  if (typeof shape === "string") {
    const { test, words } = LEAVES[shape]!;
    return test(value) ? null : `${path || "the file"} must be ${words}`;
  }
  if (Array.isArray(shape)) {
    if (!Array.isArray(value)) return `${path} must be a list`;
    return first(value, (entry, i) => mismatch(entry, shape[0] as Shape, `${path}[${i}]`));
  }
  if (!isObject(value)) return `${path || "the file"} must be an object`;
  return first(Object.entries(shape), ([name, of]) => mismatch(value[name], of, path ? `${path}.${name}` : name));
}

/** The first answer of `ask` that is not null. */
export function first<T>(values: readonly T[], ask: (value: T, index: number) => string | null): string | null {
  for (let i = 0; i < values.length; ++i) {
    const answer = ask(values[i]!, i);
    if (answer !== null) return answer;
  }
  return null;
}
