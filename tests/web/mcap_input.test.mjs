// What trace_to_mcap.mjs makes of what it is given: the same bytes, names as text, refusals.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { at } from "./harness.mjs";
import { changed, convert, converted, open, trial } from "./mcap_trace.mjs";

const stripe = trial("pathfinder/nominal", "stripe");

test("the same data gives the same bytes", () => {
  const again = converted(stripe.data, at("again.mcap"));
  assert.ok(readFileSync(stripe.file).equals(readFileSync(again)));
  const other = changed(stripe.data, "other.json", (replay) => void (replay.events[0].detail = "other"));
  assert.ok(!readFileSync(stripe.file).equals(readFileSync(converted(other, at("other.mcap")))));
});

test("names are text: markup, quotes and control characters come back as they were", async () => {
  const name = `<img src=x onerror="alert(1)">'\u0000\u001b[31m\n"}]\u{1f680}`;
  const data = changed(stripe.data, "names.json", (replay) => {
    Object.assign(replay, { scenario: name, title: name });
    replay.events[0].detail = name;
    const link = replay.rover.links[1];
    replay.motion.joints[name] = replay.motion.joints[link.name];
    link.name = name;
  });
  const { stdout } = convert(data);
  assert.doesNotMatch(stdout, /\u001b|\u0000/);
  // Without --out it lies beside the data.
  const trace = await open(at("names.mcap"));
  assert.equal(trace.metadata["rockyard.trial"].scenario, name);
  assert.equal(trace.of("/events")[0].content.message, name);
  assert.ok(trace.of("/tf")[0].content.transforms.some((transform) => transform.child_frame_id === `rover/${name}`));
});

test("bad input exits with 2, says what is wrong and writes nothing", () => {
  const out = at("never.mcap");
  const refused = (message, ...args) => {
    const { status, stderr } = convert(...args);
    assert.equal(status, 2, stderr);
    assert.match(stderr, message);
    assert.doesNotMatch(stderr, /\n +at /);
    assert.ok(!existsSync(out));
  };
  const damaged = (message, change) => refused(message, changed(stripe.data, "damaged.json", change), "--out", out);
  refused(/name one file/);
  refused(/name one file/, stripe.data, stripe.data, "--out", out);
  refused(/--colour/, stripe.data, "--colour", "red");
  refused(/--out would replace/, stripe.data, "--out", stripe.data);
  refused(/ENOENT/, at("missing.json"), "--out", out);
  refused(/JSON/, stripe.file, "--out", out);
  damaged(/not the data of a replay\n  try: rockyard replay/, () => ({ version: 1, runs: [] }));
  damaged(/not the data of a replay/, () => [1, 2]);
  damaged(/not the data of a replay/, (replay) => void (replay.version = 2));
  damaged(/motion\.qw must be a list/, (replay) => void delete replay.motion.qw);
  damaged(/motion\.z must be as long as motion\.t/, (replay) => void replay.motion.z.pop());
  damaged(/motion\.t\[2\] must be no less/, (replay) => void (replay.motion.t[2] = -1));
  damaged(/motion\.joints\.left_rocker must be as long/, (replay) => void replay.motion.joints.left_rocker.pop());
  damaged(/left_bogie\[0\] must be a number/, (replay) => void (replay.motion.joints.left_bogie[0] = null));
  damaged(/links\[1\]\.axis/, (replay) => void (replay.rover.links[1].axis = [0, 0, 0]));
  damaged(/events\[1\]\.detail must be text/, (replay) => void (replay.events[1].detail = 7));
  damaged(/links\[2\]\.parent must come before/, (replay) => void (replay.rover.links[2].parent = 2));
  damaged(/shapes\[0\]\.kind is not known/, (replay) => void (replay.rover.links[0].shapes[0].kind = "cone"));
  damaged(/rock_moves\[0\]\.rock/, (replay) => void (replay.rock_moves = [{ rock: 1e6, t: 0, x: 0, y: 0, z: 0 }]));
  damaged(/must be at least 0/, (replay) => void (replay.scans[0].t = -5));
  const pose = { x: 0, y: 0, heading: 0 };
  const overlays = (more) => (replay) =>
    void (replay.overlays = { every: 1, shown: [{ t: 1, pose, believed: pose, lines: [], grids: [], ...more }] });
  damaged(/overlays\.shown\[0\]\.lines\[0\]\.name must be text/, overlays({ lines: [{ points: [] }] }));
  damaged(/lines\[0\] must have points of two numbers/, overlays({ lines: [{ name: "a", points: [[1]] }] }));
  damaged(/grids\[0\] must have nx times ny/, overlays({ grids: [{ name: "a", x0: 0, y0: 0, step: 1, nx: 2, ny: 1, values: [1] }] }));
  damaged(/must be at least 0/, overlays({ t: -1 }));
  damaged(/ground\.z must have/, (replay) => void replay.ground.z.pop());
});

test("what cannot be written exits with 5", () => {
  const { status, stderr } = convert(stripe.data, "--out", at("no/such/folder.mcap"));
  assert.equal(status, 5, stderr);
  assert.match(stderr, /ENOENT/);
});

test("--help says how to use it", () => {
  const { status, stdout } = convert("--help");
  assert.equal(status, 0);
  assert.match(stdout, /^usage: .*rockyard replay RUN/s);
});
