// Light and dark: the system's choice until the switch is used. Kept for as long as the page is open.

import { el } from "./dom";

type Scheme = "light" | "dark";

/** The scheme that the page shows now. */
function currentScheme(): Scheme {
  const chosen = document.documentElement.dataset.theme;
  if (chosen === "light" || chosen === "dark") return chosen;
  return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

/** A button that changes between light and dark; `changed` is called after each change. */
export function themeSwitch(changed: (scheme: Scheme) => void = () => {}): HTMLButtonElement {
  const button = el("button", { type: "button", class: "theme-switch" });
  const label = () => {
    button.textContent = currentScheme() === "dark" ? "Light colours" : "Dark colours";
  };
  button.addEventListener("click", () => {
    document.documentElement.dataset.theme = currentScheme() === "dark" ? "light" : "dark";
    label();
    changed(currentScheme());
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    label();
    changed(currentScheme());
  });
  label();
  return button;
}

/** What a colour variable of theme.css ("--accent") is now, as "rgb(...)": for what draws without CSS. */
export function resolvedColour(variable: string): string {
  const probe = el("span", { style: `color: var(${variable}); display: none` });
  document.body.append(probe);
  const colour = getComputedStyle(probe).color;
  probe.remove();
  return colour;
}
