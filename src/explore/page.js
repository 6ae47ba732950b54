"use strict";
// The page asks the library's own rooms, which it holds as WebAssembly, and draws what they answer: every figure of a law comes from there.
const data = JSON.parse(document.getElementById("data").textContent);
const $ = (id) => document.getElementById(id);
const root = document.documentElement;

// ---- the library ----
let library;
async function unpack() {
  const text = $("wasm").textContent.trim();
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  let module;
  try { module = new WebAssembly.Module(bytes); } catch { module = await WebAssembly.compile(bytes); } // some browsers wait for none that large
  library = { module };
  library.exports = (await WebAssembly.instantiate(library.module, {})).exports;
}
function taken(packed) {
  const bits = BigInt.asUintN(64, packed), place = Number(bits >> 32n), length = Number(bits & 0xffffffffn);
  const text = new TextDecoder().decode(new Uint8Array(library.exports.memory.buffer, place, length));
  library.exports.release(place, length);
  return text;
}
function ask(question) {
  const bytes = new TextEncoder().encode(JSON.stringify(question));
  const place = library.exports.allocate(bytes.length);
  new Uint8Array(library.exports.memory.buffer, place, bytes.length).set(bytes);
  try {
    return JSON.parse(taken(library.exports.answer(place, bytes.length)));
  } catch (trap) {
    const said = taken(library.exports.last_words()) || String(trap);
    library.exports = new WebAssembly.Instance(library.module, {}).exports; // its memory is not to be trusted
    return { error: `the program stopped, which is a fault of it: ${said}` };
  }
}

// ---- quantities ----
const PREFIXES = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"]];
const plain = (x, digits) => String(Number(x.toPrecision(digits)));
function scaled(x, unit) {
  if (!unit || unit === "kg/m3") return [1, unit];
  const size = Math.abs(x) * (1 + 1e-9);
  const [factor, prefix] = PREFIXES.find(([f]) => size >= f) || PREFIXES[PREFIXES.length - 1];
  return [factor, prefix + unit];
}
function shown(x, unit, digits = 4) {
  if (x === null || x === undefined) return "";
  if (x === 0) return unit ? `0 ${unit}` : "0";
  const [factor, name] = scaled(x, unit);
  return name ? `${plain(x / factor, digits)} ${name}` : plain(x, digits);
}

