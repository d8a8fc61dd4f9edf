// The page: the set-up is sent to the worker, its points are recorded, and the picture follows the player's time.
import { largestPower, Legend, MODES, scaled } from "./colouring.js";
import { hasPairs, hasTeeth, largestPressure } from "./contact.js";
import { Controls } from "./controls.js";
import { hasFinalDrive, largestRingForce } from "./final_drive.js";
import { Flank } from "./flank.js";
import { $, Notice, Walk } from "./frame.js";
import { clutchParts } from "./half_shafts.js";
import { bind } from "./operation.js";
import { Player, showFigures, showTransport, toothTime } from "./player.js";
import { forces, Record, recorded, save } from "./record.js";
import { Setup } from "./setup.js";
import { Shapes, Simulation } from "./simulation.js";
import { forceText, readable, Table } from "./table.js";
import { TraceChoice, Traces } from "./traces.js";
import { PRESETS, View } from "./view.js";

const REFRESH = 100; // ms between two drawings of new points
const ASIDE = { wide: [-0.19, 0], narrow: [0, -0.2] }; // shift of the picture as fractions of the window
const NARROW = 820; // pixels

class Page {
  // `library` is the packed library of the page.
  constructor(data, library) {
    this.table = new Table(data);
    this.setup = new Setup(this.table);
    this.player = new Player();
    this.record = new Record([]);
    this.notice = new Notice($("message"));
    this.simulation = new Simulation(library, {
      gears: (message) => this.shapes.take(message),
      started: (message) => this.started(message),
      points: (message) => this.points(message),
      over: ({ warnings }) => {
        this.isOver = true;
        this.controls.warn(warnings, true);
      },
      refused: ({ text }) => this.refuse(text),
      trap: ({ text }) => this.trapped(text),
      anew: () => this.shapes.forget(),
    });
    this.shapes = new Shapes(this.table, (settings) => this.simulation.gears(settings), (surfaces, geometry) => {
      this.view.build(surfaces, geometry);
      this.flank.shape(surfaces[0].cones);
      this.moved = true;
    });
    const labels = Object.fromEntries([...document.querySelectorAll("[data-label]")].map((label) => [label.dataset.label, label]));
    this.setup.read(location.hash);
    this.view = new View($("canvas"), labels, this.setup.picture === "fine");
    this.legend = new Legend($("legend"), (name) => this.switchOn(name));
    this.flank = new Flank($("flank"), this.table);
    this.traces = new Traces($("traces"), this.table, (time) => this.seek(time));
    this.choice = new TraceChoice($("trace-list"), this.table, (names) => {
      this.setup.traces = names;
      this.keep();
      this.simulate();
    });
    this.controls = new Controls($("groups"), this.setup, () => this.changed());
    this.walk = new Walk($("walk"), (step) => this.walkTo(step), () => this.makeRoom());
    bind(this);
    this.restore();
    $("coarse").hidden = !this.view.isCoarse;
    requestAnimationFrame((now) => {
      this.last = now;
      this.frame(now);
    });
  }

  // Reads the set-up from the page's address.
  restore() {
    const { odd, faults } = this.setup.read(location.hash);
    this.player.chosen = false;
    if (this.player.time > 0 && this.shownScene !== this.setup.scene.name) this.player.time = 0;
    this.shownScene = this.setup.scene.name;
    this.look(this.setup.view);
    this.changed();
    this.odd = odd.length > 0 ? `The address contains unknown words: ${odd.join(", ")}. ` : "";
    for (const { name, text } of faults) this.controls.complain(name, text);
    if (faults.length > 0) this.odd += `The address contains invalid values, which are left out: ${faults.map(({ name }) => name).join(", ")}. `;
    if (this.odd) this.notice.say(this.odd, true);
  }

  changed() {
    this.table.showSpeedsIn(this.setup.speeds);
    this.controls.relabel();
    $("scene").value = this.setup.scene.name;
    $("about").textContent = this.setup.scene.description;
    $("duration").value = String(this.setup.stop);
    $("colour").value = this.setup.colour;
    $("speeds").value = this.setup.speeds;
    const hasDrive = hasFinalDrive(this.setup);
    const parts = { drive: hasDrive, ...clutchParts(this.setup) };
    for (const part of document.querySelectorAll("[data-of]")) part.hidden = !parts[part.dataset.of];
    if (this.setup.view === "drive" && !hasDrive) this.look("whole");
    this.keep();
    this.notice.say("");
    this.simulate();
  }

