// Time of the replay: what plays when, how fast, and what is skipped. No clock, no page: whoever
// draws calls `advance` with the time that went by.
import { lastAtOrBefore } from "./motion";

export const SPEEDS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000] as const;

/** Standing for longer is played as if it were this long, s. */
export const STANDING_S = 0.25;

/** How long a whole replay should take by itself, s. */
const COMFORTABLE_S = 60;

export interface Stretch { from: number; to: number }

/** Stretches of `t` in which `stands(i)` holds from sample i to i + 1, joined where they touch. */
export function standingStretches(t: number[], stands: (index: number) => boolean): Stretch[] {
  const stretches: Stretch[] = [];
  for (let i = 0; i + 1 < t.length; ++i) {
    if (!stands(i)) continue;
    const last = stretches[stretches.length - 1];
    if (last && last.to === t[i]) last.to = t[i + 1]!;
    else stretches.push({ from: t[i]!, to: t[i + 1]! });
  }
  return stretches;
}

/** Where both stretches hold: what stands in one drive alone is not shortened. */
export function common(a: Stretch[], b: Stretch[]): Stretch[] {
  const found: Stretch[] = [];
  for (const { from, to } of a) {
    for (const other of b) {
      const begin = Math.max(from, other.from);
      const end = Math.min(to, other.to);
      if (begin < end) found.push({ from: begin, to: end });
    }
  }
  return found.sort((x, y) => x.from - y.from);
}

/** Maps simulated time to played time and back: both grow together, piece by piece. */
export class Pace {
  private readonly simulated = [this.start];
  private readonly played = [this.start];

  constructor(private readonly start: number, end: number, skipped: Stretch[]) {
    for (const { from, to } of skipped) {
      if (to - from <= STANDING_S) continue;
      this.add(from, from - this.simulated[this.simulated.length - 1]!);
      this.add(to, STANDING_S);
    }
    this.add(end, end - this.simulated[this.simulated.length - 1]!);
  }

  /** Played seconds of the whole. */
  get duration(): number { return this.played[this.played.length - 1]! - this.played[0]!; }

  toPlayed(t: number): number { return Pace.map(this.simulated, this.played, t); }

  toSimulated(t: number): number { return Pace.map(this.played, this.simulated, t); }

  private add(simulated: number, seconds: number): void {
    if (seconds <= 0) return;
    this.simulated.push(simulated);
    this.played.push(this.played[this.played.length - 1]! + seconds);
  }

  private static map(from: number[], to: number[], t: number): number {
    const last = from.length - 1;
    if (t >= from[last]!) return to[last]!;
    const index = lastAtOrBefore(from, t);
    if (index < 0) return to[0]!;
    const share = (t - from[index]!) / (from[index + 1]! - from[index]!);
    return to[index]! + share * (to[index + 1]! - to[index]!);
  }
}

/** The speed at which the whole takes about a minute. */
export function comfortableSpeed(duration: number): number {
  const wanted = duration / COMFORTABLE_S;
  return SPEEDS.find((speed) => speed >= wanted) ?? SPEEDS[SPEEDS.length - 1]!;
}

export class Player {
  time = this.start;
  playing = false;
  private skipping = true;
  private readonly whole = new Pace(this.start, this.end, []);
  private readonly shortened = new Pace(this.start, this.end, this.standing);
  speed = comfortableSpeed(this.shortened.duration);
  private readonly listeners: (() => void)[] = [];

  constructor(readonly start: number, readonly end: number, private readonly standing: Stretch[]) {}

  get skipStanding(): boolean { return this.skipping; }

  set skipStanding(skip: boolean) {
    this.skipping = skip;
    this.tell();
  }

  /** How much of the whole was played by `t`, 0 to 1. */
  shareOf(t: number): number {
    const { pace } = this;
    return pace.duration > 0 ? (pace.toPlayed(t) - this.start) / pace.duration : 0;
  }

  /** The time by which `share` of the whole was played. */
  timeOf(share: number): number { return this.pace.toSimulated(this.start + share * this.pace.duration); }

  /** Called whenever time, speed or playing have changed. */
  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Starts again from the beginning where the end was reached. */
  play(): void {
    if (this.time >= this.end) this.time = this.start;
    this.playing = this.end > this.start;
    this.tell();
  }

  pause(): void {
    this.playing = false;
    this.tell();
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  seek(t: number): void {
    if (Number.isNaN(t)) return;
    this.time = Math.min(this.end, Math.max(this.start, t));
    if (this.time >= this.end) this.playing = false;
    this.tell();
  }

  setSpeed(speed: number): void {
    this.speed = Math.min(SPEEDS[SPEEDS.length - 1]!, Math.max(SPEEDS[0], speed));
    this.tell();
  }

  /** One speed faster (+1) or slower (-1). */
  changeSpeed(by: number): void {
    const at = SPEEDS.findIndex((speed) => speed >= this.speed);
    this.setSpeed(SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, at + by))]!);
  }

  /** Plays on by `seconds` of the viewer's time; stops at the end. */
  advance(seconds: number): void {
    if (!this.playing || seconds <= 0) return;
    const pace = this.pace;
    this.seek(pace.toSimulated(pace.toPlayed(this.time) + seconds * this.speed));
  }

  private get pace(): Pace { return this.skipping ? this.shortened : this.whole; }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}

/**
 * The next (+1) or previous (-1) of ascending `times`, at least `gap` away, because events come in
 * groups: what happened in one look is one step. Null where there is none.
 */
export function neighbour(times: number[], now: number, by: 1 | -1, gap = 1e-6): number | null {
  return (by > 0 ? times.find((t) => t > now + gap) : times.findLast((t) => t < now - gap)) ?? null;
}
