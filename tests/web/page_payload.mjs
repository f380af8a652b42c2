// The data inside of a page: read, and written anew.
import { readFileSync, writeFileSync } from "node:fs";
import { gunzipSync, gzipSync } from "node:zlib";

const PAYLOAD = /(<script type="application\/octet-stream" id="payload">)([^<]*)/;

/** The data of the page, compressed. */
export const payloadTextOf = (file) => readFileSync(file, "utf8").match(PAYLOAD)[2];

/** What the page was given. */
export const payloadOf = (file) => JSON.parse(gunzipSync(Buffer.from(payloadTextOf(file), "base64")));

/** The same page as another file, with text in place of its compressed data. */
export function withPayloadText(file, target, text) {
  writeFileSync(target, readFileSync(file, "utf8").replace(PAYLOAD, (_, mark) => mark + text));
  return target;
}

/** The same page with data that `change` was applied to (it may return a new one). */
export function withPayload(file, target, change) {
  const payload = payloadOf(file);
  const changed = change(payload) ?? payload;
  return withPayloadText(file, target, gzipSync(JSON.stringify(changed)).toString("base64"));
}
