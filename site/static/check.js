"use strict";
// The checkers in the page: the proved one, made by js_of_ocaml from what Coq extracts, and the second one in Python, by
// pyodide. Both are loaded from scripts beside the page, since a page from a file may not fetch anything.
// The proved checker, once: its exit code and what it printed. It takes strings of bytes.
async function proved(graph, proof) {
  await load("proved.js");
  let code = null, out = "";
  const write = (more) => { out += more; };
  window.caml_fs_tmp = [{ name: "/static/graph", content: graph }, { name: "/static/proof", content: proof }];
  window.process = {
    argv: ["", "viewcert-proved", "/static/graph", "/static/proof"],
    stdout: { write }, stderr: { write },
    exit(status) { code = status; throw { exit: status }; },
  };
  try {
    Function(window.PROVED)();
  } catch (thrown) {
    if (code === null) out += String(thrown);
  }
  delete window.process;
  return { code, out: out.replaceAll("/static/graph", "graph").replaceAll("/static/proof", "proof") };
}

let python = null;
function interpreter() {
  python ??= (async () => {
    for (const name of ["pyodide/loader.js", "pyodide/module.js", "pyodide/wasm.js", "pyodide/library.js", "checker.js"]) await load(name);
    const url = URL.createObjectURL(new Blob([window.PYODIDE_MODULE], { type: "text/javascript" }));
    const module = (await import(url)).default;
    const files = {
      "pyodide.asm.wasm": [window.PYODIDE_WASM, "application/wasm"],
      "python_stdlib.zip": [window.PYODIDE_LIBRARY, "application/zip"],
    };
    const fetched = window.fetch;
    window.fetch = async (place, ...more) => {
      const name = String(place?.url ?? place).split("/").pop();
      if (!files[name]) return fetched(place, ...more);
      return new Response(bytes(files[name][0]), { headers: { "Content-Type": files[name][1] } });
    };
    const found = await loadPyodide({ indexURL: "pyodide/", createPyodideModule: module, lockFileContents: window.PYODIDE_LOCK });
    window.fetch = fetched;
    found.FS.mkdirTree("/checker");
    for (const [name, source] of Object.entries(window.CHECKER)) found.FS.writeFile(`/checker/${name}`, source);
    found.runPython("import sys; sys.path.insert(0, '/checker'); sys.dont_write_bytecode = True");
    return found;
  })();
  return python;
}

// The second checker, once, on a certificate and the pairs of its graph (or ""): its exit code and what it printed.
async function second(certificate, graph) {
  const found = await interpreter();
  found.FS.writeFile("/checker/certificate.json", certificate);
  if (graph) found.FS.writeFile("/checker/graph.txt", graph);
  found.globals.set("with_graph", Boolean(graph));
  const [code, out] = found.runPython(`
import contextlib, io
import check as second_checker
words = ["/checker/certificate.json"] + ["/checker/graph.txt"] * with_graph
shown = io.StringIO()
with contextlib.redirect_stdout(shown), contextlib.redirect_stderr(shown):
    try:
        code = second_checker.main(words)
    except SystemExit as end:
        code = end.code
[code, shown.getvalue().replace("/checker/", "")]
`).toJs();
  return { code, out };
}

function answer(place, who, { code, out }) {
  const kind = { 0: "verified", 1: "rejected" }[code] ?? "undecided";
  const div = make("div", { className: `answer ${kind}` }, make("h3", {}, who), make("pre", {}, out.trim()));
  div.dataset.code = code;
  if (kind === "undecided") div.append("Nothing was decided. The program viewcert-check takes what is too large for this page, and a certificate that needs its graph takes the graph as a second file.");
  place.append(div);
}

const SECOND = "The second checker, Python in this page (crates/check/second)";
const PROVED = "The checker that is proved correct in Coq (proofs/), on its own proof";

async function checkAll(certificate, pairs, proof) {
  const place = id("answers"), wait = make("p", {}, "Python is starting; the first time takes some seconds …");
  place.replaceChildren(wait);
  for (const [who, run] of [[SECOND, () => second(certificate, pairs)], ...(proof ? [[PROVED, () => proved(pairs, proof)]] : [])]) {
    const found = await run().catch((error) => ({ code: 2, out: `this checker did not run: ${error}` }));
    wait.remove();
    answer(place, who, found);
  }
}

// A copy that claims another rank, and a proof that does: what the copy says is false, and both have to notice.
function tampered(certificate, proof) {
  const value = JSON.parse(certificate);
  value.claim.rank.value -= 1;
  const other = proof.replace(/^claim (\d+) (\d+)$/m, (_, least, most) => `claim ${least - 1} ${most - 1}`);
  return [JSON.stringify(value), other];
}

// The part of a page that has a certificate: its box and its buttons.
function offerChecks() {
  const box = id("certificate-text");
  if (!box || !id("certificate")) return;
  let proof = "";
  const shown = () => { box.value = text("certificate"); proof = text("proof"); };
  shown();
  const check = () => checkAll(box.value, text("pairs"), proof);
  id("check-now").addEventListener("click", check);
  id("restore").addEventListener("click", () => { shown(); id("answers").replaceChildren(); });
  id("tamper").addEventListener("click", () => {
    [box.value, proof] = tampered(text("certificate"), text("proof"));
    check();
  });
}
offerChecks();

// Files that the reader chooses.
id("check-files")?.addEventListener("click", async () => {
  const [certificate, graph, proof] = await Promise.all(["certificate", "graph", "proof"].map((name) => id(`${name}-file`).files[0]?.text()));
  if (certificate === undefined) {
    id("answers").replaceChildren("Choose a certificate first.");
    return;
  }
  await checkAll(certificate, graph ?? "", graph && proof);
  if (proof && !graph) id("answers").append("The proved checker takes a graph and a proof: choose the graph as well.");
});
