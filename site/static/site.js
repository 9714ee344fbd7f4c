"use strict";
// What every page has: words of the glossary that explain themselves, texts that can be saved.
const text = (id) => JSON.parse(document.getElementById(id).textContent);

function save(name, content) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type: "text/plain" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const SUFFIX = { certificate: ".certificate.json", proof: ".proof", witness: ".witness.json", pairs: ".txt" };
for (const button of document.querySelectorAll("[data-save]")) {
  const what = button.dataset.save;
  const stem = location.pathname.split("/").pop().replace(/\.html$/, "");
  button.addEventListener("click", () => save(stem + SUFFIX[what], text(what)));
}

for (const link of document.querySelectorAll("a.term")) {
  const found = (window.TERMS || {})[link.dataset.term];
  if (!found) continue;
  link.href = `${document.body.dataset.up}docs/glossary.html#${link.dataset.term}`;
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
