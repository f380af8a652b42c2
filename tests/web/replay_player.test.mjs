// Time and motion of the replay, without a browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { loadModule } from "./harness.mjs";

const { comfortableSpeed, neighbour, Pace, Player, standingStretches } = await loadModule("replay/player.ts");
const { angleBetween, Course, headingOf, lastAtOrBefore, slerp } = await loadModule("replay/motion.ts");
const { activityRuns, inWords, kindName, kindsOf, timelineEvents } = await loadModule("replay/events.ts");
const { clock, recorded } = await loadModule("replay/format.ts");

const about = (actual, expected, within = 1e-12) =>
  assert.ok(Math.abs(actual - expected) <= within, `${actual} is not ${expected} within ${within}`);

const turned = (rad) => ({ w: Math.cos(rad / 2), x: 0, y: 0, z: Math.sin(rad / 2) });

// Drives 1 m in 10 s, stands 20 s, is set elsewhere at 40 s, and turns on the spot until 50 s.
function motion() {
  const headings = [0, 0, 0, 0, 1];
  return {
    t: [0, 10, 30, 40, 50],
    x: [0, 1, 1, 5, 5], y: [0, 0, 0, 2, 2], z: [0, 0.1, 0.1, 0, 0],
    qw: headings.map((h) => turned(h).w), qx: [0, 0, 0, 0, 0], qy: [0, 0, 0, 0, 0],
    qz: headings.map((h) => turned(h).z),
    joints: { left_front_wheel: [0, 4, 4, 4, 5] },
    believed_x: [0, 1.1, 1.1, 1.1, 1.1], believed_y: [0, 0, 0, 0, 0], believed_heading: [0, 0, 0, 3, -3],
    activity: [0, 0, 1, 1, 2], activity_names: ["drive", "scan", "turn"],
    tilt: [0, 0.2, 0.2, 0.1, 0.1], breaks: [3],
  };
}

test("the last entry at or before a value", () => {
  const list = [0, 1, 1, 3];
  const places = [-1, 0, 0.5, 1, 2.9, 3, 99].map((value) => lastAtOrBefore(list, value));
  assert.deepEqual(places, [-1, 0, 0, 2, 2, 3, 3]);
  assert.equal(lastAtOrBefore([], 1), -1);
});

test("angles go the short way round", () => {
  about(angleBetween(3, -3), 2 * Math.PI - 6);
  about(angleBetween(-3, 3), 6 - 2 * Math.PI);
  about(angleBetween(0.5, 0.7 + 4 * Math.PI), 0.2, 1e-9);
});

test("attitudes turn at a constant rate, the short way, whatever their sign", () => {
  const negative = (q) => ({ w: -q.w, x: -q.x, y: -q.y, z: -q.z });
  for (const share of [0, 0.25, 0.5, 1]) {
    about(headingOf(slerp(turned(0.2), turned(1.8), share)), 0.2 + 1.6 * share);
    about(headingOf(slerp(turned(0.2), negative(turned(1.8)), share)), 0.2 + 1.6 * share);
  }
  about(headingOf(slerp(turned(0.3), turned(0.3 + 1e-9), 0.5)), 0.3, 1e-8);
});

test("between samples the rover is between their poses", () => {
  const now = new Course(motion()).at(5);
  assert.equal(now.index, 0);
  about(now.x, 0.5);
  about(now.z, 0.05);
  about(now.joints.left_front_wheel, 2);
  about(now.believed.x, 0.55);
  about(now.error, 0.05);
  assert.equal(now.activity, "drive");
});

test("at a sample the rover is exactly there", () => {
  const course = new Course(motion());
  motion().t.forEach((t, i) => {
    const now = course.at(t);
    assert.equal(now.index, i);
    assert.equal(now.x, motion().x[i]);
    assert.equal(now.y, motion().y[i]);
    assert.equal(now.attitude.z, motion().qz[i]);
  });
  assert.equal(course.at(1e9).x, 5);
  assert.equal(course.at(-1e9).x, 0);
});

test("where operators moved the rover it waits, then it is there", () => {
  const course = new Course(motion());
  assert.equal(course.at(39.999).x, 1);
  assert.equal(course.at(39.999).believed.heading, 0);
  assert.equal(course.at(40).x, 5);
});

test("a believed heading passes 180 degrees without a turn round", () => {
  about(new Course(motion()).at(45).believed.heading, Math.PI, 1e-9);
});

test("standing is where nothing moves: no drive, no turn, no break", () => {
  const course = new Course(motion());
  const stretches = standingStretches(motion().t, (i) => course.standsAfter(i));
  assert.deepEqual(stretches, [{ from: 10, to: 30 }]);
  const joined = standingStretches([0, 1, 2, 3, 4], (i) => i !== 2);
  assert.deepEqual(joined, [{ from: 0, to: 2 }, { from: 3, to: 4 }]);
});

test("standing is played as a quarter of a second", () => {
  const pace = new Pace(0, 50, [{ from: 10, to: 30 }, { from: 41, to: 41.5 }, { from: 45, to: 45.2 }]);
  assert.equal(pace.duration, 30);
  assert.equal(pace.toPlayed(10), 10);
  assert.equal(pace.toPlayed(20), 10.125);
  assert.equal(pace.toPlayed(30), 10.25);
  assert.equal(pace.toPlayed(50), 30);
  for (const t of [0, 3, 10, 17, 30, 41.2, 50]) about(pace.toSimulated(pace.toPlayed(t)), t, 1e-9);
});

