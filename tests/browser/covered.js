// Returns the name of the element that covers a control, or null if a user can press the control.
window.coverOf = (control) => {
  control.scrollIntoView({ block: "center" });
  const { left, top, width, height } = control.getBoundingClientRect();
  for (const [x, y] of [[0.5, 0.5], [0.1, 0.5], [0.9, 0.5], [0.5, 0.15], [0.5, 0.85]]) {
    const over = document.elementFromPoint(left + x * width, top + y * height);
    if (over && (over === control || control.contains(over) || over.closest("label")?.contains(control))) continue;
    return over?.id || over?.parentElement?.id || over?.className || "a part without a name";
  }
  return null;
};

window.isSeen = (part) => part.checkVisibility({ visibilityProperty: true }) && part.getBoundingClientRect().width > 0;

// Lists the controls that other elements cover and the boxes over the picture that overlap.
window.covered = () => {
  const found = [];
  for (const control of document.querySelectorAll("button, input, select, summary")) {
    if (!isSeen(control) || control.closest("#groups, #trace-list")) continue;
    const over = coverOf(control);
    if (over !== null) found.push(`${control.id || control.textContent} is under ${over}`);
  }
  scrollTo(0, 0);
  const boxes = ["cameras", "figures", "meaning", "flank", "walk", "message"].map((id) => document.getElementById(id)).filter(isSeen);
  boxes.forEach((box, i) => boxes.slice(0, i).forEach((other) => {
    const [a, b] = [box, other].map((each) => each.getBoundingClientRect());
    const isApart = a.left >= b.right - 1 || b.left >= a.right - 1 || a.top >= b.bottom - 1 || b.top >= a.bottom - 1;
    if (!isApart) found.push(`${box.id} overlaps ${other.id}`);
  }));
  return found;
};
