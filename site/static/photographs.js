"use strict";
// What the reader drops or chooses, and `verify overview` of it, in this page.
let asked = 0, answer = null;

// The files of a dropped folder, with their paths.
async function below(entry, path) {
  const taken = (read) => new Promise((done, failed) => read(done, failed));
  if (entry.isFile) return [[path + entry.name, await taken((...then) => entry.file(...then))]];
  const reader = entry.createReader(), found = [];
  for (let some; (some = await taken((...then) => reader.readEntries(...then))).length;) for (const inner of some) found.push(...await below(inner, `${path}${entry.name}/`));
  return found;
}

async function dropped(items) {
  // All entries at once: the list is empty after the first wait.
  const found = [...items].filter((item) => item.kind === "file").map((item) => [item.webkitGetAsEntry?.(), item.getAsFile()]);
  const read = (entry) => below(entry, "").catch(() => { throw new Error("a browser gives no dropped folder to a page of the disk: choose the folder by its button"); });
  return (await Promise.all(found.map(([entry, file]) => (entry?.isDirectory ? read(entry) : [[file.name, file]])))).flat();
}

// What the program is asked about: the one file or folder that is no companion of a database.
function input(files) {
  const tops = [...new Set(files.map(([path]) => path.split("/")[0]))].filter((name) => !/-(wal|shm|journal)$/.test(name));
  if (tops.length === 1) return [tops[0], files];
  if (!tops.length) throw new Error("there is no file: choose a database, the files of a model, or a list");
  if (tops.some((name) => name.endsWith(".db"))) throw new Error("these are several inputs: choose one database, with its -wal file if there is one");
  return ["model", files.map(([path, file]) => [`model/${path}`, file])];
}

// A database that is written by way of a log may have its last changes beside it, where a page does not look.
async function lacksLog(name, files) {
  const [, file] = files.find(([path]) => path === name) ?? [];
  const head = file && new Uint8Array(await file.slice(0, 19).arrayBuffer());
  return head?.[18] === 2 && new TextDecoder().decode(head.slice(0, 13)) === "SQLite format" && !files.some(([path]) => path === `${name}-wal`);
}

async function overview(choose) {
  const mine = ++asked;
  PROGRAM.stop();
  for (const name of ["message", "told"]) id(name).textContent = "";
  for (const name of ["keep", "page"]) id(name).hidden = true;
  id("stop").hidden = false;
  id("status").textContent = "The program is starting …";
  const ended = (status, message = "") => { id("status").textContent = status; id("message").textContent = message; id("stop").hidden = true; id("told").dataset.done = mine; };
  try {
    const [name, files] = input(await choose());
    const noLog = await lacksLog(name, files);
    id("status").textContent = `${name} is being read …`;
    const begin = performance.now();
    const { code, out, err } = await PROGRAM.run(["overview", "--html", "-", "--", name], "", files);
    if (mine !== asked) return;
    if (code > 1) return ended("", err.trim().replace(/^verify: /, ""));
    answer = { name, page: out, text: err };
    id("told").textContent = err.trim();
    id("page").srcdoc = out;
    for (const name of ["keep", "page"]) id(name).hidden = false;
    ended(`Read and decided in ${((performance.now() - begin) / 1000).toFixed(1)} s.`, noLog ? `If ${name}-wal lies beside the database, its last changes are there: choose both.` : "");
  } catch (error) {
    if (mine === asked) ended(error.message === "stopped" ? "Stopped." : "", error.message === "stopped" ? "" : `${error.message}`);
  }
}

const chosen = (list) => [...list].map((file) => [file.webkitRelativePath || file.name, file]);
for (const name of ["files", "folder"]) id(name).addEventListener("change", (event) => event.target.files.length && overview(() => chosen(event.target.files)));
for (const event of ["dragover", "drop"]) addEventListener(event, (happened) => happened.preventDefault());
addEventListener("drop", (event) => { const files = dropped(event.dataTransfer.items); overview(() => files); });
for (const button of document.querySelectorAll("[data-sample]")) button.addEventListener("click", () => overview(async () => {
  await load("samples.js");
  return [[button.dataset.sample, await unpacked(window.SAMPLES[button.dataset.sample]).blob()]];
}));
id("stop").addEventListener("click", () => PROGRAM.stop());
id("keep-page").addEventListener("click", () => save(`${answer.name}.html`, answer.page, "text/html"));
id("keep-text").addEventListener("click", () => save(`${answer.name}.txt`, answer.text));
