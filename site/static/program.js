"use strict";
// `verify` in the page: the same program, built for the browser. A run is a message to a worker, so that the page stays awake
// and what takes too long can be stopped.
const PROGRAM = (() => {
  const waiting = new Map();
  const compiled = compile();
  let worker = null, number = 0;

  // From a server that sends compressed copies, compiled as it arrives; else, and from the disk, where nothing may be fetched,
  // as a script.
  async function compile() {
    const found = location.protocol.startsWith("http") && await fetch("static/verify.wasm");
    if (!found.ok) await load("verify.js");
    const body = found.ok ? found.body : unpacked(window.VERIFY).body;
    return WebAssembly.compileStreaming(new Response(body, { headers: { "Content-Type": "application/wasm" } }));
  }

  async function start() {
    await load("worker.js");
    if (worker) return;
    worker = new Worker(URL.createObjectURL(new Blob([window.WORKER], { type: "text/javascript" })));
    worker.onmessage = ({ data: { number: answered, ...answer } }) => { waiting.get(answered)?.[0](answer); waiting.delete(answered); };
    worker.onerror = (event) => { event.preventDefault(); stop(event.message); };
  }

  // Ends what is running; the next run starts anew.
  function stop(why = "stopped") {
    if (why === "stopped" && !waiting.size) return;
    worker?.terminate();
    worker = null;
    for (const [, failed] of waiting.values()) failed(new Error(why));
    waiting.clear();
  }

  // Exit code, standard output and standard error of a run of `verify` with these arguments, this standard input and these
  // files, each a path and a File.
  async function run(words, input, files = []) {
    const module = await compiled, mine = ++number;
    await start();
    return new Promise((done, failed) => {
      waiting.set(mine, [done, failed]);
      worker.postMessage({ module, number: mine, words, input, files });
    });
  }

  start();
  return { run, stop };
})();
