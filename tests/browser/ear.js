// Runs in the page before its program: notes what the page asks its worker for, and what the worker answers.
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

// Without a graphics card drawing takes most of the time: while a test holds the pictures, the page gets a frame only when it is asked for.
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
// The next frame.
ear.frame = () => new Promise((done) => soon((now) => {
  for (const draw of held?.splice(0) ?? []) draw(now);
  done();
}));

// What the page shows of a variable: its value and its word in the address, messages at controls by variable, the message over the picture.
ear.complaints = () => Object.fromEntries([...document.querySelectorAll(".fault")].filter((each) => !each.hidden)
  .map((each) => [each.id.replace("fault ", ""), each.textContent]));
ear.message = () => {
  const message = document.getElementById("message");
  return message.hidden ? "" : message.textContent;
};
ear.seen = (name) => ({
  value: page.setup.value(name),
  word: new URLSearchParams(location.hash.slice(1)).get(name),
  complaints: ear.complaints(),
  message: ear.message(),
});

// Of a gear's surface: the farthest corner from the apex and the nearest [mm], and how many triangles there are.
function measured({ vertices, triangles }) {
  const far = [];
  for (let i = 0; i < vertices.length; i += 3) far.push(Math.hypot(vertices[i], vertices[i + 1], vertices[i + 2]));
  return { farthest: Math.max(...far), nearest: Math.min(...far), triangles: triangles.length / 3 };
}
