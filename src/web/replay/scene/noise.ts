// Random numbers and smooth noise for what is drawn only. Everything comes from fixed seeds, so that
// the same trial looks the same on every machine.

/** Numbers in [0, 1) from a seed: a counter, mixed by the finalizer of MurmurHash3 (Appleby 2011). */
export function randomNumbers(seed: number): () => number {
  let counter = seed >>> 0;
  return () => {
    counter = (counter + 0x9e3779b9) >>> 0;
    return hashed(counter) / 2 ** 32;
  };
}

function hashed(value: number): number {
  let h = value >>> 0;
  h = Math.imul(h ^ (h >>> 16), 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae35);
  return (h ^ (h >>> 16)) >>> 0;
}

const lattice = (x: number, y: number, z: number, seed: number): number =>
  hashed(Math.imul(x, 0x27d4eb2f) ^ Math.imul(y, 0x165667b1) ^ Math.imul(z, 0x5bd1e995) ^ seed) / 2 ** 32;

const smooth = (share: number): number => share * share * (3 - 2 * share);

const mix = (a: number, b: number, share: number): number => a + share * (b - a);

/** Smooth noise in [0, 1) over space, with one value for each unit cube's corner. */
export function noise3(x: number, y: number, z: number, seed: number): number {
  const [ix, iy, iz] = [Math.floor(x), Math.floor(y), Math.floor(z)];
  const [u, v, w] = [smooth(x - ix), smooth(y - iy), smooth(z - iz)];
  const edge = (dy: number, dz: number): number => mix(lattice(ix, iy + dy, iz + dz, seed), lattice(ix + 1, iy + dy, iz + dz, seed), u);
  return mix(mix(edge(0, 0), edge(1, 0), v), mix(edge(0, 1), edge(1, 1), v), w);
}

/** Smooth noise in [0, 1) over a square that repeats every `period` units. */
export function tiledNoise(x: number, y: number, period: number, seed: number): number {
  const [ix, iy] = [Math.floor(x), Math.floor(y)];
  const [u, v] = [smooth(x - ix), smooth(y - iy)];
  const at = (dx: number, dy: number): number => lattice((ix + dx) % period, (iy + dy) % period, 0, seed);
  return mix(mix(at(0, 0), at(1, 0), u), mix(at(0, 1), at(1, 1), u), v);
}
