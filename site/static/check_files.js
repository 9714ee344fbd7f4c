"use strict";
// The checkers on files that the reader chooses.
document.getElementById("check-files").addEventListener("click", async () => {
  const file = (name) => document.getElementById(`${name}-file`).files[0];
  const read = async (name) => (file(name) ? await file(name).text() : "");
  const place = document.getElementById("answers");
  if (!file("certificate")) {
    place.replaceChildren("Choose a certificate first.");
    return;
  }
  const graph = await read("graph"), proof = await read("proof");
  await checkAll(await read("certificate"), graph, graph && proof ? proof : "");
  if (proof && !graph) place.append("The proved checker takes a graph and a proof: choose the graph as well.");
});
