// Fingers on a picture that can be turned by hand, within a page that scrolls.
//
// One finger up or down scrolls the page, sideways it turns the picture, two fingers move and zoom it.
// After a tap the picture has every finger, until somebody touches the page beside it. Otherwise a
// picture as wide as a phone could not be scrolled past, or could not be turned.
import { el } from "../shared/dom";

const ASLEEP = "One finger scrolls the page; two fingers zoom. Tap the picture to turn it with one finger.";
const AWAKE = "One finger turns the picture. Tap beside it to scroll again.";

/** Lets fingers share the picture with the page; returns a hint that shows when a finger is first used. */
export function shareTouch(picture: HTMLElement): HTMLElement {
  const hint = el("p", { class: "touch-hint", role: "status", hidden: true });
  const give = (awake: boolean): void => {
    picture.style.touchAction = awake ? "none" : "pan-y";
    hint.textContent = awake ? AWAKE : ASLEEP;
  };
  give(false);
  picture.addEventListener("click", () => give(true));
  // Who has no touch screen need not read this.
  picture.addEventListener("pointerdown", ({ pointerType }) => {
    if (pointerType === "touch") hint.hidden = false;
  });
  document.addEventListener("pointerdown", (event) => {
    if (!picture.closest(".picture")!.contains(event.target as Node)) give(false);
  });
  // Browsers take two fingers that move up or down for scrolling.
  const keep = (event: TouchEvent): void => {
    if (event.touches.length > 1 && event.cancelable) event.preventDefault();
  };
  for (const name of ["touchstart", "touchmove"] as const) picture.addEventListener(name, keep, { passive: false });
  return hint;
}
