// Loads the engine and the pack, says how far that is, and starts the demo. Without what the demo needs of the browser it
// says so in a sentence.
"use strict";

(function () {
  const cover = document.getElementById("cover");
  const bar = document.getElementById("bar");
  const done = document.getElementById("done");
  const state = document.getElementById("state");
  // The files' bytes: what a host compresses, it sends without its length.
  const files = JSON.parse(document.getElementById("files").textContent);
  const MEGABYTE = 1e6;
  // Of the canvas for each pixel of CSS, along either axis. Phones have 3 or 4: nine or sixteen times the work for what is hardly seen.
  const MOST_PIXELS = 2;
  let failed = false;
  let started = false;

  function fail(sentence) {
    failed = true;
    bar.hidden = true;
    state.classList.add("problem");
    state.textContent = sentence;
    cover.classList.remove("gone");
  }

  function say(sentence, part) {
    if (failed) {
      return;
    }
    state.textContent = sentence;
    bar.classList.toggle("unknown", part === null);
    if (part !== null) {
      done.style.width = `${(100 * part).toFixed(1)}%`;
      bar.setAttribute("aria-valuenow", Math.round(100 * part));
    } else {
      done.style.width = "";
      bar.removeAttribute("aria-valuenow");
    }
  }

  // What the browser or the graphics driver has not, in a sentence; empty if all is there.
  function findMissing() {
    if (typeof WebAssembly !== "object" || typeof WebAssembly.instantiate !== "function") {
      return "This browser has no WebAssembly, in which the demo is built: please take a newer one.";
    }
    if (location.protocol === "file:") {
      return "Browsers load nothing of this page from a folder: please open it through a web server, as ./dev web --serve does.";
    }
    if (!window.isSecureContext) {
      return "Browsers run the engine on pages from https:// or localhost only: please open this page there.";
    }
    const trial = document.createElement("canvas");
    const gl = typeof WebGL2RenderingContext === "function" ? trial.getContext("webgl2") : null;
    if (!gl) {
      return "This browser offers no WebGL 2 on this device, with which the demo draws: please take a newer browser, or turn on hardware acceleration.";
    }
    const floats = gl.getExtension("EXT_color_buffer_float") || gl.getExtension("EXT_color_buffer_half_float");
    const lose = gl.getExtension("WEBGL_lose_context");
    if (lose) {
      lose.loseContext();
    }
    if (!floats) {
      return "This device cannot draw into textures of floats (EXT_color_buffer_float), of which the light of the surroundings is made.";
    }
    return "";
  }

  // The engine asks the window whenever it looks how large the canvas has to be.
  function limitPixelRatio() {
    const own = Object.getOwnPropertyDescriptor(window, "devicePixelRatio");
    if (own && own.get && own.configurable) {
      Object.defineProperty(window, "devicePixelRatio", {
        configurable: true,
        enumerable: true,
        get: () => Math.min(own.get.call(window), MOST_PIXELS),
      });
    }
  }

  function showProgress(current, total) {
    if (total > 0 && current < total) {
      const loaded = (current / MEGABYTE).toFixed(1);
      say(`${loaded} of ${(total / MEGABYTE).toFixed(1)} MB`, current / total);
    } else if (total > 0) {
      say("Starting …", 1);
    } else {
      say(`${(current / MEGABYTE).toFixed(1)} MB`, null);
    }
  }

  function showFailure(error) {
    console.error(error);
    fail(describe(error));
  }

  function describe(error) {
    const text = error && error.message ? error.message : String(error);
    return `The demo could not be started: ${text.replace(/\.*$/, "")}. Please reload the page to try again.`;
  }

  const problem = findMissing();
  if (problem) {
    fail(problem);
    // What there is instead of the demo.
    const still = document.getElementById("still");
    still.src = "demo.png";
    still.hidden = false;
    return;
  }
  if (typeof Engine !== "function") {
    fail("index.js, the engine's part of this page, was not found beside it.");
    return;
  }
  const canvas = document.getElementById("canvas");
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextlost", () => {
    fail("The browser has taken the graphics context away, as it does when memory is short: please reload the page.");
  });
  limitPixelRatio();
  const engine = new Engine({
    executable: "index",
    mainPack: "index.pck",
    canvas: canvas,
    // As large as the window, in the screen's own pixels or those that are left of them.
    canvasResizePolicy: 2,
    focusCanvas: true,
    args: [],
    fileSizes: files,
    onProgress: showProgress,
  });
  // What fails while the engine itself is loaded reaches nobody else.
  window.addEventListener("unhandledrejection", (event) => {
    if (!started) {
      showFailure(event.reason);
    }
  });
  say("Loading …", 0);
  engine.startGame().then(() => {
    started = true;
    if (!failed) {
      cover.classList.add("gone");
    }
  }, showFailure);
})();
