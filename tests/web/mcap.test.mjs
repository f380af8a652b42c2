// Traces as MCAP files: written from replay data, and read back with the library of the format.
import assert from "node:assert/strict";
import { test } from "node:test";
import { at, requirePackage } from "./harness.mjs";
import { changed, converted, open, trial } from "./mcap_trace.mjs";

const foxglove = requirePackage("@foxglove/schemas/jsonschema");

// Round rocks, of which one is made pointed below, and a trial that does not arrive.
const stripe = trial("pathfinder/nominal", "stripe", ["terrain.rocks.pointedness=0", "referee.time_limit_s=2000"]);
stripe.trace = await open(stripe.file);
const mapped = trial("gestalt/narrow_course", "mapped");
mapped.trace = await open(mapped.file);

const WELL_KNOWN = {
  "/tf": "FrameTransforms",
  "/pose/true": "PoseInFrame",
  "/pose/believed": "PoseInFrame",
  "/joints": "JointStates",
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
    for (const topic of ["/tf", "/pose/true", "/pose/believed", "/joints", "/state"]) {
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

test("joints, tilt and activity are those of each moment", () => {
  for (const { replay: { motion }, trace } of [stripe, mapped]) {
    trace.of("/joints").forEach(({ content }, i) => {
      const angles = Object.fromEntries(content.joints.map(({ name, position }) => [name, position]));
      assert.deepEqual(angles, Object.fromEntries(Object.entries(motion.joints).map(([name, column]) => [name, column[i]])));
    });
    trace.of("/state").forEach(({ content }, i) => {
      assert.deepEqual([content.tilt_rad, content.activity], [motion.tilt[i], motion.activity_names[motion.activity[i]] ?? ""]);
    });
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
  // The one arrived, the other ran out of time.
  assert.equal(mapped.replay.outcome, "goal_reached");
  assert.deepEqual(levels(mapped.trace, "end"), [2]);
  assert.notEqual(stripe.replay.outcome, "goal_reached");
  assert.deepEqual(levels(stripe.trace, "end"), [4]);
});

/** The rows of a point cloud or grid by the names of their fields. */
function unpack({ fields, data, point_stride: pointStride, cell_stride: cellStride }) {
  const bytes = Buffer.from(data, "base64");
  const stride = pointStride ?? cellStride;
  return Array.from({ length: bytes.length / stride }, (_, row) =>
    Object.fromEntries(fields.map(({ name, offset }) => [name, bytes.readFloatLE(row * stride + offset)])));
}

test("points of scans and looks, and maps, hold what the data holds", () => {
  const asFloats = (values) => values.map(Math.fround);
  stripe.replay.scans.forEach(({ points, hazards }, i) => {
    const rows = unpack(stripe.trace.of("/scan")[i].content);
    assert.equal(rows.length, points.length);
    rows.forEach(({ x, y, z, stripe: index, height, hazard }, k) => {
      const point = points[k];
      assert.deepEqual([x, y, z, height], asFloats([point.x, point.y, point.z, point.height]));
      assert.deepEqual([index, hazard], [point.stripe, hazards[point.stripe] ? 1 : 0]);
    });
  });
  mapped.replay.steps.forEach(({ map, points, votes }, i) => {
    const { content } = mapped.trace.of("/map")[i];
    assert.deepEqual([content.pose.position.x, content.pose.position.y], [map.x0, map.y0]);
    assert.deepEqual([content.column_count, content.cell_size], [map.nx, { x: map.xstep, y: map.ystep }]);
    const cells = unpack(content);
    assert.deepEqual(cells.map(({ goodness }) => goodness), map.goodness);
    assert.deepEqual(cells.map(({ certainty }) => certainty), map.certainty);
    assert.deepEqual(cells.map(({ elevation }) => elevation), map.elevation.map((z) => (z === null ? NaN : Math.fround(z))));
    assert.deepEqual(unpack(mapped.trace.of("/look")[i].content).map(({ x, y, z }) => [x, y, z]), points.map(asFloats));
    assert.deepEqual(mapped.trace.of("/votes")[i].content.votes, votes);
  });
});

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const sum = (...terms) => [0, 1, 2].map((i) => terms.reduce((total, term) => total + term[i], 0));
const times = (k, v) => v.map((entry) => k * entry);

/** Rodrigues' formula: without quaternions, for the check of those that were written. */
function turned(v, axis, angle) {
  const along = times((1 - Math.cos(angle)) * dot(axis, v), axis);
  return sum(times(Math.cos(angle), v), times(Math.sin(angle), cross(axis, v)), along);
}

const rotated = (v, { x, y, z, w }) => {
  const t = times(2, cross([x, y, z], v));
  return sum(v, times(w, t), cross([x, y, z], t));
};
const list = ({ x, y, z }) => [x, y, z];

function near(actual, expected, what) {
  actual.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) < 1e-9, `${what}: ${actual}, not ${expected}`));
}

