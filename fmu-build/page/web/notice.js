// Line of text over the picture: problems until they are solved, other remarks for a few seconds.

const SHOWN = 6000; // ms

export class Notice {
  constructor(host) {
    this.host = host;
  }

  say(text, bad = false) {
    this.host.textContent = text;
    this.host.hidden = text === "";
    this.host.classList.toggle("bad", bad);
    clearTimeout(this.silence);
    if (!bad) this.silence = setTimeout(() => { this.host.hidden = true; }, SHOWN);
  }
}
