// Traces as MCAP files: written from replay data, and read back with the library of the format.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { before, test } from "node:test";
import { pagesFolder, requirePackage, rockyard, temporaryFolder } from "./harness.mjs";

const { McapIndexedReader } = requirePackage("@mcap/core");
const foxglove = requirePackage("@foxglove/schemas/jsonschema");
const Ajv = requirePackage("ajv").default;

const folder = temporaryFolder();
const inFolder = (name) => path.join(folder, name);

function convert(...args) {
  const script = path.join(pagesFolder, "pages", "trace_to_mcap.mjs");
  return spawnSync(process.execPath, [script, ...args], { encoding: "utf8" });
}

function converted(input, out) {
  const { status, stderr } = convert(input, "--out", out);
  assert.equal(status, 0, stderr);
  return out;
}

const read = (file) => JSON.parse(readFileSync(file, "utf8"));

/** Replay data with a change, as another file. */
function changed(file, name, change) {
  const data = read(file);
  const target = inFolder(name);
  writeFileSync(target, JSON.stringify(change(data) ?? data));
  return target;
}

/** Everything in a file: messages in the order of the file, each held against the schema in it. */
async function open(file) {
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

function trial(scenario, name) {
  const run = inFolder(name);
  rockyard(["run", `scenarios/${scenario}.json`, "--trials", "1", "--seed", "1", "--threads", "1", "--out", run]);
  const data = inFolder(`${name}.json`);
  const pages = ["--out", inFolder(`${name}.html`), "--svg", inFolder(`${name}.svg`)];
  rockyard(["replay", run, "--trial", "0", "--data", data, ...pages]);
  return { data, replay: read(data), file: converted(data, inFolder(`${name}.mcap`)) };
}

let stripe;
let mapped;
before(async () => {
  stripe = trial("pathfinder/nominal", "stripe");
  stripe.trace = await open(stripe.file);
  mapped = trial("gestalt/narrow_course", "mapped");
  mapped.trace = await open(mapped.file);
});

const WELL_KNOWN = {
  "/tf": "FrameTransforms",
  "/pose/true": "PoseInFrame",
  "/pose/believed": "PoseInFrame",
  "/scene/course": "SceneUpdate",
  "/scene/rocks": "SceneUpdate",
  "/scene/rover": "SceneUpdate",
  "/scene/paths": "SceneUpdate",
  "/scan": "PointCloud",
  "/look": "PointCloud",
  "/map": "Grid",
  "/events": "Log",
};

test("topics carry Foxglove's schemas, word for word", () => {
  const seen = new Set();
  for (const { trace } of [stripe, mapped]) {
    for (const { topic, schema } of trace.messages) {
      seen.add(topic);
      if (topic in WELL_KNOWN) assert.equal(schema, `foxglove.${WELL_KNOWN[topic]}`);
      else assert.match(schema, /^rockyard\./);
    }
    for (const { name, schema } of trace.schemas) {
      if (name.startsWith("foxglove.")) assert.deepEqual(schema, foxglove[name.slice("foxglove.".length)]);
    }
  }
  for (const topic of Object.keys(WELL_KNOWN)) assert.ok(seen.has(topic), topic);
});

test("there are as many messages as the data has moments, scans, decisions and events", () => {
  for (const { replay, trace } of [stripe, mapped]) {
    const { motion, scans, steps, events } = replay;
    for (const topic of ["/tf", "/pose/true", "/pose/believed", "/state"]) {
      assert.equal(trace.of(topic).length, motion.t.length, topic);
    }
    assert.equal(trace.of("/scan").length, scans.length);
    assert.equal(trace.of("/map").length, steps.length);
    assert.equal(trace.of("/votes").length, steps.length);
    assert.equal(trace.of("/look").length, steps.filter(({ points }) => points.length > 0).length);
    assert.equal(trace.of("/events").length, events.length);
    for (const topic of ["/scene/course", "/scene/rocks", "/scene/rover", "/scene/paths"]) {
      assert.equal(trace.of(topic).length, 1, topic);
    }
  }
  assert.ok(stripe.replay.scans.length > 0 && mapped.replay.steps.length > 0);
});

test("log times are simulated nanoseconds, never descend, and are those in the messages", () => {
  for (const { replay, trace } of [stripe, mapped]) {
    trace.messages.reduce((before, { logTime, publishTime }) => {
      assert.ok(logTime >= before);
      assert.equal(publishTime, logTime);
      return logTime;
    }, 0n);
    trace.of("/pose/true").forEach(({ logTime, content, sequence }, i) => {
      assert.equal(sequence, i);
      assert.ok(Math.abs(Number(logTime) - 1e9 * replay.motion.t[i]) < 1000);
      const { sec, nsec } = content.timestamp;
      assert.equal(BigInt(sec) * 1_000_000_000n + BigInt(nsec), logTime);
    });
  }
});

test("the drive ends where the stored record says, with every digit", () => {
  for (const { replay, trace } of [stripe, mapped]) {
    const stored = Object.fromEntries(replay.record.map(({ name, value }) => [name, value]));
    const { position } = trace.of("/pose/true").at(-1).content.pose;
    assert.equal(position.x, stored.final_x_m);
    assert.equal(position.y, stored.final_y_m);
    const believed = trace.of("/pose/believed").at(-1).content.pose.position;
    assert.equal(believed.x, stored.believed_x_m);
    assert.equal(believed.y, stored.believed_y_m);
    for (const [name, value] of Object.entries(stored)) {
      assert.equal(trace.metadata["rockyard.record"][name], JSON.stringify(value), name);
    }
    assert.equal(trace.metadata["rockyard.trial"].record_hash, replay.record_hash);
    assert.equal(trace.metadata["rockyard.record_units"].final_x_m, "m");
  }
});

test("events are told as the data has them, troubles above the others", () => {
  for (const { replay, trace } of [stripe, mapped]) {
    const told = trace.of("/events").map(({ logTime, content }) => [Number(logTime), content.name, content.message]);
    const inOrder = [...replay.events].sort((a, b) => a.t - b.t);
    assert.deepEqual(told, inOrder.map(({ t, kind, detail }) => [Math.round(1e9 * t), kind, detail]));
  }
  const levels = (trace, kind) => trace.of("/events").filter((m) => m.content.name === kind).map((m) => m.content.level);
  assert.ok(levels(stripe.trace, "hazard").every((level) => level === 3));
  assert.deepEqual(levels(stripe.trace, "end"), [2]);
});
