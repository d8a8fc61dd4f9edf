// Sets controls one after another and restores each value with the button next to its control. This runs within the page, because calls
// from a test into the page take longer than the checks. The sweep fails if a user could not press a control.
const LONGEST = 60_000; // maximum wait for an answer [ms]

window.sweep = async (cases) => {
  const outcomes = [];
  for (const { name, given } of cases) {
    const control = document.getElementById(`set ${name}`);
    const back = control.closest(".row").querySelector(".back");
    const put = await answered(name, control, () => give(name, control, given));
    // only every fourth case draws, because a picture takes as long as the case itself
    if (outcomes.length % 4 === 0) await ear.frame();
    outcomes.push([put, await answered(name, back, () => back.click())]);
  }
  return outcomes;
};

// Calls `press` for a control or button. Returns the answer of the worker and what the page then shows.
async function answered(name, part, press) {
  if (!isSeen(part)) part.closest("details").querySelector("summary").click();
  const hindrance = !isSeen(part) ? "not seen" : part.matches(":disabled, input[type=text]:read-only") ? "locked" : coverOf(part);
  if (hindrance !== null) throw new Error(`${name}: ${part.className || part.tagName} cannot be pressed: ${hindrance}`);
  const before = ear.asked.number;
  press();
  if (ear.asked.number !== before + 1) throw new Error(`${name}: ${ear.asked.number - before} runs for a change`);
  const answer = ear.answers[ear.asked.number];
  const begin = performance.now();
  while (!answer.started && !answer.refused && !answer.trap) {
    if (performance.now() - begin > LONGEST) throw new Error(`${name}: no answer`);
    await new Promise((done) => setTimeout(done, 2));
  }
  return { answer: { ...answer }, ...ear.seen(name) };
}

// Sets a control as a user does. `given` is a text, a boolean or the name of a literal.
function give(name, control, given) {
  const shown = control.type === "checkbox" ? control.checked : control.selectedOptions?.[0].label ?? control.value;
  if (shown === given) throw new Error(`${name} is ${given} already`);
  if (control.type === "checkbox") {
    control.click();
    return;
  }
  control.value = control.options ? [...control.options].find(({ label }) => label === given).value : given;
  for (const kind of ["input", "change"]) control.dispatchEvent(new Event(kind, { bubbles: true }));
}
