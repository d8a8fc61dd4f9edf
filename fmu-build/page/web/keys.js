// Keys of the page, unless a field uses them.

const STEP = 0.01; // fraction of the run
const TURN = 0.08; // rad

export function listenToKeys(page) {
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
