// Runs in the page before its program. It records the requests of the page to its worker and the answers of the worker.
window.ear = { asked: null, answers: {}, gears: [], workers: 0 };
window.Worker = class extends Worker {
  constructor(...address) {
    super(...address);
    ear.workers += 1;
    this.addEventListener("message", ({ data }) => this.hear(data));
  }

  postMessage(message, ...more) {
    if (message.kind === "run") {
      ear.asked = message;
      ear.answers[message.number] = { points: 0, width: message.references.length + 1 };
    }
    super.postMessage(message, ...more);
  }

  hear({ kind, number, points, text, warnings, surfaces }) {
    if (kind === "gears") ear.gears.push(surfaces.map((surface) => surface && measured(surface)));
    const answer = ear.answers[number];
    if (kind === "points") answer.points += points.length / answer.width;
    else if (answer) Object.assign(answer, { [kind]: text ?? true }, warnings && { warnings });
  }
};

// Without a graphics card, drawing takes most of the time. After `ear.hold`, the page therefore draws only frames that a test requests.
const soon = requestAnimationFrame;
let held = null;
window.requestAnimationFrame = (draw) => (held ? held.push(draw) : soon(draw));
ear.hold = () => {
  held ??= [];
};
ear.free = () => {
  for (const draw of held ?? []) soon(draw);
  held = null;
};
// Draws the next frame.
ear.frame = () => new Promise((done) => soon((now) => {
  for (const draw of held?.splice(0) ?? []) draw(now);
  done();
}));

// Visible messages at controls, by variable.
ear.complaints = () => Object.fromEntries([...document.querySelectorAll(".fault")].filter((each) => !each.hidden)
  .map((each) => [each.id.replace("fault ", ""), each.textContent]));
// Message over the picture, or "".
ear.message = () => {
  const message = document.getElementById("message");
  return message.hidden ? "" : message.textContent;
};
// Value of a variable, its text in the address, all messages at controls, and the message over the picture.
ear.seen = (name) => ({
  value: page.setup.value(name),
  word: new URLSearchParams(location.hash.slice(1)).get(name),
  complaints: ear.complaints(),
  message: ear.message(),
});

// Largest and smallest distance of a gear's vertices from the apex [mm], and the number of triangles.
function measured({ vertices, triangles }) {
  const far = [];
  for (let i = 0; i < vertices.length; i += 3) far.push(Math.hypot(vertices[i], vertices[i + 1], vertices[i + 2]));
  return { farthest: Math.max(...far), nearest: Math.min(...far), triangles: triangles.length / 3 };
}
