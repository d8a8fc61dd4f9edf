// Runs in the page before its program: notes what the page asks its worker for, and what the worker answers.
window.ear = { asked: null, answers: {}, gears: [], workers: 0, pictures: 1 };
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

// Without a graphics card drawing takes most of the time: a test that does not look lowers the part of pictures that are drawn.
const soon = requestAnimationFrame;
window.requestAnimationFrame = (draw) => (ear.pictures === 1 ? soon(draw) : setTimeout(() => soon(draw), 16 / ear.pictures));

// Of a gear's surface: the farthest corner from the apex and the nearest [mm], and how many triangles there are.
function measured({ vertices, triangles }) {
  const far = [];
  for (let i = 0; i < vertices.length; i += 3) far.push(Math.hypot(vertices[i], vertices[i + 1], vertices[i + 2]));
  return { farthest: Math.max(...far), nearest: Math.min(...far), triangles: triangles.length / 3 };
}
