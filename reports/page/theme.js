// SPDX-License-Identifier: GPL-3.0-or-later
// Runs before anything is drawn, so that a dark page never flashes white.

let chosenTheme = "system";
const systemIsDark = matchMedia("(prefers-color-scheme: dark)");

function chooseTheme(theme) {
  chosenTheme = theme;
  const isDark = theme === "system" ? systemIsDark.matches : theme === "dark";
  document.documentElement.dataset.theme = isDark ? "dark" : "light";
}

systemIsDark.addEventListener("change", () => chooseTheme(chosenTheme));
chooseTheme(chosenTheme);
