// Unpacks the contents of the page and starts it. `window.page` is the page object, for scripts and tests.
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
