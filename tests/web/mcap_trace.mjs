// What the tests of MCAP files share: trials written as such, and everything in a file read back.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { at, pagesFolder, requirePackage, rockyard, set } from "./harness.mjs";

const { McapIndexedReader } = requirePackage("@mcap/core");
const Ajv = requirePackage("ajv").default;

/** Runs the converter. */
export function convert(...args) {
  const script = path.join(pagesFolder, "pages", "trace_to_mcap.mjs");
  return spawnSync(process.execPath, [script, ...args], { encoding: "utf8" });
}

/** Writes `out`, which must succeed. */
export function converted(input, out) {
  const { status, stderr } = convert(input, "--out", out);
  assert.equal(status, 0, stderr);
  return out;
}

const read = (file) => JSON.parse(readFileSync(file, "utf8"));

/** Replay data with a change, as another file. */
export function changed(file, name, change) {
  const data = read(file);
  const target = at(name);
  writeFileSync(target, JSON.stringify(change(data) ?? data));
  return target;
}

/** Everything in a file: messages in the order of the file, each held against the schema in it. */
export async function open(file) {
  const bytes = readFileSync(file);
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => new Uint8Array(bytes.buffer, bytes.byteOffset + Number(offset), Number(length)),
  };
  const reader = await McapIndexedReader.Initialize({ readable });
  const ajv = new Ajv({ strict: false });
  const text = (data) => JSON.parse(new TextDecoder().decode(data));
  const schemas = new Map();
  for (const [id, { name, encoding, data }] of reader.schemasById) {
    assert.equal(encoding, "jsonschema");
    schemas.set(id, { name, schema: text(data), fits: ajv.compile(text(data)) });
  }
  const messages = [];
  for await (const { channelId, logTime, publishTime, sequence, data } of reader.readMessages()) {
    const { topic, schemaId, messageEncoding } = reader.channelsById.get(channelId);
    assert.equal(messageEncoding, "json");
    const { name, fits } = schemas.get(schemaId);
    const content = text(data);
    assert.ok(fits(content), `${topic}: ${ajv.errorsText(fits.errors)}`);
    messages.push({ topic, schema: name, logTime, publishTime, sequence, content });
  }
  const metadata = {};
  for await (const entry of reader.readMetadata()) metadata[entry.name] = Object.fromEntries(entry.metadata);
  return { schemas: [...schemas.values()], messages, metadata, of: (topic) => messages.filter((m) => m.topic === topic) };
}

/** A trial of a scenario: its replay data, and its trace as a file. */
export function trial(scenario, name, settings = []) {
  const run = at(name);
  rockyard(["run", `scenarios/${scenario}.json`, "--trials", "1", "--seed", "1", "--threads", "1", "--out", run, ...set(...settings)]);
  const data = at(`${name}.json`);
  const pages = ["--out", at(`${name}.html`), "--svg", at(`${name}.svg`)];
  rockyard(["replay", run, "--trial", "0", "--data", data, ...pages]);
  return { data, replay: read(data), file: converted(data, at(`${name}.mcap`)) };
}
