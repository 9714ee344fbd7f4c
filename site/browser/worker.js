// `verify` as WebAssembly, beside the page: one run of the program for each message. There is no folder and no clock to wait
// for; what a command writes goes to standard output (`--certificate -`).
import { File, OpenFile, WASI } from "@bjorn3/browser_wasi_shim";

let program = null;

// What Debian's C library for WASI has not: there are no threads, and then all is done by the one there is; nothing else of
// this is called, as there is no folder.
const NO_THREADS = 52;
const missing = {
  pthread_create: () => NO_THREADS,
  pthread_attr_init: () => 0,
  pthread_attr_setstacksize: () => 0,
  pthread_attr_destroy: () => 0,
};

function library() {
  const needed = WebAssembly.Module.imports(program).filter(({ module }) => module === "env").map(({ name }) => name);
  const absent = (name) => () => { throw new Error(`${name} is not there in a page`); };
  return Object.fromEntries(needed.map((name) => [name, missing[name] ?? absent(name)]));
}

function run(words, input) {
  const [standard, printed, said] = [new TextEncoder().encode(input), [], []].map((content) => new File(content));
  const wasi = new WASI(["verify", ...words], [], [standard, printed, said].map((file) => new OpenFile(file)), { debug: false });
  const instance = new WebAssembly.Instance(program, { wasi_snapshot_preview1: wasi.wasiImport, env: library() });
  const read = (file) => new TextDecoder().decode(file.data);
  let code;
  try {
    code = wasi.start(instance);
  } catch (error) {
    return { code: 101, out: "", err: `${read(said)}${error}` };
  }
  return { code, out: read(printed), err: read(said) };
}

onmessage = ({ data: { module, number, words, input } }) => {
  program ??= module;
  if (words) postMessage({ number, ...run(words, input) });
};