test("frames of links lie where pivots, axes and joints put them", () => {
  const { replay: { rover: { links }, motion }, trace } = stripe;
  const frameOf = (i) => (i === 0 ? "rover" : `rover/${links[i].name}`);
  const inRover = (place, index, moment) => {
    let point = place;
    for (let i = index; i > 0; i = links[i].parent) {
      const { name, pivot, axis } = links[i];
      point = sum(pivot, turned(point, axis, motion.joints[name][moment]));
    }
    return point;
  };
  for (const moment of [0, Math.floor(motion.t.length / 2), motion.t.length - 1]) {
    const { transforms } = trace.of("/tf")[moment].content;
    const byChild = new Map(transforms.map((transform) => [transform.child_frame_id, transform]));
    assert.equal(byChild.size, transforms.length);
    assert.equal(byChild.get("believed_rover").parent_frame_id, "world");
    assert.equal(byChild.get("believed_rover").translation.x, motion.believed_x[moment]);
    assert.deepEqual(list(byChild.get("rover").translation), [motion.x[moment], motion.y[moment], motion.z[moment]]);
    links.forEach((_, i) => {
      const place = [0.1, -0.2, 0.3];
      let point = place;
      for (let frame = frameOf(i); frame !== "rover"; frame = byChild.get(frame).parent_frame_id) {
        const { translation, rotation } = byChild.get(frame);
        point = sum(list(translation), rotated(point, rotation));
      }
      near(point, inRover(place, i, moment), frameOf(i));
    });
  }
});

test("the rover's shapes are in the frames of its links, wheels across, struts from end to end", () => {
  const { links } = stripe.replay.rover;
  const { entities } = stripe.trace.of("/scene/rover")[0].content;
  const shown = links.filter(({ shapes }) => shapes.length > 0);
  assert.deepEqual(entities.map(({ frame_id: frame }) => frame), shown.map(({ name }) => (name === "chassis" ? "rover" : `rover/${name}`)));
  shown.forEach(({ shapes }, i) => {
    assert.equal(entities[i].frame_locked, true);
    const long = shapes.filter(({ kind }) => kind === "capsule" || kind === "wheel");
    assert.equal(entities[i].cylinders.length, long.length);
    assert.equal(entities[i].cubes.length, shapes.filter(({ kind }) => kind === "box").length);
    long.forEach(({ kind, from, to, center, radius, width }, k) => {
      const { pose, size } = entities[i].cylinders[k];
      assert.equal(size.x, 2 * radius);
      const end = sum(list(pose.position), rotated([0, 0, size.z / 2], pose.orientation));
      near(end, kind === "wheel" ? sum(center, [0, width / 2, 0]) : to, "upper end");
      if (kind === "capsule") near(sum(times(2, list(pose.position)), times(-1, end)), from, "lower end");
    });
  });
});

test("pointed rocks are stacks of frusta from base to top", async () => {
  const growth = 0.4;
  const data = changed(stripe.data, "pointed.json", (replay) => {
    replay.rocks[0].growth = growth;
  });
  const trace = await open(converted(data, at("pointed.mcap")));
  const { spheres, cylinders } = trace.of("/scene/rocks")[0].content.entities[0];
  const { rocks } = stripe.replay;
  assert.equal(spheres.length, rocks.length - 1);
  const { x, y, z, a, b, c } = rocks[0];
  // The top first: each frustum begins where the one above it ends, as wide as it.
  let above = { z: z + c, width: 0 };
  for (const { pose, size, bottom_scale, top_scale } of cylinders) {
    assert.deepEqual([pose.position.x, pose.position.y, bottom_scale], [x, y, 1]);
    assert.ok(Math.abs(pose.position.z + 0.5 * size.z - above.z) < 1e-9);
    assert.ok(Math.abs(top_scale * size.x - above.width) < 1e-9);
    assert.ok(Math.abs(size.y / size.x - b / a) < 1e-9);
    above = { z: pose.position.z - 0.5 * size.z, width: size.x };
    const s = 1 - (above.z - z) / c;
    assert.ok(Math.abs(above.width - 2 * a * Math.sqrt(growth * s + (1 - growth) * s * s)) < 1e-9);
  }
  assert.ok(Math.abs(above.z - z) < 1e-9 && Math.abs(above.width - 2 * a) < 1e-9);
});

