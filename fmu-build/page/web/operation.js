// Operation of the page: its elements, its keys, and its light or dark theme.
import { MODES } from "./colouring.js";
import { $ } from "./frame.js";
import { SPEEDS, unitText, words } from "./table.js";

const STEP = 0.01; // fraction of the run
const TURN = 0.08; // rad

// Connects the elements of the page to its functions.
export function bind(page) {
  const on = (id, event, call) => $(id).addEventListener(event, () => call($(id)));
  for (const { name } of page.table.scenes) $("scene").append(new Option(words(name), name));
  for (const name of Object.keys(MODES)) $("colour").append(new Option(name, name));
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

// Keys of the page, unless a field uses them.
function listenToKeys(page) {
  const { player, view } = page;
  const turns = { ArrowLeft: [-TURN, 0], ArrowRight: [TURN, 0], ArrowUp: [0, TURN], ArrowDown: [0, -TURN] };
  const actions = {
    " ": () => page.play(),
    ArrowLeft: () => page.seek(player.time - STEP * player.stop),
    ArrowRight: () => page.seek(player.time + STEP * player.stop),
    Home: () => page.seek(0),
    End: () => page.seek(player.stop),
    ArrowUp: () => { player.share = Math.min(player.share + 0.05, 1); },
    ArrowDown: () => { player.share = Math.max(player.share - 0.05, 0); },
    1: () => page.choose("whole"),
    2: () => page.choose("mesh"),
    3: () => page.choose("side"),
    4: () => page.choose("flank"),
    5: () => page.choose("drive"),
    w: () => (page.walk.isOpen ? page.walk.close() : page.walk.show(0)),
    Escape: () => page.walk.close(),
  };
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const presses = [" ", "Enter"].includes(event.key) && event.target.closest("button, summary, input");
    const types = event.target.closest("select, input:not([type=checkbox])") && event.key !== "Escape";
    if (presses || types) return;
    const turn = event.shiftKey && turns[event.key];
    if (turn) view.turn(...turn);
    else if (actions[event.key]) actions[event.key]();
    else return;
    event.preventDefault();
  });
}

// The theme follows the system until the button is used.
function followTheme(button, changed) {
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
