"use strict";
// What every page has: scripts that are loaded when they are needed, words of the glossary that explain themselves, texts that
// can be saved.
const text = (id) => JSON.parse(document.getElementById(id).textContent);
const up = document.body?.dataset.up ?? "../";
const loaded = {};

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

function save(name, content, type = "text/plain") {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
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
    const show = () => {
      const tip = document.createElement("span");
      tip.className = "tip";
      tip.role = "tooltip";
      tip.textContent = found;
      link.append(tip);
    };
    const hide = () => link.querySelector(".tip")?.remove();
    for (const event of ["mouseenter", "focus"]) link.addEventListener(event, show);
    for (const event of ["mouseleave", "blur"]) link.addEventListener(event, hide);
  }
}
enliven(document);
