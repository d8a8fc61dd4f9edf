// Time of the picture: it plays, pauses, seeks, and restarts at the end.

const SHOW = 15; // s on the screen for a run, by default
const TOOTH = 10; // s on the screen for one tooth in the slowest motion

export class Player {
  constructor() {
    Object.assign(this, { time: 0, stop: 1, playing: true, rate: 1, slowest: 0.01, chosen: false });
  }

  // Starts a new run of the duration `stop`.
  begin(stop) {
    this.stop = stop;
    this.time = Math.min(this.time, stop);
    this.slowest = Math.min(stop / SHOW, 1) / 20;
    if (!this.chosen) this.rate = Math.min(stop / SHOW, 1);
    this.rate = Math.min(Math.max(this.rate, this.slowest), 1);
  }

  // Limits slow motion: at the slowest, one tooth takes ten seconds. `tooth` is its time in the run, Infinity if
  // nothing turns.
  limit(tooth) {
    if (!(tooth > 0 && Number.isFinite(tooth))) return;
    this.slowest = Math.min(tooth / TOOTH, this.stop / SHOW, 1);
    this.rate = Math.max(this.rate, this.slowest);
  }

  // Advances by `seconds` of the clock; `end` is the end of the run so far, and `isOver` is true if the run is
  // complete.
  tick(seconds, end, isOver) {
    if (!this.playing) return;
    this.time += this.rate * seconds;
    if (this.time <= end) return;
    this.time = isOver ? 0 : end;
  }

  seek(time) {
    this.time = Math.min(Math.max(time, 0), this.stop);
  }

  // Slider of slow motion: 0 the slowest, 1 real time.
  get share() {
    return this.slowest >= 1 ? 1 : 1 - Math.log(this.rate) / Math.log(this.slowest);
  }

  set share(share) {
    this.chosen = true;
    this.rate = this.slowest ** (1 - share);
  }
}
