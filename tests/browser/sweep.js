// Gives values to controls one after the other, and takes each back by the button beside its control: within the page, as the way from a
// test to the page and back takes longer than what is tested. What would keep a reader from doing it ends the sweep.
const LONGEST = 60_000; // ms until an answer

window.sweep = async (cases) => {
  const outcomes = [];
  for (const { name, given } of cases) {
    const control = document.getElementById(`set ${name}`);
    const back = control.closest(".row").querySelector(".back");
    const put = await answered(name, control, () => give(name, control, given));
    // a picture takes as long as all the rest
    if (outcomes.length % 4 === 0) await ear.frame();
    outcomes.push([put, await answered(name, back, () => back.click())]);
  }
  return outcomes;
};

// Does something to a control or button; the worker's answer, and what the page shows then.
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

// A value as a reader gives it: text, true or false, or a literal's name.
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
