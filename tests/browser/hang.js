// A step that never returns.
window.failure = () => {
  for (;;);
};
