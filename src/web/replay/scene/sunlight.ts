// The sun, or the lamp of a hall, and its shadows: they reach as far as the camera sees around the
// rover.
import { AmbientLight, type Camera, Color, DirectionalLight, Frustum, Group, HemisphereLight, Matrix4, OrthographicCamera, Vector3 } from "three";
import type { World } from "../payload";

const SHADOW_PX = 2048;
const PLAIN_SHADOW_PX = 1024;
// Of the visible ground around the rover that gets shadows, m.
const LEAST_REACH_M = 1.5;
const MOST_REACH_M = 14;
// In distances of the camera from the rover.
const SEEN_DISTANCES = 2.2;
// What stands above or below the rover's place and casts shadows there, m.
const HEIGHT_M = 1.5;
// Sizes of the lit square grow in such steps: a shadow whose pixels change with every move would flicker.
const SIZE_STEP = 1.25;
const SUN = 2.3;
const SKY = 1.05;
const AMBIENT = 0.42;

/** Unit vector towards the sun, in W. */
function towardSun({ sun }: World): Vector3 {
  const flat = Math.cos(sun.elevation);
  return new Vector3(flat * Math.cos(sun.azimuth), flat * Math.sin(sun.azimuth), Math.sin(sun.elevation));
}

export class Sunlight {
  readonly group = new Group();
  readonly toward: Vector3;
  /** What gets and casts shadows. */
  readonly lit = new Frustum();
  private readonly lamp = new DirectionalLight(0xffffff, SUN);
  private readonly sky = new HemisphereLight(0xffffff, 0x8a7a6a, SKY);

  constructor(world: World) {
    this.toward = towardSun(world);
    const { shadow } = this.lamp;
    this.lamp.castShadow = true;
    shadow.bias = -0.0006;
    shadow.normalBias = 0.012;
    this.group.add(new AmbientLight(0xffffff, AMBIENT), this.sky, this.lamp, this.lamp.target);
    this.setPlain(false);
  }

  /** The colour that light from the sky and from the ground has. */
  recolour(sky: string, ground: string): void {
    this.sky.color.set(sky).lerp(new Color(0xffffff), 0.6);
    this.sky.groundColor.set(ground);
  }

  setPlain(plain: boolean): void {
    const size = plain ? PLAIN_SHADOW_PX : SHADOW_PX;
    const { shadow } = this.lamp;
    if (shadow.mapSize.x === size) return;
    shadow.mapSize.set(size, size);
    shadow.map?.dispose();
    shadow.map = null;
  }

  /** Fits the shadows to what `camera` sees of the ground around the rover at `place`. */
  fit(camera: Camera, place: Vector3): void {
    const { middle, reach } = visibleGround(camera, place);
    const frustum = this.lamp.shadow.camera;
    const size = SIZE_STEP ** Math.ceil(Math.log(reach) / Math.log(SIZE_STEP));
    frustum.left = frustum.bottom = -size;
    frustum.right = frustum.top = size;
    // At low sun what casts a shadow into the square stands far away.
    const depth = size + HEIGHT_M / Math.max(0.1, this.toward.z);
    frustum.near = 0.1;
    frustum.far = 2 * depth;
    frustum.updateProjectionMatrix();
    const center = this.snapped(middle, (2 * size) / this.lamp.shadow.mapSize.x);
    this.lamp.target.position.copy(center);
    this.lamp.position.copy(center).addScaledVector(this.toward, depth);
    this.group.updateMatrixWorld(true);
    this.lamp.shadow.updateMatrices(this.lamp);
    this.lit.setFromProjectionMatrix(this.toLight());
  }

  /** From W to the shadow's picture, -1 to 1 within it. */
  toLight(): Matrix4 {
    const { camera } = this.lamp.shadow;
    return new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  }

  /** Length of one pixel of the shadows, m. */
  get texel_m(): number {
    const { camera, mapSize } = this.lamp.shadow;
    return (camera.right - camera.left) / mapSize.x;
  }

  // Moved to whole pixels of the shadow, so that its edges stand still while the rover drives.
  private snapped(point: Vector3, texel_m: number): Vector3 {
    const toLight = new Matrix4().lookAt(this.toward, new Vector3(), new Vector3(0, 1, 0)).transpose();
    const p = point.clone().applyMatrix4(toLight);
    p.x = Math.round(p.x / texel_m) * texel_m;
    p.y = Math.round(p.y / texel_m) * texel_m;
    return p.applyMatrix4(toLight.transpose());
  }
}

/** A circle of ground that holds the rover and most of what the camera sees near it. */
function visibleGround(camera: Camera, place: Vector3): { middle: Vector3; reach: number } {
  if (camera instanceof OrthographicCamera) {
    const middle = camera.getWorldPosition(new Vector3()).setZ(place.z);
    const half = Math.hypot(camera.right - camera.left, camera.top - camera.bottom) / 2 / camera.zoom;
    // Where the plan is wider than shadows reach, they stay with the rover.
    return half <= MOST_REACH_M ? { middle, reach: Math.max(LEAST_REACH_M, half) } : { middle: place, reach: MOST_REACH_M };
  }
  const eye = camera.getWorldPosition(new Vector3());
  const distance = eye.distanceTo(place);
  const reach = Math.min(MOST_REACH_M, Math.max(LEAST_REACH_M, SEEN_DISTANCES * distance));
  // Ahead of the rover, where the camera sees more of the ground than behind it.
  const ahead = camera.getWorldDirection(new Vector3()).setZ(0);
  if (ahead.lengthSq() > 1e-9) ahead.normalize();
  return { middle: place.clone().addScaledVector(ahead, 0.45 * reach), reach };
}
