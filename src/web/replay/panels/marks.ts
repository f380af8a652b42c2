// The mark of each kind of event: a shape and a colour of its own.

interface Look {
  /** About (0, 0), some 10 wide. */
  path: string;
  /** A variable of the style sheet. */
  colour: string;
}

const LOOKS: Record<string, Look> = {
  scan: { path: "M-1-5h2v10h-2z", colour: "--series-6" },
  look: { path: "M-1-5h2v10h-2z", colour: "--series-6" },
  hazard: { path: "M0-5 5 4h-10z", colour: "--series-2" },
  chosen: { path: "M0-5 4 0 0 5-4 0z", colour: "--series-3" },
  turn: { path: "M-4 0a4 4 0 1 1 8 0a4 4 0 1 1-8 0M-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0", colour: "--series-1" },
  felt: { path: "M0-5 1.5-1.5 5 0 1.5 1.5 0 5-1.5 1.5-5 0-1.5-1.5z", colour: "--series-5" },
  scrape: { path: "M-4-5 0-1 4-5 5-4 1 0 5 4 4 5 0 1-4 5-5 4-1 0-5-4z", colour: "--series-4" },
  stall: { path: "M-4-4h8v8h-8z", colour: "--bad" },
  reflection: { path: "M-3-5h2v10h-2zM1-5h2v10h-2z", colour: "--series-4" },
  end: { path: "M-3-5h7l-2 2.5 2 2.5h-5.5v5h-1.5z", colour: "--text" },
};

const OTHER: Look = { path: "M-3 0a3 3 0 1 1 6 0a3 3 0 1 1-6 0", colour: "--muted" };

export function markOf(kind: string): Look {
  return LOOKS[kind] ?? OTHER;
}

interface Band {
  colour: string;
  height: number;
}

/** Activities differ in height too: what moves is high, what stands low. */
export function bandOf(activity: string): Band {
  const bands: Record<string, Band> = {
    drive: { colour: "--series-1", height: 16 },
    turn: { colour: "--series-3", height: 12 },
    steer: { colour: "--series-4", height: 10 },
    scan: { colour: "--series-6", height: 6 },
    image: { colour: "--series-6", height: 6 },
    compute: { colour: "--series-5", height: 5 },
    overhead: { colour: "--line-strong", height: 3 },
    stall: { colour: "--bad", height: 8 },
  };
  return bands[activity] ?? { colour: "--muted", height: 4 };
}
