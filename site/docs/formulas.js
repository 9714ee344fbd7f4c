// Formulas to MathML, one a line of JSON.
const katex = require(process.argv[2]);
require("readline").createInterface({ input: process.stdin }).on("line", (line) => {
  const { formula, display } = JSON.parse(line);
  try {
    const html = katex.renderToString(formula, { displayMode: display, output: "mathml", throwOnError: true, strict: "ignore" });
    console.log(JSON.stringify({ mathml: html }));
  } catch (error) {
    console.log(JSON.stringify({ error: error.message }));
  }
});
