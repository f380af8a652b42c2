// Traces as MCAP, read back with the library of the format and held against the arrays of the same trial.
// PYTHON is an interpreter that has NumPy; tests/web/harness.mjs names the other variables.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { at, requirePackage, rockyard, set } from "../web/harness.mjs";

const { McapIndexedReader, McapStreamReader } = requirePackage("@mcap/core");
const { crc32 } = requirePackage("@foxglove/crc");
const foxglove = requirePackage("@foxglove/schemas/jsonschema");
const { NumericType } = requirePackage("@foxglove/schemas");
const Ajv = requirePackage("ajv").default;

const parse = (data) => JSON.parse(new TextDecoder().decode(data));

/** Everything that a reader of the index finds, messages in the order of the file. */
async function indexed(bytes) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => new Uint8Array(bytes.buffer, bytes.byteOffset + Number(offset), Number(length)),
  };
  const reader = await McapIndexedReader.Initialize({ readable });
  const messages = [];
  for await (const { channelId, logTime, publishTime, sequence, data } of reader.readMessages()) {
    const { topic, schemaId } = reader.channelsById.get(channelId);
    messages.push({ topic, schemaId, logTime, publishTime, sequence, content: parse(data) });
  }
  const metadata = {};
  for await (const entry of reader.readMetadata()) metadata[entry.name] = Object.fromEntries(entry.metadata);
  return { reader, messages, metadata, of: (topic) => messages.filter((message) => message.topic === topic) };
}

/** Every record in the order of the file, those in chunks too; CRCs of chunks are checked. */
function streamed(bytes) {
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(bytes);
  const records = [];
  for (let record; (record = reader.nextRecord()); ) records.push(record);
  assert.ok(reader.done());
  return records;
}

// The readers leave the CRC of the data to whoever wants it; the record with it ends where the summary begins.
function checkData(bytes, { footer }) {
  const end = Number(footer.summaryStart);
  assert.equal(bytes.readUInt32LE(end - 4), crc32(bytes.subarray(0, end - 13)), "CRC of the data");
}

const ARRAYS = `
import json, numpy, sys
with numpy.load(sys.argv[1]) as arrays:
    print(json.dumps({name: arrays[name].tolist() for name in sys.argv[2:]}))`;
const NAMES = ["time_s", "position_m", "attitude_wxyz", "believed", "tilt_rad", "rocker_rad", "activity", "event_time_s", "event_kind",
  "event_detail", "scan_time_s", "scan_points", "scan_hazards", "step_time_s", "vote", "vote_kind",
  "vote_step"];

async function trial(name, scenario, ...settings) {
  const [mcap, npz] = [at(`${name}.mcap`), at(`${name}.npz`)];
  rockyard(["trace", `scenarios/${scenario}.json`, "--trial", "2", "--mcap", mcap, "--npz", npz, ...set(...settings)]);
  const text = execFileSync(process.env.PYTHON, ["-c", ARRAYS, npz, ...NAMES], { encoding: "utf8", maxBuffer: 1 << 28 });
  const bytes = readFileSync(mcap);
  return { bytes, arrays: JSON.parse(text), ...(await indexed(bytes)) };
}

const stripe = await trial("stripe", "pathfinder/nominal");
const mapped = await trial("mapped", "gestalt/narrow_course", "sensors.stereo.fidelity=image", "sensors.stereo.images.pyramid_level=0",
  "rover.fidelity=quasi_static", "referee.time_limit_s=300");
const TRIALS = [stripe, mapped];

const ns = (time) => BigInt(Math.round(1e9 * time));
const xyz = ({ x, y, z }) => [x, y, z];

/** The rows of a point cloud or grid. */
function unpack({ fields, data, point_stride: pointStride, cell_stride: cellStride }) {
  const bytes = Buffer.from(data, "base64");
  const stride = pointStride ?? cellStride;
  assert.ok(fields.every(({ type }) => type === NumericType.FLOAT32));
  return Array.from({ length: bytes.length / stride }, (_, row) => fields.map(({ offset }) => bytes.readFloatLE(row * stride + offset)));
}

const withoutWords = (value) =>
  typeof value !== "object" || value === null || Array.isArray(value)
    ? value
    : Object.fromEntries(
        Object.entries(value)
          .filter(([key, entry]) => !((key === "description" || key === "$comment") && typeof entry === "string"))
          .map(([key, entry]) => [key, Array.isArray(entry) ? entry.map(withoutWords) : withoutWords(entry)]),
      );

