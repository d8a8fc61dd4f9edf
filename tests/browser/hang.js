// A step that never comes back.
function failure() {
  for (;;);
}
