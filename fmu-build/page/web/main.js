// The page: the set-up goes to the worker, its points go into the record, and the picture follows the player's time.
import { Assembly } from "./assembly.js";
import { Controls } from "./controls.js";
import { embeddedJson, embeddedLibrary } from "./embedded.js";
import { listenToKeys } from "./keys.js";
import { Player } from "./player.js";
import { showFigures, showTransport, toothTime } from "./readings.js";
import { Record } from "./record.js";
import { Setup } from "./setup.js";
import { Simulation } from "./simulation.js";
import { readable, Table } from "./table.js";
import { followTheme } from "./theme.js";
import { TraceChoice } from "./choice.js";
import { Traces } from "./traces.js";
import { PRESETS, View } from "./view.js";
import { Walk } from "./walk.js";

const $ = (id) => document.getElementById(id);
const MOVING = ["mesh.frequency", "carrier.angle", "carrier.speed", "solver.energy_residual"];
const SIDES = ["left", "right"];
const MOST_POINTS = 2e5; // of a run
const REFRESH = 100; // ms between two drawings of new points
const CONSTANTS = ["geometry.planet_pitch_angle", "geometry.outer_cone_distance"];

class Page {
  constructor(data, library) {
    this.table = new Table(data);
    this.setup = new Setup(this.table);
    this.player = new Player();
    this.record = new Record([]);
    this.labels = Object.fromEntries([...document.querySelectorAll("[data-label]")].map((label) => [label.dataset.label, label]));
    this.view = new View($("canvas"), this.labels);
    this.traces = new Traces($("traces"), this.table, (time) => this.seek(time));
    this.choice = new TraceChoice($("trace-list"), this.table, (names) => {
      this.setup.traces = names;
      this.keep();
      this.simulate();
    });
    this.controls = new Controls($("groups"), this.table, this.setup, () => this.changed());
    this.walk = new Walk($("walk"), (step) => {
      this.player.chosen = false;
      this.player.time = 0;
      this.player.playing = true;
      location.hash = step.fragment;
      this.look(step.camera);
    }, (open) => this.view.shift(...(open ? (innerWidth > 820 ? [-0.19, 0] : [0, -0.2]) : [0, 0])));
    this.simulation = new Simulation(library, {
      ready: () => {},
      gears: (message) => this.takeGears(message),
      started: (message) => this.started(message),
      points: (message) => this.points(message),
      over: () => { this.isOver = true; },
      refused: ({ text }) => this.refuse(text),
      trap: ({ text }) => this.trapped(text),
    });
    this.listen();
    this.restore();
    this.look("whole");
    this.last = performance.now();
    requestAnimationFrame((now) => this.frame(now));
  }

  listen() {
    for (const { name } of this.table.scenes) $("scene").append(new Option(name.replaceAll("_", " "), name));
    $("scene").addEventListener("change", () => { location.hash = `scene=${$("scene").value}`; });
    $("walk-open").addEventListener("click", () => this.walk.show(0));
    $("copy").addEventListener("click", () => this.copy());
    $("reset").addEventListener("click", () => { location.hash = `scene=${this.setup.scene.name}`; });
    $("search").addEventListener("input", () => this.controls.filter($("search").value));
    $("duration").addEventListener("change", () => this.takeDuration());
    $("play").addEventListener("click", () => this.play());
    $("time").addEventListener("input", () => this.seek(Number($("time").value)));
    $("rate").addEventListener("input", () => { this.player.share = Number($("rate").value); });
    $("scroll").addEventListener("change", () => this.scroll());
    $("spectrum").addEventListener("change", () => this.spectral());
    $("hold").addEventListener("change", () => { this.view.hold = $("hold").checked; });
    $("shell").addEventListener("change", () => {
      this.view.differential.showCase($("shell").checked);
      this.view.stale = true;
    });
    for (const button of document.querySelectorAll("[data-camera]")) {
      button.addEventListener("click", () => this.look(button.dataset.camera));
    }
    addEventListener("hashchange", () => { if (location.hash !== this.setup.fragment()) this.restore(); });
    followTheme($("theme"), () => this.traces.build());
    listenToKeys(this);
  }

  // Takes the set-up of the page's address.
  restore() {
    const odd = this.setup.read(location.hash);
    this.player.chosen = false;
    if (this.player.time > 0 && this.shownScene !== this.setup.scene.name) this.player.time = 0;
    this.shownScene = this.setup.scene.name;
    this.changed();
    this.odd = odd.length > 0 ? `The address has what this page does not know: ${odd.join(", ")}. ` : "";
    if (this.odd) this.say(this.odd, true);
  }

  changed() {
    this.controls.show();
    $("scene").value = this.setup.scene.name;
    $("about").textContent = this.setup.scene.description;
    $("duration").value = String(this.setup.stop);
    this.keep();
    this.say("");
    this.simulate();
  }

  // The address is the set-up.
  keep() {
    try {
      history.replaceState(null, "", this.setup.fragment());
    } catch {
      location.hash = this.setup.fragment();
    }
  }

  simulate() {
    const planets = Array.from({ length: this.setup.value("geometry.planet_count") }, (_, i) => `planet[${i + 1}]`);
    const forces = planets.flatMap((planet) => SIDES.map((side) => `${planet}.${side}_normal_force`));
    const names = [
      ...MOVING, ...SIDES.flatMap((side) => [`${side}.angle`, `${side}.speed`, `${side}.twist`, `${side}.tangential_force`]),
      ...planets.map((planet) => `${planet}.spin_angle`), ...forces, ...this.setup.shown(),
      ...this.table.outputs().map(({ name }) => name).filter((name) => name.startsWith("heat.")),
    ].filter((name) => this.table.find(name));
    this.wanted = { names: [...new Set(names)], forces, shown: this.setup.shown(), stop: this.setup.stop };
    const references = (list) => list.map((name) => this.table.find(name).reference);
    this.simulation.run(this.setup.compiled(), references(this.wanted.names), references(CONSTANTS));
  }

