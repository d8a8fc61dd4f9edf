// A step that never comes back.
window.failure = () => {
  for (;;);
};
