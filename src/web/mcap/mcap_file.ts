// A trial as the bytes of an MCAP file (https://mcap.dev/spec): the same data gives the same bytes.
import { McapWriter } from "@mcap/core";
import type { ReplayPayload } from "../replay/payload";
import { nanoseconds } from "./geometry";
import { motionMessages } from "./motion_messages";
import { overlayMessages } from "./overlay_messages";
import { sceneMessages } from "./scene_messages";
import { sensingMessages } from "./sensing_messages";
import { schemaOf, type Message, type Topic } from "./topics";

/** Collects what a writer writes. */
class Memory {
  private readonly pieces: Uint8Array[] = [];
  private length = 0;

  position(): bigint { return BigInt(this.length); }

  // A copy, because the writer goes on with its buffer.
  async write(piece: Uint8Array): Promise<void> {
    this.pieces.push(piece.slice());
    this.length += piece.length;
  }

  bytes(): Uint8Array { return Buffer.concat(this.pieces); }
}

const asText = (value: unknown): string => (typeof value === "string" ? value : JSON.stringify(value));

/** Everything is text there: numbers with every digit, what is undefined as null. */
function metadataOf(replay: ReplayPayload): { name: string; metadata: Map<string, string> }[] {
  const { version, scenario, cell, seed, trial, outcome, detail, record_hash, repeats_stored, command } = replay;
  const described = { version, scenario, cell, seed, trial, outcome, detail, record_hash, repeats_stored, command };
  const texts = (entries: [string, unknown][]): Map<string, string> => new Map(entries.map(([key, value]) => [key, asText(value)]));
  return [
    { name: "rockyard.trial", metadata: texts(Object.entries(described)) },
    { name: "rockyard.record", metadata: texts(replay.record.map(({ name, value }) => [name, value])) },
    { name: "rockyard.record_units", metadata: texts(replay.record.map(({ name, unit }) => [name, unit])) },
    { name: "rockyard.provenance", metadata: texts(Object.entries(replay.provenance)) },
  ];
}

// As the JSON encoding of Foxglove's schemas wants bytes.
const withBase64 = (_: string, value: unknown): unknown => value instanceof Uint8Array ? Buffer.from(value).toString("base64") : value;

const encode = (content: unknown): Uint8Array => Buffer.from(JSON.stringify(content, withBase64), "utf8");

/** In the order of time; of one moment in the order of the topics, then as they came. */
function messagesOf(replay: ReplayPayload): Message[] {
  const messages = [...sceneMessages(replay), ...motionMessages(replay), ...sensingMessages(replay), ...overlayMessages(replay)];
  return messages.sort((a, b) => nanoseconds(a.t) - nanoseconds(b.t));
}

async function registerTopics(writer: McapWriter, topics: Iterable<Topic>): Promise<Map<Topic, number>> {
  const schemas = new Map<string, number>();
  const channels = new Map<Topic, number>();
  for (const topic of topics) {
    const schema = schemaOf(topic);
    const name = schema.title;
    if (!schemas.has(name)) {
      schemas.set(name, await writer.registerSchema({ name, encoding: "jsonschema", data: encode(schema) }));
    }
    const schemaId = schemas.get(name)!;
    channels.set(topic, await writer.registerChannel({ topic, schemaId, messageEncoding: "json", metadata: new Map() }));
  }
  return channels;
}

/** Topics without messages are left out. Chunks are not compressed: every reader opens them. */
export async function mcapOf(replay: ReplayPayload): Promise<Uint8Array> {
  const memory = new Memory();
  const writer = new McapWriter({ writable: memory });
  await writer.start({ profile: "", library: "rockyard" });
  for (const entry of metadataOf(replay)) await writer.addMetadata(entry);
  const messages = messagesOf(replay);
  const channels = await registerTopics(writer, new Set(messages.map(({ topic }) => topic)));
  const sequences = new Map<Topic, number>();
  for (const { topic, t, content } of messages) {
    const sequence = sequences.get(topic) ?? 0;
    sequences.set(topic, sequence + 1);
    const time = BigInt(nanoseconds(t));
    const channelId = channels.get(topic)!;
    await writer.addMessage({ channelId, sequence, logTime: time, publishTime: time, data: encode(content) });
  }
  await writer.end();
  return memory.bytes();
}
