// Dark and light: as the system has it, unless the reader has switched.

const KEPT_AS = "gyration-theme";

type Theme = "light" | "dark";

const system = matchMedia("(prefers-color-scheme: dark)");

function current(): Theme {
  const chosen = document.documentElement.dataset.theme;
  return chosen === "dark" || chosen === "light" ? chosen : system.matches ? "dark" : "light";
}

/** Applies what was chosen before; calls back at each change. */
export function watchTheme(changed: () => void): void {
  try {
    const kept = localStorage.getItem(KEPT_AS);
    if (kept === "dark" || kept === "light") document.documentElement.dataset.theme = kept;
  } catch {
    // A page from a disk may have no storage; the choice then lasts as long as the page.
  }
  system.addEventListener("change", changed);
}

export function switchTheme(): void {
  const next = current() === "dark" ? "light" : "dark";
  document.documentElement.dataset.theme = next;
  try {
    localStorage.setItem(KEPT_AS, next);
  } catch {
    // As above.
  }
}

/** A colour of the theme. */
export function themeColor(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