  // Writes the set-up to the page's address.
  keep() {
    try {
      history.replaceState(null, "", this.setup.fragment());
    } catch {
      location.hash = this.setup.fragment();
    }
  }

  get names() {
    return recorded(this.setup, MODES[this.setup.colour].needs, this.setup.view === "flank");
  }

  simulate() {
    this.run = { names: this.names, forces: forces(this.setup), shown: this.setup.shown(), stop: this.setup.stop };
    this.simulation.run(this.setup.compiled(), this.run.names.map((name) => this.table.find(name).reference));
    // the first picture does not wait for the run
    if (!this.shapes.shown) this.shapes.want(this.setup);
  }

  // Replaces the previous run, because the new run has begun.
  started({ warnings }) {
    const { names, forces, shown, stop } = this.run;
    this.record = new Record(names);
    this.isOver = false;
    this.forces = forces;
    this.most = 0;
    this.mostHeat = 0;
    this.mostPressure = 0;
    this.player.begin(stop);
    this.traces.begin(shown, this.record, stop);
    this.choice.show(shown, this.setup.value("geometry.planet_count"));
    this.flank.begin(this.record, this.setup);
    $("time").max = stop;
    this.scroll();
    this.controls.warn(warnings);
    this.shapes.want(this.setup);
  }

  points({ points, time, seconds }) {
    this.record.append(points);
    this.isFresh = true;
    if (seconds > 0 && time > 0) $("speed").textContent = `${readable(time / seconds, 2)} × real time`;
  }

  // Updates everything that depends on all points so far.
  refresh() {
    this.isFresh = false;
    this.refreshed = performance.now();
    this.traces.refresh();
    this.most = Math.max(...this.forces.map((name) => this.record.largest(name)));
    this.mostPressure = hasPairs(this.record, true) ? largestPressure(this.record, this.setup) : 0;
    if (this.setup.colour === "heat") this.mostHeat = largestPower(this.record, this.table);
    $("scale").lastElementChild.textContent = this.most > 0
      ? `force on a side gear, longest ${forceText(this.most)}${this.onRing()}` : "no force on the teeth";
    this.tooth = toothTime(this.record, (name) => this.setup.value(name));
    this.player.limit(this.tooth);
    this.moved = true;
  }

  // Words about the force on the ring gear, if there is one.
  onRing() {
    const largest = largestRingForce(this.record);
    return largest > 0 ? `; ring gear ${forceText(largest)}` : "";
  }

  trapped(text) {
    this.isOver = true;
    this.shapes.standIn();
    this.notice.say(`The simulation failed and was restarted; your set-up is kept. Change a value to try again. (${text})`, true);
  }

  refuse(text) {
    this.isOver = true;
    const about = text.split("\n").map((line) => this.table.subject(line));
    for (const { name, text: own } of about) this.controls.complain(name, own);
    const placed = about[0].name && `The library refuses this ${about[0].name}: see the message at it.`;
    const kept = this.record.count > 0 ? " The picture shows the last set-up that worked." : " The gears stand still.";
    this.notice.say(`${this.odd}${placed || about[0].text}${kept}`, true);
    this.odd = "";
  }

  takeDuration() {
    const fault = this.setup.setStop(Number($("duration").value));
    if (fault) this.notice.say(fault, true);
    else this.changed();
  }

  // Changes the mode of colours. The run is repeated if it did not record the outputs of the mode.
  colour(mode) {
    this.setup.colour = mode;
    this.again();
  }

  // Changes the unit of speeds, without a new simulation.
  speeds(unit) {
    this.setup.speeds = unit;
    this.table.showSpeedsIn(unit);
    this.controls.relabel();
    this.traces.build();
    this.moved = true;
    this.keep();
  }

  // Saves the drawn traces as a file.
  save() {
    save(`${this.setup.scene.name}.csv`, this.record, this.setup.shown());
  }

  again() {
    this.keep();
    if (this.names.every((name) => this.record.has(name))) this.refresh();
    else this.simulate();
  }

