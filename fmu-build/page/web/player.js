// Time of the picture: it plays, pauses, seeks, and turns round at the end.

const SHOW = 15; // s that a run takes on the screen unless chosen otherwise
const TOOTH = 10; // s that one tooth takes at the slowest

export class Player {
  constructor() {
    Object.assign(this, { time: 0, stop: 1, playing: true, rate: 1, slowest: 0.01, chosen: false });
  }

  // A new run: `tooth` is the time one tooth takes, Infinity where nothing turns.
  begin(stop) {
    this.stop = stop;
    this.time = Math.min(this.time, stop);
    this.slowest = Math.min(stop / SHOW, 1) / 20;
    if (!this.chosen) this.rate = Math.min(stop / SHOW, 1);
    this.rate = Math.min(Math.max(this.rate, this.slowest), 1);
  }

  // The slowest motion shows one tooth in ten seconds.
  limit(tooth) {
    if (!(tooth > 0 && Number.isFinite(tooth))) return;
    this.slowest = Math.min(tooth / TOOTH, this.stop / SHOW, 1);
    this.rate = Math.max(this.rate, this.slowest);
  }

  // On by `seconds` of the clock; `end` is how far the run has come, `isOver` whether it will come no farther.
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