// ---- sliders: key, words, symbol, unit, lowest, highest, first; of log scale unless `linear`; `zero`: its left end is 0 ----
const SLIDERS = [
  { of: "material", key: "young", words: "Young's modulus", symbol: "E", unit: "Pa", low: 1e8, high: 5e11, first: 128e9 },
  { of: "material", key: "strength", words: "Yield strength", symbol: "Y", unit: "Pa", low: 1e6, high: 5e9, first: 162e6 },
  { of: "material", key: "poisson", words: "Poisson's ratio", symbol: "ν", unit: "", low: 0.15, high: 0.48, first: 0.343, linear: true },
  { of: "material", key: "hardening", words: "Hardening modulus", symbol: "H", unit: "Pa", low: 1e5, high: 1e10, first: 0, zero: true },
  { of: "material", key: "density", words: "Density", symbol: "ρ", unit: "kg/m3", low: 500, high: 22000, first: 8960 },
  { of: "sphere", key: "radius", words: "Radius", symbol: "R", unit: "m", low: 1e-6, high: 2e-2, first: 250e-6 },
  { of: "sphere", key: "velocity", words: "Speed", symbol: "V", unit: "m/s", low: 1e-3, high: 1e3, first: 10 },
  { of: "turning", key: "press", words: "Displacement", symbol: "δ", unit: "m", low: 1e-9, high: 1e-2, first: 5e-6 },
];
const STEPS = 1000;
const slider = {};
for (const s of SLIDERS) {
  const box = document.createElement("div");
  box.className = "slider";
  box.innerHTML = `<label for="${s.key}">${s.words} <i>${s.symbol}</i></label>` +
    `<input id="${s.key}" type="text" spellcheck="false"${s.key === "strength" ? ' placeholder="elastic"' : ""}>` +
    `<input id="${s.key}-slider" type="range" min="0" max="${STEPS}" step="1" aria-label="${s.words}">`;
  $(s.of).querySelector(".sliders").append(box);
  Object.assign(s, { text: box.querySelector("[type=text]"), range: box.querySelector("[type=range]") });
  slider[s.key] = s;
  s.range.addEventListener("input", () => { s.set(at(s, +s.range.value / STEPS)); changed(s); });
  s.text.addEventListener("input", () => { placed(s, read(s)); changed(s); });
  s.set = (x) => { s.text.value = shown(x, s.unit, s.digits || 4); placed(s, x); };
  s.set(s.first);
}
function at(s, t) {
  if (s.linear) return Number((s.low + t * (s.high - s.low)).toFixed(3));
  if (s.zero && t === 0) return 0;
  return Number((s.low * Math.pow(s.high / s.low, t)).toPrecision(3));
}
function placed(s, x) {
  if (!(x >= 0)) return;
  const t = s.linear ? (x - s.low) / (s.high - s.low) : Math.log(Math.max(x, s.low) / s.low) / Math.log(s.high / s.low);
  s.range.value = Math.round(Math.min(Math.max(t, 0), 1) * STEPS);
  s.range.setAttribute("aria-valuetext", shown(x, s.unit));
}
// Only where the thumb stands depends on this; the value itself is read by the library, which knows every unit.
function read(s) {
  const match = /^\s*([-+.\deE]+)\s*(\S.*)?$/.exec(s.text.value);
  if (!match) return NaN;
  const name = (match[2] || "").trim().replace(/^u/, "µ").replace("kg/m³", "kg/m3");
  if (name === s.unit) return +match[1];
  const prefix = PREFIXES.find(([, p]) => p && p + s.unit === name);
  return prefix ? +match[1] * prefix[0] : NaN;
}
function changed(s) {
  if (s.of === "material") $("preset").value = "";
  if (s.key === "press") document.querySelector("[name=press][value=to]").checked = true;
  ordered();
}

// ---- what is asked about ----
let opened = null; // { name, text }
const on = new Set(data.laws.filter((law) => law.shown).map((law) => law.name));
const law = Object.fromEntries(data.laws.map((l) => [l.name, l]));
function body() {
  const text = (key) => slider[key].text.value;
  return { young: text("young"), poisson: text("poisson"), density: text("density"), strength: text("strength"),
    hardening: text("hardening"), radius: text("radius"), velocity: text("velocity"), law: opened };
}
const listed = () => data.laws.map((l) => l.name).filter((name) => on.has(name));
const press = () => (document.querySelector("[name=press]:checked").value === "to" ? slider.press.text.value : null);

// ---- one picture after the other: the impact at once, restitution law by law after it ----
let turn = 0, waiting = false, now = null, bounces = null;
function ordered() {
  turn += 1;
  root.dataset.state = "busy";
  if (waiting || !library) return;
  waiting = true;
  setTimeout(() => { waiting = false; thrown(); });
}
function thrown() {
  const mine = turn;
  const answer = ask({ ask: "impact", body: body(), laws: listed(), press: press() });
  $("refused").hidden = !answer.error;
  now = answer.error ? null : answer;
  bounces = null;
  if (!now) {
    $("refused").textContent = answer.error;
    drawForce(); drawSpeed(); fillTable();
    root.dataset.state = "ready";
    return;
  }
  const refused = now.laws.find((l) => l.name === "law" && l.refused);
  if (refused) { $("refused").hidden = false; $("refused").textContent = `No law here. ${refused.refused}`; }
  drawForce(); fillTable();
  bounces = { velocities: speeds(), laws: {} };
  drawSpeed();
  const todo = listed();
  const next = () => {
    if (mine !== turn) return;
    const name = todo.shift();
    if (name) {
      const answer = ask({ ask: "restitution", body: body(), laws: [name], velocities: bounces.velocities });
      if (!answer.error) bounces.laws[name] = answer.laws[0];
      drawSpeed();
      setTimeout(next);
    } else {
      root.dataset.state = "ready";
    }
  };
  setTimeout(next);
}
function speeds() {
  const a = now.about, v = a.velocity_m_s;
  // from half the speed of first yield to where the atlas ends
  let low = a.yield_velocity_m_s ? a.yield_velocity_m_s / 2 : v / 100;
  let high = a.rho_V2_over_Y ? v * Math.sqrt(1.2 / a.rho_V2_over_Y) : v * 100;
  if (a.law_velocities_m_s) high = Math.max(high, a.law_velocities_m_s[1]);
  low = Math.min(low, v / 2); high = Math.max(high, v * 2);
  const points = 49;
  return Array.from({ length: points }, (_, i) => low * Math.pow(high / low, i / (points - 1)));
}

