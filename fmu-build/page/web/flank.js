// Panel next to the view "flank": contact patterns of the flanks of planet 1 toward the left side gear.
import { gradient, shade } from "./colouring.js";
import {
  along, COLUMNS, CONTACT, contactOf, hasPairs, hasTeeth, isInSeam, pairColumns, pairs, Pattern, ROWS,
} from "./contact.js";
import { colour } from "./frame.js";
import { forceText, readable } from "./table.js";

const FLANKS = [[1, "drive flank"], [-1, "coast flank"]];
const ROOM = { left: 38, right: 12, top: 16, bottom: 18 }; // pixels around a flank

const onFlank = (present, sign) => present.filter(({ force }) => Math.sign(force) === sign);
const inMPa = (pressure) => readable(pressure / 1e6, 3);

export class Flank {
  // `host` contains elements by data-flank: text, scale, and the canvases drive and coast.
  constructor(host, table) {
    Object.assign(this, { host, table, done: 0 });
    this.part = (name) => host.querySelector(`[data-flank=${name}]`);
    this.canvases = [this.part("drive"), this.part("coast")];
  }

  show(isShown) {
    this.host.hidden = !isShown;
  }

  shape(cones) {
    this.cones = cones;
    this.forget();
  }

  begin(record, setup) {
    this.record = record;
    this.contact = this.table.shown(CONTACT, setup.value(CONTACT));
    this.hasTeeth = hasTeeth(setup);
    this.elastic = contactOf(setup);
    this.forget();
  }

  forget() {
    this.done = 0;
    this.largest = 0;
    if (!this.cones) return;
    const { pitch, root, tip, mean } = this.cones;
    const height = (angle) => 1e-3 * mean * (angle - pitch);
    this.patterns = FLANKS.map(() => new Pattern(height(root), height(tip)));
  }

  // Shows the pattern up to a time, and the contact lines at that time; `most` is the largest pressure of the run
  // outside the seam [Pa].
  at(time, most) {
    if (this.host.hidden || !this.cones) return;
    this.scale = most;
    const hasTeeth = this.hasTeeth && hasPairs(this.record, true);
    for (const canvas of this.canvases) canvas.hidden = !hasTeeth;
    if (!hasTeeth) {
      this.say([`No teeth are in contact: ${CONTACT} is ${this.contact}, a joint without tooth pairs. `
        + "Set it to tooth to see the contact pattern."]);
      return;
    }
    const { times } = this.record;
    if (this.done > 0 && times[this.done - 1] > time) this.forget();
    let until = this.done;
    while (until < times.length && times[until] <= time) until += 1;
    const columns = pairColumns(this.record);
    for (let i = this.done; i < until; i += 1) this.add(pairs((name) => columns[name][i]));
    this.done = until;
    const present = pairs((name) => this.record.point(name));
    // an untouched flank is hidden
    this.canvases[1].hidden = this.patterns[1].most === 0;
    FLANKS.forEach(([sign], i) => this.draw(i, onFlank(present, sign)));
    this.describe(present);
  }

  add(present) {
    const sound = present.filter((pair) => !isInSeam(this.elastic, pair));
    this.largest = Math.max(this.largest, ...sound.flatMap(({ pressures }) => pressures));
    FLANKS.forEach(([sign], i) => this.patterns[i].add(onFlank(present, sign)));
  }

  describe(present) {
    const lines = present.map(({ tooth, force, height, pressures }) =>
      `Tooth ${tooth}: ${forceText(Math.abs(force))} at ${readable(1e3 * height, 2)} mm; `
      + `${pressures.map(inMPa).join(", ")} MPa at toe, middle, heel`);
    if (lines.length === 0) lines.push("No pair is in contact now.");
    lines.push(`Largest so far, without the seam at the foot, ${inMPa(this.largest)} MPa`);
    this.say(lines);
  }

  say(lines) {
    const host = this.part("text");
    const text = lines.join("\n");
    if (host.textContent !== text) host.textContent = text;
    this.part("scale").hidden = this.canvases[0].hidden;
    this.part("scale").style.setProperty("--scale", gradient());
    this.part("most").textContent = `${inMPa(this.scale)} MPa, the most of this run without the seam`;
  }

