// The data of a replay as an MCAP file, which Foxglove, Lichtblick and other readers open.
import { readFile, rename, rm, writeFile } from "node:fs/promises";
import path from "node:path";
import { parseArgs } from "node:util";
import { asReplay } from "./check";
import { mcapOf } from "./mcap_file";

const USAGE = `usage: trace_to_mcap.mjs TRIAL.json [--out TRIAL.mcap]

TRIAL.json is what \`rockyard replay RUN --trial I --data TRIAL.json\` writes.`;

// As rockyard itself exits.
const BAD_INPUT = 2;
const FAILED = 5;

/** What the user can mend. */
class UserError extends Error {}

const messageOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));

async function orUserError<T>(what: string, attempt: () => T | Promise<T>): Promise<T> {
  try {
    return await attempt();
  } catch (error) {
    throw new UserError(`${what}: ${messageOf(error)}`);
  }
}

function readArguments(): { input: string; out: string } | null {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { out: { type: "string" }, help: { type: "boolean", short: "h" } },
  });
  if (values.help) return null;
  const [input, ...others] = positionals;
  if (!input || others.length > 0) throw new Error(`name one file of replay data\n${USAGE}`);
  const { dir, name } = path.parse(input);
  const out = values.out ?? path.join(dir, `${name}.mcap`);
  if (path.resolve(out) === path.resolve(input)) throw new Error("--out would replace the data that it is made of");
  return { input, out };
}

/** Whole or not at all. */
async function writeWhole(file: string, bytes: Uint8Array): Promise<void> {
  const temporary = `${file}.${process.pid}.tmp`;
  try {
    await writeFile(temporary, bytes);
    await rename(temporary, file);
  } finally {
    await rm(temporary, { force: true });
  }
}

async function main(): Promise<void> {
  const wanted = await orUserError("arguments", readArguments);
  if (!wanted) {
    console.log(USAGE);
    return;
  }
  const { input, out } = wanted;
  const replay = await orUserError(input, async () => asReplay(JSON.parse(await readFile(input, "utf8"))));
  await writeWhole(out, await mcapOf(replay));
  console.log(`  ${replay.title.replace(/\p{Cc}/gu, " ")}\n  trace in ${out}`);
}

main().catch((error: unknown) => {
  console.error(`error: ${messageOf(error)}`);
  process.exitCode = error instanceof UserError ? BAD_INPUT : FAILED;
});