// ---- charts ----
const NS = "http://www.w3.org/2000/svg";
function node(name, attributes, parent, text) {
  const n = document.createElementNS(NS, name);
  for (const [k, v] of Object.entries(attributes)) n.setAttribute(k, v);
  if (text !== undefined) n.textContent = text;
  if (parent) parent.append(n);
  return n;
}
function chart(box, x, y) {
  const width = box.clientWidth || 500, height = box.clientHeight || 300;
  const left = 52, right = 14, top = 10, bottom = 40;
  const svg = node("svg", { viewBox: `0 0 ${width} ${height}` });
  const px = (v) => left + x.place(v) * (width - left - right), py = (v) => height - bottom - y.place(v) * (height - top - bottom);
  const crisp = (v) => Math.round(v) + 0.5;
  for (const [value, label] of x.ticks(Math.max(3, Math.floor(width / 90)))) {
    node("line", { class: "grid", x1: crisp(px(value)), x2: crisp(px(value)), y1: top, y2: height - bottom }, svg);
    if (label) node("text", { x: px(value), y: height - bottom + 16, "text-anchor": "middle" }, svg, label);
  }
  for (const [value, label] of y.ticks(6)) {
    node("line", { class: "grid", x1: left, x2: width - right, y1: crisp(py(value)), y2: crisp(py(value)) }, svg);
    if (label) node("text", { x: left - 6, y: py(value) + 4, "text-anchor": "end" }, svg, label);
  }
  node("rect", { class: "frame", x: left + 0.5, y: top + 0.5, width: width - left - right, height: height - top - bottom }, svg);
  node("text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle" }, svg, x.title);
  node("text", { x: 12, y: (top + height - bottom) / 2, "text-anchor": "middle", transform: `rotate(-90 12 ${(top + height - bottom) / 2})` }, svg, y.title);
  box.replaceChildren(svg);
  return { svg, px, py, left, right: width - right, top, bottom: height - bottom, x, y };
}
function linear(high, quantity, unit) {
  const [factor, name] = scaled(high, unit);
  return {
    title: name ? `${quantity} (${name})` : quantity, place: (v) => v / high, value: (t) => t * high,
    ticks(count) {
      const rough = high / factor / count, power = Math.pow(10, Math.floor(Math.log10(rough)));
      const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough * 0.999);
      const ticks = [];
      for (let k = 0; k * step <= (high / factor) * 1.0001; k++) ticks.push([k * step * factor, plain(k * step, 6)]);
      return ticks;
    },
  };
}
function logarithmic(low, high, quantity, unit) {
  const span = Math.log(high / low);
  return {
    title: `${quantity} (${unit})`, place: (v) => Math.log(v / low) / span, value: (t) => low * Math.exp(t * span),
    ticks(count) {
      const from = Math.ceil(Math.log10(low) - 1e-9), to = Math.floor(Math.log10(high) + 1e-9);
      const each = Math.max(1, Math.ceil((to - from + 1) / count));
      const ticks = [];
      for (let k = from; k <= to; k++) ticks.push([Math.pow(10, k), (k - from) % each ? "" : Math.abs(k) > 3 ? `1e${k}` : plain(Math.pow(10, k), 3)]);
      return ticks;
    },
  };
}
function drawn(c, name, xs, ys, keep, extra = "") {
  let d = "", pen = false;
  for (let i = 0; i < xs.length; i++) {
    const good = ys[i] !== null && keep(i);
    if (good) d += `${pen ? "L" : "M"}${c.px(xs[i]).toFixed(2)} ${c.py(ys[i]).toFixed(2)}`;
    pen = good;
  }
  const ink = law[name];
  const attributes = { class: `curve ${extra}`, "data-law": name, d, style: `--c:${ink.colour}`, "stroke-width": ink.width };
  if (ink.dash && !extra) attributes["stroke-dasharray"] = ink.dash.join(" ");
  if (d) node("path", attributes, c.svg);
}
let forceChart = null, speedChart = null;
function drawForce() {
  const all = now ? now.laws.filter((l) => l.pressed) : [];
  // a law that is far stiffer than the others, as Hertz's, does not press them to the floor
  const top = (f) => Math.max(...all.map(f), 1e-300);
  const forces = all.map((l) => l.pressed.max_force_N).sort((a, b) => a - b);
  const middle = forces[Math.floor(forces.length / 2)] || 1;
  const high = Math.min(top((l) => l.pressed.max_force_N), 2.5 * middle);
  forceChart = chart($("force"), linear(1.04 * top((l) => l.pressed.max_displacement_m), "displacement δ", "m"), linear(1.06 * high, "force F", "N"));
  const c = forceChart;
  const clip = node("clipPath", { id: "inside" }, c.svg);
  node("rect", { x: c.left, y: c.top, width: c.right - c.left, height: c.bottom - c.top }, clip);
  for (const l of [...all].reverse()) {
    drawn(c, l.name, l.pressed.displacement_m, l.pressed.force_N, () => true, l.pressed.beyond ? "faint" : "");
    if (c.svg.lastChild.tagName === "path") c.svg.lastChild.setAttribute("clip-path", "url(#inside)");
  }
}
function drawSpeed() {
  const v = bounces ? bounces.velocities : [1e-2, 1e2];
  speedChart = chart($("speed"), logarithmic(v[0], v[v.length - 1], "speed V", "m/s"), linear(1.05, "restitution e", ""));
  if (!now || !bounces) return;
  const c = speedChart, x = c.px(now.about.velocity_m_s);
  node("line", { class: "now", x1: x, x2: x, y1: c.top, y2: c.bottom }, c.svg);
  for (const name of listed().reverse()) {
    const l = bounces.laws[name];
    if (!l) continue;
    if (l.bounces) {
      const { restitution: e, supported: s } = l.bounces;
      drawn(c, name, v, e, (i) => s[i]);
      drawn(c, name, v, e, (i) => !s[i] || s[i - 1] === false || s[i + 1] === false, "faint");
    } else if (l.closed_form) {
      drawn(c, name, v, l.closed_form, () => true);
    }
  }
  for (const l of now.laws) {
    const e = l.pressed && l.pressed.restitution !== null ? l.pressed.restitution : l.restitution_closed_form;
    if (e !== null) node("circle", { class: "dot", cx: x, cy: c.py(e), r: l.name === "law" ? 5 : 3.2, style: `--c:${law[l.name].colour}` }, c.svg);
  }
  const place = c.x.place(now.about.velocity_m_s);
  $("speed").setAttribute("aria-valuenow", Math.round(1000 * place));
  $("speed").setAttribute("aria-valuetext", shown(now.about.velocity_m_s, "m/s"));
}