test("topics have Foxglove's schemas but for their words, and messages fit them", () => {
  const seen = new Set();
  for (const { reader, messages } of TRIALS) {
    const checks = new Map();
    for (const [id, { name, encoding, data }] of reader.schemasById) {
      assert.equal(encoding, "jsonschema");
      const [maker, title] = name.split(".");
      if (maker === "foxglove") assert.deepEqual(parse(data), withoutWords(foxglove[title]));
      else assert.equal(maker, "rockyard");
      checks.set(id, new Ajv({ strict: false }).compile(parse(data)));
    }
    for (const { topic, schemaId, content } of messages) {
      const check = checks.get(schemaId);
      assert.ok(check(content), `${topic}: ${JSON.stringify(check.errors)}`);
      seen.add(`${topic} ${reader.schemasById.get(schemaId).name.split(".")[1]}`);
    }
  }
  assert.deepEqual([...seen].sort(), [
    "/camera/disparity CompressedImage", "/camera/left CompressedImage", "/events Log", "/joints JointStates", "/look PointCloud", "/map Grid",
    "/pose/believed PoseInFrame", "/pose/true PoseInFrame", "/scan PointCloud", "/scene/course SceneUpdate", "/scene/paths SceneUpdate",
    "/scene/rocks SceneUpdate", "/scene/rover SceneUpdate", "/state State", "/tf FrameTransforms", "/votes Votes",
  ]);
});

test("the index, the order of the file and the statistics tell the same messages", () => {
  for (const { bytes, reader, messages } of TRIALS) {
    checkData(bytes, reader);
    const records = streamed(bytes);
    const inOrder = records.filter(({ type }) => type === "Message");
    assert.deepEqual(inOrder.map(({ logTime, sequence }) => [logTime, sequence]), messages.map(({ logTime, sequence }) => [logTime, sequence]));
    const { statistics, channelsById, chunkIndexes } = reader;
    assert.equal(Number(statistics.messageCount), messages.length);
    for (const [id, { topic }] of channelsById) {
      const sequences = messages.filter((message) => message.topic === topic).map(({ sequence }) => sequence);
      assert.equal(Number(statistics.channelMessageCounts.get(id)), sequences.length);
      assert.deepEqual(sequences, sequences.map((_, i) => i));
    }
    assert.equal(statistics.messageStartTime, messages[0].logTime);
    assert.equal(statistics.messageEndTime, messages.at(-1).logTime);
    assert.equal(statistics.chunkCount, chunkIndexes.length);
    assert.ok(chunkIndexes.length > 1);
  }
});

test("log times never descend and are those in the messages", () => {
  for (const { messages } of TRIALS) {
    messages.reduce((before, { logTime, publishTime, content: { timestamp } }) => {
      assert.ok(logTime >= before);
      assert.equal(publishTime, logTime);
      if (timestamp) assert.equal(BigInt(timestamp.sec) * 1_000_000_000n + BigInt(timestamp.nsec), logTime);
      return logTime;
    }, 0n);
  }
});

test("every moment of the arrays is there with every digit", () => {
  for (const { arrays, of } of TRIALS) {
    const poses = of("/pose/true");
    assert.deepEqual(poses.map(({ logTime }) => logTime), arrays.time_s.map(ns));
    assert.deepEqual(poses.map(({ content }) => xyz(content.pose.position)), arrays.position_m);
    assert.deepEqual(poses.map(({ content: { pose: { orientation: { w, x, y, z } } } }) => [w, x, y, z]), arrays.attitude_wxyz);
    const believed = of("/pose/believed").map(({ content }) => content.pose);
    assert.deepEqual(believed.map(({ position: { x, y } }) => [x, y]), arrays.believed.map((row) => row.slice(0, 2)));
    believed.forEach(({ orientation: { z, w } }, i) => assert.ok(Math.cos(2 * Math.atan2(z, w) - arrays.believed[i][2]) > 1 - 1e-12));
    const joint = (name) => of("/joints").map(({ content }) => content.joints.find((one) => one.name === name).position);
    assert.deepEqual(joint("left_rocker"), arrays.rocker_rad.map(([left]) => left));
    assert.deepEqual(of("/state").map(({ content }) => [content.activity, content.tilt_rad]), arrays.activity.map((word, i) => [word, arrays.tilt_rad[i]]));
    // Transforms are those of some moments, first and last among them.
    const places = new Map(poses.map(({ logTime, content }) => [logTime, content.pose.position]));
    const transforms = of("/tf");
    for (const { logTime, content } of transforms) assert.deepEqual(content.transforms[0].translation, places.get(logTime));
    assert.deepEqual([transforms[0].logTime, transforms.at(-1).logTime], [poses[0].logTime, poses.at(-1).logTime]);
    assert.ok(transforms.length > 20 && transforms.length < poses.length);
  }
});

