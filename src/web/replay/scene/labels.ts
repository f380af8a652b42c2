// Text in the scene that keeps its size on the screen.
import { CanvasTexture, OrthographicCamera, PerspectiveCamera, Sprite, SpriteMaterial, SRGBColorSpace, Vector3, type Camera, type Object3D } from "three";

const TEXT_PX = 17;
const FONT_PX = 40;

interface LabelStyle {
  colour: string;
  /** Where the point is within the text: (0.5, 0) is the middle of its lower edge. */
  anchor?: [number, number];
  /** Hidden where the viewer in the scene is further away, m. */
  reach_m?: number;
}

export function makeLabel(text: string, x: number, y: number, z: number, style: LabelStyle): Sprite {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d")!;
  const font = `600 ${FONT_PX}px system-ui, sans-serif`;
  context.font = font;
  canvas.width = Math.ceil(context.measureText(text).width) + 16;
  canvas.height = FONT_PX + 16;
  context.font = font;
  context.textBaseline = "middle";
  context.textAlign = "center";
  context.fillStyle = style.colour;
  context.fillText(text, canvas.width / 2, canvas.height / 2 + 2);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  const sprite = new Sprite(new SpriteMaterial({ map: texture, depthWrite: false }));
  sprite.renderOrder = 5;
  sprite.position.set(x, y, z);
  sprite.center.set(...(style.anchor ?? [0.5, 0]));
  sprite.userData = { aspect: canvas.width / canvas.height, reach_m: style.reach_m ?? Infinity };
  return sprite;
}

/** Makes all labels below `root` as high as text of the page, on a picture of `height_px`. */
export function fitLabels(root: Object3D, camera: Camera, height_px: number): void {
  const eye = camera.getWorldPosition(new Vector3());
  root.traverse((object) => {
    if (!(object instanceof Sprite)) return;
    const { aspect, reach_m: reach } = object.userData as { aspect: number; reach_m: number };
    const distance = eye.distanceTo(object.position);
    const flat = camera instanceof OrthographicCamera;
    object.visible = flat || distance < reach;
    // Seen from above, half of a text would be under the ground.
    object.material.depthTest = !flat;
    const size = TEXT_PX / pixelsPerMetre(camera, distance, height_px);
    object.scale.set(size * aspect, size, 1);
  });
}

/** On a picture of `height_px`, of what is at a distance from the camera. */
export function pixelsPerMetre(camera: Camera, distance: number, height_px: number): number {
  return height_px / visibleHeight(camera, distance);
}

/** How much of the scene the picture is high, m, at a distance. */
function visibleHeight(camera: Camera, distance: number): number {
  if (camera instanceof OrthographicCamera) return (camera.top - camera.bottom) / camera.zoom;
  if (camera instanceof PerspectiveCamera) return 2 * distance * Math.tan((camera.fov * Math.PI) / 360);
  return 1;
}
