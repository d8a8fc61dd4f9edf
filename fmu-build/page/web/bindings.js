// Connects the elements of the page to its functions.
import { MODES } from "./colouring.js";
import { listenToKeys } from "./keys.js";
import { SPEEDS, unitText } from "./table.js";
import { followTheme } from "./theme.js";

const $ = (id) => document.getElementById(id);

export function bind(page) {
  const on = (id, event, call) => $(id).addEventListener(event, () => call($(id)));
  for (const { name } of page.table.scenes) $("scene").append(new Option(name.replaceAll("_", " "), name));
  for (const [name, { label }] of Object.entries(MODES)) $("colour").append(new Option(label, name));
  for (const unit of Object.keys(SPEEDS)) $("speeds").append(new Option(unitText(unit), unit));
  on("scene", "change", ({ value }) => { location.hash = page.setup.fragmentOf(value); });
  on("colour", "change", ({ value }) => page.colour(value));
  on("speeds", "change", ({ value }) => page.speeds(value));
  on("save", "click", () => page.save());
  on("walk-open", "click", () => page.walk.show(0));
  on("copy", "click", () => copy(page.notice));
  on("reset", "click", () => { location.hash = page.setup.fragmentOf(page.setup.scene.name); });
  on("search", "input", ({ value }) => page.controls.filter(value));
  on("duration", "change", () => page.takeDuration());
  on("play", "click", () => page.play());
  on("time", "input", ({ value }) => page.seek(Number(value)));
  on("rate", "input", ({ value }) => { page.player.share = Number(value); });
  on("scroll", "change", () => page.scroll());
  on("spectrum", "change", () => page.spectral());
  on("hold", "change", ({ checked }) => { page.view.hold = checked; });
  on("shell", "change", ({ checked }) => page.view.showCase(checked));
  for (const button of document.querySelectorAll("[data-camera]")) {
    button.addEventListener("click", () => page.choose(button.dataset.camera));
  }
  addEventListener("hashchange", () => { if (location.hash !== page.setup.fragment()) page.restore(); });
  addEventListener("resize", () => page.makeRoom());
  followTheme($("theme"), () => page.themed());
  listenToKeys(page);
}

async function copy(notice) {
  try {
    await navigator.clipboard.writeText(location.href);
    notice.say("Link copied.");
  } catch {
    notice.say("The link is in the address line.");
  }
}
