// Unpacks what the page holds and starts it. `window.page` is the whole page, for scripts and tests that drive it.
import { embeddedJson, embeddedLibrary } from "./embedded.js";
import { Page } from "./page.js";

embeddedJson("data")
  .then((data) => { window.page = new Page(data, embeddedLibrary("library")); })
  .catch((error) => {
    const message = document.getElementById("message");
    message.hidden = false;
    message.className = "bad";
    message.textContent = `This browser cannot run the page: ${error.message}`;
  });