  switchOn(name) {
    this.setup.set(name, true);
    this.changed();
  }

  // Changes the view. The run is repeated if it did not record the outputs of the view.
  choose(name) {
    if (name === "drive" && !hasFinalDrive(this.setup)) return;
    this.look(name);
    this.again();
  }

  themed() {
    this.traces.build();
    this.moved = true;
  }

  look(name) {
    this.setup.view = name;
    this.view.look(name);
    this.view.hold = PRESETS[name].hold;
    $("hold").checked = PRESETS[name].hold;
    $("shell").checked = PRESETS[name].shell;
    this.flank.show(name === "flank");
    for (const button of document.querySelectorAll("[data-camera]")) {
      button.setAttribute("aria-pressed", button.dataset.camera === name);
    }
    this.makeRoom();
    this.moved = true;
  }

  walkTo(step) {
    this.player.chosen = false;
    this.player.time = 0;
    this.player.playing = true;
    location.hash = step.fragment;
  }

  // Moves the picture away from panels that cover it.
  makeRoom() {
    const isCovered = this.walk.isOpen || this.setup.view === "flank";
    this.view.shift(...(isCovered ? ASIDE[innerWidth > NARROW ? "wide" : "narrow"] : [0, 0]));
  }

  play() {
    this.player.playing = !this.player.playing;
  }

  seek(time) {
    this.player.playing = false;
    this.player.seek(time);
    this.moved = true;
  }

  scroll() {
    this.traces.share = $("scroll").checked ? 0.3 : 1;
    this.traces.refresh();
  }

  spectral() {
    this.traces.isSpectral = $("spectrum").checked;
    this.traces.build();
    if ($("spectrum").checked && this.isOver && this.traces.plots[0].plot.data[0].length === 0) {
      this.notice.say("No spectrum: the planets roll through no whole mesh cycle in this run. "
        + "Choose a turn, or a longer duration.");
    }
  }

  // Each frame requests the next one before it draws, so that an error in one frame does not stop the others.
  frame(now) {
    requestAnimationFrame((next) => this.frame(next));
    const seconds = Math.min((now - this.last) / 1e3, 0.1);
    this.last = now;
    try {
      this.advance(now, seconds);
    } catch (error) {
      this.fail(error);
    }
  }

  // Reports an error of the page itself once.
  fail(error) {
    if (this.failure === error.message) return;
    this.failure = error.message;
    console.error(error);
    this.notice.say(`A part of the picture cannot be drawn (${error.message}). Another view or scene may help.`, true);
  }

  advance(now, seconds) {
    const { player, record } = this;
    if (this.isFresh && !(now - this.refreshed < REFRESH)) this.refresh();
    const before = player.time;
    player.tick(seconds, record.end, this.isOver);
    if (player.time !== before || this.moved || this.view.hold !== this.held) this.show();
    this.view.draw();
    showTransport(player, this.tooth);
  }

  // Shows the picture, the values and the traces at the player's time.
  show() {
    const { player, record, table, setup, most, mostHeat } = this;
    this.moved = false;
    this.held = this.view.hold;
    record.seek(player.time);
    const colours = MODES[setup.colour].colours({ setup, record, most, mostHeat, hasPairs: hasTeeth(setup) && hasPairs(record) });
    this.view.pose(record, most, colours, (pressure) => scaled(pressure / this.mostPressure));
    if (record.count === 0) return;
    this.legend.show(setup.colour, colours.legend);
    this.flank.at(player.time, this.mostPressure);
    this.traces.at(player.time);
    showFigures(record, table);
  }
}

// Packed contents of the page, in base64: data in gzip, and the library in xz, which needs half as much space.
function packed(id) {
  const text = $(id).textContent.trim();
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}

async function start() {
  const data = new Blob([packed("data")]).stream().pipeThrough(new DecompressionStream("gzip"));
  // the library is still packed: the worker unpacks it while the page is built
  window.page = new Page(await new Response(data).json(), packed("library")); // for scripts and tests
}

start().catch((error) => {
  const textContent = `This browser cannot run the page: ${error.message}`;
  Object.assign($("message"), { hidden: false, className: "bad", textContent });
});
