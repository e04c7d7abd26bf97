// Light, dark, or as the system has it.
import {radios} from "./controls";

const kKey = "contactcheck-theme";

function remembered(): string {
  try {
    return localStorage.getItem(kKey) ?? "auto";
  } catch {
    return "auto"; // a page from disk may have no storage
  }
}

function apply(theme: string): void {
  if (theme === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
  try {
    localStorage.setItem(kKey, theme);
  } catch {
    // It is not remembered, then.
  }
}

export function themeSwitch(): HTMLElement {
  const theme = remembered();
  apply(theme);
  const control = radios(
    "Colours",
    [
      ["auto", "system"],
      ["light", "light"],
      ["dark", "dark"],
    ],
    theme,
    apply,
  );
  control.classList.add("theme");
  return control;
}
