// Lists of outcomes in the pages: complete, as the program has them (src/truth).
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { loadModule, sourceFolder } from "./harness.mjs";

const { causeWords, outcomeSentence } = await loadModule("shared/outcomes.ts");
const { STYLES } = await loadModule("report/series.ts");
const { TRY } = await loadModule("replay/panels/ending.ts");

const source = (name) => readFileSync(path.join(sourceFolder, "src/truth", name), "utf8");
const names = source("record.h").match(/kTrialOutcomeNames = \{([^}]*)\}/)[1].match(/[a-z_]+/g);
// Literals that follow one another are one text.
const causes = [...source("end_cause.h").matchAll(/\{"(\w+)", TrialOutcome::k(\w+), "[^"]*",\s*((?:"[^"]*"\s*)+),/g)].map(
  ([, name, outcome, texts]) => ({ name, outcome: outcome.replace(/(?<!^)[A-Z]/g, "_$&").toLowerCase(), sentence: texts.match(/"([^"]*)"/g).map((text) => text.slice(1, -1)).join("") }),
);

const NO_DRIVES = ["simulator_fault", "measured"];

test("the lists of the program are read", () => {
  assert.ok(names.length >= 13 && names.includes("navigator_fault"), `${names}`);
  assert.equal(causes.length, Number(source("end_cause.h").match(/EndCauseInfo, (\d+)>/)[1]));
  for (const { outcome } of causes) assert.ok(names.includes(outcome), outcome);
});

test("each outcome has its sentence, its words, a style and advice", () => {
  for (const name of names) {
    assert.notEqual(outcomeSentence(name), "", name);
    if (name !== "measured") assert.doesNotMatch(causeWords(name), /^ended as/, name);
    if (NO_DRIVES.includes(name)) continue;
    assert.ok(name in STYLES, `style of ${name}`);
    if (name !== "goal_reached") assert.ok(name in TRY, `advice on ${name}`);
  }
  for (const list of [STYLES, TRY]) for (const name of Object.keys(list)) assert.ok(names.includes(name), name);
});

test("no two outcomes look the same on a map", () => {
  const looks = Object.values(STYLES).map(({ colour, mark, dash, hollow }) => [colour, mark(1), dash, Boolean(hollow)].join());
  assert.equal(new Set(looks).size, looks.length);
});

test("each fault of a navigator has words of its own, whatever the navigator said", () => {
  const faults = causes.filter(({ outcome }) => outcome === "navigator_fault");
  assert.ok(faults.length >= 8);
  const words = faults.map(({ sentence }) => causeWords("navigator_fault", `${sentence}: no map: at all`));
  assert.equal(new Set([...words, causeWords("navigator_fault")]).size, faults.length + 1);
  faults.forEach(({ sentence }, i) => assert.equal(causeWords("navigator_fault", sentence), words[i]));
});
