"use strict";
// All numbers are read from the report, which is what `verify --json --components` prints. Names
// become text nodes, never markup.
(() => {
  const parse = (id) => JSON.parse(document.getElementById(id).textContent);
  const find = (selector) => document.querySelector(selector);
  const SVG = "http://www.w3.org/2000/svg";
  const MOST_ROWS = 200;
  const SELECTABLE = 500;
  const LABEL = 11;

  // ---- Elements

  const fill = (element, attributes, children) => {
    for (const [name, value] of Object.entries(attributes)) {
      if (name === "on") {
        for (const [event, handler] of Object.entries(value)) element.addEventListener(event, handler);
      } else if (value === true) {
        element.setAttribute(name, "");
      } else if (value !== false && value !== undefined && value !== null) {
        element.setAttribute(name, value);
      }
    }
    element.append(...children.flat().filter((child) => child !== null && child !== undefined));
    return element;
  };
  const html = (tag, attributes = {}, ...children) =>
    fill(document.createElement(tag), attributes, children);
  const svg = (tag, attributes = {}, ...children) =>
    fill(document.createElementNS(SVG, tag), attributes, children);

  const grouped = (number) =>
    Number.isInteger(number) ? number.toLocaleString("en-US") : String(number);
  const counted = (count, thing) => {
    const many = thing.endsWith("y") ? `${thing.slice(0, -1)}ies` : `${thing}s`;
    return `${grouped(count)} ${count === 1 ? thing : many}`;
  };

  // ---- What is shown

  const report = parse("report");
  const drawing = parse("drawing");
  const components = report.components.map((component, index) => ({ ...component, index }));
  const names = drawing.names;
  const nodeOf = new Map(names.map((name, node) => [name, node]));
  const tracks = components.some((component) => "points" in component);
  const edgeWord = tracks ? "observation" : "pair";
  const larger = components.filter((component) => component.edges > 1).length;

  // The components of every camera, by the members that the report lists.
  const componentsOf = names.map(() => []);
  for (const component of components) {
    for (const label of component.labels ?? []) {
      const node = nodeOf.get(label);
      if (node !== undefined) componentsOf[node].push(component.index);
    }
  }
  const hinges = names.map((_, node) => node).filter((node) => componentsOf[node].length > 1);
  // A camera that sees no track is a component of its own in the report.
  const isolated = names.map((_, node) => node).filter((node) => drawing.degrees[node] === 0);
  const alone = components.filter((component) => component.edges === 0).length;

  const sizeWords = (component) => {
    if (tracks) {
      return `${counted(component.cameras, "camera")}, ${counted(component.points, "point")}`;
    }
    return `${counted(component.nodes, "camera")}, ${counted(component.edges, "pair")}`;
  };

  // ---- Marks: a colour and a shape, as in the picture

  const glyphOf = (children) =>
    svg("svg", { class: "glyph", viewBox: "-8 -8 16 16", "aria-hidden": "true" }, children);
  const SHAPES = [
    (colour) => svg("circle", { r: 6.5, fill: colour }),
    (colour) => svg("rect", { x: -6, y: -6, width: 12, height: 12, fill: colour }),
    (colour) => svg("polygon", { points: "0,-7.5 7,5.5 -7,5.5", fill: colour }),
    (colour) => svg("polygon", { points: "0,-7.5 7.5,0 0,7.5 -7.5,0", fill: colour }),
  ];
  const glyph = (index) => {
    if (index < drawing.marked) {
      const colour = drawing.colours[index % drawing.colours.length];
      return glyphOf([SHAPES[Math.floor(index / drawing.colours.length) % SHAPES.length](colour)]);
    }
    if (index < larger) return glyphOf([SHAPES[0]("#5b6470")]);
    if (components[index]?.edges === 0) return emptyGlyph();
    return glyphOf([svg("path", { d: "M-7 0H7", stroke: "#8a929c", "stroke-width": 2.5 })]);
  };
  const hingeGlyph = () =>
    glyphOf([
      svg("path", { d: "M0 -6.5A6.5 6.5 0 0 1 0 6.5Z", fill: drawing.colours[0] }),
      svg("path", { d: "M0 6.5A6.5 6.5 0 0 1 0 -6.5Z", fill: drawing.colours[1] }),
      svg("circle", { r: 6.5, fill: "none", "stroke-width": 1.6, class: "ink" }),
    ]);
  const emptyGlyph = () =>
    glyphOf([svg("circle", { r: 5.8, fill: "none", stroke: "#5b6470", "stroke-width": 1.6 })]);

  // ---- State in the address, so that a view can be kept and sent

  const state = new URLSearchParams(location.hash.slice(1));
  const remember = (key, value) => {
    if (value) state.set(key, value);
    else state.delete(key);
    try {
      history.replaceState(null, "", `#${state}`);
    } catch {
      // Some viewers of local files do not let an address change; the page works without.
    }
  };

  // ---- The verdict

  const placed = tracks ? "the positions of all cameras and points are" : "the cameras are";
  const UNIQUE = {
    projective: "The fundamental matrices determine all cameras, up to one projective change of the whole scene.",
    calibrated: `The directions between the cameras ${tracks ? "and the points " : ""}determine all their positions, up to one shift and one scale of the whole.`,
    affine: "The affine fundamental matrices determine all cameras, up to one affine change of the whole scene.",
  };
  const APART = {
    calibrated: "Each component is determined by itself, up to shift and scale; how they fit together is not.",
    affine: "Each component is determined by itself, up to an affine change; how they fit together is not.",
  };
  const solutionsCounted = ({ exactly, at_least, at_most }) =>
    exactly ? `There are exactly ${exactly} sets of cameras over the complex numbers.`
      : at_most ? `There are at least ${at_least} and at most ${at_most} sets of cameras over the complex numbers.`
        : at_least > 1 ? `There are at least ${at_least} sets of cameras over the complex numbers.`
          : "Whether there is just one set of cameras is left open.";
  const ANSWERS = {
    solvable: [`Solvable: ${placed} unique`, UNIQUE[report.model]],
    "finite-solvable": ["Finite solvable: finitely many sets of cameras",
      `No small change of the cameras fits the fundamental matrices. ${solutionsCounted(report.solutions ?? {})}`],
    "not-finite-solvable": report.model in APART
      ? [`Not solvable: infinitely many ${tracks ? "positions of the cameras and points" : "sets of cameras"}`, APART[report.model]]
      : ["Not finite solvable: infinitely many sets of cameras",
        "Each component is finite solvable by itself; how they fit together is not determined."],
  };
  const strengthWords = (name, exponent) => {
    if (name === "proof") return "proved";
    const bound = exponent === undefined || exponent === null
      ? "error bound"
      : `wrong with a probability of at most 2^${exponent}`;
    return `not proved: ${bound}, over random cameras modulo random primes`;
  };

  const showVerdict = () => {
    const [answer, meaning] = ANSWERS[report.verdict] ?? [report.verdict, ""];
    const element = find("#verdict");
    // Of photographs a verdict is half an answer: mappers want more.
    const photographs = "condition" in report;
    const isGood = report.verdict !== "not-finite-solvable";
    element.classList.add(!isGood ? "bad" : photographs ? "open" : "good");
    element.append(
      html("p", { class: "answer", "data-verdict": report.verdict }, isGood && photographs ? `${answer} ${report.condition}` : answer),
      "database" in report && !find("#answer")
        ? html("p", {}, "What the mappers will make of it is another question: ", html("code", {}, "verify overview"), " forecasts it.") : "",
      html("p", {}, meaning),
      html("p", { class: "soft" },
        `This is ${strengthWords(report.strength, report.error_log2)}. It rests on this: ${report.because}.`),
    );
    // That was about cameras in general position; the given ones may be special.
    const here = report.at_cameras;
    if (here) {
      const box = html("div", { id: "here", class: `${here.determined ? "good" : "bad"}` },
        html("p", { class: "answer", "data-determined": String(here.determined) },
          `At the given cameras: ${here.determined ? "determined" : "not determined"}`),
        html("p", {}, `${here.means[0].toUpperCase()}${here.means.slice(1)}: the rank there is ${
          grouped(here.rank)} of ${grouped(here.rank_required)}.`),
        html("p", { class: "soft" },
          here.strength === "proof" ? "This is proved. " : `This is ${strengthWords(here.strength, here.error_log2)}. `,
          here.degenerate ? "The answer above is about cameras in general position, and these are degenerate." : ""));
      element.after(box);
    }
  };

  const showFacts = () => {
    const facts = html("dl", { class: "facts" });
    const add = (title, value, from, note, long) => facts.append(html("div", {},
      html("dt", {}, title),
      html("dd", { "data-from": from, "data-value": value, class: long ? "long" : false },
        typeof value === "number" ? grouped(value) : value),
      note ? html("dd", { class: "note" }, note) : null));
    const shares = components.map((component) => component.cameras ?? component.nodes);
    const share = shares.length > 0 && names.length > 0 ? Math.max(...shares.slice(0, 1000)) : 0;
    if (tracks) {
      add("cameras", names.length, "cameras");
      add("nodes: cameras and points", report.graph.nodes, "/graph/nodes");
    } else {
      add("cameras", report.graph.nodes, "/graph/nodes");
    }
    add(`${edgeWord}s`, report.graph.edges, "/graph/edges");
    add("components", components.length, "components",
      strengthWords(report.components_strength));
    if (share > 0) {
      const percent = Math.floor((1000 * share) / names.length) / 10;
      add("cameras in the largest", share, "largest", `${percent} % of all`);
    }
    add("cameras in several components", hinges.length, "hinges");
    if (isolated.length > 0) {
      add(`cameras without ${edgeWord}s`, isolated.length, "isolated",
        tracks ? "components of their own" : "in no component");
    }
    add("rank", report.rank, "/rank",
      `of ${grouped(report.rank_required)}; ${strengthWords(report.rank_strength)}`);
    add("model", report.model, "/model");
    const time = report.seconds < 1
      ? `${(1000 * report.seconds).toFixed(report.seconds < 0.01 ? 1 : 0)} ms`
      : `${report.seconds.toFixed(report.seconds < 10 ? 1 : 0)} s`;
    if (report.seconds > 0) add("time", time, "/seconds");
    add("SHA-256 of the graph", report.graph.sha256, "/graph/sha256", null, true);
    find("#summary").append(facts);
    if (report.notes.length > 0) {
      find("#notes").hidden = false;
      find("#notes").append(html("ul", {}, report.notes.map((note) => html("li", {}, note))));
    }
  };

  // ---- The picture: hover, keys, zoom

  const status = find("#status");
  const picture = find("#picture svg");
  const drawn = new Map();
  for (const element of picture.querySelectorAll("[data-node]")) {
    drawn.set(Number(element.dataset.node), element);
  }
  const place = (element) => {
    const { e, f } = element.transform.baseVal.consolidate().matrix;
    return [e, f];
  };
  const describeNode = (node) => {
    const numbers = componentsOf[node].map((index) => index + 1);
    const where = numbers.length === 0
      ? "in no component"
      : `in ${numbers.length === 1 ? "component" : "components"} ${numbers.slice(0, 20).join(", ")}${
        numbers.length > 20 ? ", ..." : ""}`;
    return `${names[node]}: ${counted(drawing.degrees[node], edgeWord)}, ${where}`;
  };
  const describeComponent = (index) => {
    const component = components[index];
    return `component ${index + 1}: ${sizeWords(component)}`;
  };

  let selected = null;
  const overlay = svg("g", { class: "selection", "aria-hidden": "true" });
  const clear = () => {
    selected = null;
    overlay.replaceChildren();
    picture.classList.remove("dimmed");
    for (const element of picture.querySelectorAll(".kept")) element.classList.remove("kept");
    status.textContent = "";
  };
  const selectNode = (node) => {
    clear();
    selected = node;
    status.textContent = describeNode(node);
    const element = drawn.get(node);
    if (!element) return;
    const [x, y] = place(element);
    let path = "";
    if (drawing.edges) {
      for (let k = 0; k < drawing.edges.length; k += 2) {
        const [i, j] = [drawing.edges[k], drawing.edges[k + 1]];
        if (i === node || j === node) {
          const [a, b] = place(drawn.get(i === node ? j : i));
          path += `M${x} ${y}L${a} ${b}`;
        }
      }
    }
    overlay.append(
      svg("path", { d: path || "M0 0", "stroke-width": 1.5 }),
      svg("circle", { cx: x, cy: y, r: 11, "stroke-width": 2 }),
    );
  };
  const selectComponent = (index) => {
    clear();
    picture.classList.add("dimmed");
    for (const element of picture.querySelectorAll(`[data-component="${index}"]`)) {
      element.classList.add("kept");
    }
    for (const label of components[index].labels ?? []) {
      drawn.get(nodeOf.get(label))?.classList.add("kept");
    }
    status.textContent = describeComponent(index);
  };
  const show = (select, what) => {
    select(what);
    find("#graph").scrollIntoView({ block: "nearest" });
  };

  const setUpPicture = () => {
    picture.append(overlay);
    fill(picture, {
      tabindex: 0,
      role: "application",
      "aria-label": "The graph, with its components in colours. Arrow keys go from camera to camera, " +
        "plus and minus zoom, Escape ends the selection. The tables below say the same.",
      "aria-describedby": "status",
    }, []);
    const of = (event) => event.target.closest?.("[data-node], [data-component]");
    picture.addEventListener("pointerover", (event) => {
      const element = of(event);
      if (selected !== null) return;
      if (!element) status.textContent = "";
      else if ("node" in element.dataset) status.textContent = describeNode(Number(element.dataset.node));
      else status.textContent = describeComponent(Number(element.dataset.component));
    });
    picture.addEventListener("click", (event) => {
      const element = of(event);
      if (!element) clear();
      else if ("node" in element.dataset) selectNode(Number(element.dataset.node));
      else selectComponent(Number(element.dataset.component));
    });

    const whole = picture.viewBox.baseVal;
    const all = { x: whole.x, y: whole.y, width: whole.width, height: whole.height };
    // Names are as large on every screen; one that would cover another, or end outside, waits for a closer look.
    const labels = [...picture.querySelectorAll("text")];
    const legible = () => {
      const scale = picture.getScreenCTM()?.a;
      if (!scale) return;
      for (const label of labels) label.style.fontSize = `${LABEL / scale}px`;
      const frame = picture.getBoundingClientRect();
      const shown = [];
      for (const label of labels) {
        const box = label.getBoundingClientRect();
        const isFree = box.left >= frame.left && box.right <= frame.right && !shown.some((other) =>
          box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom);
        label.style.visibility = isFree ? "visible" : "hidden";
        if (isFree) shown.push(box);
      }
    };
    const view = (x, y, width, height) => {
      picture.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
      legible();
    };
    new ResizeObserver(legible).observe(picture);
    const zoom = (factor, [cx, cy] = [whole.x + whole.width / 2, whole.y + whole.height / 2]) => {
      const width = Math.min(all.width, Math.max(all.width / 40, whole.width * factor));
      const ratio = width / whole.width;
      view(cx - (cx - whole.x) * ratio, cy - (cy - whole.y) * ratio, width, whole.height * ratio);
    };
    const reset = () => view(all.x, all.y, all.width, all.height);
    const move = (dx, dy) => view(whole.x + dx, whole.y + dy, whole.width, whole.height);
    const actions = { in: () => zoom(1 / 1.5), out: () => zoom(1.5), all: () => { reset(); clear(); } };
    find(".tools").hidden = false;
    for (const button of document.querySelectorAll("[data-zoom]")) {
      button.addEventListener("click", () => actions[button.dataset.zoom]());
    }
    find(".hint").textContent = matchMedia("(pointer: coarse)").matches
      ? "tap a camera for its neighbours, + to zoom, then drag to move"
      : "drag to move, Ctrl and the wheel to zoom, click for the neighbours";
    const point = (event) => {
      const matrix = picture.getScreenCTM().inverse();
      const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
      return [x, y];
    };
    picture.addEventListener("wheel", (event) => {
      if (!event.ctrlKey) return;
      event.preventDefault();
      zoom(event.deltaY < 0 ? 1 / 1.2 : 1.2, point(event));
    }, { passive: false });
    let grip = null;
    picture.addEventListener("pointerdown", (event) => { grip = point(event); });
    picture.addEventListener("pointermove", (event) => {
      if (!grip || event.buttons === 0 || whole.width >= all.width) return;
      const [x, y] = point(event);
      move(grip[0] - x, grip[1] - y);
    });
    const order = [...drawn.keys()].sort((a, b) => a - b);
    picture.addEventListener("keydown", (event) => {
      const at = order.indexOf(selected);
      const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
      if (step !== undefined && order.length > 0) {
        const first = step > 0 ? 0 : order.length - 1;
        selectNode(order[at < 0 ? first : (at + step + order.length) % order.length]);
      } else if (event.key === "+" || event.key === "=") actions.in();
      else if (event.key === "-") actions.out();
      else if (event.key === "0") actions.all();
      else if (event.key === "Escape") clear();
      else return;
      event.preventDefault();
    });
  };

  const showLegend = () => {
    const legend = find("#legend");
    const listed = components.slice(0, drawing.marked);
    for (const component of listed) {
      legend.append(html("button", {
        type: "button",
        "data-component-size": `${component.index}`,
        on: { click: () => show(selectComponent, component.index) },
      }, glyph(component.index), sizeWords(component)));
    }
    const add = (symbol, count, words) => {
      if (count > 0) legend.append(html("span", {}, symbol, words));
    };
    const others = larger === 0 ? 0 : larger - listed.length;
    const pairs = components.length - alone - listed.length - others;
    add(glyph(drawing.marked), others, counted(others, "smaller component"));
    add(glyph(components.length), pairs, counted(pairs, `single ${edgeWord}`));
    add(hingeGlyph(), hinges.length, `${counted(hinges.length, "camera")} in several components`);
    add(emptyGlyph(), isolated.length, `${counted(isolated.length, "camera")} without ${edgeWord}s`);
    const lineGlyph = (stroke, dashes = "none") =>
      glyphOf([svg("path", { d: "M-7 0H7", stroke, "stroke-width": 2, "stroke-dasharray": dashes })]);
    const [short, suggested, contradicting] = drawing.others;
    add(lineGlyph("#5b6470", "4 2"), short, `${counted(short, "pair")} of images are matched, their tracks too short`);
    add(lineGlyph("#0b5cad", "1.5 2"), suggested, `${counted(suggested, "pair")} of images are suggested to be matched`);
    add(lineGlyph("#d1242f"), contradicting, `${counted(contradicting, "pair")} in contradictions: not all are right`);
  };

  // ---- Tables

  const collator = new Intl.Collator("en", { numeric: true });
  const compare = (a, b) => {
    const missing = (value) => value === null || value === undefined;
    if (missing(a) || missing(b)) return Number(missing(a)) - Number(missing(b));
    if (typeof a === "number" && typeof b === "number") return a - b;
    return collator.compare(String(a), String(b));
  };

  // A table that sorts and filters. A column has a `title`, `value(row)` to sort by, perhaps
  // `text(row)` to filter by, and `show(row)` for what stands in a cell.
  const table = (section, caption, columns, rows, extra = null) => {
    section.hidden = false;
    const key = section.id;
    let [sort, descending] = [state.get(`${key}.sort`), state.get(`${key}.order`) === "descending"];
    let filter = state.get(`${key}.filter`) ?? "";
    let limit = MOST_ROWS;
    const texts = rows.map((row) => columns
      .map((column) => String((column.text ?? column.value)(row) ?? ""))
      .join("\n").toLowerCase());
    const count = html("span", { class: "soft", role: "status" });
    const more = html("button", { type: "button", on: { click: () => { limit = Infinity; update(); } } });
    const field = html("input", {
      type: "search",
      value: filter,
      "aria-label": `Filter: ${caption}`,
      placeholder: "filter",
      on: { input: () => { filter = field.value; remember(`${key}.filter`, filter); update(); } },
    });
    const heads = columns.map((column) => {
      const number = column.number ? "number" : false;
      const press = () => {
        descending = sort === column.title ? !descending : Boolean(column.number);
        sort = column.title;
        remember(`${key}.sort`, sort);
        remember(`${key}.order`, descending ? "descending" : "ascending");
        update();
      };
      return html("th", { scope: "col", class: number },
        html("button", { type: "button", on: { click: press } }, column.title));
    });
    const body = html("tbody");
    const update = () => {
      const wanted = filter.trim().toLowerCase();
      let kept = rows.map((_, index) => index)
        .filter((index) => texts[index].includes(wanted) && (!extra || extra.keep(rows[index])));
      const column = columns.find((candidate) => candidate.title === sort);
      if (column) {
        const sign = descending ? -1 : 1;
        const values = rows.map(column.value);
        kept = kept.sort((a, b) => sign * compare(values[a], values[b]) || a - b);
      }
      columns.forEach((candidate, index) => {
        const order = descending ? "descending" : "ascending";
        if (candidate === column) heads[index].setAttribute("aria-sort", order);
        else heads[index].removeAttribute("aria-sort");
      });
      body.replaceChildren(...kept.slice(0, limit).map((index) => html("tr", {},
        columns.map((candidate) => html("td", { class: candidate.number ? "number" : false },
          candidate.show(rows[index]))))));
      count.textContent = kept.length === rows.length
        ? grouped(rows.length)
        : `${grouped(kept.length)} of ${grouped(rows.length)}`;
      count.dataset.rows = kept.length;
      more.hidden = kept.length <= limit;
      more.textContent = `Show all ${grouped(kept.length)}`;
    };
    section.append(
      html("div", { class: "controls" }, field, extra ? extra.control(() => update()) : null, count),
      html("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption },
        html("table", {}, html("caption", {}, caption), html("thead", {}, html("tr", {}, heads)), body)),
      more,
    );
    update();
    return { refilter: () => update() };
  };

  const componentButton = (index) => html("button", {
    type: "button",
    title: components[index] ? sizeWords(components[index]) : false,
    on: { click: () => show(selectComponent, index) },
  }, glyph(index), String(index + 1));
  const cameraButton = (node) => html("button", {
    type: "button",
    on: { click: () => show(selectNode, node) },
  }, names[node]);
  const separated = (elements) => elements.flatMap((element, k) => (k > 0 ? [", ", element] : [element]));

  const showComponents = () => {
    if (components.length === 0) return;
    const shared = components.map(() => 0);
    for (const node of hinges) for (const index of componentsOf[node]) shared[index] += 1;
    const sizes = tracks
      ? [["cameras", "cameras"], ["points", "points"], ["observations", "edges"]]
      : [["cameras", "nodes"], ["pairs", "edges"]];
    table(find("#components"),
      tracks
        ? "A component is a largest set of observations whose cameras and points are determined against each other. " +
          "Two components share one camera or one point at most; a camera of several is placed in each of them, " +
          "and nothing tells how large one is against the other."
        : "A component is a largest part that is determined by itself. Two components share one camera at most.",
      [
        { title: "component", number: true, value: (c) => c.index + 1, show: (c) => componentButton(c.index) },
        ...sizes.map(([title, member]) => ({
          title,
          number: true,
          value: (c) => c[member],
          show: (c) => grouped(c[member]),
        })),
        {
          title: "cameras shared with others",
          number: true,
          value: (c) => shared[c.index],
          show: (c) => grouped(shared[c.index]),
        },
      ], components);
  };

  const showCameras = () => {
    const section = find("#cameras");
    const choices = components.slice(0, SELECTABLE);
    let chosen = state.get("cameras.component") ?? "";
    const extra = {
      keep: (node) => chosen === "" ||
        (chosen === "several" && componentsOf[node].length > 1) ||
        (chosen === "none" && drawing.degrees[node] === 0) ||
        componentsOf[node].includes(Number(chosen) - 1),
      control: (update) => {
        const option = (value, words) => html("option", { value, selected: value === chosen }, words);
        const select = html("select", {
          "aria-label": "Show the cameras of",
          on: { change: () => { chosen = select.value; remember("cameras.component", chosen); update(); } },
        },
        option("", "all cameras"),
        hinges.length > 0 ? option("several", "in several components") : null,
        isolated.length > 0 ? option("none", `without ${edgeWord}s`) : null,
        choices.map((c) => option(String(c.index + 1), `component ${c.index + 1}: ${sizeWords(c)}`)));
        return select;
      },
    };
    table(section, "All cameras by the names of their images.", [
      { title: "image", value: (node) => names[node], show: cameraButton },
      {
        title: `${edgeWord}s`,
        number: true,
        value: (node) => drawing.degrees[node],
        text: () => "",
        show: (node) => grouped(drawing.degrees[node]),
      },
      {
        title: "components",
        value: (node) => componentsOf[node].length,
        text: () => "",
        show: (node) => {
          const shown = componentsOf[node].slice(0, 30);
          const rest = componentsOf[node].length - shown.length;
          const listed = separated(shown.map(componentButton));
          if (rest > 0) listed.push(`, and ${grouped(rest)} more`);
          return listed.length > 0 ? listed : ["none"];
        },
      },
    ], names.map((_, node) => node), extra);
  };

  // ---- Parts that a report may have

  const words = (value) => {
    if (value === null || value === undefined) return "";
    if (typeof value === "number") return grouped(value);
    if (typeof value === "boolean") return value ? "yes" : "no";
    if (Array.isArray(value)) return value.map(words).join(", ");
    if (typeof value === "object") {
      return Object.entries(value).map(([name, inner]) => `${named(name)} ${words(inner)}`).join("; ");
    }
    return String(value);
  };
  const HEADS = {
    between: "components",
    how: "how they touch",
    images: "images",
    through: "by way of",
    crossing: "pairs and paths across",
    freedom: "free",
    meaning: "what is free",
    joins: "joins components",
    single_pairs: "single pairs",
    gain: "images gained",
    min_inliers: "least number of inliers",
    min_views: "least number of views",
    images_without_pair: "images without pairs",
    pairs_used: "pairs used",
    pairs_inside: "pairs within components",
    pairs_outside: "pairs in no larger component",
    unused: "pairs that were not used",
    reaches: "leads to components",
    configs: "kinds of two-view geometry",
    cameras_without_point: "cameras that see no track",
    inconsistent: "inconsistent tracks",
    short: "tracks that are too short",
    rank_required: "rank of a solvable graph",
    shared_images: "images in several components",
    outside: "images in none",
  };
  const named = (name) => HEADS[name] ?? name.replaceAll("_", " ");
  // What a member says, in words.
  const told = (member, value) => {
    if (member === "strength" || member === "verdict") return VALUES[value] ?? words(value);
    // COLMAP writes 4.2.1 as 4020100.
    if (member === "version") return value < 1e6 ? String(value) : [1e6, 1e4, 100].map((one) => Math.floor(value / one) % 100).join(".");
    const isList = Array.isArray(value) && value.every(Array.isArray);
    if (isList) return value.map((images) => images.join(" – ")).join(", ");
    return words(value);
  };
  const VALUES = {
    proof: "proved",
    "error-bound": "with an error bound",
  };
  const isEmpty = (value) =>
    value === null || value === undefined || (Array.isArray(value) && value.every(isEmpty));
  const objectsTable = (section, caption, list) => {
    const members = [...new Set(list.flatMap((item) => Object.keys(item)))]
      .filter((member) => !list.every((item) => isEmpty(item[member])));
    table(section, caption, members.map((member) => ({
      title: named(member),
      number: list.every((item) => typeof (item[member] ?? 0) === "number"),
      value: (item) => (typeof item[member] === "number" ? item[member] : told(member, item[member])),
      show: (item) => told(member, item[member]),
    })), list);
  };
  const isObject = (value) => value !== null && typeof value === "object" && !Array.isArray(value);
  const isTable = (value) => Array.isArray(value) && value.length > 0 && value.every(isObject);
  // Any value of the report, under a heading of its own.
  const part = (id, title, value, level = 2) => {
    const section = html("section", { id }, html(`h${level}`, {}, title));
    if (isTable(value)) {
      objectsTable(section, title, value);
    } else if (isObject(value)) {
      const plain = Object.entries(value).filter(([, inner]) => !isTable(inner) && !isEmpty(inner));
      section.append(html("dl", { class: "pairs" }, plain.flatMap(([name, inner]) =>
        [html("dt", {}, named(name)), html("dd", {}, told(name, inner))])));
      for (const [name, inner] of Object.entries(value)) {
        if (isTable(inner)) section.append(part(`${id}-${name}`, named(name), inner, 3));
      }
    } else {
      section.append(html("p", {}, words(value)));
    }
    return section;
  };

  const JOINTS = "Where components touch, and what is left free between them.";
  const showJoints = () => {
    const section = find("#joints");
    if (isTable(report.joints)) {
      objectsTable(section, report.joints_complete === false
        ? `${JOINTS} These are the ones of the largest components.` : JOINTS, report.joints);
    } else if (!("joints" in report) && hinges.length > 0) {
      section.querySelector("h2").textContent = "Cameras in several components";
      table(section, "Here components touch: they share this camera and nothing else of it.", [
        { title: "image", value: (node) => names[node], show: cameraButton },
        {
          title: "components",
          value: (node) => componentsOf[node].length,
          text: () => "",
          show: (node) => separated(componentsOf[node].slice(0, 30).map(componentButton)),
        },
      ], hinges);
    }
  };

  const SHOWN = new Set(["program", "because", "graph", "read", "notes", "model", "verdict", "strength", "error_log2", "rank",
    "rank_required", "rank_strength", "components", "components_strength", "mode", "seconds", "joints",
    "joints_complete", "solutions"]);
  const TITLES = {
    conditions: "Conditions",
    database: "Database",
    intrinsics: "Intrinsics",
    planar: "If all centres lie in one plane",
    tracks: "Tracks",
    suggestions: "What would join components",
    parts: "Known parts",
  };
  // Which intrinsics are determined: over the picture pairs in the colours of their metric components, grey
  // if they are in none, and a ring round each camera, dashed if its intrinsics are not determined.
  const METRIC = {
    metric: "All cameras and intrinsics are determined, up to similarities and finitely many choices (proved).",
    "not-metric": "Not metric: infinitely many sets of cameras and intrinsics (proved).",
    open: "Not metric at drawn cameras; counting gives no proof.",
  };
  const RINGS = { true: "#228833", false: "#cc3311" };
  const intrinsicsPart = (id, found) => {
    const section = html("section", { id }, html("h2", {}, TITLES.intrinsics));
    const metric = drawing.metric ?? [];
    const partsOf = names.map(() => []);
    metric.forEach((nodes, k) => nodes.forEach((node) => partsOf[node].push(k)));
    const colour = (k) => (k === undefined ? "#8a929c" : drawing.colours[k % drawing.colours.length]);
    const paths = new Map();
    for (let k = 0; k < (drawing.edges?.length ?? 0); k += 2) {
      const [i, j] = [drawing.edges[k], drawing.edges[k + 1]];
      // Two components have one camera in common at most.
      const part = partsOf[i].find((one) => partsOf[j].includes(one));
      const [[x, y], [a, b]] = [i, j].map((node) => place(drawn.get(node)));
      paths.set(part, `${paths.get(part) ?? ""}M${x} ${y}L${a} ${b}`);
    }
    const lines = svg("g", { class: "metric", "aria-hidden": "true", fill: "none", "stroke-width": 2.5 });
    for (const [part, d] of paths) {
      lines.append(svg("path", { d, stroke: colour(part), "data-metric": part === undefined ? "none" : part + 1 }));
    }
    const first = picture.querySelector("[data-node]");
    if (first) first.parentNode.insertBefore(lines, first);
    const open = new Set(found.not_determined.map((name) => nodeOf.get(name)));
    const rings = svg("g", { class: "rings", "aria-hidden": "true", fill: "none", "stroke-width": 2 });
    for (const [node, element] of drawn) {
      const [cx, cy] = place(element);
      const determined = !open.has(node);
      rings.append(svg("circle", {
        cx, cy, r: 9, stroke: RINGS[determined], "stroke-dasharray": determined ? "none" : "3 2", "data-determined": String(determined),
      }));
    }
    picture.insertBefore(rings, overlay);
    const of = found.classes.filter((line) => line.cameras > 0).map((line) => `${grouped(line.cameras)} ${line.class}`).join(", ");
    section.append(
      html("p", { "data-metric-verdict": found.verdict }, METRIC[found.verdict]),
      html("p", {}, `Cameras: ${of}. Rank ${grouped(found.rank)} of ${grouped(found.rank_required)}${
        found.proved ? " (proved)" : `, ${grouped(found.rank_at_most)} at most`}. ` +
        `The intrinsics of ${grouped(found.determined)} of ${grouped(names.length)} cameras are known or determined: ` +
        "these have a green ring in the picture, the others a dashed red one."),
    );
    if (metric.length > 0) {
      table(section, `Metric components, whose pairs have these colours in the picture; ${
        counted(found.other_pairs, "pair")} in none ${found.other_pairs === 1 ? "is" : "are"} grey.`, [
        {
          title: "metric component",
          number: true,
          value: (k) => k,
          show: (k) => html("span", { style: `border-left: .6em solid ${colour(k)}; padding-left: .4em` }, `${k + 1}`),
        },
        { title: "cameras", number: true, value: (k) => found.components[k].nodes, show: (k) => grouped(found.components[k].nodes) },
        { title: "pairs", number: true, value: (k) => found.components[k].edges, show: (k) => grouped(found.components[k].edges) },
      ], metric.map((_, k) => k));
    }
    if (open.size > 0) {
      table(section, "Cameras whose intrinsics are not determined.", [
        { title: "image", value: (node) => names[node], show: cameraButton },
      ], [...open]);
    }
    return section;
  };
  const partOf = (name, value) => {
    const id = `part-${name}`;
    if (name === "intrinsics" && Array.isArray(value.classes)) return intrinsicsPart(id, value);
    return part(id, TITLES[name] ?? named(name), value);
  };
  const showFurther = () => {
    for (const [name, value] of Object.entries(report)) {
      const empty = value === null || (Array.isArray(value) && value.length === 0);
      if (!SHOWN.has(name) && !empty) find("#further").append(partOf(name, value));
    }
  };

  const showFooter = () => {
    find("footer").append(
      html("p", {}, "All this is about generic cameras: what the graph determines if every " +
        `${edgeWord} is right. Wrong ${edgeWord}s are not detected.`),
      html("p", {}, `Written by viewcert ${drawing.version}. The numbers are those of `,
        html("code", {}, "verify --json --components"), "; they stand in this file as JSON."),
    );
  };

  const steps = [showVerdict, showFacts, setUpPicture, showLegend, showComponents,
    showJoints, showCameras, showFurther, showFooter];
  // One part that fails must not take the others with it.
  for (const step of steps) {
    try {
      step();
    } catch (error) {
      find("#failure").hidden = false;
      console.error(error);
    }
  }
})();
