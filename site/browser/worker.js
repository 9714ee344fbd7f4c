// `verify` as WebAssembly, beside the page: one run of the program for each message. The files that the reader chose are its
// only files, and are not written to; what a command writes goes to standard output (`--certificate -`).
import { Directory, File, OpenFile, PreopenDirectory, SyncOPFSFile, WASI } from "@bjorn3/browser_wasi_shim";

const BLOCK = 1 << 19, BLOCKS = 1024;
let program = null;

// A file of any size, of which the program reads what it needs: the blocks that it asked for last are kept.
function sliced(blob) {
  const kept = new Map(), reader = new FileReaderSync();
  const block = (k) => {
    const found = kept.get(k) ?? new Uint8Array(reader.readAsArrayBuffer(blob.slice(k * BLOCK, (k + 1) * BLOCK)));
    kept.delete(k);
    if (kept.size === BLOCKS) kept.delete(kept.keys().next().value);
    kept.set(k, found);
    return found;
  };
  const read = (into, { at }) => {
    const size = Math.max(0, Math.min(into.length, blob.size - at));
    for (let done = 0; done < size;) {
      const k = Math.floor((at + done) / BLOCK), from = at + done - k * BLOCK;
      const part = block(k).subarray(from, from + size - done);
      into.set(part, done);
      done += part.length;
    }
    return size;
  };
  return new SyncOPFSFile({ getSize: () => blob.size, read }, { readonly: true });
}

function folder(files) {
  const root = new Map();
  for (const [path, blob] of files) {
    const names = path.split("/"), name = names.pop();
    const place = names.reduce((at, step) => at.get(step)?.contents ?? at.set(step, new Directory(new Map())).get(step).contents, root);
    place.set(name, sliced(blob));
  }
  return new PreopenDirectory("/", root);
}

function run(words, input, files) {
  const standard = [new TextEncoder().encode(input), [], []].map((content) => new File(content));
  const wasi = new WASI(["verify", ...words], [], [...standard.map((file) => new OpenFile(file)), folder(files)], { debug: false });
  const instance = new WebAssembly.Instance(program, { wasi_snapshot_preview1: wasi.wasiImport });
  const [, out, err] = standard.map((file) => () => new TextDecoder().decode(file.data));
  try {
    return { code: wasi.start(instance), out: out(), err: err() };
  } catch (error) {
    return { code: 101, out: "", err: `${err()}${error}` };
  }
}

onmessage = ({ data: { module, number, words, input, files } }) => {
  program ??= module;
  if (words) postMessage({ number, ...run(words, input, files) });
};
