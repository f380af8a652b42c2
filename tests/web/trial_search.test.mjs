// What is asked of the table of trials, without a browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { loadModule } from "./harness.mjs";

const { matching } = await loadModule("report/trial_rows.ts");

const COLUMNS = [{ name: "energy_wh", unit: "Wh" }, { name: "true_distance_m", unit: "m" }, { name: "Mine.replans", unit: "1" }];
const row = (trial, outcome, energy, distance, more) =>
  ({ run: "nominal", trial, outcome, detail: "", replay: "", of: 0, unrated: "", v_energy_wh: energy, v_true_distance_m: distance, ...more });
const ROWS = [
  row(0, "goal_reached", 18, 8.5),
  row(1, "jammed", 50, 3, { detail: "no motion", replay: "r/1.html" }),
  row(2, "false_goal", 22, 9, { unrated: "not in the rates" }),
  row(30, "simulator_fault", null, null),
];
const ALL = { text: "", run: "", outcome: "", onlyReplays: false, onlyRated: false };

const search = (text) => {
  const { rows, problems } = matching(ROWS, COLUMNS, { ...ALL, text });
  return [rows.map((each) => each.trial), problems.length];
};

test("numbers are compared, with blanks or without, by the column's name or title", () => {
  for (const text of ["energy_wh>20", "energy_wh > 20", "energy>20", "ENERGY_WH >20", "true_distance>=3 energy>2.0e1"]) {
    assert.deepEqual(search(text), [[1, 2], 0], text);
  }
  assert.deepEqual(search("trial=30"), [[30], 0]);
  assert.deepEqual(search("energy>20 true_distance<5"), [[1], 0]);
});

test("what a navigator counts is found by a name with a dot, in upper or lower case", () => {
  const rows = [row(0, "jammed", 1, 1, { "v_Mine.replans": 3 }), row(1, "jammed", 1, 1, { "v_Mine.replans": 5 })];
  for (const text of ["Mine.replans>4", "mine.replans > 4"]) {
    assert.deepEqual(matching(rows, COLUMNS, { ...ALL, text }).rows.map((each) => each.trial), [1], text);
  }
});

test("texts are found by words, and by the name of what they are", () => {
  assert.deepEqual(search("jammed"), [[1], 0]);
  assert.deepEqual(search("outcome=jammed"), [[1], 0]);
  assert.deepEqual(search("outcome = goal"), [[0, 2], 0]);
  assert.deepEqual(search("motion"), [[1], 0]);
  assert.deepEqual(search("30"), [[30], 0]);
});

test("what cannot be understood is said, and asks for nothing", () => {
  for (const text of ["foo>3", "energy_wh>", "energy_wh>many", ">3", "outcome<3"]) assert.deepEqual(search(text), [[0, 1, 2, 30], 1], text);
  const { problems } = matching(ROWS, COLUMNS, { ...ALL, text: "foo>3 energy_wh>20" });
  assert.match(problems.join(), /no column “foo”/);
});

test("choices: a replay page, in the rates, one outcome", () => {
  const trials = (choice) => matching(ROWS, COLUMNS, { ...ALL, ...choice }).rows.map((each) => each.trial);
  assert.deepEqual(trials({ onlyReplays: true }), [1]);
  assert.deepEqual(trials({ onlyRated: true }), [0, 1, 30]);
  assert.deepEqual(trials({ outcome: "false_goal" }), [2]);
  assert.deepEqual(trials({ run: "other" }), []);
});
