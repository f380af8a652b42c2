import { el } from "../shared/dom";
import { readPayload } from "../shared/payload";
import { App } from "./app";
import type { Handle } from "./handle";
import type { ReplayPayload } from "./payload";
import "./replay.css";

declare global {
  interface Window {
    /** For tests and the console; see Handle. */
    rockyardReplay?: Handle;
  }
}

async function main(): Promise<void> {
  const root = document.getElementById("page")!;
  try {
    const payload = await readPayload<ReplayPayload>();
    document.title = payload.title;
    window.rockyardReplay = Object.freeze(new App(payload, root).handle());
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    root.replaceChildren(el("p", { class: "problem", role: "alert" }, `This replay cannot be shown. ${reason}`));
    console.error(error);
  }
}

void main();