// ---- the table ----
const COLUMNS = [["F*", "max_force_N", "N"], ["δ*", "max_displacement_m", "m"], ["δ_res", "residual_displacement_m", "m"], ["e", "restitution", ""], ["e, formula", null, ""], ["t_c", "contact_time_s", "s"]];
function cell(row, value, unit, beyond) {
  const td = row.insertCell();
  td.textContent = value === null || value === undefined ? "–" : shown(value, unit);
  if (value !== null && value !== undefined) { td.dataset.si = value; td.title = `${value} ${unit}`.trim(); }
  if (beyond) { td.className = "beyond"; td.title += `: ${beyond}`; }
}
const rows = {};
function prepareTable() {
  const head = $("figures").tHead.insertRow();
  for (const name of ["law", ...COLUMNS.map(([n]) => n)]) {
    const th = document.createElement("th");
    th.scope = "col"; th.textContent = name;
    head.append(th);
  }
  for (const l of data.laws) {
    const row = $("figures").tBodies[0].insertRow(), th = document.createElement("th");
    th.scope = "row"; th.title = l.about;
    th.innerHTML = `<label><input type="checkbox"${on.has(l.name) ? " checked" : ""}><svg class="key" viewBox="0 0 30 10" aria-hidden="true"><line x1="0" x2="30" y1="5" y2="5" style="--c:${l.colour}" stroke-width="${l.width}"${l.dash ? ` stroke-dasharray="${l.dash.join(" ")}"` : ""}/></svg><span></span></label>`;
    th.querySelector("span").textContent = l.name;
    th.querySelector("input").addEventListener("change", (event) => { on[event.target.checked ? "add" : "delete"](l.name); ordered(); });
    row.append(th);
    row.dataset.law = l.name;
    rows[l.name] = row;
  }
}
function fillTable() {
  rows.law.querySelector("span").textContent = opened ? opened.name : "law of the atlas";
  const found = Object.fromEntries((now ? now.laws : []).map((l) => [l.name, l]));
  for (const [name, row] of Object.entries(rows)) {
    while (row.cells.length > 1) row.deleteCell(1);
    const l = found[name];
    row.className = l ? "" : "off";
    if (l && l.refused) {
      const td = row.insertCell();
      td.className = "said"; td.colSpan = COLUMNS.length; td.textContent = l.refused;
    } else for (const [, key, unit] of COLUMNS) {
      if (!l) cell(row, null, unit);
      else if (key) cell(row, l.pressed && l.pressed[key], unit, l.pressed && l.pressed.beyond);
      else cell(row, l.restitution_closed_form, unit);
    }
  }
  const a = now && now.about;
  const say = (words, value, unit) => (value === null ? "" : `<span data-key="${words}" data-si="${value}">${words} = ${shown(value, unit)}</span> `);
  $("about").innerHTML = a ? say("V", a.velocity_m_s, "m/s") + say("V_y", a.yield_velocity_m_s, "m/s") + say("δ_y", a.yield_displacement_m, "m") + say("F_y", a.yield_force_N, "N") +
    say("E/Y", a.young_over_yield, "") + say("ρV²/Y", a.rho_V2_over_Y, "") + say("E*", a.contact_modulus_Pa, "Pa") + say("m", a.mass_kg * 1e3, "g").replace(/data-si="[^"]*"/, `data-si="${a.mass_kg}"`) : "";
  const notes = a ? [...now.laws.filter((l) => l.pressed && l.pressed.beyond).map((l) => `${law[l.name] && l.name !== "law" ? l.name : "law"}: ${l.pressed.beyond}`), ...a.notes, ...a.law_notes.map((n) => `law: ${n}`)] : [];
  if (a && a.law_velocities_m_s) notes.push(`law: made for ${shown(a.law_velocities_m_s[0], "m/s")} to ${shown(a.law_velocities_m_s[1], "m/s")}`);
  $("notes").replaceChildren(...notes.map((n) => Object.assign(document.createElement("li"), { textContent: n })));
  for (const id of ["save-law", "save-header"]) $(id).disabled = !(a && a.law_velocities_m_s);
}