test("rocks, pushes, walls and settings back are in the scene", async () => {
  const end = stripe.replay.motion.t.at(-1);
  const data = changed(stripe.data, "pushed.json", (replay) => {
    replay.rock_moves = [{ rock: 3, t: 0.25 * end, x: 1, y: 2, z: 3 }, { rock: 5, t: 0.5 * end, x: 4, y: 5, z: 6 }];
    replay.course.walls = [{ nx: 0, ny: 1, offset: 1.5 }, { nx: 1, ny: 0, offset: 1e4 }];
    replay.motion.breaks = [20];
  });
  const trace = await open(converted(data, at("pushed.mcap")));
  const spheres = ({ content: { entities } }) => entities[0].spheres;
  const { rocks } = stripe.replay;
  assert.equal(spheres(trace.of("/scene/rocks")[0]).length, rocks.length - 2);
  const { pose, size } = spheres(stripe.trace.of("/scene/rocks")[0])[0];
  assert.deepEqual([list(pose.position), list(size)], [[rocks[0].x, rocks[0].y, rocks[0].z], [2 * rocks[0].a, 2 * rocks[0].b, 2 * rocks[0].c]]);
  const places = trace.of("/scene/pushed_rocks").map((message) => spheres(message).map((sphere) => list(sphere.pose.position)));
  const [third, fifth] = [3, 5].map((i) => [rocks[i].x, rocks[i].y, rocks[i].z]);
  assert.deepEqual(places, [[third, fifth], [[1, 2, 3], fifth], [[1, 2, 3], [4, 5, 6]]]);
  const entity = (topic, name) => trace.of(topic)[0].content.entities.find(({ id }) => id === name);
  const walls = entity("/scene/course", "walls").cubes;
  assert.deepEqual(walls.map((cube) => cube.pose.position.y), [1.5]);
  const stretches = entity("/scene/paths", "true_path").lines.map(({ points }) => points.length);
  assert.deepEqual(stretches, [20, stripe.replay.motion.t.length - 20]);
});

test("what the navigator shows is a scene of its lines, and a grid on a topic of its name", async () => {
  const [t, later, last] = [0.25, 0.5, 0.75].map((share) => share * stripe.replay.motion.t.at(-1));
  const pose = { x: 0, y: 0, heading: 0 };
  const cost = { name: "cost", x0: -1, y0: 2, step: 0.5, nx: 2, ny: 2, values: [0, 51, 255, -1] };
  const data = changed(stripe.data, "shown.json", (replay) => {
    replay.overlays = {
      every: 1,
      shown: [
        { t, pose, believed: pose, lines: [{ name: "path", points: [[0, 0], [1, 2]] }, { name: "tree", points: [[3, 4]] }], grids: [cost] },
        { t: later, pose, believed: pose, lines: [{ name: "tree", points: [[5, 6], [7, 8]] }], grids: [] },
        { t: last, pose, believed: pose, lines: [], grids: [] },
      ],
    };
  });
  const trace = await open(converted(data, at("shown.mcap")));
  const scenes = trace.of("/scene/overlay").map(({ content }) => content);
  // Each by itself: what is not in it is gone.
  assert.ok(scenes.every(({ deletions }) => deletions.length === 1 && deletions[0].type === 1));
  assert.deepEqual(scenes.map(({ entities }) => entities.map(({ id }) => id)), [["path", "tree"], ["tree"], []]);
  const points = scenes[1].entities[0].lines[0].points;
  assert.deepEqual(points.map(({ x, y }) => [x, y]), [[5, 6], [7, 8]]);
  assert.deepEqual(scenes[0].entities[1].lines[0].color, scenes[1].entities[0].lines[0].color);
  const [{ content, schema, logTime }, ...others] = trace.of("/overlay/cost");
  assert.deepEqual([others.length, schema, Number(logTime)], [0, "foxglove.Grid", Math.round(1e9 * t)]);
  assert.deepEqual([content.pose.position.x, content.pose.position.y, content.column_count], [-1, 2, 2]);
  assert.deepEqual(unpack(content).map(({ value }) => value), [0, Math.fround(0.2), 1, NaN]);
  assert.equal(stripe.trace.of("/scene/overlay").length, 0);
});
