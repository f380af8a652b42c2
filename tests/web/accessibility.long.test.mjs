// Every page in every look: what accessibility.test.mjs leaves out.
import { LOOKS, testUse } from "./accessibility_pages.mjs";

const each = (...names) => names.flatMap((name) => LOOKS.map((look) => [name, look]));
testUse(each("run.html", "comparison.html", "sweep.html"), each("replay.html", "pair.html", "steps.html"));
