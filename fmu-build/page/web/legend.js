// Meaning of the picture's colours, with the values at the time of the picture.
import { element } from "./element.js";
import { css, gradient } from "./scale.js";

export class Legend {
  // `switchOn(name)` is called to switch on an effect that provides missing values.
  constructor(host, switchOn) {
    Object.assign(this, { host, switchOn, shown: "" });
  }

  show(mode, legend) {
    const { lines, scale, off } = legend;
    const plain = JSON.stringify([mode, lines.map(({ text, colour }) => [text, colour && css(colour)]), scale, off]);
    if (plain === this.shown) return;
    this.shown = plain;
    this.host.hidden = false;
    const parts = lines.map(({ text, colour }) => {
      const mark = element("i");
      mark.style.background = colour ? css(colour) : "none";
      return element("li", {}, mark, text);
    });
    const bar = element("div", { className: "bar" });
    bar.style.setProperty("--scale", gradient());
    const made = [element("ul", {}, ...parts)];
    if (scale) made.unshift(element("p", { className: "ends" }, scale.least, bar, scale.most));
    if (off) made.push(this.missing(off));
    this.host.replaceChildren(...made);
  }

  missing({ text, name }) {
    const line = element("p", { className: "off" }, text);
    if (name) {
      const button = element("button", { type: "button", textContent: name, title: `Switch ${name} on` });
      button.addEventListener("click", () => this.switchOn(name));
      line.append(" ", button);
    }
    return line;
  }
}
