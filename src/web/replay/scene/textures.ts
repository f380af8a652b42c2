// Textures that the page makes at its start: grain of the soil, of rocks, and the print of a wheel.
// They are near white on average, because the colours of the palette go on top.
import { CanvasTexture, RepeatWrapping, SRGBColorSpace } from "three";
import { randomNumbers, tiledNoise } from "./noise";

/** What one repetition of the soil's grain covers, m. */
export const SOIL_TILE_M = 1.6;
const SOIL_PX = 512;
const ROCK_PX = 128;
const SOIL_SEED = 11;
const ROCK_SEED = 23;
// Heights of the soil's grain, in pixels of it, and sizes of its clods, px.
const GRAIN_PX = 1.1;
const CLODS_PX = [64, 24, 8, 3];
const PEBBLES = 260;
// Ground is seen at flat angles; more would cost where drawing is done in software.
const ANISOTROPY = 2;
// Steeper for the eye than the light makes it.
const RELIEF = 0.3;

/**
 * The grain of the soil as the sun shades it: a field of small heights, lit once from where the sun
 * stands, because the sun does not move while a drive is shown. `toward` is the direction to the sun.
 */
export function soilTexture(toward: { x: number; y: number; z: number }): CanvasTexture {
  const heights = grainHeights();
  const at = (x: number, y: number): number => heights[((y + SOIL_PX) % SOIL_PX) * SOIL_PX + ((x + SOIL_PX) % SOIL_PX)]!;
  const random = randomNumbers(SOIL_SEED + 1);
  return paint(SOIL_PX, (x, y) => {
    // Rows of an image count downwards, y of the ground upwards.
    const slopeX = 0.5 * (at(x + 1, y) - at(x - 1, y));
    const slopeY = 0.5 * (at(x, y - 1) - at(x, y + 1));
    const lit = -(slopeX * toward.x + slopeY * toward.y) * RELIEF;
    const speck = 0.05 * (random() - 0.5);
    return Math.max(0.55, Math.min(1.12, 0.94 + lit + speck));
  });
}

function grainHeights(): Float32Array {
  const heights = new Float32Array(SOIL_PX * SOIL_PX);
  for (let y = 0; y < SOIL_PX; ++y) {
    for (let x = 0; x < SOIL_PX; ++x) {
      let sum = 0;
      CLODS_PX.forEach((size, k) => {
        const period = Math.round(SOIL_PX / size);
        sum += Math.sqrt(size) * tiledNoise((x * period) / SOIL_PX, (y * period) / SOIL_PX, period, SOIL_SEED + k);
      });
      heights[y * SOIL_PX + x] = GRAIN_PX * sum;
    }
  }
  addPebbles(heights);
  return heights;
}

// Half balls of one to four pixels: below 13 mm, far smaller than any rock of a scenario.
function addPebbles(heights: Float32Array): void {
  const random = randomNumbers(SOIL_SEED + 2);
  for (let i = 0; i < PEBBLES; ++i) {
    const [cx, cy, radius] = [random() * SOIL_PX, random() * SOIL_PX, 1 + 3 * random() ** 3];
    for (let dy = -4; dy <= 4; ++dy) {
      for (let dx = -4; dx <= 4; ++dx) {
        const rise = radius * radius - dx * dx - dy * dy;
        if (rise <= 0) continue;
        const x = (Math.floor(cx) + dx + SOIL_PX) % SOIL_PX;
        const y = (Math.floor(cy) + dy + SOIL_PX) % SOIL_PX;
        heights[y * SOIL_PX + x]! += 1.3 * Math.sqrt(rise);
      }
    }
  }
}

/** Mottled, with dark pits. */
export function rockTexture(): CanvasTexture {
  const random = randomNumbers(ROCK_SEED);
  return paint(ROCK_PX, (x, y) => {
    const [u, v] = [x / ROCK_PX, y / ROCK_PX];
    const broad = tiledNoise(6 * u, 6 * v, 6, ROCK_SEED);
    const fine = tiledNoise(26 * u, 26 * v, 26, ROCK_SEED + 1);
    const pit = fine < 0.22 ? 0.16 * (1 - fine / 0.22) : 0;
    return 0.86 + 0.16 * broad + 0.1 * (fine - 0.5) + 0.08 * (random() - 0.5) - pit;
  });
}

/** What one repetition of a wheel's print is long: four bars, m. */
export const PRINT_TILE_M = 0.1;
const PRINT_PX = 64;
const PRINT_BARS = 4;

/** White bars across the track with soft edges, on a fainter ground; only its opacity differs. */
export function printTexture(): CanvasTexture {
  const random = randomNumbers(31);
  return paint(PRINT_PX, () => 1, (x, y) => {
    const edge = Math.min(1, Math.min(x, PRINT_PX - 1 - x) / 7);
    const bar = 0.5 + 0.5 * Math.cos((2 * Math.PI * PRINT_BARS * y) / PRINT_PX);
    return edge * (0.1 + 0.14 * bar + 0.05 * random());
  });
}

/** A grey picture that repeats; shades of 1 and above are white. */
function paint(size: number, shade: (x: number, y: number) => number, opacity: (x: number, y: number) => number = () => 1): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const context = canvas.getContext("2d")!;
  const image = context.createImageData(size, size);
  for (let i = 0; i < size * size; ++i) {
    const [x, y] = [i % size, Math.floor(i / size)];
    image.data.fill(255 * shade(x, y), 4 * i, 4 * i + 3);
    image.data[4 * i + 3] = 255 * opacity(x, y);
  }
  context.putImageData(image, 0, 0);
  const texture = new CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = ANISOTROPY;
  return texture;
}
