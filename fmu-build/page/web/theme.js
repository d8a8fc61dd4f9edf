// Light or dark theme: follows the system until the button is used.

export function followTheme(button, changed) {
  const system = matchMedia("(prefers-color-scheme: dark)");
  let own = null;
  const apply = () => {
    document.documentElement.dataset.theme = own ?? (system.matches ? "dark" : "light");
  };
  apply();
  const again = () => {
    apply();
    changed();
  };
  system.addEventListener("change", again);
  button.addEventListener("click", () => {
    own = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    again();
  });
}
