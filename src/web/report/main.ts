import { readPayload } from "../shared/payload";
import type { ReportPayload } from "./payload";

async function main(): Promise<void> {
  const payload = await readPayload<ReportPayload>();
  document.getElementById("page")!.textContent = payload.title;
}

void main();