const HINT = "Click in the chart of restitution, or use the arrow keys there, to choose V.";
// ---- choosing V in the chart, reading off it ----
function inChart(c, event) {
  const box = c.svg.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top;
  if (x < c.left || x > c.right || y < c.top || y > c.bottom) return null;
  return [c.x.value((x - c.left) / (c.right - c.left)), c.y.value((c.bottom - y) / (c.bottom - c.top))];
}
function choose(v) { slider.velocity.set(Number(v.toPrecision(3))); ordered(); }
$("speed").addEventListener("pointerdown", (event) => {
  const place = inChart(speedChart, event);
  if (place) { choose(place[0]); if (event.pointerType === "mouse") $("speed").setPointerCapture(event.pointerId); }
});
$("speed").addEventListener("keydown", (event) => {
  const steps = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
  if (!steps || !now) return;
  event.preventDefault();
  choose(now.about.velocity_m_s * Math.pow(10, steps / 40));
});
for (const [id, of, units] of [["force", () => forceChart, ["m", "N"]], ["speed", () => speedChart, ["m/s", ""]]]) {
  $(id).addEventListener("pointermove", (event) => {
    const place = inChart(of(), event);
    $("under").textContent = place ? `${id === "force" ? "δ" : "V"} = ${shown(place[0], units[0], 3)}, ${id === "force" ? "F" : "e"} = ${shown(place[1], units[1], 3)}` : HINT;
    if (id === "speed" && place && event.buttons === 1 && $("speed").hasPointerCapture(event.pointerId)) choose(place[0]);
  });
}

