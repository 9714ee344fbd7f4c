"use strict";
// What every page has: scripts that are loaded when they are needed, words of the glossary that explain themselves, texts that
// can be saved.
const text = (id) => JSON.parse(document.getElementById(id).textContent);
const up = document.body?.dataset.up ?? "../";
const loaded = {};
const id = (name) => document.getElementById(name);

// An element with these properties and what it contains.
function make(name, properties, ...content) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...content);
  return made;
}

function load(name) {
  loaded[name] ??= new Promise((done, failed) => {
    const script = document.createElement("script");
    script.src = `${up}static/${name}`;
    script.onload = done;
    script.onerror = () => failed(new Error(`${name} is not there`));
    document.head.append(script);
  });
  return loaded[name];
}

const bytes = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
const unpacked = (base64) => new Response(new Blob([bytes(base64)]).stream().pipeThrough(new DecompressionStream("deflate")));

function save(name, content, type = "text/plain") {
  const link = make("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const SUFFIX = { certificate: ".certificate.json", proof: ".proof", witness: ".witness.json", pairs: ".txt", adjacency: ".adjacency.txt", graph: ".json", bibtex: ".bib", picture: ".svg" };
const drawing = () => document.querySelector("svg.graph").outerHTML;
const asText = (value) => (typeof value === "string" ? value : JSON.stringify(value, null, 1));

// Buttons that save, and words of the glossary, in a part of the page that has just come to be.
function enliven(part) {
  for (const button of part.querySelectorAll("[data-save]")) {
    const what = button.dataset.save;
    const stem = location.pathname.split("/").pop().replace(/\.html$/, "");
    button.addEventListener("click", () => save(stem + SUFFIX[what], what === "picture" ? drawing() : asText(text(what))));
  }
  for (const link of part.querySelectorAll("a.term")) {
    const found = (window.TERMS || {})[link.dataset.term];
    if (!found) continue;
    link.href = `${up}docs/glossary.html#${link.dataset.term}`;
    const show = () => link.append(make("span", { className: "tip", role: "tooltip" }, found));
    const hide = () => link.querySelector(".tip")?.remove();
    for (const event of ["mouseenter", "focus"]) link.addEventListener(event, show);
    for (const event of ["mouseleave", "blur"]) link.addEventListener(event, hide);
  }
}
enliven(document);
