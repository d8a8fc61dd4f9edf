// Frame around the picture: elements and colours of the document, messages, and the guided walk.

const SHOWN = 6000; // ms for remarks

export const $ = (id) => document.getElementById(id);

// Creates an element of the document with properties and children.
export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

// Colour of the present theme, from the style sheet.
export const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Line of text over the picture: problems until they are solved, other remarks for a few seconds.
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

// Guided walk: five set-ups with explanations.
const STEPS = [
  {
    title: "Straight ahead",
    fragment: "scene=study_straight&show=carrier.speed+left.speed+left.normal_force+right.normal_force",
    text: "Both wheels bear the same load. Carrier and side gears turn as one: the planets stand still on their pins and push "
      + "both sides like the bar of a balance. Red arrows are the forces of the planets on the side gears. They are all equal.",
  },
  {
    title: "A turn",
    fragment: "scene=study_turning&show=carrier.speed+left.speed+right.speed+planet%5B1%5D.left_normal_force&view=mesh",
    text: "In a curve the outer wheel runs faster. The planets roll between the side gears, and what one side gains the other "
      + "one loses: the mean of both speeds is the carrier's. The picture rides with the carrier. See how one pair of teeth "
      + "hands its load to the next, and how the force follows.",
  },
  {
    title: "One wheel on ice",
    fragment: "scene=one_wheel_on_ice&show=left.wheel_speed+right.wheel_speed+left.shaft_torque+right.shaft_torque",
    text: "The left wheel has no load but its inertia. The teeth give both wheels the same torque, so the right one gets no "
      + "more than the left one can take. The left wheel spins up, and the right one falls back until its own load turns it the other way. "
      + "The arrows stay equal. This is the weakness of an open differential.",
  },
  {
    title: "Limited slip",
    fragment: "scene=limited_slip&show=left.wheel_speed+right.wheel_speed+left.shaft_torque+right.shaft_torque",
    text: "Clutch packs press the side gears to the carrier. At 0.1 s the left load falls a little, and the packs hold: "
      + "nothing slips. At 0.25 s it fails. Now the packs slip, but they pass torque to the wheel that still has grip: see the "
      + "shaft torques part.",
  },
  {
    title: "The clunk",
    fragment: "scene=clunk&show=carrier.speed+left.shaft_torque+planet%5B1%5D.left_transmission_error&view=mesh",
    text: "A drive of 100 N·m comes on from rest. The teeth cross their play in two thousandths of a second, and the carrier "
      + "has gathered speed when the flanks meet. So each half-shaft is wound up to 133 N·m instead of 50, and throws the teeth "
      + "back through their play: the clunk you hear when you come on the throttle.",
  },
];

export class Walk {
  // `host` contains elements by data-walk: title, text, place, back, next, close; `go(step)` applies a set-up;
  // `opened(isOpen)` adapts the layout.
  constructor(host, go, opened) {
    this.opened = opened;
    this.host = host;
    this.go = go;
    this.part = (name) => host.querySelector(`[data-walk=${name}]`);
    this.part("back").addEventListener("click", () => this.show(this.step - 1));
    this.part("next").addEventListener("click", () => this.show(this.step + 1));
    this.part("close").addEventListener("click", () => this.close());
  }

  get isOpen() {
    return !this.host.hidden;
  }

  show(step) {
    if (step >= STEPS.length) {
      this.close();
      return;
    }
    this.step = Math.max(step, 0);
    this.host.hidden = false;
    this.opened(true);
    const { title, text } = STEPS[this.step];
    this.part("place").textContent = `${this.step + 1} of ${STEPS.length}`;
    this.part("title").textContent = title;
    this.part("text").textContent = text;
    this.part("back").disabled = this.step === 0;
    this.part("next").textContent = this.step === STEPS.length - 1 ? "Finish" : "Next";
    this.part("next").focus();
    this.go(STEPS[this.step]);
  }

  close() {
    this.host.hidden = true;
    this.opened(false);
  }
}