  draw(i, present) {
    const canvas = this.canvases[i];
    if (canvas.hidden) return;
    const [wide, high] = [canvas.clientWidth, canvas.clientHeight].map((size) => Math.round(size * devicePixelRatio));
    if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, { width: wide, height: high });
    const pen = canvas.getContext("2d");
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const { inner, mean, outer } = this.cones;
    const { root, tip, largest } = this.patterns[i];
    const x = (share) => ROOM.left + share * (width - ROOM.left - ROOM.right);
    // tooth size is proportional to the cone distance
    const grown = (share) => (inner + share * (outer - inner)) / mean;
    const unit = (height - ROOM.top - ROOM.bottom) / ((tip - root) * grown(1));
    const y = (share, of) => ROOM.top + (tip * grown(1) - of * grown(share)) * unit;
    outline(pen, x, y, root, tip);
    for (let column = 0; column < COLUMNS; column += 1) {
      const share = column / (COLUMNS - 1);
      const [from, to] = [Math.max(share - 0.5 / (COLUMNS - 1), 0), Math.min(share + 0.5 / (COLUMNS - 1), 1)];
      const step = (tip - root) / (ROWS - 1);
      for (let row = 0; row < ROWS; row += 1) {
        const pressure = largest[row * COLUMNS + column];
        if (pressure === 0) continue;
        const of = root + row * step;
        pen.fillStyle = shade(pressure / this.scale);
        const high = Math.min(of + step / 2, tip);
        pen.fillRect(x(from), y(share, high), x(to) - x(from) + 0.5, y(share, Math.max(of - step / 2, root)) - y(share, high) + 0.5);
      }
    }
    this.marks(pen, x, y, root, tip, FLANKS[i][1]);
    for (const { height: of, pressures } of present) this.line(pen, x, y, of, pressures);
  }

  // Draws pitch line, ends and heights.
  marks(pen, x, y, root, tip, name) {
    pen.strokeStyle = colour("--ink");
    pen.fillStyle = colour("--ink");
    pen.font = "11px system-ui";
    pen.lineWidth = 1;
    pen.setLineDash([4, 3]);
    pen.beginPath();
    pen.moveTo(x(0), y(0, 0));
    pen.lineTo(x(1), y(1, 0));
    pen.stroke();
    pen.setLineDash([]);
    pen.textAlign = "left";
    pen.fillText(name, 0, 11);
    pen.textAlign = "right";
    for (const [of, word] of [[tip, "tip"], [0, "pitch"], [root, "root"]]) pen.fillText(word, x(0) - 5, y(0, of) + 4);
    const bottom = y(1, root) + 14;
    pen.textAlign = "left";
    pen.fillText("toe", x(0), bottom);
    pen.textAlign = "right";
    pen.fillText("heel", x(1), bottom);
    pen.textAlign = "center";
    pen.fillText(`face ${readable(this.cones.outer - this.cones.inner, 3)} mm`, x(0.5), bottom);
  }

  // Draws a contact line: white under the colours of its pressure.
  line(pen, x, y, of, pressures) {
    const parts = 24;
    pen.lineCap = "square";
    for (const [thick, paint] of [[7, () => "#ffffff"], [4, (share) => shade(along(pressures, share) / this.scale)]]) {
      pen.lineWidth = thick;
      for (let k = 0; k < parts; k += 1) {
        const [from, to] = [k / parts, (k + 1) / parts];
        pen.strokeStyle = paint((from + to) / 2);
        pen.beginPath();
        pen.moveTo(x(from), y(from, of));
        pen.lineTo(x(to), y(to, of));
        pen.stroke();
      }
    }
  }
}

function outline(pen, x, y, root, tip) {
  pen.fillStyle = colour("--flank");
  pen.beginPath();
  for (const [share, of] of [[0, root], [0, tip], [1, tip], [1, root]]) pen.lineTo(x(share), y(share, of));
  pen.fill();
}
