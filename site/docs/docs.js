"use strict";
// The first time that a word of the glossary occurs in a section, it explains itself; statements light up their arcs.
document.addEventListener("DOMContentLoaded", () => {
  // What the generator leaves out for keyboards and screen readers.
  for (const caption of document.querySelectorAll('p.caption[role="heading"]')) caption.ariaLevel = "2";
  for (const region of document.querySelectorAll("pre, .table-wrapper")) region.tabIndex = 0;
  const terms = JSON.parse(document.getElementById("terms")?.textContent ?? "{}");
  const words = Object.keys(terms).map((anchor) => [anchor, anchor.replaceAll("-", " ")]).sort((a, b) => b[1].length - a[1].length);
  const pattern = new RegExp(`\\b(${words.map(([, word]) => word).join("|")})s?\\b`, "gi");
  const anchorOf = Object.fromEntries(words.map(([anchor, word]) => [word, anchor]));
  const here = location.pathname.split("/").pop();
  for (const section of here === "glossary.html" ? [] : document.querySelectorAll("article section")) {
    const seen = new Set();
    for (const paragraph of section.querySelectorAll(":scope > p, :scope > ul > li > p")) {
      const walker = document.createTreeWalker(paragraph, NodeFilter.SHOW_TEXT), texts = [];
      while (walker.nextNode()) if (!walker.currentNode.parentElement.closest("a, code, math")) texts.push(walker.currentNode);
      for (const node of texts) for (const match of [...node.data.matchAll(pattern)].reverse()) {
        const anchor = anchorOf[match[1].toLowerCase()];
        if (seen.has(anchor)) continue;
        seen.add(anchor);
        const link = document.createElement("a"), rest = node.splitText(match.index);
        rest.data = rest.data.slice(match[0].length);
        link.className = "term";
        link.href = `glossary.html#${anchor}`;
        link.textContent = match[0];
        rest.before(link);
        const show = () => {
          const tip = document.createElement("span");
          tip.className = "tip";
          tip.role = "tooltip";
          tip.textContent = terms[anchor];
          link.append(tip);
        };
        for (const event of ["mouseenter", "focus"]) link.addEventListener(event, show);
        for (const event of ["mouseleave", "blur"]) link.addEventListener(event, () => link.querySelector(".tip")?.remove());
      }
    }
  }
  for (const link of document.querySelectorAll(".statements a")) {
    const number = link.dataset.number;
    const set = (on) => {
      for (const path of document.querySelectorAll(`.statements path[data-from="${number}"]`)) path.classList.toggle("uses", on);
      for (const path of document.querySelectorAll(`.statements path[data-to="${number}"]`)) path.classList.toggle("used", on);
    };
    for (const event of ["mouseenter", "focus"]) link.addEventListener(event, () => set(true));
    for (const event of ["mouseleave", "blur"]) link.addEventListener(event, () => set(false));
  }
});