test("a drive that stands at both ends keeps them", () => {
  const pace = new Pace(5, 100, [{ from: 5, to: 50 }, { from: 60, to: 100 }]);
  assert.equal(pace.duration, 10.5);
  assert.equal(pace.toSimulated(pace.toPlayed(100)), 100);
  assert.equal(pace.toSimulated(pace.toPlayed(5)), 5);
});

test("the player plays at its speed and stops exactly at the end", () => {
  const player = new Player(0, 50, [{ from: 10, to: 30 }]);
  assert.equal(player.playing, false);
  player.advance(1);
  assert.equal(player.time, 0);
  player.setSpeed(2);
  player.play();
  player.advance(2.5);
  assert.equal(player.time, 5);
  player.advance(2.625);
  assert.equal(player.time, 30);
  player.skipStanding = false;
  player.seek(10);
  player.advance(3);
  assert.equal(player.time, 16);
  player.advance(1000);
  assert.equal(player.time, 50);
  assert.equal(player.playing, false);
});

test("playing at the end starts anew; seeking stays within the drive", () => {
  const player = new Player(10, 20, []);
  player.seek(99);
  assert.equal(player.time, 20);
  player.play();
  assert.equal(player.time, 10);
  player.seek(-5);
  assert.equal(player.time, 10);
  player.seek(NaN);
  assert.equal(player.time, 10);
});

test("shares are of what is played", () => {
  const player = new Player(0, 50, [{ from: 10, to: 30 }]);
  about(player.shareOf(10), 10 / 30.25);
  about(player.timeOf(10.25 / 30.25), 30);
  player.skipStanding = false;
  about(player.shareOf(10), 0.2);
  about(player.timeOf(0.5), 25);
  assert.equal(player.timeOf(1), 50);
  assert.equal(player.timeOf(-1), 0);
  assert.equal(new Player(3, 3, []).shareOf(3), 0);
});

test("an empty drive cannot be played", () => {
  const player = new Player(0, 0, []);
  player.play();
  assert.equal(player.playing, false);
  assert.equal(new Pace(0, 0, []).toSimulated(3), 0);
});

test("speeds go up and down by steps and end where the list ends", () => {
  const player = new Player(0, 1200, []);
  assert.equal(player.speed, 20);
  player.changeSpeed(1);
  assert.equal(player.speed, 50);
  for (let i = 0; i < 20; ++i) player.changeSpeed(1);
  assert.equal(player.speed, 1000);
  for (let i = 0; i < 20; ++i) player.changeSpeed(-1);
  assert.equal(player.speed, 1);
  assert.equal(comfortableSpeed(30), 1);
  assert.equal(comfortableSpeed(1e9), 1000);
});

test("who listens hears of every change", () => {
  const player = new Player(0, 10, []);
  let heard = 0;
  player.onChange(() => ++heard);
  player.play();
  player.advance(1);
  player.pause();
  player.seek(3);
  assert.equal(heard, 4);
});

test("the neighbour of a time skips what is the same moment", () => {
  const times = [1, 5, 5.01, 9];
  assert.equal(neighbour(times, 1, 1, 0.05), 5);
  assert.equal(neighbour(times, 5, 1, 0.05), 9);
  assert.equal(neighbour(times, 9, 1, 0.05), null);
  assert.equal(neighbour(times, 9, -1, 0.05), 5.01);
  assert.equal(neighbour(times, 5.01, -1, 0.05), 1);
  assert.equal(neighbour(times, 1, -1, 0.05), null);
});

test("scans and turns that nobody wrote as events become marks, once", () => {
  const end = { t: 50, kind: "end", detail: "time_limit", x: 5, y: 2, heading: 1 };
  const payload = { motion: motion(), events: [end], scans: [{ t: 30, x: 1, y: 0, heading: 0, points: [], hazards: [] }] };
  const events = timelineEvents(payload);
  assert.deepEqual(events.map(({ t, kind }) => [t, kind]), [[30, "scan"], [40, "turn"], [50, "end"]]);
  assert.deepEqual(kindsOf(events), ["scan", "turn", "end"]);
  assert.deepEqual(timelineEvents({ ...payload, events }).length, 3);
});

test("runs of one activity cover the time", () => {
  assert.deepEqual(activityRuns({ motion: motion() }), [
    { from: 0, to: 10, activity: "drive" },
    { from: 10, to: 40, activity: "scan" },
    { from: 40, to: 50, activity: "turn" },
  ]);
});

test("events and numbers in words", () => {
  assert.equal(inWords({ kind: "hazard", detail: "#..#." }), "believes in a hazard: stripes 1, 4 of 5 from the left");
  assert.equal(inWords({ kind: "end", detail: "goal_reached" }), "the trial ended: goal reached");
  assert.equal(inWords({ kind: "new_kind", detail: "" }), "new_kind");
  assert.deepEqual(["turn", "scan", "new_kind"].map(kindName), ["turn in place", "scan", "new_kind"]);
  assert.equal(clock(65.25), "1:05.3");
  assert.equal(clock(59.96), "1:00.0");
  assert.equal(clock(3661), "1:01:01.0");
  assert.equal(recorded(null), "undefined");
  assert.equal(recorded(-2), "−2");
  assert.equal(recorded(1 / 3), "0.333333");
});
