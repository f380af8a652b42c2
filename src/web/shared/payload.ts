// The data that a page was written with: JSON, compressed, in a script element that never runs.

/** Reads and decompresses the page's data. Rejects where the page was damaged. */
export async function readPayload<T>(): Promise<T> {
  const element = document.getElementById("payload");
  const text = element?.textContent?.trim();
  if (!text) throw new Error("This page holds no data: it was not written to its end.");
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return JSON.parse(await new Response(stream).text()) as T;
}
