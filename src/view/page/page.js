"use strict";
// The bed in 3-D: grains as sphere impostors, bodies as glass, WebGL 2, nothing from the network.
(() => {
  const $ = (id) => document.getElementById(id);
  const bed = JSON.parse($("data").textContent);
  const view = $("view");
  const gl = view.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  const fail = (text) => { $("failed").textContent = text; $("failed").hidden = false; };
  if (!gl) return fail("This page needs WebGL 2, which this browser does not offer or has switched off.");
  if (!bed.frames.length) return fail("No frame of this bed was kept.");
  view.addEventListener("webglcontextlost", () => fail("The graphics context was lost: reload the page."));

  // ---- data -------------------------------------------------------------------------------------------------
  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const floats = (text) => new Float32Array(bytes(text).buffer);
  const words = (text) => new Uint32Array(bytes(text).buffer);
  const buffer = (data, target = gl.ARRAY_BUFFER) => {
    const made = gl.createBuffer();
    gl.bindBuffer(target, made);
    gl.bufferData(target, data, gl.STATIC_DRAW);
    return made;
  };
  const kept = new Map();
  const once = (key, make) => { if (!kept.has(key)) kept.set(key, make()); return kept.get(key); };
  const centresOf = (k) => once(`centres ${k}`, () => buffer(bytes(bed.frames[k].centres)));
  const levelsOf = (k, q) => once(`${q} ${k}`, () => buffer(bytes(bed.frames[k].levels[q])));

  // ---- grains of two frames: those of the second that were not in the first appear with it --------------------
  const whoOf = (k) => once(`who ${k}`, () => (bed.frames[k].who ? words(bed.frames[k].who) : null));
  /** Places within two frames, and among all, of the grains that are in both; none where both begin with all of them. */
  const both = (first, second) => once(`both ${first} ${second}`, () => {
    const [a, b] = [whoOf(first), whoOf(second)];
    if (!a && !b) return null;
    const at = { first: [], second: [], all: [] };
    const [m, n] = [bed.frames[first].count, bed.frames[second].count];
    for (let i = 0, j = 0; i < m && j < n;) {
      const [x, y] = [a ? a[i] : i, b ? b[j] : j];
      if (x === y) { at.first.push(i); at.second.push(j); at.all.push(x); }
      if (x <= y) i++;
      if (y <= x) j++;
    }
    return at;
  });
  /** Those of `size` numbers a grain that stand at `places`. */
  const picked = (data, places, size) => {
    const out = new data.constructor(places.length * size);
    places.forEach((place, i) => { for (let c = 0; c < size; c++) out[size * i + c] = data[size * place + c]; });
    return out;
  };
  const shorts = (text) => new Uint16Array(bytes(text).buffer);
  /** Buffers of two frames for the grains in both. */
  const pairOf = (first, second, q) => {
    const at = both(first, second);
    const sort = sortOf(q);
    if (sort) {
      const of = once(`kinds ${q}`, () => bytes(sort.of));
      const pair = pairOf(first, second, bed.quantities[0].key);
      const kinds = at ? once(`kinds ${q} ${first} ${second}`, () => buffer(picked(of, at.all, 1))) : once(`all ${q}`, () => buffer(of));
      return { ...pair, levels: [kinds, kinds] };
    }
    if (!at) {
      return {
        count: Math.min(bed.frames[first].count, bed.frames[second].count), radius: radii,
        before: centresOf(first), after: centresOf(second), levels: [levelsOf(first, q), levelsOf(second, q)],
      };
    }
    const key = `${first} ${second}`;
    const centres = (k, places, name) => once(`${name} ${key}`, () => buffer(picked(shorts(bed.frames[k].centres), places, 3)));
    const levels = (k, places, name) => once(`${name} ${q} ${key}`, () => buffer(picked(bytes(bed.frames[k].levels[q]), places, 1)));
    return {
      count: at.all.length,
      radius: once(`radius ${key}`, () => buffer(picked(floats(bed.radii), at.all, 1))),
      before: centres(first, at.first, "before"), after: centres(second, at.second, "after"),
      levels: [levels(first, at.first, "from"), levels(second, at.second, "to")],
    };
  };

  // ---- programs ---------------------------------------------------------------------------------------------
  const compile = (vertex, fragment) => {
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, `#version 300 es\nprecision highp float;\n${text}`);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const at = {};
    const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
    for (let i = 0; i < count; i++) {
      const name = gl.getActiveUniform(program, i).name;
      at[name] = gl.getUniformLocation(program, name);
    }
    const input = (name) => gl.getAttribLocation(program, name);
    return { program, at, input };
  };
  const CAMERA = `
    uniform mat3 turn; uniform vec3 middle; uniform vec2 scale; uniform vec2 shift; uniform float range;
    vec3 seen(vec3 place) { return turn * (place - middle); }`;
  const grains = compile(`${CAMERA}
    uniform vec3 low; uniform vec3 size; uniform float part; uniform float cut;
    in vec2 corner; in vec3 before; in vec3 after; in float radius; in float levelBefore; in float levelAfter;
    out vec2 spot; out float level; out float wide; out float high;
    void main() {
      vec3 place = seen(low + size * mix(before, after, part));
      spot = corner; wide = radius; high = place.z; level = mix(levelBefore, levelAfter, part);
      gl_Position = vec4((place.xy + corner * radius) * scale + shift, 0.0, 1.0);
      if (place.z > cut) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    }`, `
    uniform sampler2D colours; uniform float range;
    in vec2 spot; in float level; in float wide; in float high;
    out vec4 colour;
    void main() {
      float square = dot(spot, spot);
      if (square > 1.0) discard;
      vec3 normal = vec3(spot, sqrt(1.0 - square));
      gl_FragDepth = 0.5 - 0.5 * (high + normal.z * wide) / range;
      vec3 light = normalize(vec3(0.35, 0.6, 0.75));
      float lit = 0.4 + 0.6 * max(dot(normal, light), 0.0);
      float shine = 0.25 * pow(max(dot(normal, normalize(light + vec3(0.0, 0.0, 1.0))), 0.0), 40.0);
      vec3 own = texture(colours, vec2(level * 0.996 + 0.002, 0.5)).rgb;
      colour = vec4(1.3 * own * lit * mix(0.45, 1.0, smoothstep(0.0, 0.55, normal.z)) + shine, 1.0);
    }`);
  const solids = compile(`${CAMERA}
    uniform vec4 rotation; uniform vec3 translation; uniform float nearer;
    in vec3 corner;
    out vec3 place;
    void main() {
      vec3 turned = corner + 2.0 * cross(rotation.xyz, cross(rotation.xyz, corner) + rotation.w * corner);
      place = seen(turned + translation);
      gl_Position = vec4(place.xy * scale + shift, -place.z / range - nearer, 1.0);
    }`, `
    uniform vec3 tint; uniform vec2 glass; uniform float plain;
    in vec3 place;
    out vec4 colour;
    void main() {
      vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
      float facing = plain > 0.5 ? 1.0 : abs(normal.z);
      float opaque = glass.x + glass.y * pow(1.0 - facing, 2.0);
      colour = vec4(tint * (plain > 0.5 ? 1.0 : 0.55 + 0.45 * facing), opaque);
    }`);

  // ---- what does not change -----------------------------------------------------------------------------------
  const square = buffer(new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
  const radii = buffer(floats(bed.radii));
  const bodies = bed.bodies.map((body) => {
    const triangles = words(body.triangles), edges = words(body.edges);
    return {
      free: body.free,
      corners: buffer(floats(body.vertices)),
      triangles: buffer(triangles, gl.ELEMENT_ARRAY_BUFFER), faces: triangles.length,
      edges: buffer(edges, gl.ELEMENT_ARRAY_BUFFER), ends: edges.length,
    };
  });
  const sortOf = (key) => bed.sorts.find((sort) => sort.key === key);
  /** 256 colours: of the kinds one each, of all else a ramp. */
  const rampOf = (key) => once(`ramp ${key ? "kinds" : ""}`, () => {
    if (!key) return ramp;
    const made = new Uint8Array(256 * 4);
    for (let i = 0; i < 256; i++) {
      for (let c = 0; c < 3; c++) made[4 * i + c] = Math.round(255 * bed.kinds[i % bed.kinds.length][c]);
      made[4 * i + 3] = 255;
    }
    return made;
  });
  const paint = (key) => gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, rampOf(key));
  const ramp = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; i++) {
    const place = (i / 255) * (bed.colours.length - 1), low = Math.min(Math.floor(place), bed.colours.length - 2);
    for (let c = 0; c < 3; c++) {
      ramp[4 * i + c] = Math.round(255 * (bed.colours[low][c] + (place - low) * (bed.colours[low + 1][c] - bed.colours[low][c])));
    }
    ramp[4 * i + 3] = 255;
  }
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, ramp);
  for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
    [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) {
    gl.texParameteri(gl.TEXTURE_2D, name, value);
  }

  // ---- camera -------------------------------------------------------------------------------------------------
  const START = { yaw: -0.97, pitch: 0.36, zoom: 1, x: 0, y: 0 };
  let eye = { ...START };
  let now = bed.opens, fresh = true, playing = false, quantity = bed.quantities[0].key;
  const low = bed.view[0], high = bed.view[1];
  const middle = low.map((x, i) => 0.5 * (x + high[i]));
  const reach = 0.5 * Math.hypot(...high.map((x, i) => x - low[i])) || 1;
  const axes = () => {
    const [cy, sy, cp, sp] = [Math.cos(eye.yaw), Math.sin(eye.yaw), Math.cos(eye.pitch), Math.sin(eye.pitch)];
    return { right: [-sy, cy, 0], up: [-sp * cy, -sp * sy, cp], out: [cp * cy, cp * sy, sp] };
  };
  /** Half the size of the bed along an axis. */
  const half = (axis) => axis.reduce((sum, a, i) => sum + 0.5 * Math.abs(a) * (high[i] - low[i]), 0);
  const scaleOf = () => {
    const { right, up } = axes();
    const aspect = view.width / view.height;
    const fit = Math.max(half(up), half(right) / aspect) * 1.25 || reach;
    return [eye.zoom / (fit * aspect), eye.zoom / fit];
  };

  const camera = ({ at }) => {
    const { right, up, out } = axes();
    gl.uniformMatrix3fv(at.turn, false, [0, 1, 2].flatMap((i) => [right[i], up[i], out[i]]));
    gl.uniform3fv(at.middle, middle);
    gl.uniform2fv(at.scale, scaleOf());
    gl.uniform2f(at.shift, eye.x, eye.y);
    gl.uniform1f(at.range, 8 * reach);
  };
  const attribute = (at, data, size, kind, normal, every) => {
    if (at < 0) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, data);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, kind, normal, 0, 0);
    gl.vertexAttribDivisor(at, every);
  };

  const drawGrains = (first, second, part) => {
    const pair = pairOf(first, second, quantity);
    if (!pair.count) return;
    const { program, at, input } = grains;
    gl.useProgram(program);
    camera(grains);
    gl.uniform3fv(at.low, bed.low);
    gl.uniform3fv(at.size, bed.size);
    gl.uniform1f(at.part, part);
    const depth = half(axes().out) * 1.02;
    gl.uniform1f(at.cut, $("cut").value > 0 ? depth - 0.02 * $("cut").value * depth : 1e30);
    attribute(input("corner"), square, 2, gl.FLOAT, false, 0);
    attribute(input("before"), pair.before, 3, gl.UNSIGNED_SHORT, true, 1);
    attribute(input("after"), pair.after, 3, gl.UNSIGNED_SHORT, true, 1);
    attribute(input("radius"), pair.radius, 1, gl.FLOAT, false, 1);
    attribute(input("levelBefore"), pair.levels[0], 1, gl.UNSIGNED_BYTE, true, 1);
    attribute(input("levelAfter"), pair.levels[1], 1, gl.UNSIGNED_BYTE, true, 1);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, pair.count);
    for (const name of ["before", "after", "radius", "levelBefore", "levelAfter"]) {
      gl.vertexAttribDivisor(input(name), 0);
      gl.disableVertexAttribArray(input(name));
    }
  };

  /** Place and orientation of a body between two frames. */
  const poseOf = (body, first, second, part) => {
    const pose = (k) => bed.frames[k].poses.slice(7 * body, 7 * body + 7);
    const [a, b] = [pose(first), pose(second)];
    const same = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6] < 0 ? -1 : 1;
    const mixed = a.map((x, i) => x + part * ((i > 2 ? same : 1) * b[i] - x));
    const length = Math.hypot(...mixed.slice(3)) || 1;
    return { translation: mixed.slice(0, 3), rotation: mixed.slice(3).map((q) => q / length) };
  };

  const FACES = 1, EDGES = 2;
  const drawBodies = (first, second, part, opaque, what) => {
    const { program, at, input } = solids;
    gl.useProgram(program);
    camera(solids);
    const ink = getComputedStyle(document.body).color.match(/[\d.]+/g).slice(0, 3).map((c) => c / 255);
    bodies.forEach((body, index) => {
      if (body.free !== opaque || bed.frames[first].gone.includes(index)) return;
      const { translation, rotation } = poseOf(index, first, second, part);
      gl.uniform3fv(at.translation, translation);
      gl.uniform4fv(at.rotation, rotation);
      attribute(input("corner"), body.corners, 3, gl.FLOAT, false, 0);
      gl.depthMask(opaque);
      gl.uniform1f(at.plain, 0);
      gl.uniform1f(at.nearer, 0);
      gl.uniform3fv(at.tint, opaque ? [0.55, 0.63, 0.72] : ink.map((c) => 0.5 * c + 0.25));
      gl.uniform2f(at.glass, opaque ? 1 : 0.045, opaque ? 0 : 0.12);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, body.triangles);
      if (what & FACES) gl.drawElements(gl.TRIANGLES, body.faces, gl.UNSIGNED_INT, 0);
      gl.uniform1f(at.plain, 1);
      gl.uniform1f(at.nearer, 1e-4);
      gl.uniform3fv(at.tint, ink);
      gl.uniform2f(at.glass, 0.45, 0);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, body.edges);
      if (what & EDGES) gl.drawElements(gl.LINES, body.ends, gl.UNSIGNED_INT, 0);
    });
    gl.depthMask(true);
  };

  const draw = () => {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [Math.round(view.clientWidth * ratio), Math.round(view.clientHeight * ratio)];
    if (view.width !== width || view.height !== height) [view.width, view.height] = [width, height];
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const first = Math.min(Math.floor(now), bed.frames.length - 1);
    const second = Math.min(first + 1, bed.frames.length - 1), part = now - first;
    const shown = $("bodies").checked;
    // walls first: grains cover them, so that nothing tints a colour
    if (shown) drawBodies(first, second, part, false, FACES);
    if (shown) drawBodies(first, second, part, true, FACES | EDGES);
    drawGrains(first, second, part);
    if (shown) drawBodies(first, second, part, false, EDGES);
    tell(first, second, part);
    ruler();
  };
  let waiting = false;
  const redraw = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; draw(); });
  };

  // ---- words and numbers ----------------------------------------------------------------------------------------
  const number = (value, unit) => {
    if (value === 0) return `0 ${unit}`;
    const power = Math.max(-5, Math.min(3, Math.floor(Math.log10(Math.abs(value)) / 3)));
    const prefix = ["f", "p", "n", "µ", "m", "", "k", "M", "G"][power + 5];
    return `${Number((value / 1000 ** power).toPrecision(3))} ${prefix}${unit}`;
  };
  const tell = (first, second, part) => {
    const [a, b] = [bed.frames[first], bed.frames[second]];
    $("frame").value = String(Math.round(now));
    $("clock").textContent = `${number(a.time + part * (b.time - a.time), "s")} · ${a.stage}`;
  };
  /** Scale bar: a round length, about a fifth of the view. */
  const ruler = () => {
    const perMetre = 0.5 * scaleOf()[0] * view.clientWidth;
    const most = (0.2 * view.clientWidth) / perMetre, power = 10 ** Math.floor(Math.log10(most));
    const length = power * [5, 2, 1].find((step) => step * power <= most);
    $("bar").style.width = `${length * perMetre}px`;
    $("length").textContent = number(length, "m");
  };
  const legend = () => {
    const sort = sortOf(quantity);
    paint(sort && sort.key);
    const chosen = sort || bed.quantities.find((q) => q.key === quantity);
    $("quantity").textContent = chosen.label;
    $("scale").hidden = Boolean(sort);
    if (sort) {
      $("ticks").replaceChildren(...sort.names.map((name, i) => {
        const tick = document.createElement("span");
        const [r, g, b] = bed.kinds[i % bed.kinds.length].map((c) => Math.round(255 * c));
        const patch = document.createElement("i");
        patch.style.cssText = `display:inline-block;width:.8em;height:.8em;margin-right:.3em;background:rgb(${r} ${g} ${b})`;
        tick.append(patch, name);
        return tick;
      }));
      return;
    }
    const pen = $("scale").getContext("2d");
    for (let x = 0; x < 208; x++) {
      const i = 4 * Math.round((255 * x) / 207);
      pen.fillStyle = `rgb(${ramp[i]} ${ramp[i + 1]} ${ramp[i + 2]})`;
      pen.fillRect(x, 0, 1, 12);
    }
    const ticks = [];
    for (let d = bed.decades; d >= 0; d--) ticks.push(chosen.most / 10 ** d);
    $("ticks").replaceChildren(...ticks.map((value) => {
      const tick = document.createElement("span");
      tick.textContent = number(value, chosen.unit);
      return tick;
    }));
  };

  // ---- controls -----------------------------------------------------------------------------------------------
  const LAST = bed.frames.length - 1;
  const SECONDS = Math.max(6, Math.min(20, LAST / 8));
  $("frame").max = String(LAST);
  for (const { key, name } of bed.quantities) $("colour").add(new Option(name, key));
  for (const { key } of bed.sorts) $("colour").add(new Option(key, key));
  $("frame").addEventListener("input", () => { play(false); fresh = false; now = Number($("frame").value); redraw(); });
  $("colour").addEventListener("change", () => { quantity = $("colour").value; legend(); redraw(); });
  for (const id of ["cut", "bodies"]) $(id).addEventListener("input", redraw);
  $("reset").addEventListener("click", () => { eye = { ...START }; $("cut").value = "0"; redraw(); });
  let clock = null;
  const run = (time) => {
    if (!playing) return;
    now = Math.min(LAST, now + ((time - (clock ?? time)) / 1000) * (LAST / SECONDS));
    clock = time;
    draw();
    if (now >= LAST) return play(false);
    requestAnimationFrame(run);
  };
  const play = (on) => {
    if (on === playing) return;
    playing = on;
    $("play").textContent = on ? "Pause" : "Play";
    if (!on) return;
    if (fresh || now >= LAST) now = 0;
    fresh = false;
    clock = null;
    requestAnimationFrame(run);
  };
  $("play").addEventListener("click", () => play(!playing));
  const turn = (x, y) => {
    eye.yaw -= x;
    eye.pitch = Math.max(-1.57, Math.min(1.57, eye.pitch + y));
    redraw();
  };
  const zoom = (factor) => { eye.zoom = Math.max(0.2, Math.min(60, eye.zoom * factor)); redraw(); };
  document.addEventListener("keydown", (event) => {
    if (event.target.matches("input, select, button")) return;
    const step = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    if (step) turn(...step);
    else if (event.key === " ") play(!playing);
    else if (event.key === "+") zoom(1.2);
    else if (event.key === "-") zoom(1 / 1.2);
    else return;
    event.preventDefault();
  });
  const fingers = new Map();
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return { distance: Math.hypot(a.x - b.x, a.y - b.y), x: 0.5 * (a.x + b.x), y: 0.5 * (a.y + b.y) };
  };
  const move = (x, y) => {
    eye.x += (2 * x) / view.clientWidth;
    eye.y -= (2 * y) / view.clientHeight;
    redraw();
  };
  view.addEventListener("pointerdown", (event) => {
    view.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  view.addEventListener("pointermove", (event) => {
    const finger = fingers.get(event.pointerId);
    if (!finger) return;
    const [x, y] = [event.clientX - finger.x, event.clientY - finger.y];
    const before = fingers.size === 2 ? spread() : null;
    [finger.x, finger.y] = [event.clientX, event.clientY];
    if (before) {
      const after = spread();
      zoom(after.distance / (before.distance || 1));
      move(after.x - before.x, after.y - before.y);
    } else if (event.shiftKey || event.buttons & 6) move(x, y);
    else turn(x * 0.008, y * 0.008);
  });
  for (const end of ["pointerup", "pointercancel"]) view.addEventListener(end, (event) => fingers.delete(event.pointerId));
  view.addEventListener("contextmenu", (event) => { if (event.shiftKey) event.preventDefault(); });
  view.addEventListener("wheel", (event) => { event.preventDefault(); zoom(Math.exp(-0.0015 * event.deltaY)); }, { passive: false });
  window.addEventListener("resize", redraw);
  // what stands above the controls, which take as many lines as the width asks for
  const controls = document.querySelector(".controls");
  new ResizeObserver(() => document.documentElement.style.setProperty("--low", `${controls.offsetHeight}px`)).observe(controls);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  legend();
  draw();
})();