  // A run has begun: only now the old one goes.
  started({ values, warnings }) {
    const { names, forces, shown: chosen, stop } = this.wanted;
    this.record = new Record(names);
    this.isOver = false;
    this.forces = forces;
    this.names = chosen;
    this.player.begin(stop);
    this.traces.begin(chosen, this.record, stop);
    this.choice.show(chosen);
    $("time").max = stop;
    this.scroll();
    if (warnings.length > 0 && !this.odd) this.say(this.table.subject(warnings[0]).text);
    this.pair = values;
    const settings = this.setup.settings();
    const isShape = ({ reference }) => this.table.variables[reference].name.startsWith("geometry.");
    const shape = JSON.stringify(settings.filter(isShape));
    if (shape !== this.shape) this.simulation.gears(settings);
    this.shape = shape;
  }

  takeGears({ surfaces }) {
    if (surfaces.includes(null)) return;
    const value = (name) => this.setup.value(`geometry.${name}`);
    this.view.build(surfaces, new Assembly({
      planetTeeth: value("planet_teeth"), sideTeeth: value("side_teeth"), planets: value("planet_count"),
      planetPitch: this.pair[0], outerCone: 1e3 * this.pair[1], pressureAngle: value("pressure_angle"),
    }));
    this.moved = true;
  }

  points({ points, time, seconds }) {
    this.record.append(points);
    this.isFresh = true;
    if (seconds > 0 && time > 0) $("speed").textContent = `${readable(time / seconds, 2)} × real time`;
  }

  // What depends on all points so far.
  refresh() {
    this.isFresh = false;
    this.refreshed = performance.now();
    this.traces.refresh();
    this.most = Math.max(...this.forces.map((name) => this.record.largest(name)));
    $("scale").lastElementChild.textContent = this.most > 0
      ? `force on a side gear, longest ${readable(this.most / 1e3, 3)} kN` : "no force on the teeth";
    this.tooth = toothTime(this.record, (name) => this.setup.value(name));
    this.player.limit(this.tooth);
    this.moved = true;
  }

  trapped(text) {
    this.isOver = true;
    this.say(`The simulation failed and was started anew; your set-up is kept. Change a value to try again. (${text})`, true);
  }

  refuse(text) {
    this.isOver = true;
    const about = text.split("\n").map((line) => this.table.subject(line));
    for (const { name, text: own } of about) this.controls.complain(name, own);
    const placed = about[0].name && `The library refuses this ${about[0].name}: see the message at it.`;
    const kept = this.view.differential.gears ? " The picture shows the last set-up that worked." : "";
    this.say(`${this.odd}${placed || about[0].text}${kept}`, true);
    this.odd = "";
  }

  say(text, bad = false) {
    $("message").textContent = text;
    $("message").hidden = text === "";
    $("message").classList.toggle("bad", bad);
    clearTimeout(this.silence);
    if (!bad) this.silence = setTimeout(() => { $("message").hidden = true; }, 6000);
  }

  takeDuration() {
    const stop = Number($("duration").value);
    if (stop > 0 && stop / this.setup.scene.step <= MOST_POINTS) {
      this.setup.stop = stop;
      this.changed();
    } else {
      const longest = readable(MOST_POINTS * this.setup.scene.step);
      this.say(`The duration takes a time above 0 s, up to ${longest} s in this scene.`, true);
    }
  }

  async copy() {
    try {
      await navigator.clipboard.writeText(location.href);
      this.say("Link copied.");
    } catch {
      this.say("The link is in the address line.");
    }
  }

  look(name) {
    this.view.look(name);
    this.view.hold = PRESETS[name].hold;
    $("hold").checked = PRESETS[name].hold;
    $("shell").checked = PRESETS[name].shell;
    for (const button of document.querySelectorAll("[data-camera]")) {
      button.setAttribute("aria-pressed", button.dataset.camera === name);
    }
    this.moved = true;
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
      this.say("No spectrum: the planets roll through no whole mesh cycle in this run. Choose a turn, or a longer duration.");
    }
  }

  frame(now) {
    const seconds = Math.min((now - this.last) / 1e3, 0.1);
    this.last = now;
    const { player, record } = this;
    if (this.isFresh && !(now - this.refreshed < REFRESH)) this.refresh();
    const before = player.time;
    player.tick(seconds, record.end, this.isOver);
    if (record.count > 0 && (player.time !== before || this.moved || this.view.hold !== this.held)) {
      this.moved = false;
      this.held = this.view.hold;
      record.seek(player.time);
      this.view.pose((name) => record.value(name), this.most);
      this.traces.at(player.time);
      showFigures(record, this.table);
    }
    this.view.draw();
    showTransport(player, this.tooth);
    requestAnimationFrame((next) => this.frame(next));
  }
}

Promise.all([embeddedJson("data"), embeddedLibrary("library")])
  .then(([data, library]) => { window.page = new Page(data, library); })
  .catch((error) => {
    $("message").hidden = false;
    $("message").className = "bad";
    $("message").textContent = `This browser cannot run the page: ${error.message}`;
  });
