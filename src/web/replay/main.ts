import { readPayload } from "../shared/payload";
import type { ReplayPayload } from "./payload";

async function main(): Promise<void> {
  const payload = await readPayload<ReplayPayload>();
  document.getElementById("page")!.textContent = payload.title;
}

void main();
