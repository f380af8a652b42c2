import { el } from "../shared/dom";
import { readPayload } from "../shared/payload";
import { App } from "./app";
import type { Handle } from "./handle";
import { makePair } from "./pair";
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
    document.title = payload.beside ? `${payload.title}, and ${payload.beside.title}` : payload.title;
    const app = payload.beside ? makePair(payload, payload.beside, root) : new App(payload, root);
    window.rockyardReplay = Object.freeze(app.handle());
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    root.replaceChildren(el("p", { class: "problem", role: "alert" }, `This replay cannot be shown. ${reason}`));
    console.error(error);
  }
}

void main();