test("events are those of the arrays, and what the motion tells beyond them", () => {
  for (const { arrays, of } of TRIALS) {
    const told = of("/events").filter(({ content }) => !["turn", "stall"].includes(content.name));
    assert.deepEqual(told.map(({ logTime, content }) => [logTime, content.name, content.message]),
      arrays.event_kind.map((kind, i) => [ns(arrays.event_time_s[i]), kind, arrays.event_detail[i]]));
  }
});

test("scans, maps and votes are those of the arrays", () => {
  const { arrays, of } = stripe;
  assert.deepEqual(of("/scan").map(({ logTime }) => logTime), arrays.scan_time_s.map(ns));
  const rows = of("/scan").flatMap(({ content }, scan) => unpack(content).map((row) => [scan, ...row]));
  assert.deepEqual(rows, arrays.scan_points.map(([scan, x, y, z, index, height]) =>
    [scan, ...[x, y, z, index, height].map(Math.fround), arrays.scan_hazards[scan][index] ? 1 : 0]));
  const votes = mapped.of("/votes").flatMap(({ content }, step) =>
    content.votes.map(({ kind, curvature, hazard, certainty, waypoint, merged }) => [step, kind, curvature, hazard, certainty, waypoint, merged]));
  const { vote, vote_kind: kinds, vote_step: steps } = mapped.arrays;
  assert.deepEqual(votes, vote.map(([curvature, direction, ...shares], i) => [steps[i], kinds[i], kinds[i] === "turn" ? direction : curvature, ...shares]));
  for (const topic of ["/map", "/votes"]) assert.deepEqual(mapped.of(topic).map(({ logTime }) => logTime), mapped.arrays.step_time_s.map(ns));
  const cells = unpack(mapped.of("/map")[0].content);
  assert.ok(cells.some(([goodness, certainty, elevation]) => goodness === -1 && certainty === -1 && Number.isNaN(elevation)));
  assert.ok(cells.some(([goodness, certainty, elevation]) => goodness > 0 && certainty > 0 && Math.abs(elevation) < 1));
});

test("looks have pictures", () => {
  for (const topic of ["/camera/left", "/camera/disparity"]) {
    const pictures = mapped.of(topic);
    assert.ok(pictures.length > 3);
    assert.ok(pictures.every(({ content }, i) => content.data !== mapped.of("/camera/left")[i].content.data || topic === "/camera/left"));
    for (const { content } of pictures) assert.equal(Buffer.from(content.data, "base64").toString("latin1", 1, 4), content.format.toUpperCase());
  }
});

test("the record is in the metadata", () => {
  const { metadata, of } = stripe;
  const { position } = of("/pose/true").at(-1).content.pose;
  assert.equal(Number(metadata["rockyard.record"].final_x_m), position.x);
  assert.equal(metadata["rockyard.record_units"].final_x_m, "m");
  const { trial: number, scenario, cell, seed } = metadata["rockyard.trial"];
  assert.deepEqual([number, scenario, cell, seed], ["2", "nominal", "", "1"]);
  assert.match(metadata["rockyard.trial"].record_hash, /^[0-9a-f]{16}$/);
  assert.ok(metadata["rockyard.provenance"].compiler);
});

test("a file with one byte changed is refused, wherever that byte is", async () => {
  const { bytes, reader } = mapped;
  const refused = async (place) => {
    const damaged = Buffer.from(bytes);
    damaged[place] ^= 0x20;
    await assert.rejects(async () => {
      const { reader: found } = await indexed(damaged);
      checkData(damaged, found);
      streamed(damaged);
    }, undefined, `byte ${place}`);
  };
  const chunk = reader.chunkIndexes[1];
  const inMessage = bytes.indexOf('"tilt_rad":', Number(chunk.chunkStartOffset)) + 12;
  const inMetadata = bytes.indexOf("final_x_m");
  assert.ok(inMessage > inMetadata && inMetadata > 0);
  for (const place of [inMessage, inMetadata, Number(chunk.chunkStartOffset + chunk.chunkLength) + 20, Number(reader.footer.summaryStart) + 40, bytes.length - 20]) {
    await refused(place);
  }
  for (let i = 0; i < 10; ++i) await refused(Math.floor(((i + 0.5) / 10) * bytes.length));
  await indexed(bytes);
});
