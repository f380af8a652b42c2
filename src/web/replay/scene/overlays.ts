// What the navigator shows, on the ground: its grid as a picture, its lines over it.
import {
  BufferGeometry, CanvasTexture, DoubleSide, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial,
  NearestFilter, SRGBColorSpace,
} from "three";
import { gridPicture, lineNames, overlayStyle, type Placing, placingOf } from "../overlays";
import type { Palette } from "../palette";
import type { Overlay, OverlayGrid, Overlays } from "../payload";
import type { Drawing, Layers } from "../view";
import { geometryOf } from "./geometry";
import type { GroundHeights } from "./ground";
import { MOST_OVERLAY_PIECES, MOST_OVERLAY_SQUARES } from "./limits";
import { Lines, type Point } from "./lines";

const GRID_LIFT_M = 0.014;
const LINE_LIFT_M = 0.025;
// Keeps lines apart from cells of their colour.
const EDGE_PX = 2;
const WIDTH_PX = 3;
// Of dashes: a width of a line where one looks at it from near.
const WIDTH_M = 0.03;
// So a line follows the ground.
const PIECE_M = 0.1;

/** The lines of one name: wide, or of one pixel where there are very many. */
class NamedLines {
  readonly group = new Group();
  private readonly wide: Lines;
  private readonly edge = new Lines({ width_px: WIDTH_PX + EDGE_PX, edge: true });
  private readonly thin = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  private readonly style = overlayStyle(this.slot);

  constructor(readonly name: string, private readonly slot: number) {
    const { dash } = this.style;
    this.wide = new Lines({ width_px: WIDTH_PX, dash: dash ? [dash[0] * WIDTH_M, dash[1] * WIDTH_M] : undefined });
    this.thin.frustumCulled = false;
    this.group.add(this.edge.object, this.wide.object, this.thin);
  }

  set(points: Point[], many: boolean): void {
    this.wide.set(many ? [] : points);
    this.edge.set(many ? [] : points);
    this.thin.visible = many;
    this.thin.geometry.dispose();
    this.thin.geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(many ? points.flat() : [], 3));
  }

  set onTop(on: boolean) {
    this.wide.onTop = this.edge.onTop = on;
    this.thin.material.depthTest = !on;
    this.thin.renderOrder = on ? 10 : 1;
  }

  recolour(palette: Palette): void {
    this.edge.recolour(palette["overlay-edge"]);
    this.wide.recolour(palette[this.style.colour]);
    this.thin.material.color.set(palette[this.style.colour]);
  }
}

export class OverlayPicture {
  readonly group = new Group();
  private readonly lines: NamedLines[];
  private readonly grids = new Group();
  private overlay: Overlay | null = null;
  private key = "";
  private drawn_: Drawing["overlay"] = { lines: [], grids: [] };

  constructor(overlays: Overlays | null, private readonly heights: GroundHeights) {
    this.lines = lineNames(overlays).map((name, slot) => new NamedLines(name, slot));
    this.group.add(this.grids, ...this.lines.map(({ group }) => group));
  }

  set onTop(on: boolean) {
    for (const lines of this.lines) lines.onTop = on;
  }

  recolour(palette: Palette): void {
    for (const lines of this.lines) lines.recolour(palette);
  }

  show(overlay: Overlay | null, layers: Layers): void {
    const shown = layers.overlay ? overlay : null;
    const key = JSON.stringify([layers.overlayGrid, layers.mapAtTruth]);
    if (shown === this.overlay && key === this.key) return;
    this.overlay = shown;
    this.key = key;
    this.clear();
    if (shown === null) return;
    const place = placingOf(shown, layers.mapAtTruth);
    for (const grid of shown.grids) if (grid.name === layers.overlayGrid) this.addGrid(grid, place);
    this.addLines(shown, place);
  }

  drawn(): Drawing["overlay"] { return this.drawn_; }

  private clear(): void {
    this.drawn_ = { lines: [], grids: [] };
    for (const lines of this.lines) lines.set([], false);
    for (const child of [...this.grids.children]) {
      const mesh = child as Mesh<BufferGeometry, MeshBasicMaterial>;
      this.grids.remove(mesh);
      mesh.geometry.dispose();
      mesh.material.map?.dispose();
      mesh.material.dispose();
    }
  }

  // All lines of a name are one object: a tree has thousands.
  private addLines({ lines }: Overlay, place: Placing): void {
    const paths = lines.map(({ name, points }) => ({ name, points: this.onGround(points.map(([x, y]) => place(x, y))) }));
    const many = paths.reduce((sum, { points }) => sum + points.length - 1, 0) > MOST_OVERLAY_PIECES;
    for (const named of this.lines) {
      const own = paths.filter(({ name }) => name === named.name);
      named.set(own.flatMap(({ points }) => points.slice(1).flatMap((point, i) => [points[i]!, point])), many);
    }
    this.drawn_.lines = paths.map(({ name, points }) => ({ name, points: points.map(([x, y, z]) => ({ x, y, z })) }));
  }

  private onGround(corners: [number, number][]): Point[] {
    const points: Point[] = [];
    corners.forEach(([x, y], i) => {
      const [x0, y0] = corners[Math.max(0, i - 1)]!;
      const pieces = Math.max(1, Math.min(MOST_OVERLAY_PIECES, Math.ceil(Math.hypot(x - x0, y - y0) / PIECE_M)));
      for (let k = i === 0 ? pieces : 1; k <= pieces; ++k) {
        const [wx, wy] = [x0 + (k / pieces) * (x - x0), y0 + (k / pieces) * (y - y0)];
        points.push([wx, wy, this.heights.at(wx, wy) + LINE_LIFT_M]);
      }
    });
    return points;
  }

  // A picture on squares that follow the ground, whatever the number of cells.
  private addGrid(grid: OverlayGrid, place: Placing): void {
    const picture = gridPicture(grid);
    if (!picture) return;
    const { canvas, width, height } = picture;
    const squares = (side: number, cells: number): number => Math.max(1, Math.min(cells, MOST_OVERLAY_SQUARES, Math.ceil(side / PIECE_M)));
    const [columns, rows] = [squares(width, canvas.width), squares(height, canvas.height)];
    const positions: number[] = [];
    const uv: number[] = [];
    for (let i = 0; i < columns * rows; ++i) {
      for (const [du, dv] of CORNERS) {
        const [u, v] = [((i % columns) + du) / columns, (Math.floor(i / columns) + dv) / rows];
        const [x, y] = place(grid.x0 + u * width, grid.y0 + v * height);
        positions.push(x, y, this.heights.at(x, y) + GRID_LIFT_M);
        uv.push(u, v);
      }
    }
    const map = new CanvasTexture(canvas);
    map.colorSpace = SRGBColorSpace;
    map.magFilter = map.minFilter = NearestFilter;
    map.generateMipmaps = false;
    // The lowest row comes first.
    map.flipY = false;
    const mesh = new Mesh(geometryOf(positions, { uv }), new MeshBasicMaterial({ map, transparent: true, side: DoubleSide, depthWrite: false }));
    // Before the edges of lines, which it would cover.
    mesh.renderOrder = 0.2;
    this.grids.add(mesh);
    this.drawn_.grids.push(grid.name);
  }
}

const CORNERS = [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]] as const;
