// Choice of the outputs that are drawn.
import { MOST_TRACES } from "./setup.js";
import { isThere } from "./wanted.js";
import { words } from "./table.js";

export class TraceChoice {
  // `chosen(names)` is called when the reader changes the choice.
  constructor(host, table, chosen) {
    this.boxes = table.outputs().map(({ name, description }) => {
      const box = Object.assign(document.createElement("input"), { type: "checkbox", value: name });
      const label = Object.assign(document.createElement("label"), { title: `${name}: ${description}` });
      label.append(box, words(name));
      host.append(label);
      box.addEventListener("change", () => chosen(this.names()));
      return box;
    });
  }

  names() {
    return this.boxes.filter((box) => box.checked).map((box) => box.value);
  }

  // Marks the drawn outputs. Only outputs of the first `planets` planets are offered.
  show(names, planets) {
    for (const box of this.boxes) {
      box.parentElement.hidden = !isThere(box.value, planets);
      box.checked = names.includes(box.value);
      box.disabled = !box.checked && names.length >= MOST_TRACES;
    }
    // the last one cannot be removed, because a page without traces has nothing to follow
    if (names.length === 1) this.boxes.find((box) => box.checked).disabled = true;
  }
}
