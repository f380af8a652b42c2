// The page: what it is made of, and what goes on when time, switches or the window change.

import { button, el } from "../shared/dom";
import { themeSwitch } from "../shared/theme";
import { timelineEvents } from "./events";
import { type Handle, makeHandle } from "./handle";
import { makeView } from "./make_view";
import { Course as Drive, lastAtOrBefore } from "./motion";
import { Overview } from "./overview";
import { CameraBar } from "./panels/camera_bar";
import { Ending } from "./panels/ending";
import { EyesPanel } from "./panels/eyes";
import { gridNames } from "./overlays";
import { bindKeys, helpDialog, type Key, pageKeys } from "./panels/keys";
import { layersPanel, SCENE_LAYERS } from "./panels/layers";
import { Readout } from "./panels/readout";
import { originPanel, outcomeBanner, recordPanel } from "./panels/record";
import { SharePanel } from "./panels/share_panel";
import { Timeline } from "./panels/timeline";
import { Transport } from "./panels/transport";
import { VotesPanel } from "./panels/votes";
import type { ReplayPayload } from "./payload";
import { Player, standingStretches, type Stretch } from "./player";
import { type Beat, beatsOf } from "./story";
import { shareTouch } from "./touch";
import type { CameraMode, Layers, MapKind, Shown, View } from "./view";

const MAP_KINDS: MapKind[] = ["goodness", "certainty", "elevation", "off"];
/** When nothing of the drive moves. */
export function stretchesOf(drive: Drive): Stretch[] {
  return standingStretches(drive.motion.t, (i) => drive.standsAfter(i));
}

const LONGEST_FRAME_S = 0.1;
// A page in the background draws nothing for minutes.
const LONGEST_GLANCE_S = 1;

/** What a page that shows two trials shares between them. */
export interface Shared {
  player: Player;
  /** The first takes keys, runs the overview and has the player below its picture. */
  first: boolean;
  beats: Beat[];
  /** Where the player is, once for both; and the tools of the page. */
  transport: HTMLElement;
  tools: HTMLElement;
  /** All but the first. */
  others: App[];
}

export class App {
  private readonly drive = new Drive(this.payload.motion);
  private readonly player = this.shared?.player ?? new Player(this.drive.start, this.drive.end, stretchesOf(this.drive));
  private readonly scanTimes = this.payload.scans.map((scan) => scan.t);
  private readonly stepTimes = this.payload.steps.map((step) => step.t);
  private readonly overlayTimes = (this.payload.overlays?.shown ?? []).map((overlay) => overlay.t);
  private readonly layers: Layers = {
    believed: true, wholePath: false, scan: this.payload.steps.length === 0, map: this.payload.steps.length > 0 ? "goodness" : "off",
    mapAtTruth: false, votes: true, marks: true, grid: true, ...SCENE_LAYERS,
    // One map at a time.
    overlay: true, overlayGrid: this.payload.steps.length > 0 ? null : (gridNames(this.payload.overlays)[0] ?? null),
  };
  private readonly events = timelineEvents(this.payload);
  private readonly readout = new Readout(this.payload, this.events);
  private readonly votes = new VotesPanel();
  private readonly eyes = this.payload.eyes ? new EyesPanel(this.payload.eyes) : null;
  private readonly timeline = new Timeline(this.payload, this.events, this.player, () => this.refresh());
  private readonly transport = new Transport(this.player, () => this.timeline.shownTimes);
  private readonly view = makeView(this.payload, this.drive);
  private readonly overview = new Overview(
    this.player, (factor) => this.eachView((view) => view.approach(factor)), this.shared?.beats ?? beatsOf(this.payload, this.events));
  private readonly ending = new Ending(this.payload, this.events, this.player, this.drive.end, () => this.playOverview());
  private readonly share = new SharePanel(this.payload, this.player, this.overview, this.view.element, () => this.refresh());
  private layerPanel = this.makeLayers();
  private readonly cameras = new CameraBar(this.view.modes, {
    mode: (mode) => this.setMode(mode),
    overview: () => this.playOverview(),
    planOfPaths: () => this.planOfPaths(),
  });
  private dirty = true;
  private before = 0;
  private frames = 0;

  constructor(private readonly payload: ReplayPayload, private readonly root: HTMLElement, private readonly shared: Shared | null = null) {
    this.build();
    if (this.leads) bindKeys(this.keys());
    this.player.onChange(() => this.refresh());
    requestAnimationFrame((now) => this.frame(now));
  }

  /** Alone on the page, or the first of two. */
  private get leads(): boolean { return this.shared?.first ?? true; }

  /** Whose camera and layers go as this one's. */
  private get others(): App[] { return this.leads ? (this.shared?.others ?? []) : []; }

  handle(): Handle {
    return makeHandle(this.player, this.drive, this.view, this.overview, {
      frames: () => this.frames,
      update: () => this.updateAll(),
      playOverview: () => this.playOverview(),
    });
  }

