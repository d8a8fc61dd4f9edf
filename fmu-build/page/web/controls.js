// Parameters and inputs in groups, and effects as switches, generated from the table of variables.
import { element } from "./frame.js";
import { isThere } from "./record.js";
import { inUnit, range, readable, readValue, unitText, words } from "./table.js";

const EFFECTS = "effects";
const FIRST = ["effects", "carrier", "pinion", "left", "right", "planet", "lock", "geometry"];

export class Controls {
  // `changed()` is called after a value of the set-up was changed.
  constructor(host, setup, changed) {
    Object.assign(this, { host, setup, changed, table: setup.table, rows: new Map(), groups: [], searched: "" });
    const groups = [...this.table.groups()];
    const place = ([group]) => (FIRST.includes(group) ? FIRST.indexOf(group) : FIRST.length);
    groups.sort((a, b) => place(a) - place(b));
    for (const [group, variables] of groups) this.group(group, variables);
  }

  group(name, variables) {
    const count = element("span", { className: "count" });
    const body = element("div", { className: name === EFFECTS ? "switches" : "fields" });
    const own = variables.map((variable) => this.row(variable, body));
    const summary = element("summary", {}, words(name), count);
    const details = element("details", { open: name === EFFECTS }, summary, body);
    this.groups.push({ details, count, rows: own });
    this.host.append(details);
  }

  row(variable, body) {
    const { name, kind, description } = variable;
    const id = `set ${name}`;
    const input = field(variable, id);
    const back = element("button", { type: "button", className: "back", textContent: "↺", title: "Back to the scene's value" });
    back.setAttribute("aria-label", `${name}: back to the scene's value`);
    const fault = element("p", { className: "fault", hidden: true, id: `fault ${name}` });
    fault.setAttribute("role", "alert");
    const price = this.table.prices.get(name);
    const label = element("label", { htmlFor: id, title: name }, name.slice(name.indexOf(".") + 1).replaceAll("_", " "));
    const unit = element("span", { className: "unit", textContent: price && `× ${readable(price, 3)}` });
    const warning = element("p", { className: "warning" });
    const what = element("p", { className: "what", textContent: price
      && `${description}. It takes ${readable(price, 3)} times the time of plain teeth.` });
    const frame = element("div", { className: `row ${kind.toLowerCase()}` }, label, input, unit, back, what, warning, fault);
    frame.dataset.words = `${name} ${description}`.toLowerCase().replaceAll("_", " ");
    body.append(frame);
    input.addEventListener("change", () => this.take(variable, input));
    back.addEventListener("click", () => {
      this.setup.reset(name);
      this.done();
      input.focus();
    });
    const row = { variable, frame, input, warning, fault, unit, what };
    if (!price) this.say(row);
    this.rows.set(name, row);
    return row;
  }

  // Shows unit, description and range of a variable.
  say({ variable, unit, what }) {
    const { description } = variable;
    unit.textContent = unitText(variable.shown);
    what.textContent = range(variable) ? `${description} (${range(variable)})` : description;
  }

  // Updates the display after a change of units.
  relabel() {
    for (const row of this.rows.values()) if (!this.table.prices.has(row.variable.name)) this.say(row);
    this.show();
  }

  // Number as text for its field.
  text(variable, value) {
    return Number.isFinite(value) ? readable(inUnit(variable, value), 7).replaceAll("−", "-") : String(value);
  }

  take(variable, input) {
    const { name, kind } = variable;
    if (kind === "Boolean") this.setup.set(name, input.checked);
    else if (kind === "Enumeration") this.setup.set(name, Number(input.value));
    else {
      const { value, fault } = readValue(variable, input.value);
      if (fault) {
        this.complain(name, fault);
        return;
      }
      // an unchanged text stands for the exact value of the scene, not for its rounded text
      const same = this.text(variable, this.setup.valueInScene(name)) === this.text(variable, value);
      this.setup.set(name, same ? this.setup.valueInScene(name) : value);
    }
    this.done();
  }

  done() {
    this.show();
    this.changed();
  }

  // Shows the values of the set-up.
  show() {
    for (const [name, { variable, frame, input, fault }] of this.rows) {
      const value = this.setup.value(name);
      if (variable.kind === "Boolean") input.checked = value;
      else if (variable.kind === "Enumeration") input.value = String(value);
      else input.value = this.text(variable, value);
      frame.classList.toggle("own", this.setup.isOwn(name));
      frame.classList.toggle("driven", this.setup.isDriven(name) && !this.setup.isOwn(name));
      fault.hidden = true;
      input.removeAttribute("aria-invalid");
    }
    this.filter(this.searched);
    this.count();
  }

  // Shows how many values of each group are changed, and how many have warnings.
  count() {
    for (const { count, rows } of this.groups) {
      const own = rows.filter(({ variable }) => this.setup.isOwn(variable.name)).length;
      const warned = rows.filter(({ warning }) => warning.textContent !== "").length;
      const counts = [own > 0 && `${own} changed`, warned > 0 && (warned > 1 ? `${warned} warnings` : "1 warning")];
      count.textContent = counts.filter(Boolean).join(", ");
    }
  }

  // Shows warnings of the library at their controls: those of a starting run, or `more` of the same run.
  warn(warnings, more = false) {
    for (const { warning } of more ? [] : this.rows.values()) warning.textContent = "";
    for (const { name, text } of warnings.map((line) => this.table.subject(line))) this.rows.get(name)?.warning.append(element("span", {}, text));
    this.count();
  }

  // Shows a message at its control.
  complain(name, text) {
    const row = this.rows.get(name);
    if (!row) return;
    row.fault.textContent = text;
    row.fault.hidden = false;
    row.input.setAttribute("aria-invalid", "true");
    row.input.setAttribute("aria-describedby", row.fault.id);
    row.frame.closest("details").open = true;
    row.frame.scrollIntoView({ block: "nearest" });
  }

  // Shows only rows whose name or description contains all these words, and no rows of missing planets.
  filter(text) {
    this.searched = text;
    const planets = this.setup.value("geometry.planet_count");
    const wanted = text.toLowerCase().replaceAll("_", " ").split(/[\s.]+/).filter(Boolean);
    for (const { details, rows } of this.groups) {
      const fits = rows.filter(({ frame, variable }) => {
        frame.hidden = !wanted.every((word) => frame.dataset.words.includes(word)) || !isThere(variable.name, planets);
        return !frame.hidden;
      });
      details.hidden = fits.length === 0;
      if (wanted.length > 0) details.open = true;
    }
  }
}

function field({ kind, literals }, id) {
  if (kind === "Boolean") {
    const input = element("input", { type: "checkbox", id });
    input.setAttribute("role", "switch");
    return input;
  }
  if (kind === "Enumeration") {
    return element("select", { id }, ...literals.map(({ name, value }) => new Option(name, String(value))));
  }
  return element("input", { type: "text", inputMode: "decimal", id, autocomplete: "off", spellcheck: false });
}