// ---- presets, law files, downloads ----
for (const m of data.materials) $("preset").append(new Option(m.name, m.name));
$("preset").addEventListener("change", () => {
  const m = data.materials.find((one) => one.name === $("preset").value);
  if (!m) return;
  for (const key of ["young", "strength", "poisson", "hardening", "density"]) { slider[key].digits = 9; slider[key].set(m[key]); slider[key].digits = 4; }
  ordered();
});
function origin() {
  $("material").disabled = !!opened;
  $("atlas").hidden = !opened;
  $("origin").textContent = opened ? `${opened.name}: its material stands for the constants above, in the theories too.` : "From the atlas.";
  ordered();
}
async function take(file) {
  if (file) { opened = { name: file.name, text: await file.text() }; origin(); }
}
$("open").addEventListener("change", () => { take($("open").files[0]); $("open").value = ""; });
$("atlas").addEventListener("click", () => { opened = null; origin(); });
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => { event.preventDefault(); take(event.dataTransfer.files[0]); });
function save(name, text) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
const nameOfLaw = () => $("preset").value || "law";
for (const [id, what] of [["save-law", "file"], ["save-header", "header"]]) {
  $(id).addEventListener("click", () => {
    const file = ask({ ask: what, body: body(), name: nameOfLaw() });
    if (file.error) { $("refused").hidden = false; $("refused").textContent = file.error; } else save(file.name, file.text);
  });
}
const text = (x) => (x === null || x === undefined ? "" : String(x));
$("save-curves").addEventListener("click", () => {
  const lines = ["law,displacement_m,force_N"];
  for (const l of now ? now.laws : []) if (l.pressed) l.pressed.displacement_m.forEach((d, i) => lines.push(`${l.name},${text(d)},${text(l.pressed.force_N[i])}`));
  save("force.csv", lines.join("\n") + "\n");
});
$("save-restitution").addEventListener("click", () => {
  const lines = ["law,velocity_m_s,restitution,restitution_closed_form,supported"];
  for (const [name, l] of Object.entries(bounces ? bounces.laws : {})) {
    bounces.velocities.forEach((v, i) => lines.push([name, v, text(l.bounces && l.bounces.restitution[i]), text(l.closed_form && l.closed_form[i]), text(l.bounces && l.bounces.supported[i])].join(",")));
  }
  save("restitution.csv", lines.join("\n") + "\n");
});
for (const radio of document.querySelectorAll("[name=press]")) radio.addEventListener("change", ordered);
$("body").addEventListener("submit", (event) => event.preventDefault());
new ResizeObserver(() => { if (now) { drawForce(); drawSpeed(); } }).observe($("force"));

$("program").textContent = data.program;
prepareTable();
drawForce(); drawSpeed();
// the page is painted before the laws are unpacked
requestAnimationFrame(() => setTimeout(() => unpack().then(ordered, (why) => {
  $("refused").hidden = false;
  $("refused").textContent = `This browser does not run the laws: ${why}`;
})));
