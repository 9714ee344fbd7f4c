"use strict";
// The first time that a word of the glossary occurs in a section, it explains itself.
document.addEventListener("DOMContentLoaded", () => {
  // What the generator leaves out for keyboards and screen readers.
  for (const caption of document.querySelectorAll('p.caption[role="heading"]')) caption.ariaLevel = "2";
  for (const region of document.querySelectorAll("pre, .table-wrapper")) region.tabIndex = 0;
  const words = Object.keys(window.TERMS).map((anchor) => [anchor, anchor.replaceAll("-", " ")]).sort((a, b) => b[1].length - a[1].length);
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
        const link = make("a", { className: "term" }, match[0]), rest = node.splitText(match.index);
        rest.data = rest.data.slice(match[0].length);
        link.dataset.term = anchor;
        rest.before(link);
      }
    }
  }
  enliven(document);
});
