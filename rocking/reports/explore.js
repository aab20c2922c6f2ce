"use strict";
(() => {
  const content = JSON.parse(document.getElementById("content").textContent);
  const { records, structures, reports } = content;
  const at = (id) => document.getElementById(id);
  const SIGNS = { overturns: "▲", undecided: "?", stands: "●", unknown: "–" };

  // Numbers ---------------------------------------------------------------------------------------------
  function unpacked(packed) {
    if (!packed.values) {
      const bytes = Uint8Array.from(atob(packed.data), (c) => c.charCodeAt(0));
      const view = new DataView(bytes.buffer);
      packed.values = Float64Array.from({ length: bytes.length / 2 }, (_, k) => view.getInt16(2 * k, true) * packed.scale);
    }
    return packed.values;
  }
  const ratio = (value) => (value === null ? "not known" : value === "inf" ? "overturns" : Number(value.toPrecision(3)).toString());

  // Value of a trace of equal stretches of [begin, end] at a time; 0 outside
  function valueAt(values, [begin, end], time) {
    const place = ((time - begin) / (end - begin)) * values.length - 0.5;
    if (place < -0.5 || place > values.length - 0.5) return 0;
    const low = Math.max(0, Math.min(values.length - 2, Math.floor(place)));
    const share = Math.max(0, Math.min(1, place - low));
    return values[low] * (1 - share) + values[low + 1] * share;
  }

  // Matrix ----------------------------------------------------------------------------------------------
  function element(name, properties = {}, ...children) {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
  }
  const caseOf = (record, structure) => record.cases[structure.name];
  const share = (each) => (each && each.share !== null ? Number(each.share) : 0);
  const peak = (value) => (value === null ? "–" : Number(value.toPrecision(2)).toString());

  function described(record, structure) {
    const each = caseOf(record, structure);
    if (!each) return `${structure.name} under ${record.id}: no result. ${record.failure}`;
    return [
      `${structure.name} under ${record.id}, component ${each.component || "–"}`,
      `${each.verdict}: ${each.why}`,
      `as given ${ratio(each.ratio)}, closed form ${ratio(each.predicted)}`,
    ].join("\n");
  }

  function cellOf(record, structure) {
    const each = caseOf(record, structure);
    const verdict = each ? each.verdict : "unknown";
    const shown = each && each.members ? Math.round(100 * share(each)) : each && typeof each.ratio === "number" ? ratio(each.ratio) : "";
    const button = element("button", { type: "button", className: `cell ${verdict}`, tabIndex: -1, title: described(record, structure) });
    Object.assign(button.dataset, { record: records.indexOf(record), structure: structures.indexOf(structure), verdict });
    button.textContent = `${SIGNS[verdict]} ${shown}`.trim();
    button.setAttribute("aria-pressed", "false");
    button.setAttribute("aria-label", button.title);
    return button;
  }

  // How the rows may be ordered; the worst, the largest, or the first name stands on top
  const worse = (a, b) => {
    const place = a.findIndex((value, k) => value !== b[k]);
    return place < 0 ? 0 : b[place] - a[place];
  };
  const severity = (record) => structures.reduce((sum, each) => sum + share(caseOf(record, each)), 0);
  const NONE = [-9, -9, -9];
  const ORDERS = {
    record: (a, b) => a.id.localeCompare(b.id, undefined, { numeric: true }),
    severity: (a, b) => severity(b) - severity(a),
    pga: (a, b) => b.pga - a.pga,
    pgv: (a, b) => b.pgv - a.pgv,
  };

  function order(by) {
    const compare = ORDERS[by] || ((a, b) => worse((caseOf(a, structures[by]) || { severity: NONE }).severity, (caseOf(b, structures[by]) || { severity: NONE }).severity));
    const body = at("matrix").querySelector("tbody");
    const rows = [...body.rows];
    rows.sort((a, b) => compare(records[a.dataset.record], records[b.dataset.record]));
    body.append(...rows);
    at("matrix").querySelectorAll("thead th").forEach((head) => {
      if (head.dataset.by === String(by)) head.setAttribute("aria-sort", by === "record" ? "ascending" : "descending");
      else head.removeAttribute("aria-sort");
    });
  }

  function fill() {
    const heading = (by, text, title) => {
      const head = element("th", { scope: "col", title }, element("button", { type: "button" }, text));
      head.dataset.by = by;
      return head;
    };
    const heads = [
      heading("record", "Record", "order by name"), heading("pga", "PGA [g]", "order by peak acceleration"),
      heading("pgv", "PGV [m/s]", "order by peak velocity"), ...structures.map((each, s) => heading(s, each.name, `${each.type}: ${each.size}`)),
    ];
    const body = element("tbody");
    records.forEach((record, r) => {
      const peaks = [record.pga, record.pgv].map((value) => element("td", { className: "peak" }, peak(value)));
      const row = element("tr", {}, element("th", { scope: "row" }, record.id), ...peaks);
      row.dataset.record = r;
      structures.forEach((each) => row.append(element("td", {}, cellOf(record, each))));
      body.append(row);
    });
    at("matrix").append(element("thead", {}, element("tr", {}, ...heads)), body);
    order("severity");
    const first = at("matrix").querySelector("tbody button");
    if (first) first.tabIndex = 0;
  }

  function filter() {
    const text = at("text").value.trim().toLowerCase();
    const verdict = at("verdict").value;
    const named = structures.map((each) => each.name.toLowerCase().includes(text));
    let count = 0;
    const used = new Set();
    const rows = [...at("matrix").querySelectorAll("tbody tr")];
    rows.forEach((row) => {
      const isNamed = records[row.dataset.record].id.toLowerCase().includes(text);
      let any = false;
      row.querySelectorAll("button").forEach((button, s) => {
        const kept = (text === "" || isNamed || named[s]) && (!verdict || button.dataset.verdict === verdict);
        button.style.visibility = kept ? "" : "hidden";
        if (kept) { any = true; count += 1; used.add(s); }
      });
      row.hidden = !any;
    });
    const columns = [...at("matrix").querySelectorAll("thead th")].slice(3);
    columns.forEach((head, s) => { head.hidden = !used.has(s); });
    rows.forEach((row) => [...row.cells].slice(3).forEach((cell, s) => { cell.hidden = !used.has(s); }));
    at("shown").textContent = `${count} of ${records.length * structures.length} cells`;
    const open = visible();
    if (open.length && !open.some((each) => each.tabIndex === 0)) roam(open[0], false);
  }

  const visible = () => [...at("matrix").querySelectorAll("tbody button")].filter((each) => each.offsetParent && each.style.visibility !== "hidden");

  function roam(button, focus = true) {
    at("matrix").querySelectorAll("tbody button[tabindex='0']").forEach((each) => { each.tabIndex = -1; });
    button.tabIndex = 0;
    if (focus) button.focus();
  }

  function onArrow(event) {
    const step = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] }[event.key];
    const from = event.target.closest("tbody button");
    if (!step || !from) return;
    event.preventDefault();
    const [down, right] = step;
    const place = (button) => [button.closest("tr").rowIndex, Number(button.dataset.structure)];
    const [r, s] = place(from);
    const ahead = visible().map((each) => [each, place(each)[0] - r, place(each)[1] - s]);
    const along = ahead.filter(([, dr, ds]) => (down ? ds === 0 && dr * down > 0 : dr === 0 && ds * right > 0));
    along.sort((a, b) => Math.abs(a[1]) + Math.abs(a[2]) - Math.abs(b[1]) - Math.abs(b[2]));
    if (along.length) roam(along[0][0]);
  }

  // Histories -------------------------------------------------------------------------------------------
  const SVG = "http://www.w3.org/2000/svg";
  const [LEFT, RIGHT] = [72, 610];
  const PANELS = [{ top: 8, bottom: 120 }, { top: 146, bottom: 258 }];

  function drawn(name, attributes, text = "", parent = at("histories")) {
    const made = document.createElementNS(SVG, name);
    Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
    made.textContent = text;
    parent.append(made);
    return made;
  }

  function ticks(low, high, wished) {
    const raw = (high - low) / wished;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find((each) => each * power >= raw);
    const found = [];
    for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; k += 1) found.push(Number((k * step).toPrecision(6)));
    return found;
  }

  function panel({ top, bottom }, span, reach, label) {
    const x = (time) => LEFT + ((time - span[0]) / (span[1] - span[0])) * (RIGHT - LEFT);
    const y = (value) => (top + bottom) / 2 - (value / reach) * ((bottom - top) / 2);
    drawn("rect", { x: LEFT, y: top, width: RIGHT - LEFT, height: bottom - top, fill: "none", stroke: "#555" });
    ticks(-reach, reach, 5).forEach((value) => {
      drawn("line", { x1: LEFT, x2: RIGHT, y1: y(value), y2: y(value), stroke: value === 0 ? "#888" : "#e2e2e2" });
      drawn("text", { x: LEFT - 6, y: y(value) + 4, "text-anchor": "end" }, String(value));
    });
    ticks(span[0], span[1], 8).forEach((value) => {
      drawn("line", { x1: x(value), x2: x(value), y1: bottom, y2: bottom + 4, stroke: "#555" });
      drawn("text", { x: x(value), y: bottom + 17, "text-anchor": "middle" }, String(value));
    });
    drawn("text", { transform: `translate(16 ${(top + bottom) / 2}) rotate(-90)`, "text-anchor": "middle" }, label);
    return { x, y };
  }

  function trace(values, own, span, { x, y }, attributes) {
    const points = [];
    values.forEach((value, k) => {
      const time = own[0] + ((k + 0.5) / values.length) * (own[1] - own[0]);
      if (time >= span[0] && time <= span[1]) points.push(`${x(time).toFixed(1)},${y(value).toFixed(1)}`);
    });
    drawn("polyline", { points: points.join(" "), fill: "none", ...attributes });
  }

  const largest = (values) => values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);

  function histories(each, motion, span) {
    at("histories").replaceChildren();
    if (motion) {
      const acceleration = unpacked(motion.acceleration);
      const pulse = motion.pulse && unpacked(motion.pulse.acceleration);
      const reach = 1.1 * Math.max(largest(acceleration), pulse ? largest(pulse) : 0) || 1;
      const axes = panel(PANELS[0], span, reach, "accel. [m/s²]");
      trace(acceleration, [0, motion.duration], span, axes, { stroke: "#444", "stroke-width": 0.8 });
      if (pulse) trace(pulse, motion.pulse.span, span, axes, { stroke: "#d55e00", "stroke-width": 2 });
      drawn("text", { x: RIGHT - 8, y: PANELS[0].top + 16, "text-anchor": "end" }, "grey: record; orange: dominant pulse");
    }
    const values = each.history ? unpacked(each.history.ratio) : new Float64Array(2);
    const predicted = typeof each.predicted === "number" ? each.predicted : 0;
    const reach = Math.min(3.1, 1.15 * Math.max(largest(values), predicted) || 1);
    const axes = panel(PANELS[1], span, reach, "rotation ratio [-]");
    if (each.history) trace(values, each.history.span, span, axes, { stroke: "#000", "stroke-width": 1.1, id: "rotation" });
    for (const level of predicted > 0 ? [predicted, -predicted] : [])
      drawn("line", { x1: LEFT, x2: RIGHT, y1: axes.y(level), y2: axes.y(level), stroke: "#0072b2", "stroke-dasharray": "8 3 2 3" });
    const said = predicted > 0 ? "dash-dot: largest by the closed form" : "closed form: " + (each.predicted === "inf" ? "overturns" : each.predicted === null ? "not known" : "no uplift");
    drawn("text", { x: RIGHT - 8, y: PANELS[1].top + 16, "text-anchor": "end" }, said);
    drawn("text", { x: (LEFT + RIGHT) / 2, y: 292, "text-anchor": "middle" }, "time after the first sample [s]");
    const cursor = drawn("line", { y1: PANELS[0].top, y2: PANELS[1].bottom, stroke: "#009e73", "stroke-width": 1.5, id: "cursor" });
    return (time) => { cursor.setAttribute("x1", axes.x(time)); cursor.setAttribute("x2", axes.x(time)); };
  }

  // Mechanism -------------------------------------------------------------------------------------------
  function framesOf(drawings) {
    if (drawings.frames) return drawings.frames;
    const flat = unpacked(drawings.points);
    let from = 0;
    const take = (count) => flat.subarray(2 * from, 2 * (from += count));
    drawings.frames = drawings.rotations.map((rotation, k) => ({
      rotation, parts: drawings.parts[k].map(take), hinges: take(drawings.hinges[k]),
      marks: drawings.marks[k].map((kind) => ({ kind, ends: take(2) })),
    }));
    return drawings.frames;
  }

  function mixed(a, b, share) {
    return a.length === b.length ? a.map((value, k) => value * (1 - share) + b[k] * share) : share < 0.5 ? a : b;
  }

  // The drawing at a rotation: between two frames of its side, no farther than the last
  function poseAt(frames, rotation) {
    const own = frames.filter((each) => each.rotation < 0 === rotation < 0);
    const side = own.length ? own : frames;
    const size = Math.abs(rotation);
    const above = side.findIndex((each) => Math.abs(each.rotation) >= size);
    if (above <= 0) return above === 0 ? side[0] : side[side.length - 1];
    const [a, b] = [side[above - 1], side[above]];
    if (a.parts.length !== b.parts.length) return a;
    const share = (size - Math.abs(a.rotation)) / (Math.abs(b.rotation) - Math.abs(a.rotation));
    const marks = a.marks.length === b.marks.length ? a.marks.map(({ kind, ends }, k) => ({ kind, ends: mixed(ends, b.marks[k].ends, share) })) : a.marks;
    return { parts: a.parts.map((part, k) => mixed(part, b.parts[k], share)), hinges: mixed(a.hinges, b.hinges, share), marks };
  }

  // Metres in the drawing, whose groups turn y upwards and move with the ground
  function paintWith(structure, motion, reach) {
    const frames = framesOf(structure.drawings);
    const moves = motion ? unpacked(motion.displacement) : null;
    const travel = moves ? largest(moves) : 0;
    const near = frames.filter((each) => Math.abs(each.rotation) <= reach || Math.abs(each.rotation) < 1e-3);
    const [left, right, low, high] = [0, 1].flatMap((axis) => {
      const values = near.flatMap((each) => [...each.parts, ...each.marks.map((mark) => mark.ends)].flatMap((points) => [...points.filter((_, k) => k % 2 === axis)]));
      return [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))];
    });
    const margin = 0.06 * Math.max(right - left, high - low);
    const wide = right - left + 2 * (travel + margin);
    at("mechanism").setAttribute("viewBox", `${(left + right - wide) / 2} ${-high - margin} ${wide} ${high - low + 2 * margin}`);
    const foot = Math.max(low, Math.min(0, high));
    const ground = { x1: left - 9 * wide, x2: right + 9 * wide };
    return (rotation, time) => {
      const shift = moves ? valueAt(moves, [0, motion.duration], time) : 0;
      const pose = poseAt(frames, rotation);
      const group = at("moving");
      group.replaceChildren();
      group.setAttribute("transform", `translate(${shift} 0) scale(1 -1)`);
      drawn("line", { ...ground, y1: foot, y2: foot }, "", group);
      drawn("line", { ...ground, y1: foot - margin / 4, y2: foot - margin / 4, "stroke-width": margin / 2, "stroke-dasharray": margin / 5, class: "ground" }, "", group);
      for (const points of pose.parts) drawn("polygon", { points: points.join(" ") }, "", group);
      for (const { kind, ends: [x1, y1, x2, y2] } of pose.marks) {
        drawn("line", { x1, y1, x2, y2, class: kind }, "", group);
        drawn("circle", { cx: x2, cy: y2, r: margin / 6, class: kind }, "", group);
      }
      for (let k = 0; k < pose.hinges.length; k += 2)
        drawn("circle", { cx: pose.hinges[k], cy: pose.hinges[k + 1], r: margin / 5 }, "", group);
    };
  }

  // One case --------------------------------------------------------------------------------------------
  let show = () => {};
  let playing = 0;

  function facts(each) {
    const said = [`${each.verdict}: ${each.why}.`];
    const band = each.members && each.high !== "inf" ? ` (5 to 95 % of the members: ${ratio(each.low)} to ${ratio(each.high)})` : "";
    said.push(`Largest rotation over critical rotation: ${ratio(each.ratio)} as given${band}, ${ratio(each.predicted)} by the closed form.`);
    if (!each.history) said.push("It does not lift enough to be drawn, or its motion was not kept.");
    return `${said.join(" ")} `;
  }
  const warned = (record) => record.warnings.map((each) => `${each} `).join("");

  function choose(r, s) {
    stop();
    const [record, structure] = [records[r], structures[s]];
    at("matrix").querySelectorAll("[aria-pressed='true']").forEach((each) => each.setAttribute("aria-pressed", "false"));
    at("matrix").querySelector(`button[data-record="${r}"][data-structure="${s}"]`).setAttribute("aria-pressed", "true");
    history.replaceState(null, "", `#${encodeURIComponent(record.id)}/${encodeURIComponent(structure.name)}`);
    const each = caseOf(record, structure);
    at("case").hidden = false;
    at("title").textContent = `${structure.name} (${structure.size}) under ${record.id}${each && each.component ? ", component " + each.component : ""}`;
    at("moves").hidden = !each;
    at("facts").textContent = (each ? facts(each) : `No result. ${record.failure} `) + warned(record);
    if (reports) at("facts").append(element("a", { href: `../${encodeURIComponent(record.id)}/report.pdf` }, "report.pdf"));
    if (!each) return;
    const motion = record.motions[each.component];
    const span = each.history ? each.history.span : [0, motion ? motion.duration : 1];
    const point = histories(each, motion, span);
    const values = each.history ? unpacked(each.history.ratio) : null;
    const rotationOf = (time) => {
      const value = values ? valueAt(values, span, time) : 0;
      return value === 0 ? 0 : value * each.history.critical[value < 0 ? 1 : 0];
    };
    const most = values ? largest(values) * Math.max(...each.history.critical) : 0;
    const draw = () => paintWith(structure, motion, Math.max(most * Number(at("magnify").value), 0.02));
    let paint = draw();
    at("magnify").onchange = () => { paint = draw(); show(); };
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

  // The cell that the address names, "#record/structure"; false where it names none
  function follow() {
    const [record, structure] = location.hash.slice(1).split("/").map(decodeURIComponent);
    const r = records.findIndex((each) => each.id === record);
    const s = structures.findIndex((each) => each.name === structure);
    if (r < 0 || s < 0) return false;
    choose(r, s);
    return true;
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
      place += (1000 * (now - before) / 1000 * Number(at("speed").value)) / show.length_s;
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
  at("text").addEventListener("input", filter);
  at("verdict").addEventListener("change", filter);
  at("filters").addEventListener("submit", (event) => event.preventDefault());
  at("matrix").addEventListener("keydown", onArrow);
  at("matrix").addEventListener("click", (event) => {
    const head = event.target.closest("thead th");
    if (head) { order(head.dataset.by); return; }
    const button = event.target.closest("tbody button");
    if (!button) return;
    roam(button);
    choose(Number(button.dataset.record), Number(button.dataset.structure));
  });
  at("play").addEventListener("click", play);
  at("scrub").addEventListener("input", () => { stop(); show(); });
  addEventListener("hashchange", follow);
  if (!follow()) {
    const cells = visible();
    const moving = cells.filter((each) => (caseOf(records[each.dataset.record], structures[each.dataset.structure]) || {}).history);
    const first = moving.find((each) => each.dataset.verdict === "overturns") || moving[0] || cells[0];
    if (first) { roam(first, false); choose(Number(first.dataset.record), Number(first.dataset.structure)); }
  }
})();