  private build(): void {
    const { payload, view } = this;
    const title = el("div", { class: "title" }, el("h1", {}, payload.title), outcomeBanner(payload));
    const tools = el("div", { class: "tools" }, this.share.element);
    if (this.leads) (this.shared?.tools ?? tools).append(...this.pageTools());
    if (this.shared) title.append(el("p", { class: "repeats" }, el("code", {}, payload.command)));
    const picture = el("div", { class: "picture" }, this.cameras.element, el("div", { class: "frame" }, view.element));
    picture.append(this.overview.element, this.ending.element);
    if (view.modes.length > 1) picture.append(shareTouch(view.element));
    else picture.append(el("p", { class: "note" }, "This browser shows no WebGL: here is the plan, without the third dimension."));
    view.element.setAttribute("role", "img");
    view.element.setAttribute("aria-label", `Picture of the trial: ${payload.title}`);
    const stage = el("section", { class: "stage" }, picture, this.timeline.element);
    if (this.shared === null) picture.after(this.transport.element);
    else if (this.leads) this.shared.transport.append(this.transport.element);
    const votes = payload.steps.length > 0 ? this.votes.element : null;
    const side = el("div", { class: "side" }, this.readout.element, this.eyes?.element, this.layerPanel, votes);
    const below = el("div", { class: "below" }, recordPanel(payload), originPanel(payload));
    this.root.classList.add("replay");
    this.root.replaceChildren(el("header", {}, title, tools), el("div", { class: "columns" }, stage, side, below));
    view.onMoved(() => (this.dirty = true));
    new ResizeObserver(() => this.resized()).observe(picture);
    // Paper is light whatever the screen is; it does not wait for the next frame.
    matchMedia("print").addEventListener("change", () => {
      this.recolour();
      this.update();
    });
    this.resized();
    this.setMode(view.modes[0]!);
    const link = new URLSearchParams(location.hash.slice(1));
    this.followLink(link);
    // A link into the page leads to a moment; who asked for less motion gets none unasked.
    if (this.leads && [...link.keys()].length === 0 && !matchMedia("(prefers-reduced-motion: reduce)").matches) this.playOverview();
  }

  private pageTools(): HTMLElement[] {
    const help = helpDialog(this.keys());
    return [button("Keys", "Keys (?)", () => help.showModal()), themeSwitch(() => this.recolourAll())];
  }

  private recolourAll(): void {
    for (const app of [this, ...this.others]) app.recolour();
  }

  private playOverview(): void {
    this.setMode(this.view.modes[0]!);
    this.overview.start();
  }

  // replay.html#view=plan, #view=top&t=120: where a link into the page leads.
  private followLink(link: URLSearchParams): void {
    const mode = link.get("view");
    if (mode === "plan") this.planOfPaths();
    else if (mode !== null) this.setMode(mode as CameraMode);
    if (link.has("t")) this.player.seek(Number(link.get("t")));
  }

  private makeLayers(): HTMLElement {
    return layersPanel(this.payload, this.layers, this.view.modes.length > 1, () => this.refresh());
  }

  private setMode(mode: CameraMode): void {
    for (const other of this.others) other.setMode(mode);
    if (!this.view.modes.includes(mode)) return;
    this.view.setMode(mode);
    this.cameras.show(mode);
    this.refresh();
  }

  /** The plan with both paths to their ends. */
  private planOfPaths(): void {
    this.change({ believed: true, wholePath: true, marks: true });
    this.setMode("top");
  }

  private change(layers: Partial<Layers>): void {
    for (const other of this.others) other.change(layers);
    Object.assign(this.layers, layers);
    const panel = this.makeLayers();
    this.layerPanel.replaceWith(panel);
    this.layerPanel = panel;
    this.refresh();
  }

  private recolour(): void {
    this.view.recolour();
    this.refresh();
  }

  private resized(): void {
    this.view.resize();
    this.refresh();
    // Before the browser shows the new size: an empty picture would flicker.
    this.update();
  }

  private refresh(): void { this.dirty = true; }

  private frame(now: number): void {
    const passed = (now - this.before) / 1000;
    this.before = now;
    // The overview lasts as long as it says, however slowly it is drawn.
    if (this.overview.running) this.overview.advance(Math.min(LONGEST_GLANCE_S, passed));
    else if (this.leads) this.player.advance(Math.min(LONGEST_FRAME_S, passed));
    if (this.dirty) {
      this.update();
      ++this.frames;
      this.share.drawn(now);
    }
    requestAnimationFrame((next) => this.frame(next));
  }

  private update(): void {
    this.dirty = false;
    const shown = this.shownAt(this.player.time);
    this.view.show(shown, this.layers);
    this.view.draw();
    this.readout.show(shown.moment);
    this.votes.show(shown.step);
    this.eyes?.show(this.player.time);
    // Moving the camera with the rover counts as moving it by hand.
    this.dirty = false;
  }

  private updateAll(): void {
    for (const app of [this, ...this.others]) app.update();
  }

  private eachView(change: (view: View) => void): void {
    for (const app of [this, ...this.others]) change(app.view);
  }

  private shownAt(t: number): Shown {
    return {
      moment: this.drive.at(t),
      scan: this.payload.scans[lastAtOrBefore(this.scanTimes, t)] ?? null,
      step: this.payload.steps[lastAtOrBefore(this.stepTimes, t)] ?? null,
      overlay: this.payload.overlays?.shown[lastAtOrBefore(this.overlayTimes, t)] ?? null,
    };
  }

  private keys(): Key[] {
    const move = (change: () => void): void => {
      change();
      this.refresh();
    };
    return pageKeys({
      player: this.player,
      step: (by) => this.transport.step(by),
      camera: (mode) => this.setMode(mode),
      approach: (factor) => move(() => this.eachView((view) => view.approach(factor))),
      turn: (angle) => move(() => this.eachView((view) => view.turn(angle))),
      planOfPaths: () => this.planOfPaths(),
      overview: () => this.playOverview(),
      savePicture: () => void this.share.savePicture(),
      toggleTrueShapes: () => this.change({ trueShapes: !this.layers.trueShapes }),
      toggleCameras: () => this.change({ cameras: !this.layers.cameras }),
      toggleBelieved: () => this.change({ believed: !this.layers.believed }),
      nextMap: () => this.change({ map: MAP_KINDS[(MAP_KINDS.indexOf(this.layers.map) + 1) % MAP_KINDS.length]! }),
    });
  }
}
