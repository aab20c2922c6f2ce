"use strict";
(() => {
  const content = JSON.parse(document.getElementById("content").textContent);
  const { records, structures } = content;
  const at = (id) => document.getElementById(id);

  // Numbers ---------------------------------------------------------------------------------------------
  function unpacked(packed) {
    if (!packed.values) {
      const bytes = Uint8Array.from(atob(packed.data), (c) => c.charCodeAt(0));
      const view = new DataView(bytes.buffer);
      packed.values = Float64Array.from({ length: bytes.length / 2 }, (_, k) => view.getInt16(2 * k, true) * packed.scale);
    }
    return packed.values;
  }
  // Value of a trace of equal stretches at a time; 0 outside
  function valueAt(trace, time) {
    const values = unpacked(trace);
    const [begin, end] = trace.span;
    const place = ((time - begin) / (end - begin)) * values.length - 0.5;
    if (place < -0.5 || place > values.length - 0.5) return 0;
    const low = Math.max(0, Math.min(values.length - 2, Math.floor(place)));
    const share = Math.max(0, Math.min(1, place - low));
    return values[low] * (1 - share) + values[low + 1] * share;
  }

  // Matrix ----------------------------------------------------------------------------------------------
  const matrix = at("matrix");
  const LONG = 24; // letters from which on a name has a wider column
  const SHOWN = "button:not([hidden])";
  const caseOf = (record, structure) => record.cases[structure.name];
  const verdictOf = (each) => content.verdicts[each.cell[0]];

  // A new last child of `parent`, of its namespace: HTML or SVG
  function add(parent, name, attributes = {}, text = "") {
    const child = document.createElementNS(parent.namespaceURI, name);
    Object.entries(attributes).forEach(([key, value]) => child.setAttribute(key, value));
    child.textContent = text;
    parent.append(child);
    return child;
  }

  // The longer side lies down the page, where there is room: a row for each record, or for each structure.
  const turned = structures.length > records.length;
  const [ROWS, COLUMNS] = turned ? [structures, records] : [records, structures];
  const LEAD = turned ? 1 : 3; // cells of a row before the first case
  const nameOf = (each) => each.id || each.name;
  const placesOf = (row, column) => (turned ? [column, row] : [row, column]); // of record and structure
  const caseAt = (row, column) => {
    const [r, s] = placesOf(row, column);
    return caseOf(records[r], structures[s]);
  };

  // Positive where the key `b` is larger: the first value that differs decides
  function compared(a, b) {
    const place = a.findIndex((value, k) => value !== b[k]);
    return place < 0 ? 0 : b[place] - a[place];
  }
  // The order by what is worst is that of all documents: each record and structure states its place
  const columnOrder = COLUMNS.map((_, c) => c).sort((a, b) => COLUMNS[a].rank - COLUMNS[b].rank);

  // What the rows may be ordered by, the largest on top
  const KEYS = {
    worst: (each) => [-each.rank],
    name: (_, r) => [-r],
    pga: (record) => [record.pga],
    pgv: (record) => [record.pgv],
  };
  COLUMNS.forEach((each, c) => { KEYS[nameOf(each) + "/"] = (_, r) => caseAt(r, c).severity; });

  function order(by) {
    const keys = ROWS.map(KEYS[by]);
    const rows = [...matrix.tBodies[0].rows].sort((a, b) => compared(keys[a.dataset.row], keys[b.dataset.row]));
    matrix.tBodies[0].append(...rows);
    for (const head of matrix.tHead.rows[0].cells) {
      if (head.dataset.by === by) head.setAttribute("aria-sort", by === "name" ? "ascending" : "descending");
      else head.removeAttribute("aria-sort");
    }
  }

  const rounded = (peak) => (peak === null ? "–" : Number(peak.toPrecision(2)));
  // A name may part behind its marks, not within a word.
  const parted = (cell, name) => name.split(/(?<=[_.-])/).forEach((piece) => { cell.append(piece); add(cell, "wbr"); });

  function fill() {
    const head = add(add(matrix, "thead"), "tr");
    const body = add(matrix, "tbody");
    const heading = (by, text, title) => {
      const cell = add(head, "th", { scope: "col", title, "data-by": by });
      cell.classList.toggle("long", text.length > LONG);
      parted(add(cell, "button", { type: "button" }), text);
      return cell;
    };
    heading("name", turned ? "Structure" : "Record", turned ? "order of the list" : "order of the catalogue");
    if (!turned) {
      heading("pga", "PGA [g]", "order by peak acceleration");
      heading("pgv", "PGV [m/s]", "order by peak velocity");
    }
    columnOrder.forEach((c) => {
      const each = COLUMNS[c];
      const cell = heading(nameOf(each) + "/", nameOf(each), turned ? "order by this record" : `${each.type}: ${each.size}`);
      if (turned) add(cell, "div", { class: "peak" }, `${rounded(each.pga)} g`);
    });
    ROWS.forEach((each, r) => {
      const row = add(body, "tr", { "data-row": r });
      const name = add(row, "th", { scope: "row" });
      if (turned) name.title = `${each.type}: ${each.size}`;
      parted(name, nameOf(each));
      if (!turned) [each.pga, each.pgv].forEach((peak) => add(row, "td", { class: "peak" }, rounded(peak)));
      columnOrder.forEach((c) => {
        const [record, structure] = placesOf(r, c);
        const { cell } = caseAt(r, c);
        const verdict = verdictOf(caseAt(r, c));
        const [sign, ...share] = cell.replace("\u00a0%", "").split(" ");
        const told = [verdict, ...(share.length ? [`${share.join(" ")} %`] : [])].join(", ");
        const title = `${structures[structure].name} under ${records[record].id}: ${told}`;
        const names = { title, "aria-label": title, "data-record": record, "data-structure": structure, "data-verdict": verdict };
        const button = add(add(row, "td"), "button", { type: "button", class: `cell ${verdict.replaceAll(" ", "-")}`, tabindex: -1, "aria-pressed": false, ...names }, sign);
        if (share.length) add(button, "span", { class: "share" }, ` ${share.join(" ")}`);
      });
    });
    matrix.classList.toggle("by-record", !turned);
    order("worst");
  }

  function filter() {
    const text = at("text").value.trim().toLowerCase();
    const verdict = at("verdict").value;
    const matches = (name) => name.toLowerCase().includes(text);
    for (const button of matrix.querySelectorAll("tbody button")) {
      const { record, structure } = button.dataset;
      const match = matches(records[record].id) || matches(structures[structure].name);
      button.hidden = !match || (verdict && button.dataset.verdict !== verdict);
    }
    for (const row of matrix.tBodies[0].rows) row.hidden = !row.querySelector(SHOWN);
    COLUMNS.forEach((_, place) => {
      const cells = [...matrix.rows].map((row) => row.cells[LEAD + place]);
      const hides = !cells.some((cell) => cell.querySelector(`tbody ${SHOWN}`));
      cells.forEach((cell) => { cell.hidden = hides; });
    });
    const cells = matrix.querySelectorAll(`tbody ${SHOWN}`);
    at("shown").textContent = `${cells.length} of ${records.length * structures.length} cells`;
    if (cells.length && !matrix.querySelector(`${SHOWN}[tabindex="0"]`)) roam(cells[0]);
    fit();
  }

  // Where the page is too narrow for all columns, their names stand upright; then the signs stand alone.
  function fit() {
    matrix.classList.remove("upright", "signs");
    for (const look of ["upright", "signs"])
      if (matrix.offsetWidth > matrix.parentElement.clientWidth) matrix.classList.add(look);
    beyond();
  }

  // Columns and rows that the page hides even so are told of
  function beyond() {
    const { left, right, bottom } = matrix.parentElement.getBoundingClientRect();
    const first = matrix.querySelector("tbody tr:not([hidden]) th");
    const from = first ? first.getBoundingClientRect().right : left;
    const heads = [...matrix.tHead.rows[0].cells].slice(LEAD).filter((head) => !head.hidden);
    const count = (hides) => heads.filter((head) => hides(head.getBoundingClientRect())).length;
    const sides = [
      [count((box) => box.left < from - 1), "← ", " to the left"],
      [count((box) => box.right > right + 1), "", " to the right →"],
    ];
    const what = turned ? ["records", "structures"] : ["structures", "records"];
    const told = sides.filter(([number]) => number).map(([number, before, after]) => `${before}${number} of ${heads.length} ${what[0]}${after}`);
    const rows = [...matrix.tBodies[0].rows].filter((row) => !row.hidden);
    const below = rows.filter((row) => row.getBoundingClientRect().bottom > bottom + 1).length;
    if (below) told.push(`${below} of ${rows.length} ${what[1]} below ↓`);
    at("beyond").textContent = told.join("; ");
  }

  // One cell is in the order of the tabulator; arrows go on to the next one that is shown
  function roam(button) {
    matrix.querySelectorAll("tbody [tabindex='0']").forEach((each) => { each.tabIndex = -1; });
    button.tabIndex = 0;
  }

  function onArrow(event) {
    const inRow = (cell, row) => row && row.cells[cell.cellIndex];
    const step = {
      ArrowLeft: (cell) => cell.previousElementSibling,
      ArrowRight: (cell) => cell.nextElementSibling,
      ArrowUp: (cell) => inRow(cell, cell.parentElement.previousElementSibling),
      ArrowDown: (cell) => inRow(cell, cell.parentElement.nextElementSibling),
    }[event.key];
    let cell = event.target.closest("tbody td");
    if (!step || !cell) return;
    event.preventDefault();
    do { cell = step(cell); } while (cell && !cell.querySelector(SHOWN));
    if (!cell) return;
    roam(cell.firstChild);
    cell.firstChild.focus();
  }

  // Histories -------------------------------------------------------------------------------------------
  const [LEFT, RIGHT] = [72, 610];
  const PANELS = [{ top: 20, bottom: 122 }, { top: 160, bottom: 262 }];

  const REACH = 1.25; // rotation ratio at either edge of a strip, as on page two of a report

  function ticks(low, high, number) {
    const raw = (high - low) / number;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find((each) => each * power >= raw);
    const first = Math.ceil(low / step);
    const count = Math.floor(high / step + 1e-9) - first + 1;
    return Array.from({ length: count }, (_, k) => Number(((first + k) * step).toPrecision(6)));
  }

  const scale = ({ top, bottom }, span, reach) => ({
    x: (time) => LEFT + ((time - span[0]) / (span[1] - span[0])) * (RIGHT - LEFT),
    y: (value) => (top + bottom) / 2 - (value / reach) * ((bottom - top) / 2),
  });

  // The axes of a panel: levels at which it has lines, times below it; returns where a time and a value stand
  function panel(svg, place, span, reach, levels, label, times = ticks(span[0], span[1], 8)) {
    const { top, bottom } = place;
    const { x, y } = scale(place, span, reach);
    add(svg, "rect", { x: LEFT, y: top, width: RIGHT - LEFT, height: bottom - top, fill: "none", stroke: "var(--axis)" });
    levels.forEach((value) => {
      add(svg, "line", { x1: LEFT, x2: RIGHT, y1: y(value), y2: y(value), stroke: value === 0 ? "var(--zero)" : "var(--grid)" });
      add(svg, "text", { x: LEFT - 6, y: y(value) + 4, "text-anchor": "end" }, String(value).replace("-", "−"));
    });
    times.forEach((value) => {
      add(svg, "line", { x1: x(value), x2: x(value), y1: bottom, y2: bottom + 4, stroke: "var(--axis)" });
      add(svg, "text", { x: x(value), y: bottom + 17, "text-anchor": "middle" }, String(value));
    });
    if (label) add(svg, "text", { transform: `translate(16 ${(top + bottom) / 2}) rotate(-90)`, "text-anchor": "middle" }, label);
    return { x, y };
  }

  // Times and values of a trace within a span
  function pointsOf(trace, span) {
    const [begin, end] = trace.span;
    return [...unpacked(trace)]
      .map((value, k, { length }) => [begin + ((k + 0.5) / length) * (end - begin), value])
      .filter(([time]) => time >= span[0] && time <= span[1]);
  }

  const drawLine = (svg, points, { x, y }, attributes) =>
    add(svg, "polyline", { points: points.map(([time, value]) => `${x(time).toFixed(1)},${y(value).toFixed(1)}`).join(" "), fill: "none", ...attributes });

  const largest = (trace) => (trace ? unpacked(trace).reduce((most, value) => Math.max(most, Math.abs(value)), 0) : 0);

  function ground(svg, motion, span, place, label, times) {
    const reach = 1.1 * Math.max(largest(motion.acceleration), largest(motion.pulse)) || 1;
    const axes = panel(svg, place, span, reach, ticks(-reach, reach, label ? 5 : 2), label, times);
    drawLine(svg, pointsOf(motion.acceleration, span), axes, { stroke: "var(--record)", "stroke-width": 0.8 });
    if (motion.pulse) drawLine(svg, pointsOf(motion.pulse, span), axes, { stroke: "var(--pulse)", "stroke-width": 2 });
    return axes;
  }

  // What the history of a case says of it: its band, the paper's lines, the history to its fall or to rest
  function strip(svg, each, span, place, label, times) {
    const sides = each.one_sided ? [1] : [1, -1];
    const clipped = (value) => Math.max(-REACH, Math.min(REACH, value));
    const { y } = scale(place, span, REACH);
    if (each.predicted > 0) {
      const low = each.one_sided ? 0 : clipped(-each.predicted);
      const high = clipped(each.predicted);
      add(svg, "rect", { x: LEFT, y: y(high), width: RIGHT - LEFT, height: y(low) - y(high), fill: "var(--band)", class: "band" });
    }
    const axes = panel(svg, place, span, REACH, [-1, 0, 1], label, times);
    const level = (value, attributes) =>
      sides.forEach((side) => {
        if (value > 0 && value <= REACH) drawLine(svg, span.map((time) => [time, side * value]), axes, attributes);
      });
    level(each.predicted, { stroke: "var(--closed)", "stroke-width": 1.4 });
    level(each.printed, { stroke: each.outside ? "var(--faint)" : "var(--ink)", "stroke-width": 1.6, "stroke-dasharray": "1.6 4", class: "printed" });
    if (!each.history) return axes;
    const falls = each.numbers[2] === "falls";
    const points = pointsOf(each.history, span);
    const beyond = falls ? points.findIndex(([, value]) => Math.abs(value) >= REACH) : -1;
    const shown = beyond < 0 ? points : points.slice(0, beyond + 1);
    if (!falls && each.history.span[1] < span[1]) shown.push([each.history.span[1], 0], [span[1], 0]);
    const line = shown.map(([time, value]) => [time, clipped(value)]);
    drawLine(svg, line, axes, { stroke: "var(--ink)", "stroke-width": 1.2, ...(label ? { id: "rotation" } : {}) });
    if (falls && line.length) {
      const [x, edge] = [axes.x(line.at(-1)[0]), axes.y(line.at(-1)[1])];
      const tip = line.at(-1)[1] > 0 ? 12 : -12;
      add(svg, "polygon", { points: `${x - 6},${edge + tip} ${x + 6},${edge + tip} ${x},${edge}`, fill: "var(--ink)", class: "falls" });
    }
    return axes;
  }

  // What stands beside page two's strip of a case, above its panel here
  const HEADS = content.against.heads;
  const LOOKS = (each) => [each.outside ? "outside" : "paper", "form", "whole"];

  function beside(each) {
    const y = PANELS[1].top - 6;
    if (!each.numbers) return;
    add(at("histories"), "text", { x: LEFT, y }, each.beside[0]);
    const told = add(at("histories"), "text", { x: RIGHT, y, "text-anchor": "end" });
    each.numbers.forEach((number, k) => add(told, "tspan", { class: LOOKS(each)[k] }, `${k ? "   " : ""}${HEADS[k][0]} ${number}`));
  }

  // Ground and rotation against time; returns what moves the cursor
  function histories(each, motion, span) {
    const svg = at("histories");
    svg.replaceChildren();
    if (motion) {
      ground(svg, motion, span, PANELS[0], "accel. [m/s²]");
      const told = add(svg, "text", { x: RIGHT, y: PANELS[0].top - 6, "text-anchor": "end" }, `record: ${motion.facts[0]}   `);
      add(told, "tspan", { class: "sine" }, motion.facts.slice(1).join(" "));
    }
    const axes = strip(svg, each, span, PANELS[1], "rotation ratio [-]");
    beside(each);
    add(svg, "text", { x: (LEFT + RIGHT) / 2, y: 292, "text-anchor": "middle" }, "time after the first sample [s]");
    const cursor = add(svg, "line", { y1: PANELS[0].top, y2: PANELS[1].bottom, stroke: "var(--mark)", "stroke-width": 1.5, id: "cursor" });
    return (time) => { cursor.setAttribute("x1", axes.x(time)); cursor.setAttribute("x2", axes.x(time)); };
  }

  // Page two of a record: every structure that moves, the worst first, and those at rest
  function strips(record) {
    const [head, body] = at("strips").children;
    head.textContent = `${content.against.title}: all structures under ${record.id}`;
    body.replaceChildren();
    if (!at("strips").open || !record.span.length) return;
    const moving = structures
      .map((structure) => [structure, caseOf(record, structure)])
      .filter(([, each]) => each.numbers)
      .sort(([, a], [, b]) => compared(a.severity, b.severity));
    const used = new Set(moving.map(([, each]) => each.component));
    const table = add(body, "table");
    const heads = add(add(table, "thead"), "tr");
    const rows = add(table, "tbody");
    ["", "rotation over critical rotation"].forEach((text) => add(heads, "th", {}, text));
    HEADS.forEach(([name, below], k) => {
      const cell = add(heads, "th", { scope: "col", class: ["", "form", ""][k] }, name);
      add(cell, "div", {}, below);
    });
    const row = (name, lines, height) => {
      const tr = add(rows, "tr");
      const cell = add(tr, "th", { scope: "row" });
      add(cell, "b", {}, name);
      lines.filter(Boolean).forEach((line) => add(cell, "div", {}, line));
      const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
      svg.setAttribute("viewBox", `0 0 620 ${height}`);
      add(tr, "td").append(svg);
      return [tr, svg];
    };
    const place = { top: 3, bottom: 63 };
    Object.entries(record.motions).filter(([name]) => used.has(name) || !used.size).forEach(([name, motion]) => {
      const [tr, svg] = row(name, motion.facts, 66);
      ground(svg, motion, record.span, place, "", []);
      tr.querySelectorAll("th div:nth-of-type(n + 2)").forEach((each) => each.classList.add("sine"));
      add(tr, "td", { colspan: 3 });
    });
    moving.forEach(([structure, each], k) => {
      const isLast = k === moving.length - 1;
      const [tr, svg] = row(structure.name, [structure.below, ...each.beside], isLast ? 86 : 66);
      strip(svg, each, record.span, place, "", isLast ? undefined : []);
      each.numbers.forEach((number, column) => add(tr, "td", { class: LOOKS(each)[column] }, number));
    });
    if (record.at_rest) add(body, "p", {}, record.at_rest);
  }

  // Map -------------------------------------------------------------------------------------------------
  const DEGREE = 111.195; // length of a degree of a great circle, km
  const FEW = 40; // stations up to which their circles are large
  const turn = (degrees) => ((((degrees + 180) % 360) + 360) % 360) - 180;

  // The stations of the earthquake of a record, coloured by one structure, on a plane in km
  function map(record, structure) {
    const [head, svg] = at("map").children;
    const here = records.filter((each) => each.place && each.event === record.event);
    at("map").hidden = !here.length;
    head.textContent = `Map: ${structure.name} at ${here.length} station${here.length === 1 ? "" : "s"}${record.event ? ` of ${record.event}` : ""}`;
    svg.replaceChildren();
    if (!at("map").open || !here.length) return;
    const began = here.filter((each) => each.epicentre).map((each) => each.epicentre);
    const all = [...here.map((each) => each.place), ...began];
    const middle = (values) => (Math.min(...values) + Math.max(...values)) / 2;
    const [first] = all[0];
    const origin = [first + middle(all.map(([east]) => turn(east - first))), middle(all.map(([, north]) => north))];
    const plane = ([east, north]) => [turn(east - origin[0]) * DEGREE * Math.cos((origin[1] * Math.PI) / 180), (north - origin[1]) * DEGREE];
    const places = all.map(plane);
    const frame = { left: 60, right: 890, top: 10, bottom: 470 };
    const [wide, high] = [frame.right - frame.left, frame.bottom - frame.top];
    const reach = (k) => Math.max(1, ...places.map((each) => Math.abs(each[k])));
    const size = Math.min((0.42 * wide) / reach(0), (0.42 * high) / reach(1)); // of a km
    const x = (east) => (frame.left + frame.right) / 2 + size * east;
    const y = (north) => (frame.top + frame.bottom) / 2 - size * north;
    add(svg, "rect", { x: frame.left, y: frame.top, width: wide, height: high, fill: "none", stroke: "var(--axis)" });
    const step = ticks(0, high / size, 5)[1];
    const marks = (length) => ticks(-length / size / 2, length / size / 2, Math.ceil(length / size / step) + 1).filter((value) => Math.abs(value) < length / size / 2);
    marks(wide).forEach((value) => {
      add(svg, "line", { x1: x(value), x2: x(value), y1: frame.top, y2: frame.bottom, stroke: "var(--grid)" });
      add(svg, "text", { x: x(value), y: frame.bottom + 16, "text-anchor": "middle" }, String(value));
    });
    marks(high).forEach((value) => {
      add(svg, "line", { x1: frame.left, x2: frame.right, y1: y(value), y2: y(value), stroke: "var(--grid)" });
      add(svg, "text", { x: frame.left - 6, y: y(value) + 4, "text-anchor": "end" }, String(value).replace("-", "−"));
    });
    const side = (value, names) => `${Math.abs(value).toFixed(2)}° ${names[value < 0 ? 1 : 0]}`;
    const label = `km east and north of ${side(origin[1], "NS")}, ${side(turn(origin[0]), "EW")}`;
    add(svg, "text", { x: (frame.left + frame.right) / 2, y: frame.bottom + 36, "text-anchor": "middle" }, label);
    // The worst on top, and the names of those that have room, the worst first
    const ordered = [...here].sort((a, b) => compared(caseOf(b, structure).severity, caseOf(a, structure).severity));
    const labels = [];
    ordered.forEach((each) => {
      const [east, north] = plane(each.place);
      const { cell, text } = caseOf(each, structure);
      const look = `${verdictOf(caseOf(each, structure)).replaceAll(" ", "-")}${each === record ? " chosen" : ""}`;
      const circle = add(svg, "circle", { cx: x(east), cy: y(north), r: here.length > FEW ? 5 : 8, class: look, "data-record": records.indexOf(each) });
      add(circle, "title", {}, `${each.id} ${each.station}: ${text}`);
      labels.unshift([x(east) + 11, y(north) + 4, `${each.id} ${cell}`]);
    });
    const taken = [];
    labels.forEach(([left, foot, text]) => {
      const box = [left, left + 7.5 * text.length, foot];
      if (taken.some(([from, to, base]) => box[0] < to && box[1] > from && Math.abs(foot - base) < 14)) return;
      taken.push(box);
      add(svg, "text", { x: left, y: foot }, text);
    });
    began.map(plane).forEach(([east, north]) => add(svg, "text", { x: x(east), y: y(north) + 8, "text-anchor": "middle", class: "epicentre" }, "☆"));
  }

  // Mechanism -------------------------------------------------------------------------------------------
  // The frame at a rotation: between two of its side, no farther than the last
  function frameAt(frames, rotation) {
    const own = frames.filter((each) => each.rotation < 0 === rotation < 0);
    const side = own.length ? own : frames;
    const size = Math.abs(rotation);
    const above = side.findIndex((each) => Math.abs(each.rotation) >= size);
    if (above <= 0) return above === 0 ? side[0] : side[side.length - 1];
    const [a, b] = [side[above - 1], side[above]];
    const [before, after] = [unpacked(a.points), unpacked(b.points)];
    if (before.length !== after.length) return a;
    const share = (size - Math.abs(a.rotation)) / (Math.abs(b.rotation) - Math.abs(a.rotation));
    return { ...a, points: { values: before.map((value, k) => value * (1 - share) + after[k] * share) } };
  }

  // Metres in the drawing, whose groups turn y upwards and move with the ground
  function paintWith(frames, motion, reach) {
    const travel = motion ? largest(motion.displacement) : 0;
    const near = frames.filter((each) => Math.abs(each.rotation) <= reach || Math.abs(each.rotation) < 1e-3);
    const [left, right, low, high] = [0, 1].flatMap((axis) => {
      const values = near.flatMap((each) => [...unpacked(each.points).filter((_, k) => k % 2 === axis)]);
      return [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))];
    });
    const margin = 0.06 * Math.max(right - left, high - low);
    const wide = right - left + 2 * (travel + margin);
    at("mechanism").setAttribute("viewBox", `${(left + right - wide) / 2} ${-high - margin} ${wide} ${high - low + 2 * margin}`);
    const rest = frames.reduce((a, b) => (Math.abs(a.rotation) <= Math.abs(b.rotation) ? a : b));
    const bodies = unpacked(rest.points).subarray(0, 2 * rest.parts.reduce((sum, count) => sum + count, 0));
    const foot = bodies.reduce((least, value, k) => (k % 2 ? Math.min(least, value) : least), Infinity);
    const ground = { x1: left - 9 * wide, x2: right + 9 * wide };
    return (rotation, time) => {
      const { parts, hinges, marks, points } = frameAt(frames, rotation);
      let from = 0;
      const take = (count) => unpacked(points).subarray(from, from += 2 * count);
      const group = at("moving");
      group.replaceChildren();
      group.setAttribute("transform", `translate(${motion ? valueAt(motion.displacement, time) : 0} 0) scale(1 -1)`);
      add(group, "line", { ...ground, y1: foot, y2: foot });
      add(group, "line", { ...ground, y1: foot - margin / 4, y2: foot - margin / 4, "stroke-width": margin / 2, "stroke-dasharray": margin / 5, class: "ground" });
      for (const count of parts) add(group, "polygon", { points: take(count).join(" ") });
      for (let k = 0; k < hinges; k += 1) {
        const [cx, cy] = take(1);
        add(group, "circle", { cx, cy, r: margin / 5 });
      }
      for (const kind of marks) {
        const [x1, y1, x2, y2] = take(2);
        add(group, "line", { x1, y1, x2, y2, class: kind });
        add(group, "circle", { cx: x2, cy: y2, r: margin / 6, class: kind });
      }
    };
  }

  // One case --------------------------------------------------------------------------------------------
  let show = () => {};
  let playing = 0;
  let shown = null;

  // What the file of a record says of it beyond its cells; nothing where it is not there, as in a copy of the page alone
  let wanted = null;
  window.rockingRecord = (whole) => Object.assign(records.find(({ id }) => id === whole.id), whole);
  function load(record) {
    return new Promise((done) => {
      const script = add(document.head, "script", { src: `../${encodeURIComponent(record.id)}/RECORD_SCRIPT` });
      script.onload = done;
      script.onerror = () => {
        const lost = `The folder ${record.id} is not next to that of this page, so its motions and its report cannot be shown: open summary/study.html in the folder of the results, not a copy or the page of snakemake --report.`;
        Object.assign(record, { motions: {}, span: [], at_rest: "", warnings: [lost], lost: true });
        done();
      };
    });
  }

  function choose(r, s) {
    stop();
    const [record, structure] = [records[r], structures[s]];
    wanted = record;
    if (!record.motions) {
      load(record).then(() => { if (wanted === record) choose(r, s); });
      return;
    }
    matrix.querySelectorAll("[aria-pressed='true']").forEach((each) => each.setAttribute("aria-pressed", "false"));
    const button = matrix.querySelector(`button[data-record="${r}"][data-structure="${s}"]`);
    button.setAttribute("aria-pressed", "true");
    roam(button);
    history.replaceState(null, "", `#${encodeURIComponent(record.id)}/${encodeURIComponent(structure.name)}`);
    const each = caseOf(record, structure);
    at("case").hidden = false;
    at("title").textContent = `${structure.name} (${structure.size}) under ${record.id}${each.component ? ", component " + each.component : ""}`;
    const failed = each.component === undefined;
    shown = [record, structure];
    map(record, structure);
    at("strips").hidden = failed;
    strips(record);
    at("moves").hidden = failed;
    const still = !failed && !each.history ? "It does not lift enough to be drawn, or its motion was not kept." : "";
    // A number keeps its unit on its line
    const facts = [each.text || verdictOf(each) + ".", ...structure.warnings, still, ...record.warnings, ""].join(" ");
    at("facts").textContent = facts.replace(/(\d) (?=[%×]|m\/s|[gms]\b)/g, "$1\u00a0");
    if (!record.lost) add(at("facts"), "a", { href: `../${encodeURIComponent(record.id)}/report.pdf` }, "report.pdf");
    if (failed) return;
    const motion = record.motions[each.component];
    const span = each.history ? each.history.span : [0, motion ? motion.duration : 1];
    const point = histories(each, motion, span);
    const rotationOf = (time) => {
      const value = each.history ? valueAt(each.history, time) : 0;
      return value === 0 ? 0 : value * each.critical[value < 0 ? 1 : 0];
    };
    const most = each.history ? largest(each.history) * Math.max(...each.critical) : 0;
    const painter = () => paintWith(structure.frames, motion, Math.max(most * Number(at("magnify").value), 0.02));
    let paint = painter();
    at("magnify").onchange = () => { paint = painter(); show(); };
    show = () => {
      const time = span[0] + (Number(at("scrub").value) / 1000) * (span[1] - span[0]);
      paint(rotationOf(time) * Number(at("magnify").value), time);
      point(time);
      at("clock").textContent = `${time.toFixed(2)} s`;
    };
    show.length_s = span[1] - span[0];
    at("scrub").value = 0;
    show();
  }

  // The cell that the address names, "#record/structure", or "#record" with all its structures; false where it names none
  function follow() {
    const [record, structure] = location.hash.slice(1).split("/").map(decodeURIComponent);
    const r = records.findIndex((each) => each.id === record);
    const worst = () => structures.reduce((a, b) => (compared(caseOf(records[r], a).severity, caseOf(records[r], b).severity) > 0 ? b : a));
    if (r >= 0 && structure === undefined) at("strips").open = true;
    const s = r >= 0 && structure === undefined ? structures.indexOf(worst()) : structures.findIndex((each) => each.name === structure);
    if (r >= 0 && s >= 0) choose(r, s);
    if (r >= 0 && structure === undefined) at("strips").scrollIntoView();
    return r >= 0 && s >= 0;
  }

  function stop() {
    cancelAnimationFrame(playing);
    playing = 0;
    at("play").textContent = "Play";
  }

  function play() {
    if (playing) { stop(); return; }
    if (Number(at("scrub").value) >= 1000) at("scrub").value = 0;
    at("play").textContent = "Pause";
    let place = Number(at("scrub").value);
    let before = performance.now();
    const step = (now) => {
      place += ((now - before) * Number(at("speed").value)) / show.length_s;
      before = now;
      at("scrub").value = Math.min(1000, place);
      show();
      if (place >= 1000) stop();
      else playing = requestAnimationFrame(step);
    };
    playing = requestAnimationFrame(step);
  }

  fill();
  filter();
  matrix.parentElement.addEventListener("scroll", beyond);
  addEventListener("resize", fit);
  at("text").addEventListener("input", filter);
  at("verdict").addEventListener("change", filter);
  at("filters").addEventListener("submit", (event) => event.preventDefault());
  matrix.addEventListener("keydown", onArrow);
  matrix.addEventListener("click", ({ target }) => {
    const head = target.closest("thead th");
    const button = target.closest("tbody button");
    if (head) order(head.dataset.by);
    else if (button) choose(button.dataset.record, button.dataset.structure);
  });
  at("play").addEventListener("click", play);
  at("scrub").addEventListener("input", () => { stop(); show(); });
  addEventListener("hashchange", follow);
  at("strips").addEventListener("toggle", () => { if (shown) strips(shown[0]); });
  at("map").addEventListener("toggle", () => { if (shown) map(...shown); });
  at("map").addEventListener("click", ({ target }) => {
    const circle = target.closest("circle");
    if (circle) choose(circle.dataset.record, structures.indexOf(shown[1]));
  });
  if (!follow()) {
    const cells = [...matrix.querySelectorAll("tbody button")];
    const first = cells.find(({ dataset }) => caseOf(records[dataset.record], structures[dataset.structure]).moves) || cells[0];
    if (first) choose(first.dataset.record, first.dataset.structure);
  }
})();
