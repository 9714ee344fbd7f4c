"use strict";
// `verify` in the page: the same program, built for the browser; graphs need no databases, so theirs is smaller. A run is a
// message to a worker, so that the page stays awake and what takes too long can be stopped.
const PROGRAM = (() => {
  const waiting = new Map();
  let compiled = null, worker = null, number = 0;

  async function compile(name) {
    await load("worker.js");
    // From a server that sends compressed copies by brotli; else, and from the disk, where nothing may be fetched, as a script.
    const found = location.protocol.startsWith("http") && await fetch(`static/verify-${name}.wasm`);
    if (found.ok) return WebAssembly.compile(await found.arrayBuffer());
    await load(`verify-${name}.js`);
    return WebAssembly.compile(await unpacked(window.VERIFY).arrayBuffer());
  }

  async function start(name) {
    const module = await (compiled ??= compile(name));
    if (worker) return;
    worker = new Worker(URL.createObjectURL(new Blob([window.WORKER], { type: "text/javascript" })));
    worker.onmessage = ({ data: { number: answered, ...answer } }) => { waiting.get(answered)?.[0](answer); waiting.delete(answered); };
    worker.onerror = (event) => { event.preventDefault(); stop(event.message); };
    worker.postMessage({ module });
  }

  // Ends what is running; the next run starts anew.
  function stop(why = "stopped") {
    worker?.terminate();
    worker = null;
    for (const [, failed] of waiting.values()) failed(new Error(why));
    waiting.clear();
  }

  // Exit code, standard output and standard error of a run of `verify` with these arguments, this standard input and these
  // files, each a path and a File.
  async function run(words, input, files = []) {
    await start(files.length ? "photographs" : "graphs");
    const mine = ++number;
    return new Promise((done, failed) => {
      waiting.set(mine, [done, failed]);
      worker.postMessage({ number: mine, words, input, files });
    });
  }

  return { run, stop };
})();
